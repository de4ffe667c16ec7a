"""The way from a scene to every answer, one law per method, so that each law can be got wrong alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from ..derivation.calculus import V
from ..derivation.conservation import cyclic, jacobi_energy, jacobi_energy_rate
from ..derivation.generator import Symmetry
from ..derivation.impacts import (
    Held,
    answers,
    bouncing,
    effective_mass,
    free_mass,
    frictions,
    gap_rate,
    holding_force,
    impact,
    largest_force,
    moving_term,
    restitution,
    slopes,
)
from ..derivation.linearization import linearizations
from ..derivation.multipliers import Multipliers, multipliers
from ..derivation.optional import symmetries_of
from ..derivation.system import System
from ..language.canonical import display
from ..language.memory import cached_method
from ..mechanics.conditions import Condition
from ..mechanics.contributions import Friction
from ..mechanics.event import Event


@dataclass(frozen=True, eq=False)
class Solution(System):
    """A system whose expressions stay as they fall out: they are compared, not shown, so no form is the best one.

    `seed` is whose task it is: what is drawn besides the scene is drawn from it as well.
    """

    seed: str = field(default="", kw_only=True)

    def display(self, value: V) -> V:
        return value

    @cached_method
    def momentum_rate(self, coordinate: str) -> sp.Expr:
        """d/dt ∂E/∂q̇"""
        return self.time_derivative(self.kinetic_energy.diff(self.rate(coordinate)))

    def energy_slope(self, coordinate: str) -> sp.Expr:
        """∂E/∂q"""
        return self.kinetic_energy.diff(self.q(coordinate))

    def potential_slope(self, coordinate: str) -> sp.Expr:
        """∂V/∂q"""
        return self.potential_energy.diff(self.q(coordinate))

    def force_of_rates(self, coordinate: str) -> sp.Expr:
        """d/dt ∂U/∂q̇ − ∂U/∂q of what of generalized potentials depends on rates."""
        return self.euler_expression(self.potential_of_rates, coordinate) if self.generalized_loads else self.zero

    @cached_method
    def equation(self, coordinate: str) -> sp.Expr:
        """d/dt ∂E/∂q̇ − ∂E/∂q + ∂V/∂q − Qᵈ − Σ λ a, the left side of `… = 0`; forces of rates from L are among them."""
        inertia = self.momentum_rate(coordinate) - self.energy_slope(coordinate)
        forces = self.nonconservative_force(coordinate) + self.reaction(coordinate) + self.force_of_rates(coordinate)
        return inertia + self.potential_slope(coordinate) - forces

    @cached_property
    def model(self) -> System:
        """The system of the last chapter, whose expressions are brought into their shown form."""
        return System(self.scene)

    @cached_property
    def rest(self) -> dict[sp.Symbol, sp.Expr] | None:
        """The first equilibrium that is stable and known in the parameters; None where there is none.

        With constraints none is sought: multipliers would belong to it.
        """
        for linear in () if self.conditions else linearizations(self.model):
            regular = linear.equilibrium.exact and linear.spectrum is not None
            if regular and linear.stability == "stable":
                return dict(linear.equilibrium.values)
        return None

    def _at_rest(self, value: sp.Expr) -> sp.Expr:
        still = {symbol: self.zero for q in self.free for symbol in (self.rate(q), self.acceleration(q))}
        return value.xreplace(still).xreplace(self.rest or {})

    @cached_method
    def linear_row(self, coordinate: str) -> tuple[tuple[sp.Expr, ...], ...]:
        """The rows of M₀, D₀ and K₀ that belong to a coordinate."""
        equation = self.equation(coordinate)
        kinds = (self.acceleration, self.rate, self.q)
        rows = [[self._at_rest(self.slope(equation, kind(q))) for q in self.free] for kind in kinds]
        return tuple(tuple(display(entry, self.symbols) for entry in row) for row in rows)

    @cached_method
    def linear_equation(self, coordinate: str) -> sp.Expr:
        """M₀ẍ + D₀ẋ + K₀x about the equilibrium; the deviation x goes by the name of its coordinate."""
        kinds = (self.acceleration, self.rate, self.q)
        rows = zip(kinds, self.linear_row(coordinate), strict=True)
        return sp.Add(*(c * kind(q) for kind, row in rows for c, q in zip(row, self.free, strict=True)))

    @cached_property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        """ω of det(K₀ − ω²M₀) = 0 for one and two degrees of freedom; none where there is damping."""
        if len(self.free) > 2:
            return ()
        rows = [self.linear_row(q) for q in self.free]
        if any(entry != 0 for _, damping, _ in rows for entry in map(sp.expand, damping)):
            return ()
        M, K = (sp.Matrix([row[kind] for row in rows]) for kind in (0, 2))
        a = M.det()
        if len(rows) == 1:
            return () if a == 0 else (sp.sqrt(K[0, 0] / a),)
        b = M[0, 1] * K[1, 0] + M[1, 0] * K[0, 1] - M[0, 0] * K[1, 1] - M[1, 1] * K[0, 0]
        inside = (b**2 - 4 * a * K.det()).expand()
        # Of two equal frequencies nothing is left of the root, which may not be seen by expanding it.
        root = self.zero if self.is_zero(inside) else sp.sqrt(inside)
        return () if self.is_zero(a) else tuple(sp.sqrt((-b + sign * root) / (2 * a)) for sign in (-1, 1))

    @cached_property
    def conserved_of(self) -> tuple[str, ...]:
        """What is conserved: the cyclic coordinates by name, and "" for the Jacobi energy."""
        energy = ("",) if self.is_zero(jacobi_energy_rate(self)) else ()
        return (*cyclic(self), *energy)

    def conserved(self, coordinate: str) -> sp.Expr:
        """The momentum of a cyclic coordinate, or the Jacobi energy."""
        return self.momentum(coordinate) if coordinate else jacobi_energy(self)

    @cached_property
    def symmetries(self) -> Mapping[str, Symmetry]:
        """Those that hold for all parameters, besides cyclic coordinates and time, by their number."""
        found = enumerate(symmetries_of(self.model), 1)
        return {str(number): each for number, each in found if not each.conditions}

    @cached_property
    def bounces(self) -> tuple[str, ...]:
        """The contacts whose impacts can be asked for: those that are short."""
        return tuple(each.name for each in bouncing(self.model) if impact(self.model, each) is not None)

    def _contact(self, name: str) -> Event:
        return next(event for event in self.scene.events if event.name == name)

    def restitution_of(self, contact: str) -> sp.Expr:
        """e"""
        return restitution(self.model, self._contact(contact))

    def closing_factor(self, contact: str) -> sp.Expr:
        """1 + e: how many times the impulse is that of an impact that only stops."""
        return 1 + self.restitution_of(contact)

    def closing_rate(self, contact: str) -> sp.Expr:
        """ġ before the impact."""
        return gap_rate(self.model, self._contact(contact))

    def contact_drift(self, contact: str) -> sp.Expr:
        """∂g/∂t"""
        return moving_term(self.model, self._contact(contact))

    def gap_slope(self, contact: str, coordinate: str) -> sp.Expr:
        """∂g/∂qᵢ"""
        return slopes(self.model, self._contact(contact)).get(coordinate, self.zero)

    def effective_mass(self, contact: str) -> sp.Expr:
        """1/(∂g/∂q M⁻¹ ∂g/∂qᵀ), what the contact has to stop."""
        return effective_mass(self.model, self._contact(contact))

    def free_mass(self, contact: str) -> sp.Expr:
        """What it would have to stop if no constraint answered."""
        return free_mass(self.model, self._contact(contact))

    def constraint_share(self, contact: str, condition: Condition) -> sp.Expr:
        """Λ_c/Λ: with how much of the impulse a constraint answers."""
        return answers(self.model, self._contact(contact)).get(condition.source, self.zero)

    def struck_by(self, contact: str) -> list[str]:
        """The coordinates whose momenta jump."""
        found = impact(self.model, self._contact(contact))
        return [] if found is None else [q for q in self.free if found.momenta.get(q, self.zero) != 0]

    def impact_impulse(self, contact: str) -> sp.Expr:
        """Λ = −(1 + e) ġ/(∂g/∂q M⁻¹ ∂g/∂qᵀ)"""
        return -self.closing_factor(contact) * self.closing_rate(contact) * self.effective_mass(contact)

    def momentum_behind(self, contact: str, coordinate: str) -> sp.Expr:
        """pᵢ⁺ = pᵢ + Λ ∂g/∂qᵢ + Σ Λ_c aᵢ"""
        answered = (
            self.constraint_share(contact, each) * self.coefficient(each, coordinate)
            for each in self.conditions
            if coordinate in self.bound(each)
        )
        along = self.gap_slope(contact, coordinate) + sp.Add(*answered)
        return self.momentum(coordinate) + self.impact_impulse(contact) * along

    def impact_loss(self, contact: str) -> sp.Expr:
        """E⁻ − E⁺ = −Λ ((1 − e) ġ/2 − ∂g/∂t) + Σ Λ_c b"""
        mean = (1 - self.restitution_of(contact)) * self.closing_rate(contact) / 2
        return self.work_of_drift(contact) - self.impact_impulse(contact) * mean

    def work_of_drift(self, contact: str) -> sp.Expr:
        """Λ ∂g/∂t + Σ Λ_c b: what a contact and constraints that move by themselves take out of the motion."""
        taken = (self.constraint_share(contact, each) * self.moving_term(each) for each in self.conditions)
        return self.impact_impulse(contact) * (self.contact_drift(contact) + sp.Add(*taken))

    def gap_rate(self, contact: str) -> sp.Expr:
        """ġ along the motion, negative while the two approach."""
        return self.closing_rate(contact)

    def kept(self, source: str) -> sp.Expr:
        """Φ of a constraint, which is zero along the motion."""
        return self.model.condition(self._bound_by(source))

    def constraint_force(self, source: str) -> sp.Expr:
        """λ of a constraint by coordinates and rates. Raises ValueError where it is too long."""
        found = self._multipliers(source)
        return found.values[self.multiplier(self._bound_by(source))]

    def _multipliers(self, source: str) -> Multipliers:
        found = multipliers(self.model)
        if found is None:
            raise ValueError(f"the multiplier of {source} is too long")
        return found

    def _bound_by(self, source: str) -> Condition:
        return next(each for each in self.conditions if each.source == source)

    def holding_force(self, load: str) -> sp.Expr:
        """What keeps a load of dry friction sticking. Raises ValueError where that is too long."""
        return self._held(load)[1].force

    def largest_holding_force(self, load: str) -> sp.Expr:
        """The most that it can be."""
        return largest_force(self.model, *self._held(load))

    def _held(self, load: str) -> tuple[Friction, Held]:
        friction = next(each for each in frictions(self.model) if each.source == load)
        found = holding_force(self.model, friction)
        if found is None:
            raise ValueError(f"the force that holds {load} is too long")
        return friction, found

    def rest_reaction(self, source: str) -> sp.Expr:
        """λ₀ of a constraint in the first position of rest."""
        (condition,) = (each for each in self.conditions if each.source == source)
        reactions = linearizations(self.model)[0].equilibrium.reactions
        return reactions[self.multiplier(condition)]

    @property
    def integrals(self) -> tuple[sp.Expr, ...]:
        """All that is known to be conserved, whatever the parameters."""
        further = (each.value for each in self.symmetries.values())
        return (*map(self.conserved, self.conserved_of), *further)
