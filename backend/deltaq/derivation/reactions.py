"""What constraints do: the conditions, their rates, and the reactions that keep them.

With one multiplier λ for each condition the reaction on a coordinate is Zᵢ = Σ λ aᵢ, where aᵢ = ∂g/∂qᵢ of a holonomic
condition g(q, t) = 0, and aᵢ = ∂u/∂q̇ᵢ of one that is linear in the rates, u = Σ aᵢ(q, t) q̇ᵢ + b(q, t) = 0.
Source: Lurie, Analytical Mechanics, ch. 1 and 5; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.4.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..language.memory import cached_method
from ..mechanics.conditions import Condition
from .formula import Given, Named, Quantity
from .work import Work


@dataclass(frozen=True, eq=False)
class Reactions(Work):
    """Constraints with the guides put in; their multipliers are symbols of the scene."""

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """What the constraints keep at zero, in the scene's order."""
        return self.scene.conditions

    @property
    def constraint_sources(self) -> tuple[str, ...]:
        """Every constraint, as a source of terms."""
        return tuple(f"constraint:{condition.source}" for condition in self.conditions)

    def multiplier(self, condition: Condition) -> sp.Symbol:
        """λ"""
        return self.q(self.scene.multipliers[self.conditions.index(condition)].name)

    @property
    def multipliers(self) -> tuple[sp.Symbol, ...]:
        """λ of every constraint, in the scene's order."""
        return tuple(map(self.multiplier, self.conditions))

    def stated(self, condition: Condition) -> Given:
        """The condition as the scene states it."""
        return Given((condition.value,), self.expression(condition.value))

    @cached_method
    def condition(self, condition: Condition) -> sp.Expr:
        """g(q, t) or u(q, q̇, t), which is zero along the motion."""
        return self.display(self.guided(self.expression(condition.value)))

    def named_condition(self, condition: Condition) -> Named:
        """Φ, with the name of the constraint where there are several."""
        of = condition.source if len(self.conditions) > 1 else ""
        return Named(Quantity("constraint", of), self.condition(condition))

    def slope_symbol(self, condition: Condition, coordinate: str) -> sp.Symbol:
        """What a condition is differentiated by: qᵢ of a holonomic one, else q̇ᵢ."""
        return self.q(coordinate) if condition.is_holonomic else self.rate(coordinate)

    @cached_method
    def coefficient(self, condition: Condition, coordinate: str) -> sp.Expr:
        """aᵢ: ∂g/∂qᵢ or ∂u/∂q̇ᵢ."""
        return self.derivative(self.condition(condition), self.slope_symbol(condition, coordinate))

    def bound(self, condition: Condition) -> tuple[str, ...]:
        """The free coordinates that a constraint acts on."""
        return tuple(q for q in self.free if self.coefficient(condition, q) != 0)

    def bound_by(self, coordinate: str) -> tuple[Condition, ...]:
        """The constraints that act on a coordinate."""
        return tuple(each for each in self.conditions if self.coefficient(each, coordinate) != 0)

    @cached_method
    def constrained_variation(self, condition: Condition) -> sp.Expr:
        """Σ aᵢ δqᵢ, which vanishes for virtual displacements that keep the constraint."""
        return self.collected(sp.Add(*(self.coefficient(condition, q) * self.variation(q) for q in self.free)))

    @cached_method
    def reaction_work(self, condition: Condition) -> sp.Expr:
        """λ Σ aᵢ δqᵢ: the virtual work of the reaction, once the constraint is released."""
        return self.collected(self.multiplier(condition) * self.constrained_variation(condition))

    @cached_method
    def reaction_share(self, condition: Condition, coordinate: str) -> sp.Expr:
        """λ aᵢ"""
        return self.display(self.multiplier(condition) * self.coefficient(condition, coordinate))

    @cached_method
    def reaction(self, coordinate: str) -> sp.Expr:
        """Zᵢ = Σ λ aᵢ of all constraints."""
        return self.display(sp.Add(*(self.reaction_share(each, coordinate) for each in self.conditions)))

    @cached_method
    def condition_rate(self, condition: Condition) -> sp.Expr:
        """Σ aᵢ q̇ᵢ + b: ġ of a holonomic condition, the condition itself of another."""
        value = self.condition(condition)
        return self.shown_rate(value) if condition.is_holonomic else value

    @cached_method
    def condition_acceleration(self, condition: Condition) -> sp.Expr:
        """Σ aᵢ q̈ᵢ + γ: the condition differentiated until accelerations stand in it."""
        return self.shown_rate(self.condition_rate(condition))

    @cached_method
    def drift_term(self, condition: Condition) -> sp.Expr:
        """γ: what the accelerations have to make up for."""
        still = {self.acceleration(q): self.zero for q in self.free}
        return self.display(self.condition_acceleration(condition).xreplace(still))

    @cached_method
    def moving_term(self, condition: Condition) -> sp.Expr:
        """b = ∂g/∂t, or what of u is left without rates: how fast the constraint itself moves."""
        still = self.zero_rates
        return self.display(self.condition_rate(condition).xreplace(still))

    @cached_method
    def constraint_matrix(self) -> sp.ImmutableMatrix:
        """A, one row for each constraint, one column for each free coordinate."""
        return sp.ImmutableMatrix([[self.coefficient(each, q) for q in self.free] for each in self.conditions])

    @cached_method
    def reaction_power(self) -> sp.Expr:
        """Σ Zᵢ q̇ᵢ = −Σ λ b: reactions only work where the constraint moves."""
        return self.display(-sp.Add(*(self.multiplier(c) * self.moving_term(c) for c in self.conditions)))
