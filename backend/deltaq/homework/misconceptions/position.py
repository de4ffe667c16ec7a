"""Mistakes in the position r(q, t): axes, directions, angles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Self

import sympy as sp

from ...derivation.calculus import V
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class CoordinateDirection(FaultySolution):
    """A coordinate is counted in the opposite direction.

    The arrow of the coordinate in the drawing is not looked at: the angle is turned the other way, the length
    measured the other way.
    """

    id: ClassVar[str] = "coordinate-direction"
    likely: ClassVar[int] = 3
    evident: ClassVar[frozenset[str] | None] = frozenset()

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        yield from (cls(true.scene, true, q) for q in true.free)

    def position(self, place: str) -> sp.ImmutableMatrix:
        q = self.q(self.about)
        return super().position(place).xreplace({q: -q})

    def kept(self, source: str) -> sp.Expr:
        q, rate = self.q(self.about), self.rate(self.about)
        return super().kept(source).xreplace({q: -q, rate: -rate})


@dataclass(frozen=True, eq=False)
class RelativeAngle(FaultySolution):
    """An absolute angle is taken as an angle relative to the body before, so that angles add up.

    The drawing counts each angle from the vertical; joints suggest counting from the previous link.
    """

    id: ClassVar[str] = "relative-angle"
    likely: ClassVar[int] = 3
    evident: ClassVar[frozenset[str] | None] = frozenset({"position"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        angles = [c.name for c in true.scene.free if c.unit in ("rad", "deg")]
        yield from (cls(true.scene, true, f"{one}/{other}") for one, other in pairwise(angles))

    def position(self, place: str) -> sp.ImmutableMatrix:
        first, second = map(self.q, self.about.split("/"))
        return super().position(place).xreplace({second: first + second})

    def kept(self, source: str) -> sp.Expr:
        first, second = self.about.split("/")
        sums = {part(second): part(first) + part(second) for part in (self.q, self.rate)}
        return super().kept(source).xreplace(sums)


@dataclass(frozen=True, eq=False)
class SineCosineSwapped(FaultySolution):
    """Sine and cosine are swapped in the position.

    Polar coordinates are written down from memory, without looking at the axis from which the angle is counted.
    """

    id: ClassVar[str] = "sine-cosine-swapped"
    likely: ClassVar[int] = 2
    evident: ClassVar[frozenset[str] | None] = frozenset({"position", "potential-energy"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        yield from (cls(true.scene, true, q) for q in true.free)

    def position(self, place: str) -> sp.ImmutableMatrix:
        return swapped(super().position(place), self.q(self.about))

    def kept(self, source: str) -> sp.Expr:
        return swapped(super().kept(source), self.q(self.about))


def swapped(value: V, coordinate: sp.Symbol) -> V:
    """Sine for cosine and cosine for sine, wherever the coordinate is in the argument."""
    found = [f for f in value.atoms(sp.sin, sp.cos) if f.has(coordinate)]
    return value.xreplace({f: (sp.cos if isinstance(f, sp.sin) else sp.sin)(f.args[0]) for f in found})
