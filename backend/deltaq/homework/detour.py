"""A road with one mistake in it: what a misconception is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import ClassVar, Self

import sympy as sp

from ..mechanics.bodies import Body
from ..mechanics.contributions import Contribution
from ..packages import classes_of
from .road import Road

PACKAGE = "deltaq.homework.misconceptions"
MOTION = ("position", "velocity")
FORCES = ("position", "virtual_displacement", "force", "energy", "dissipation", "moment", "angle", "virtual_work")


@dataclass(frozen=True, eq=False)
class Detour(Road):
    """The road as somebody walks it who gets one law wrong; everything after the mistake is derived rightly from it.

    `about` is what the mistake is made on (a load, a body, a coordinate), "" where there is nothing to choose.
    `likely` orders mistakes that lead to the same answer: the smaller comes first. What comes before the mistake is
    taken from the true road.
    """

    true: Road
    about: str = ""
    id: ClassVar[str]
    likely: ClassVar[int] = 5

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        """Every way to make the mistake on a scene."""
        yield cls(true.scene, true)

    def _keeps(self, *laws: str) -> bool:
        """Whether this road states these laws as everybody does."""
        same = all(getattr(type(self), law) is getattr(Detour, law) for law in laws)
        return same and self.scene is self.true.scene

    def position(self, place: str) -> sp.ImmutableMatrix:
        return self.true.position(place) if self._keeps() else super().position(place)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return self.true.velocity(place) if self._keeps("position") else super().velocity(place)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        kept = self._keeps("position")
        return self.true.virtual_displacement(place) if kept else super().virtual_displacement(place)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return self.true.kinetic_energy_of(body) if self._keeps(*MOTION) else super().kinetic_energy_of(body)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load) if self._keeps(*FORCES) else super().virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load) if self._keeps(*FORCES) else super().load_potential(load)

    def is_conservative(self, load: str) -> bool:
        """What has a potential is known from the true road: it is the given force, not the one got wrong."""
        return self.true.is_conservative(load)

    @property
    def rest(self) -> dict[sp.Symbol, sp.Expr] | None:
        """Small motions are asked for about the true equilibrium."""
        return self.true.rest


@cache
def misconceptions() -> tuple[type[Detour], ...]:
    """All that stand in `misconceptions/`, the likely ones first."""
    found = classes_of(PACKAGE, "id").values()
    return tuple(sorted(found, key=lambda kind: (kind.likely, kind.id)))
