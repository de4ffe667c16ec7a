"""A scene as a dynamical system: energies, the decomposition of the forces, and Lagrange's function."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import sympy as sp

from ..language.memory import cached_method
from ..language.operations import operations
from ..language.tree import Node
from ..mechanics.bodies import Body
from ..mechanics.contributions import GeneralizedPotential, PotentialEnergy
from ..mechanics.kinetics import Distribution, Kinetics, Rotation, Translation
from .antiderivative import antiderivative, is_finite
from .formula import Formula, Given, Named, Quantity, Substituted
from .reactions import Reactions


@dataclass(frozen=True, eq=False)
class System(Reactions):
    """Everything the rules ask of a scene. Results are kept, so that each is computed once in a derivation."""

    def mass(self, body: Body) -> sp.Expr:
        """m of a particle or rigid body."""
        (mass,) = (part.mass for part in body.kinetics if isinstance(part, Translation))
        return self.expression(mass)

    def angular_velocity(self, part: Rotation) -> tuple[sp.Expr, ...]:
        """ω in the body frame of principal axes, or the one rate of turning in the plane; guides put in."""
        return tuple(self.display(self.guided(self.expression(omega))) for omega in part.angular_velocity)

    def named_angular_velocities(self, part: Rotation) -> tuple[Named, ...]:
        """ω, or ω₁ ω₂ ω₃, under their symbols."""
        values = self.angular_velocity(part)
        axes = ("",) if len(values) == 1 else tuple(str(axis) for axis in range(1, len(values) + 1))
        quantities = (Quantity("angular-velocity", part.body, axis) for axis in axes)
        return tuple(Named(quantity, value) for quantity, value in zip(quantities, values, strict=True))

    @cached_method
    def inertia_work(self, coordinate: str) -> sp.Expr:
        """d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ"""
        return self.display(self.euler_expression(self.kinetic_energy, coordinate))

    def given_rate(self, tree: Node) -> Formula:
        """A rate as the scene states it, with the guides put in where there are any."""
        stated = Given((tree,), self.expression(tree))
        return Substituted(stated, self.guides) if self.guides else stated

    @property
    def body_sources(self) -> tuple[str, ...]:
        """Every body, as a source of terms."""
        return tuple(f"body:{body.name}" for body in self.scene.bodies)

    @cached_method
    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        """The sum over what the body's kinetic energy comes down to."""
        return self.display(sp.Add(*(self._kinetic_energy(body, part) for part in body.kinetics)))

    def _kinetic_energy(self, body: Body, part: Kinetics) -> sp.Expr:
        velocity = self.velocity(part.body) if not isinstance(part, Rotation) else sp.ImmutableMatrix([])
        square = self.dot(velocity, velocity)
        match part:
            case Translation():
                return self.mass(body) * square / 2
            case Rotation(entries=entries):
                omega = self.angular_velocity(part)
                products = (self.expression(j) * omega[k] * omega[l] / (1 + (k == l)) for k, l, j in entries)
                return sp.Add(*products)
            case Distribution(density=density, material=material):
                return self.integrated(self.expression(density) * square.expand() / 2, material, part.body)

    def named_kinetic_energy(self, body: Body) -> Named:
        """E, or E of this body where there are several."""
        of = body.name if len(self.scene.bodies) > 1 else ""
        return Named(Quantity("kinetic-energy", of), self.kinetic_energy_of(body))

    @cached_property
    def kinetic_energy(self) -> sp.Expr:
        """E = Σ ∫ ½ v·v dm over all bodies."""
        return self.display(sp.Add(*(self.kinetic_energy_of(body) for body in self.scene.bodies)))

    @cached_method
    def has_potential(self, load: str) -> bool:
        """Whether the load's forces have a potential: no rates in them, and a symmetric Jacobian."""
        rates = {self.rate(q) for q in self.free}
        if not all(self.symbols_in(self.load_force(load, q)).isdisjoint(rates) for q in self.free):
            return False
        return self._is_given(load) or all(self.is_zero(curl) for _, curl in self.curl(load))

    def curl(self, load: str) -> Iterator[tuple[tuple[str, str], sp.Expr]]:
        """∂Qᵢ/∂qₖ − ∂Qₖ/∂qᵢ of a load, for pairs one of whose forces hangs on the other; else it is zero."""
        forces = {q: self.load_force(load, q) for q in self.free}
        held = {q: self.symbols_in(force) for q, force in forces.items()}
        for a, b in combinations(self.free, 2):
            if self.q(b) in held[a] or self.q(a) in held[b]:
                yield (a, b), self.raw_slope(forces[a], self.q(b)) - self.raw_slope(forces[b], self.q(a))

    def _is_given(self, load: str) -> bool:
        """Whether the scene states the load's potential: mixed derivatives of one function need no comparison."""
        return all(isinstance(part, PotentialEnergy) for part in self.scene.contributions if part.source == load)

    def is_conservative(self, load: str) -> bool:
        """Whether the load's forces have a potential V(q, t) that can be written down; generalized ones stay such."""
        return not self.is_generalized(load) and self.has_potential(load) and self._potential(load) is not None

    @cached_method
    def is_generalized(self, load: str) -> bool:
        """Whether the load's forces come from generalized potentials, which depend on rates and stand in L, too."""
        parts = [part for part in self.scene.contributions if part.source == load]
        return all(isinstance(part, GeneralizedPotential) for part in parts)

    @property
    def generalized_loads(self) -> tuple[str, ...]:
        """The loads with a generalized potential, in the scene's order."""
        return tuple(load for load in self.load_names if self.is_generalized(load))

    @property
    def sources_of_lagrangian(self) -> tuple[str, ...]:
        """Every load whose potential stands in L, as a source of terms."""
        loads = (load for load in self.load_names if self.is_conservative(load) or self.is_generalized(load))
        return tuple(f"load:{load}" for load in loads)

    @cached_method
    def velocity_potential(self, load: str) -> sp.Expr:
        """U(q, q̇, t) of a load with a generalized potential."""
        parts = [p for p in self.scene.contributions if p.source == load and isinstance(p, GeneralizedPotential)]
        return self.display(sp.Add(*map(self.generalized_potential, parts)))

    def at_rest(self, function: sp.Expr) -> sp.Expr:
        """U₀, what of a generalized potential counts as energy."""
        return function.xreplace(self.zero_rates)

    @cached_method
    def generalized_share(self, coordinate: str) -> sp.Expr:
        """Σ d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ of the loads with a generalized potential."""
        return self.display(sp.Add(*(self.load_force(load, coordinate) for load in self.generalized_loads)))

    @property
    def conservative_sources(self) -> tuple[str, ...]:
        """Every load with a potential, as a source of terms."""
        return tuple(f"load:{load}" for load in self.load_names if self.is_conservative(load))

    def load_potential(self, load: str) -> sp.Expr:
        """V of a conservative load."""
        found = self._potential(load)
        if found is None:
            raise ValueError(f"{load} has no potential in closed form")
        return found

    @cached_method
    def _potential(self, load: str) -> sp.Expr | None:
        """V as given, or by line integral along the axes; up to a function of time. None: it has no closed form."""
        parts = [part for part in self.scene.contributions if part.source == load]
        given = [self.energy(part) for part in parts if isinstance(part, PotentialEnergy)]
        if len(given) == len(parts):
            return self.display(sp.Add(*given))
        slopes = {self.q(q): -self.load_force(load, q) for q in self.free}
        found = (self._line_integral(slopes, start) for start in map(sp.Integer, (0, 1)))
        return next((self.display(energy) for energy in found if energy is not None), None)

    def _line_integral(self, slopes: dict[sp.Symbol, sp.Expr], start: sp.Expr) -> sp.Expr | None:
        """The function whose partial derivatives are the slopes, less what does not depend on the coordinates.

        All coordinates have the value `start` where the path begins; a force such as 1/r² is infinite at the origin.
        """
        total, later = self.zero, dict.fromkeys(slopes, start)
        for q, slope in slopes.items():
            del later[q]
            integral = antiderivative(slope.xreplace(later), q, self.symbols)
            if integral is None:
                return None
            total += integral - integral.xreplace({q: start})
        if not is_finite(total):
            return None
        terms = sp.Add.make_args(total.expand())
        return sp.Add(*(term for term in terms if term.free_symbols & slopes.keys()))

    @cached_property
    def potential_energy(self) -> sp.Expr:
        """V = Σ V of the loads with a potential: load by load, or what they share in front where that is shorter.

        What of a generalized potential does not depend on rates counts, too.
        """
        total = sp.Add(
            self.static_potential, *(self.at_rest(self.velocity_potential(u)) for u in self.generalized_loads)
        )
        return min((total, self.display(total)), key=operations)

    @cached_property
    def static_potential(self) -> sp.Expr:
        """V of the loads with a potential V(q, t) alone."""
        loads = (load for load in self.load_names if self.is_conservative(load))
        total = sp.Add(*map(self.load_potential, loads))
        return min((total, self.display(total)), key=operations)

    @cached_method
    def conservative_force(self, coordinate: str) -> sp.Expr:
        """Qᵢᵖ: −∂V/∂qᵢ, and d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ of generalized potentials."""
        slope = self.derivative(-self.static_potential, self.q(coordinate))
        return self.display(slope + self.generalized_share(coordinate)) if self.generalized_loads else slope

    @cached_method
    def nonconservative_force(self, coordinate: str) -> sp.Expr:
        """Qᵢᵈ: what is left of Qᵢ when every load with a potential is taken out."""
        in_function = self.sources_of_lagrangian
        loads = (load for load in self.load_names if f"load:{load}" not in in_function)
        return self.display(sp.Add(*(self.load_force(load, coordinate) for load in loads)))

    @cached_property
    def lagrangian(self) -> sp.Expr:
        """L = E − V, less what of generalized potentials depends on rates."""
        return self.kinetic_energy - self.potential_energy - self.potential_of_rates

    @cached_property
    def potential_of_rates(self) -> sp.Expr:
        """Σ U − U₀ of the generalized potentials: what stands in L and is no energy."""
        found = (self.velocity_potential(load) for load in self.generalized_loads)
        return self.display(sp.Add(*(function - self.at_rest(function) for function in found)))

    @cached_method
    def momentum(self, coordinate: str) -> sp.Expr:
        """∂L/∂q̇"""
        return self.derivative(self.lagrangian, self.rate(coordinate))
