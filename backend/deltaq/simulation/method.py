"""Time integrators as data."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import ceil, isqrt, log

Row = tuple[Fraction, ...]
LEAST_ORDER = 4  # of a series
SHARE = 2.0 / 3.0  # of ln(1/ε) in the order of a series
NEGLIGIBLE = Fraction(1, 10**25)  # roots are given to 40 digits


@dataclass(frozen=True)
class Tableau:
    """An explicit Runge–Kutta method (Butcher tableau): kᵢ = f(t + cᵢ h, y + h Σ aᵢⱼ kⱼ), y₁ = y + h Σ bᵢ kᵢ.

    `error` are the weights of the embedded error estimates, over the stages and f(t + h, y₁), which counts as one more.
    `dense` are the weights of the method's own continuous extension beyond cubic Hermite interpolation; `extra_a` and
    `extra_c` are further stages that only this extension needs.
    """

    a: tuple[Row, ...]
    b: Row
    c: Row
    error: tuple[Row, ...] = ()
    dense: tuple[Row, ...] = ()
    extra_a: tuple[Row, ...] = ()
    extra_c: Row = ()
    family = "explicit-runge-kutta"
    is_symplectic = False  # no explicit Runge–Kutta method is
    is_symmetric = False

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """Once, for the many fractions take long."""
        return hash((self.a, self.b, self.c, self.error, self.dense))

    @property
    def stages(self) -> int:
        return len(self.b)


@dataclass(frozen=True)
class Partitioned:
    """A Runge–Kutta method for positions (a, b, c) and momenta (momentum_a and the same b).

    Qᵢ = q₀ + h Σ aᵢⱼ Vⱼ and p(Qᵢ, Vᵢ) = p₀ + h Σ âᵢⱼ ṗ(Qⱼ, Vⱼ). `error` are γ₀ and the weights of Yᵢ − y₀ in the error
    estimate. `kicks` and `drifts` say the same as a splitting, for scenes whose positions and momenta separate.
    """

    a: tuple[Row, ...]
    b: Row
    c: Row
    momentum_a: tuple[Row, ...]
    error: Row = ()
    kicks: Row = ()
    drifts: Row = ()
    family = "implicit-runge-kutta"

    @property
    def stages(self) -> int:
        return len(self.b)

    @property
    def is_symplectic(self) -> bool:
        """bᵢ âᵢⱼ + bⱼ aⱼᵢ = bᵢ bⱼ (Hairer, Lubich, Wanner, VI.4)."""
        b, places = self.b, range(self.stages)
        gaps = (b[i] * self.momentum_a[i][j] + b[j] * self.a[j][i] - b[i] * b[j] for i in places for j in places)
        return all(abs(gap) < NEGLIGIBLE for gap in gaps)

    @property
    def is_symmetric(self) -> bool:
        """aᵢⱼ plus its mirror image is bⱼ, for positions and momenta: a step back undoes a step (V.2)."""
        places, tables = range(self.stages), (self.a, self.momentum_a)
        gaps = (a[i][j] + a[-1 - i][-1 - j] - self.b[j] for a in tables for i in places for j in places)
        return all(abs(gap) < NEGLIGIBLE for gap in gaps)


@dataclass(frozen=True)
class Newmark:
    """Newmark's method with its two parameters (see `kernels.newmark_step`)."""

    beta: Fraction
    gamma: Fraction
    stages = 1
    error: Row = ()
    family = "newmark"
    is_symplectic = False  # it is conjugate to a symplectic method where M is constant, no more

    @property
    def is_symmetric(self) -> bool:
        """Whether a step back undoes a step: the average acceleration method alone."""
        return (self.beta, self.gamma) == (Fraction(1, 4), Fraction(1, 2))


@dataclass(frozen=True)
class Series:
    """Taylor's series of the motion: of this order with steps that are given, of one by the tolerance with others.

    Each order counts as a stage, since each asks all operations of the right-hand side for one more coefficient.
    """

    order: int
    family = "taylor-series"
    is_symplectic = False
    is_symmetric = False
    error: Row = (Fraction(1),)  # the last coefficients

    def __hash__(self) -> int:
        return self.order  # fractions take long

    @property
    def stages(self) -> int:
        return self.order

    def order_for(self, tolerance: float) -> int:
        """The order that takes least time for a local tolerance ε; the given one for none (0).

        A step grows as ε^(1/p). What it takes grew as p², were the sums all, which would make p = ½ ln(1/ε) the best;
        as far as it grows as p, that is ln(1/ε). In between lies ⅔ ln(1/ε).
        Source: À. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99–117, §3.1.
        """
        return self.order if tolerance == 0.0 else max(ceil(1.0 - SHARE * log(tolerance)), LEAST_ORDER)


Scheme = Tableau | Partitioned | Newmark | Series


@dataclass(frozen=True)
class Method:
    """A time integrator: its scheme, and what is known of it.

    `order` is that of the values returned, `error_order` the power of h with which the error estimate vanishes, and
    `memory` the exponent β of the PI step control (Hairer, Nørsett, Wanner I, IV.2).
    """

    id: str
    order: int
    scheme: Scheme
    error_order: int = 0
    memory: float = 0.0

    def __hash__(self) -> int:
        return hash(self.id)  # the many fractions of a tableau take long

    @property
    def family(self) -> str:
        return self.scheme.family

    @property
    def is_symplectic(self) -> bool:
        return self.scheme.is_symplectic

    @property
    def is_symmetric(self) -> bool:
        """Whether a step back undoes a step."""
        return self.scheme.is_symmetric

    @property
    def is_adaptive(self) -> bool:
        """Whether it has an embedded error estimate to choose its steps by."""
        return bool(self.scheme.error)

    @property
    def is_explicit(self) -> bool:
        return isinstance(self.scheme, Tableau | Series)


def discrete_action(a: tuple[Row, ...], b: Row, c: Row) -> Partitioned:
    """The method that makes the discrete action h Σ bᵢ L(Qᵢ, Vᵢ, t + cᵢh) stationary, Qᵢ = q₀ + h Σ aᵢⱼ Vⱼ.

    Its first variation with the end q₁ = q₀ + h Σ bⱼ Vⱼ held gives the discrete Euler–Lagrange equations; in momenta
    they read p(Qᵢ, Vᵢ) = p₀ + h Σ âᵢⱼ ṗⱼ with âᵢⱼ = bⱼ − bⱼ aⱼᵢ / bᵢ. Forces without potential enter by their discrete
    virtual work h Σ bᵢ Q(Qᵢ, Vᵢ)·δQᵢ, with the same weights. Every such method is symplectic.
    Source: J. E. Marsden, M. West, Acta Numerica 10 (2001) 357–514, §2.6.5, §3.2.
    """
    places = range(len(b))
    momentum_a = tuple(tuple(b[j] - b[j] * a[j][i] / b[i] for j in places) for i in places)
    return Partitioned(a, b, c, momentum_a)


def root(number: int) -> Fraction:
    """The square root, to 40 digits."""
    return Fraction(isqrt(number * 10**80), 10**40)


def rows(text: str) -> tuple[Row, ...]:
    """A table of numbers, one row per line: `1/5`, `3/40 9/40`, …; a lone `-` is an empty row."""
    lines = (line.split() for line in text.strip().splitlines())
    return tuple(tuple(Fraction(number) for number in line if number != "-") for line in lines)


def row(text: str) -> Row:
    """Numbers in one row, over as many lines as they need."""
    return tuple(Fraction(number) for number in text.split())


def sparse(text: str, width: int) -> Row:
    """A row of `width` numbers given by the places (from 1) of those that are not zero: `1 0.5  3 -2/3`."""
    words = text.split()
    given = {int(place): Fraction(number) for place, number in zip(words[::2], words[1::2], strict=True)}
    return tuple(given.get(place, Fraction(0)) for place in range(1, width + 1))
