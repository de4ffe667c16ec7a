"""Mistakes in what stands for δq: the factors are right, and so are the forces that follow."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from ..mechanics.contributions import Contribution
from .detour import Detour


@dataclass(frozen=True, eq=False)
class Respelling(Detour):
    """Virtual displacements and works in which something else is written for the variations."""

    @property
    @abstractmethod
    def written(self) -> Mapping[sp.Symbol, sp.Expr]:
        """What is written for each δq."""

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return self.true.virtual_displacement(place).xreplace(self.written)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load).xreplace(self.written)

    def load_force(self, load: str, coordinate: str) -> sp.Expr:
        return self.true.load_force(load, coordinate)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def generalized_force(self, coordinate: str) -> sp.Expr:
        return self.true.generalized_force(coordinate)
