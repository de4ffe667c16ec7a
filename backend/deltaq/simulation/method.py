"""Time integrators as data."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

Row = tuple[Fraction, ...]


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

    @property
    def stages(self) -> int:
        return len(self.b)


@dataclass(frozen=True)
class Method:
    """A method of the explicit Runge–Kutta family.

    `order` is that of the values returned, `error_order` the power of h with which the error estimate vanishes, and
    `memory` the exponent β of the PI step control (Hairer, Nørsett, Wanner I, IV.2).
    """

    id: str
    order: int
    tableau: Tableau
    error_order: int = 0
    memory: float = 0.0
    family: str = field(default="explicit-runge-kutta", init=False)
    is_symplectic: bool = field(default=False, init=False)  # no explicit Runge–Kutta method is

    def __hash__(self) -> int:
        return hash(self.id)  # the many fractions of a tableau take long

    @property
    def is_adaptive(self) -> bool:
        """Whether it has an embedded error estimate to choose its steps by."""
        return bool(self.tableau.error)

    @property
    def evaluations_per_step(self) -> int:
        """Right-hand sides per step; f(t + h, y₁) is the first stage of the next step."""
        return self.tableau.stages


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
