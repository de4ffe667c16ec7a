"""The solution that follows from a student's own lines: what they found earlier takes the place of the law."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from ..derivation.calculus import column
from ..language.memory import cached_method
from .equality import Parts
from .solution import Solution


@dataclass(frozen=True, eq=False)
class OwnSolution(Solution):
    """Everything that was not answered before is derived rightly from what was: right consequences of wrong lines."""

    true: Solution
    answers: Mapping[str, Parts]

    def is_conservative(self, load: str) -> bool:
        return self.true.is_conservative(load)

    @property
    def rest(self) -> dict[sp.Symbol, sp.Expr] | None:
        return self.true.rest

    def _own(self, task: str) -> sp.Expr | None:
        parts = self.answers.get(task)
        return parts[0] if parts else None

    def position(self, place: str) -> sp.ImmutableMatrix:
        own = self.answers.get(f"position:{place}")
        return column(own) if own else super().position(place)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        own = self.answers.get(f"virtual-displacement:{place}")
        return column(own) if own else super().virtual_displacement(place)

    def generalized_force(self, coordinate: str) -> sp.Expr:
        own, work = self._own(f"generalized-force:{coordinate}"), self._own("virtual-work")
        if own is None and work is not None:
            return work.expand().coeff(self.variation(coordinate))
        return super().generalized_force(coordinate) if own is None else own

    @property
    def kinetic_energy(self) -> sp.Expr:
        own = self._own("kinetic-energy")
        return super().kinetic_energy if own is None else own

    @property
    def potential_energy(self) -> sp.Expr:
        own = self._own("potential-energy")
        return super().potential_energy if own is None else own

    @property
    def lagrangian(self) -> sp.Expr:
        own = self._own("lagrangian")
        return self.kinetic_energy - self.potential_energy - self.potential_of_rates if own is None else own

    def momentum(self, coordinate: str) -> sp.Expr:
        own = self._own(f"momentum:{coordinate}")
        return self.lagrangian.diff(self.rate(coordinate)) if own is None else own

    def equation(self, coordinate: str) -> sp.Expr:
        own = self._own(f"equation:{coordinate}")
        return self._derived_equation(coordinate) if own is None else own

    @cached_method
    def _derived_equation(self, coordinate: str) -> sp.Expr:
        """From their momentum and Lagrange function; from their forces where they wrote those and no potential."""
        q = self.q(coordinate)
        by_force = f"generalized-force:{coordinate}" in self.answers or "virtual-work" in self.answers
        if by_force and not {"potential-energy", "lagrangian"} & self.answers.keys():
            inertia = self.time_derivative(self.kinetic_energy.diff(self.rate(coordinate)))
            return inertia - self.kinetic_energy.diff(q) - self.generalized_force(coordinate)
        rest = self.lagrangian.diff(q) + self.nonconservative_force(coordinate)
        return self.time_derivative(self.momentum(coordinate)) - rest

    def linear_row(self, coordinate: str) -> tuple[tuple[sp.Expr, ...], ...]:
        own = self._own(f"linearized:{coordinate}")
        if own is None:
            return super().linear_row(coordinate)
        kinds = (self.acceleration, self.rate, self.q)
        return tuple(tuple(own.diff(kind(q)) for q in self.free) for kind in kinds)
