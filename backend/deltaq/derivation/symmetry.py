"""Symmetries by Noether's theorem, up to gauge terms and with forces that have no potential.

q → q + ε ξ(q, t), t → t + ε τ(t) is a symmetry if

    Σ ξᵢ (∂L/∂qᵢ + Qᵢᵈ) + Σ ξ̇ᵢ ∂L/∂q̇ᵢ + τ (∂L/∂t − Σ Qᵢᵈ q̇ᵢ) + τ̇ (L − Σ q̇ᵢ ∂L/∂q̇ᵢ) = dF/dt

for every q, q̇ and t with a function F(q, t). Then I = Σ ξᵢ ∂L/∂q̇ᵢ − τ h − F is constant along the motion. The
left side is linear in ξ and τ. So the coefficients of those that are affine in coordinates and time are the kernel of a
matrix; it is found in floats at random points, and each vector in it is then proved with symbols. For the search, the
left side must be linear in the rates, a·q̇ + b, and free of curl, ∂aᵢ/∂qₖ = ∂aₖ/∂qᵢ, ∂aᵢ/∂t = ∂b/∂qᵢ.
Source: Noether, Nachr. Ges. Wiss. Göttingen (1918) 235; Sarlet, Cantrijn, SIAM Review 23 (1981) 467; for forces without
potential Djukić, Vujanović, Acta Mechanica 23 (1975) 17.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, islice
from typing import Literal

import sympy as sp

from ..language.derivatives import diff
from ..language.fourier import TooLargeError
from ..language.memory import cached_method
from ..language.normal_form import Reader
from .antiderivative import antiderivative, is_finite
from .compiled import Function, compiled
from .conservation import cyclic, jacobi_energy, jacobi_energy_rate
from .elimination import Row, kernel
from .factoring import factor_list
from .generator import Generator, Kind, Monomial, Numeric, Symmetry, clock, forces, monomials, numeric, solved
from .space import displacements
from .system import System

MOST_OPERATIONS = 4000  # of L and the forces: beyond it nothing is tried
MOST_SUPPORT = 5  # coefficients that depend on parameters, to be solved for with symbols
MOST_POINTS = 8  # for what must not depend on parameters
SPARE = 3  # points more than there are unknowns
TRIES = 6  # random points for each that is wanted
STEP = 1e-3  # of central differences of fourth order, with these weights
WEIGHTS = {2: -1 / 12, 1: 8 / 12, -1: -8 / 12, -2: 1 / 12}
NEAR = 1e-6  # of a coefficient to a fraction
LARGEST_DENOMINATOR = 12
MOST = 12  # symmetries of one scene that are looked at closely

Values = Literal["any", "one", "own"]
VALUES: tuple[Values, ...] = ("any", "one", "own")


@cached_method
def symmetries(system: System) -> tuple[Symmetry, ...]:
    """Those whose integrals are no momentum of a cyclic coordinate, not h, and independent of these and one another.

    First what holds for all values of the parameters, then what needs those of the scene.
    """
    found: list[Symmetry] = []
    for symmetry in islice(_proved(system), MOST):
        known = [*integrals_of_the_lecture(system), *(each.value for each in found)]
        if is_independent(system, known, symmetry.value):
            found.append(symmetry)
    return tuple(found)


@cached_method
def integrals_of_the_lecture(system: System) -> tuple[sp.Expr, ...]:
    """The momenta of cyclic coordinates, and h where it is conserved."""
    momenta = [system.momentum(q) for q in cyclic(system)]
    return (*momenta, jacobi_energy(system)) if system.is_zero(jacobi_energy_rate(system)) else tuple(momenta)


def is_searched(system: System) -> bool:
    """Whether symmetries were looked for: not where the expressions are too long."""
    size = sum(expr.count_ops() for expr in (system.lagrangian, *map(system.nonconservative_force, system.free)))
    return bool(size <= MOST_OPERATIONS)


def _proved(system: System) -> Iterator[Symmetry]:
    """Every vector of the kernels that stands the proof, the simple ones first."""
    if not is_searched(system):
        return
    constant, generic, own = (Search(system, values) for values in VALUES)
    vectors = constant.kernel()
    for vector in sorted(vectors, key=constant.rank):
        if not constant.is_of_the_lecture(vector):
            yield from constant.proved(vector)
    others = generic.kernel()
    for vector in sorted(_new(others, vectors), key=generic.rank):
        yield from generic.proved(vector)
    for vector in sorted(_new(own.kernel(), others), key=own.rank):
        yield from (each for each in own.proved(vector) if each.conditions)


def _new(vectors: list[Row], known: list[Row]) -> list[Row]:
    """Those that are not among the known ones, where there are more of them at all."""

    def alike(one: Row, other: Row) -> bool:
        return all(abs(a - b) < NEAR for a, b in zip(one, other, strict=True))

    found = [vector for vector in vectors if not any(alike(vector, other) for other in known)]
    return found if len(vectors) > len(known) else []


@dataclass(frozen=True, eq=False)
class Search:
    """The linear equations for the coefficients of a generator, and their solutions.

    `values` of the parameters: `any` differ from point to point, so that the coefficients are numbers; `one` are
    random, so that the coefficients may depend on parameters; `own` are the scene's.
    """

    system: System
    values: Values

    @property
    def monomials(self) -> tuple[Monomial, ...]:
        """The unknowns."""
        return monomials(self.system)

    @property
    def numeric(self) -> Numeric:
        return numeric(self.system)

    def _moved(self, monomial: Monomial) -> Mapping[str, sp.Expr]:
        """ξ of space moved as a whole."""
        return displacements(self.system)[monomial.motion] if monomial.motion else {}

    def change(self, monomial: Monomial) -> sp.Expr:
        """The left side of Noether's condition for one monomial."""
        system, t = self.system, self.system.t
        match monomial.kind:
            case "shift":
                return forces(self.system)[monomial.moved]
            case "linear":
                q, speed = system.q(monomial.by), system.rate(monomial.by)
                return q * forces(self.system)[monomial.moved] + speed * system.momentum(monomial.moved)
            case "space":
                shifts = self._moved(monomial).items()
                parts = (
                    (forces(system)[q] * shift, system.momentum(q) * system.time_derivative(shift))
                    for q, shift in shifts
                )
                return sp.Add(*(one for pair in parts for one in pair))
            case "boost":
                return t * forces(self.system)[monomial.moved] + system.momentum(monomial.moved)
            case "time":
                return clock(self.system)
            case "scaling":
                work = sp.Add(*(system.momentum(q) * system.rate(q) for q in system.free))
                return t * clock(self.system) + system.lagrangian - work

    # In numbers: values are those of t, q, q̇ and the parameters, in this order.

    def kernel(self) -> list[Row]:
        """A basis of the coefficients."""
        scales = self._scales
        vectors = kernel(self._quadratic_rows(), scales)
        sizes = [sum(abs(c) * scale for c, scale in zip(vector, scales, strict=True)) for vector in vectors]
        rows = ([sum(map(_times, row, vector)) for vector in vectors] for row in self._curl_rows(vectors))
        return _tidied([_combined(weights, vectors) for weights in kernel(rows, sizes)])

    @cached_property
    def _scales(self) -> Row:
        """The size of what each monomial changes."""
        rows = [self.numeric.sizes(values) for values in self._points(SPARE)]
        return [max((row[k] for row in rows), default=0.0) for k in range(len(self.monomials))]

    def _quadratic_rows(self) -> Iterator[Row]:
        """W(q̇ + u) + W(q̇ − u) − 2 W(q̇), which is zero if W is linear in the rates."""
        n = len(self.system.free)
        source = random.Random(2)
        for values in self._points(len(self.monomials) + SPARE):
            nudge = [source.uniform(-1, 1) for _ in range(n)]
            ahead, here, behind = (self.numeric.row(_pushed(values, nudge, way, n)) for way in (1, 0, -1))
            yield [a + b - 2 * c for a, b, c in zip(ahead, behind, here, strict=True)]

    def _curl_rows(self, vectors: list[Row]) -> Iterator[Row]:
        """∂aᵢ/∂t − ∂b/∂qᵢ and ∂aᵢ/∂qₖ − ∂aₖ/∂qᵢ, for W = a·q̇ + b."""
        n = len(self.system.free)
        enough = len(vectors) // max(1, n * (n + 1) // 2) + 2
        if self.values == "any":  # a point says nothing of other values of the parameters
            enough = max(enough, min(len(vectors) + 1, MOST_POINTS))
        for values in self._points(enough) if vectors else ():
            slopes = [self._slopes(values, place) for place in range(n + 1)]  # by t, then by each q
            for i in range(n):
                yield [a - b for a, b in zip(slopes[0][i + 1], slopes[i + 1][0], strict=True)]
            for i, k in combinations(range(n), 2):
                yield [a - b for a, b in zip(slopes[k + 1][i + 1], slopes[i + 1][k + 1], strict=True)]

    def _slopes(self, values: Row, place: int) -> list[Row]:
        """∂/∂(t or q) of b, a₁, a₂ …, by differences of fourth order."""
        found = {}
        for steps in WEIGHTS:
            moved = list(values)
            moved[place] += steps * STEP
            found[steps] = self._parts(moved)
        return [
            [sum(map(_times, WEIGHTS.values(), entries)) / STEP for entries in zip(*rows, strict=True)]
            for rows in zip(*(found[steps] for steps in WEIGHTS), strict=True)
        ]

    def _parts(self, values: Row) -> list[Row]:
        """b and a₁, a₂ … of W = a·q̇ + b at a point."""
        n = len(self.system.free)
        still = [*values[: n + 1], *[0.0] * n, *values[2 * n + 1 :]]
        rest = self.numeric.row(still)
        rows = [rest]
        for i in range(n):
            moving = list(still)
            moving[n + 1 + i] = 1.0
            rows.append([a - b for a, b in zip(self.numeric.row(moving), rest, strict=True)])
        return rows

    def _points(self, count: int) -> Iterator[Row]:
        """Random t, q and q̇ with the parameters, where all is defined."""
        found = map(self._point, range(TRIES * count))
        return islice((p for p in found if all(map(math.isfinite, self.numeric.row(p)))), count)

    def _point(self, number: int) -> Row:
        source = random.Random(number)
        moving = [source.uniform(0.3, 1.7) for _ in range(2 * len(self.system.free) + 1)]
        own = [float(value) for value in self.system.parameter_values.values()]
        if self.values == "own":
            return [*moving, *own]
        if self.values == "one":
            source = random.Random(self.system.scene.id)
        even = [source.uniform(0.5, 1.5) for _ in own]
        near = [value * source.uniform(0.7, 1.3) or entry for value, entry in zip(own, even, strict=True)]
        return [*moving, *(near if number % 3 == 2 and self.values == "any" else even)]

    # With symbols.

    def rank(self, vector: Row) -> tuple[int, int]:
        """Shifts and turns, then the time, then what holds t explicitly; few coordinates first."""
        kinds = [monomial.kind for monomial, entry in zip(self.monomials, vector, strict=True) if entry]
        order: tuple[Kind, ...] = ("shift", "linear", "space", "time", "boost", "scaling")
        return max(map(order.index, kinds)), len(kinds)

    def is_of_the_lecture(self, vector: Row) -> bool:
        """Whether it shifts a cyclic coordinate, or the time where h is conserved."""
        support = [monomial for monomial, entry in zip(self.monomials, vector, strict=True) if entry]
        if len(support) > 1:
            return False
        if support[0].kind == "shift":
            return support[0].moved in cyclic(self.system)
        return support[0].kind == "time" and self.system.is_zero(jacobi_energy_rate(self.system))

    def proved(self, vector: Row) -> Iterator[Symmetry]:
        """The symmetry that the vector stands for, if its condition is an identity; for `own`, where it is one."""
        coefficients = self._exact(vector)
        if coefficients is None:
            return
        change = sp.Add(*(c * self.change(monomial) for monomial, c in coefficients.items()))
        conditions = self._conditions(change) if self.values == "own" else ()
        if conditions is None:
            return
        special = solved(conditions, self.system)
        gauge = self._gauge(change.xreplace(special))
        if gauge is not None:
            generator = self._generator(coefficients)
            value = self._integral(generator, gauge).xreplace(special)
            yield Symmetry(generator, gauge, value, conditions)

    def _generator(self, coefficients: Mapping[Monomial, sp.Expr]) -> Generator:
        system = self.system
        factors = {"shift": system.zero + 1, "boost": system.t, "time": system.zero + 1, "scaling": system.t}
        shifts: dict[str, sp.Expr] = {}
        time = system.zero
        for monomial, coefficient in coefficients.items():
            if monomial.kind == "space":
                for q, shift in self._moved(monomial).items():
                    shifts[q] = shifts.get(q, system.zero) + coefficient * shift
                continue
            part = coefficient * (factors.get(monomial.kind) or system.q(monomial.by))
            if monomial.moved:
                shifts[monomial.moved] = shifts.get(monomial.moved, system.zero) + part
            else:
                time += part
        return Generator({q: shifts[q] for q in system.free if shifts.get(q, 0) != 0}, time)

    def _integral(self, generator: Generator, gauge: sp.Expr) -> sp.Expr:
        system = self.system
        moved = sp.Add(*(shift * system.momentum(q) for q, shift in generator.shifts.items()))
        return system.display(moved - generator.time * jacobi_energy(system) - gauge)

    def _exact(self, vector: Row) -> dict[Monomial, sp.Expr] | None:
        """The coefficients as whole numbers, or for `one` as functions of the parameters; None if neither is found."""
        support = [k for k, entry in enumerate(vector) if entry]
        if self.values == "one":
            return self._in_parameters(support)
        fractions = [Fraction(vector[k]).limit_denominator(LARGEST_DENOMINATOR) for k in support]
        if any(abs(f - vector[k]) > NEAR * (1 + abs(vector[k])) for f, k in zip(fractions, support, strict=True)):
            return None
        whole = math.lcm(*(f.denominator for f in fractions)) * (1 if self._is_upright(support, vector) else -1)
        return {self.monomials[k]: sp.Integer(int(f * whole)) for f, k in zip(fractions, support, strict=True)}

    def _is_upright(self, support: Sequence[int], vector: Row) -> bool:
        """Whether a shift is forwards; a rotation counts from one coordinate to the next, δx = −ε y."""
        first = self.monomials[support[0]]
        return (vector[support[0]] < 0) is (first.kind == "linear" and first.moved != first.by)

    def _in_parameters(self, support: Sequence[int]) -> dict[Monomial, sp.Expr] | None:
        """One coefficient is 1, the others solve the equations that the condition's terms are."""
        if len(support) > MOST_SUPPORT:
            return None
        *unknown, last = (sp.Dummy(f"c{k}", real=True) for k in support)
        named = dict(zip([self.monomials[k] for k in support], [*unknown, last], strict=True))
        change = sp.Add(*(c * self.change(monomial) for monomial, c in named.items()))
        equations = self._equations(change)
        if equations is None:
            return None
        answers = sp.solve([e.xreplace({last: sp.Integer(1)}) for e in equations], unknown, dict=True)
        if len(answers) != 1 or set(answers[0]) != set(unknown):
            return None
        values = {**answers[0], last: sp.Integer(1)}
        return {monomial: self.system.display(values[c]) for monomial, c in named.items()}

    def _conditions(self, change: sp.Expr) -> tuple[sp.Expr, ...] | None:
        """What must be zero for a generator to be a symmetry; it must be so at the scene's values."""
        equations = self._equations(change)
        if equations is None:
            return None
        found = dict.fromkeys(_without_units(factor, self.system) for factor in equations)
        own = dict(self.system.parameter_values)
        return tuple(found) if all(each.xreplace(own) == 0 for each in found) else None

    def _equations(self, change: sp.Expr) -> list[sp.Expr] | None:
        """The coefficients, by what moves, of all that must vanish for the change to be dF/dt."""
        try:
            return [e for part in self._residuals(change) for e in self._by_motion(part)]
        except (TooLargeError, ZeroDivisionError):
            return None

    def _residuals(self, change: sp.Expr) -> Iterator[sp.Expr]:
        system = self.system
        rates, places = [system.rate(q) for q in system.free], [system.q(q) for q in system.free]
        still = dict.fromkeys(rates, system.zero)
        slopes = [diff(change, rate) for rate in rates]
        rest = change.xreplace(still)
        for i, slope in enumerate(slopes):
            yield from (diff(slope, rate) for rate in rates[i:])
            yield diff(slope, system.t) - diff(rest, places[i])
            yield from (diff(slope, q) - diff(slopes[k], places[i]) for k, q in list(enumerate(places))[i + 1 :])

    def _by_motion(self, part: sp.Expr) -> Iterator[sp.Expr]:
        """The numerator's coefficient of every product of what moves; each is a function of parameters."""
        reader = Reader()
        numerator, _ = reader.cleared(reader.form(part))
        moving = {self.system.t, *map(self.system.q, self.system.free), *map(self.system.rate, self.system.free)}
        groups: dict[object, list[sp.Expr]] = {}
        for (mono, phase, sine), number in numerator.items():
            still = tuple(p for p in mono if not reader.monomial((p,)).free_symbols & moving)
            key = (tuple(p for p in mono if p not in still), phase, sine)
            groups.setdefault(key, []).append(reader.expression({(still, (), False): number}))
        yield from (sp.Add(*terms) for terms in groups.values())

    def _gauge(self, change: sp.Expr) -> sp.Expr | None:
        """F with dF/dt = change for every motion; None where there is none that can be written down."""
        system = self.system
        if system.is_zero(change):
            return system.zero
        still = system.zero_rates
        slopes = {system.t: change.xreplace(still)} | {
            system.q(q): diff(change, system.rate(q)).xreplace(still) for q in system.free
        }
        slopes = {x: system.zero if system.is_zero(slope) else system.display(slope) for x, slope in slopes.items()}
        for start in (0, 1):
            gauge = _line_integral(system, slopes, sp.Integer(start))
            if gauge is not None and system.is_zero(change - system.time_derivative(gauge)):
                return system.display(gauge)
        return None


def is_independent(system: System, known: Sequence[sp.Expr], value: sp.Expr) -> bool:
    """Whether the value is no function of the known ones and t: the rank of the slopes by q and q̇ rises."""
    moving = [*map(system.q, system.free), *map(system.rate, system.free)]
    symbols = [*moving, system.t, *system.parameter_values]
    slots = {symbol: slot for slot, symbol in enumerate(symbols)}
    functions = [compiled(expr, slots) for expr in (*known, value)]
    for seed in range(TRIES):
        source = random.Random(seed)
        point = [source.uniform(0.3, 1.7) for _ in symbols]
        rows = [[_slope(function, point, place) for place in range(len(moving))] for function in functions]
        if all(math.isfinite(entry) for row in rows for entry in row):
            return _rank(rows) > _rank(rows[:-1])
    return False


def _slope(function: Function, point: Row, place: int) -> float:
    """The partial derivative, by a difference of fourth order."""
    total = 0.0
    for steps, weight in WEIGHTS.items():
        moved = list(point)
        moved[place] += steps * STEP
        total += weight * function(moved)
    return total / STEP


def _rank(rows: list[Row]) -> int:
    """Of the rows, each scaled to length 1: the unknown coefficients of their dependences."""
    scaled = [[entry / (math.hypot(*row) or 1.0) for entry in row] for row in rows]
    columns = [list(column) for column in zip(*scaled, strict=True)]
    return len(rows) - len(kernel(columns, [1.0] * len(rows)))


def _line_integral(system: System, slopes: Mapping[sp.Symbol, sp.Expr], start: sp.Expr) -> sp.Expr | None:
    """The function whose partial derivatives are the slopes, less what is constant."""
    total, later = system.zero, dict.fromkeys(slopes, start)
    for q, slope in slopes.items():
        del later[q]
        value = slope.xreplace(later)
        integral = antiderivative(value, q, system.symbols) if value != 0 else system.zero
        if integral is None:
            return None
        total += integral
    if not is_finite(total):
        return None
    return sp.Add(*(term for term in sp.Add.make_args(total.expand()) if term.free_symbols & slopes.keys()))


def _tidied(vectors: list[Row]) -> list[Row]:
    """A basis of the same space in reduced form: the kernel of all equations that the vectors fulfil."""
    ones = [1.0] * len(vectors[0]) if vectors else []
    return kernel(kernel(vectors, ones), ones)


def _combined(weights: Row, vectors: list[Row]) -> Row:
    return [sum(w * vector[k] for w, vector in zip(weights, vectors, strict=True)) for k in range(len(vectors[0]))]


def _pushed(values: Row, nudge: Row, way: int, n: int) -> Row:
    rates = [speed + way * step for speed, step in zip(values[n + 1 : 2 * n + 1], nudge, strict=True)]
    return [*values[: n + 1], *rates, *values[2 * n + 1 :]]


def _times(a: float, b: float) -> float:
    return a * b


def _without_units(condition: sp.Expr, system: System) -> sp.Expr:
    """The condition without number and factors that the scene says are not zero: k₁ − k₂ of 2 m (k₁ − k₂)."""
    positive = {system.q(p.name) for p in system.scene.parameters if p.positive}
    _, factors = factor_list(sp.fraction(sp.together(condition))[0])
    own = dict(system.parameter_values)
    kept = [base for base, _ in factors if base not in positive and base.xreplace(own) == 0]
    return sp.Mul(*kept) if kept else condition
