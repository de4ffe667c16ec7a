"""Mistakes in small motions: in the linearized equation and the eigenfrequency ω."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...derivation.calculus import V
from ...language.canonical import display
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class LinearizedTooEarly(FaultySolution):
    """The position is linearized before the energies are formed.

    sin φ ≈ φ and cos φ ≈ 1 are put in at once; the potential needs the second order: its force is lost.
    """

    id: ClassVar[str] = "linearized-too-early"
    likely: ClassVar[int] = 2
    evident: ClassVar[frozenset[str] | None] = frozenset()

    def position(self, place: str) -> sp.ImmutableMatrix:
        return _with_small_angles(super().position(place), self)


@dataclass(frozen=True, eq=False)
class EquationLinearized(FaultySolution):
    """The linearized equation is given where the full one is asked for.

    The small-angle form is the one remembered from school.
    """

    id: ClassVar[str] = "equation-linearized"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"function", "name"})

    def equation(self, coordinate: str) -> sp.Expr:
        return _with_small_angles(display(super().equation(coordinate), self.symbols), self)

    def linear_equation(self, coordinate: str) -> sp.Expr:
        return self.true.linear_equation(coordinate)


@dataclass(frozen=True, eq=False)
class NotLinearized(FaultySolution):
    """The full equation is given where the linearized one is asked for.

    The last step, sin φ ≈ φ and products of small quantities dropped, has not been taken.
    """

    id: ClassVar[str] = "not-linearized"
    likely: ClassVar[int] = 1

    def linear_equation(self, coordinate: str) -> sp.Expr:
        return self.equation(coordinate)


@dataclass(frozen=True, eq=False)
class FrequencyWithoutRoot(FaultySolution):
    """The eigenfrequency is given without the square root.

    k/m is what stands in the equation, and it is ω², not ω.
    """

    id: ClassVar[str] = "frequency-without-root"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(omega**2 for omega in self.true.frequencies)


@dataclass(frozen=True, eq=False)
class FrequencyInverted(FaultySolution):
    """The eigenfrequency is upside down: √(m/k) instead of √(k/m).

    The formula of the period, T = 2π √(m/k), is mixed up with that of the frequency.
    """

    id: ClassVar[str] = "frequency-inverted"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(1 / omega for omega in self.true.frequencies)


@dataclass(frozen=True, eq=False)
class FrequencyInHertz(FaultySolution):
    """The frequency f = ω/2π is given where the circular frequency is asked for.

    Both are called frequency in everyday language.
    """

    id: ClassVar[str] = "frequency-in-hertz"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(omega / (2 * sp.pi) for omega in self.true.frequencies)


@dataclass(frozen=True, eq=False)
class PeriodForFrequency(FaultySolution):
    """The period T = 2π/ω is given where the circular frequency is asked for.

    The period is what one can see and count.
    """

    id: ClassVar[str] = "period-for-frequency"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(2 * sp.pi / omega for omega in self.true.frequencies)


def _with_small_angles(value: V, solution: Solution) -> V:
    """sin φ ≈ φ and cos φ ≈ 1 for the coordinates; the sines and cosines of the time are not small."""
    moving = {solution.q(q) for q in solution.free}
    waves = [f for f in value.atoms(sp.sin, sp.cos) if f.free_symbols & moving]
    return value.xreplace({f: f.args[0] if isinstance(f, sp.sin) else sp.Integer(1) for f in waves})
