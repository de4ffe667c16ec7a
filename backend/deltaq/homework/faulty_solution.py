"""A solution with one law got wrong: what a misconception is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from inspect import getattr_static, unwrap
from types import CodeType
from typing import ClassVar, Self

import sympy as sp

from ..derivation.system import System
from ..language.memory import cached_method
from ..mechanics.bodies import Body
from ..mechanics.contributions import Contribution
from ..packages import classes_of
from ..vocabulary import SlipKind
from .solution import Solution

PACKAGE = "deltaq.homework.misconceptions"


@dataclass(frozen=True, eq=False)
class FaultySolution(Solution):
    """The solution of somebody who gets one law wrong; everything after the mistake is derived correctly from it.

    `about` is what the mistake is made on (a load, a body, a coordinate), "" where there is nothing to choose. `likely`
    orders mistakes that lead to the same answer: the smaller comes first. `evident` are the kinds of tasks in which a
    single wrong term shows the mistake (None: all); in others something else may have left the same trace, and it takes
    more than one term. `traces` are the kinds of slip that it leaves (None: any). What comes before the mistake is
    taken from the true solution.
    """

    true: Solution
    about: str = ""
    id: ClassVar[str]
    likely: ClassVar[int] = 5
    evident: ClassVar[frozenset[str] | None] = None
    traces: ClassVar[frozenset[SlipKind] | None] = None

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        """Every way to make the mistake on a scene."""
        yield cls(true.scene, true)

    @cached_method
    def _comes_before(self, law: str) -> bool:
        """Whether this solution states everything that a law follows from as everybody does."""
        return self.scene is self.true.scene and not mistaken(type(self)) & premises(law)

    def position(self, place: str) -> sp.ImmutableMatrix:
        return self.true.position(place) if self._comes_before("position") else super().position(place)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return self.true.velocity(place) if self._comes_before("velocity") else super().velocity(place)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        right = self._comes_before("virtual_displacement")
        return self.true.virtual_displacement(place) if right else super().virtual_displacement(place)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        right = self._comes_before("kinetic_energy_of")
        return self.true.kinetic_energy_of(body) if right else super().kinetic_energy_of(body)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load) if self._comes_before("virtual_work") else super().virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load) if self._comes_before("load_potential") else super().load_potential(load)

    def is_conservative(self, load: str) -> bool:
        """Which loads have a potential: those of the true solution, since the forces are given."""
        return self.true.is_conservative(load)

    @cached_property
    def model(self) -> System:
        """That of the true solution: what is looked up in it is the same."""
        return self.true.model if self.scene is self.true.scene else System(self.scene)

    def rest_reaction(self, source: str) -> sp.Expr:
        """That of the true position of rest."""
        return self.true.rest_reaction(source)

    @property
    def rest(self) -> dict[sp.Symbol, sp.Expr] | None:
        """The true equilibrium, about which small motions are asked for."""
        return self.true.rest


def mistaken(kind: type[FaultySolution]) -> frozenset[str]:
    """The members of Solution that a misconception overrides."""
    classes = kind.__mro__[: kind.__mro__.index(FaultySolution)]
    return frozenset(name for one in classes for name in vars(one) if hasattr(Solution, name))


@cache
def premises(law: str) -> frozenset[str]:
    """The members of Solution that a law uses, directly or through others, by the names in their code; without itself.

    A name that is only that of a field elsewhere counts, too: then something is computed twice, but nothing wrongly.
    """
    found, left = set[str](), {law}
    while left:
        found |= left
        left = {name for member in left for name in _names(member) if hasattr(Solution, name)} - found
    return frozenset(found - {law})


def _names(member: str) -> Iterator[str]:
    """The names in the code of a member of Solution, be it a method or a property."""
    stated = getattr_static(Solution, member)
    function = stated.func if isinstance(stated, cached_property) else getattr(stated, "fget", stated)
    left = [getattr(unwrap(function), "__code__", None)]
    while left:
        code = left.pop()
        if isinstance(code, CodeType):
            yield from code.co_names
            left += code.co_consts


@cache
def misconceptions() -> tuple[type[FaultySolution], ...]:
    """All misconceptions of `misconceptions/`, the likely ones first."""
    found = classes_of(PACKAGE, "id").values()
    return tuple(sorted(found, key=lambda kind: (kind.likely, kind.id)))
