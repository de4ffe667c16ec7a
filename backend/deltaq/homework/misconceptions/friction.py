"""Mistakes in dry friction that holds: it is a reaction, as large as it has to be, and no larger than it can be."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...derivation.impacts import frictions
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class HoldingMistake(FaultySolution):
    """A mistake that only scenes with dry friction have room for."""

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if frictions(true.model):
            yield cls(true.scene, true)


@dataclass(frozen=True, eq=False)
class HoldingForceAtItsLimit(HoldingMistake):
    """Friction that holds is taken as large as it can be: μ_s N, whatever pulls.

    A block that nothing pulls needs no friction to stay. The limit is reached at the moment when it tears off.
    """

    id: ClassVar[str] = "holding-force-at-its-limit"
    likely: ClassVar[int] = 1

    def holding_force(self, load: str) -> sp.Expr:
        return self.true.largest_holding_force(load)


@dataclass(frozen=True, eq=False)
class HoldingForceSign(HoldingMistake):
    """Friction that holds is drawn along the force that it holds against.

    The two balance each other, so that they point to opposite sides.
    """

    id: ClassVar[str] = "holding-force-sign"
    likely: ClassVar[int] = 2

    def holding_force(self, load: str) -> sp.Expr:
        return -self.true.holding_force(load)


@dataclass(frozen=True, eq=False)
class HoldingForceVanishes(HoldingMistake):
    """Without slipping there is said to be no friction.

    Sliding friction needs motion; what holds does so at rest, and does no work.
    """

    id: ClassVar[str] = "holding-force-vanishes"
    likely: ClassVar[int] = 3

    def holding_force(self, _load: str) -> sp.Expr:
        return self.zero
