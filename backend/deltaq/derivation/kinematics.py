"""Where bodies are, how they may be displaced, and how they move."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..errors import InputError, SceneError
from ..language.memory import cached_method
from ..language.tree import Node
from ..mechanics.contributions import DistributedForce
from ..mechanics.material import Material
from .antiderivative import definite_integral
from .calculus import Calculus, column
from .formula import Bounds, Named, Quantity


@dataclass(frozen=True, eq=False)
class Kinematics(Calculus):
    """Positions r(q, t) of points and bodies with the guides put in, and their derivatives."""

    def source(self, place: str) -> str:
        """The name under which a place is the source of a term."""
        if any(body.name == place for body in self.scene.bodies):
            return f"body:{place}"
        return f"point:{place}" if place in self.scene.places else f"load:{place}"

    def trees(self, place: str) -> tuple[Node, ...]:
        """The position as the scene states it: of a point, of a body, or of the particles that a load acts on."""
        for load in self.scene.contributions:
            if isinstance(load, DistributedForce) and load.place == place:
                return load.position
        return tuple(component.tree for component in self.scene.place(place))

    @cached_method
    def position(self, place: str) -> sp.ImmutableMatrix:
        """r(P, t, q) with the guides put in."""
        return self.guided(self.vector(self.trees(place)))

    def bounds(self, material: tuple[Material, ...]) -> tuple[Bounds, ...]:
        """The material coordinates as symbols, with their intervals."""
        return tuple(
            Bounds(self.q(m.name), self.expression(m.lower.tree), self.expression(m.upper.tree)) for m in material
        )

    def integrated(self, density: sp.Expr, material: tuple[Material, ...], place: str) -> sp.Expr:
        """∫ density over the material coordinates, in closed form. Raises SceneError that points at the density."""
        try:
            for bounds in reversed(self.bounds(material)):
                density = definite_integral(density, bounds, self.symbols, self.parameter_values)
        except InputError as error:
            raise SceneError(*(problem.below(self._density_of(place)) for problem in error.problems)) from None
        return self.display(density)

    def _density_of(self, place: str) -> str:
        """Where the scene states the density of a continuum or of a distributed force."""
        bodies = {body.name: f"/bodies/{i}" for i, body in enumerate(self.scene.bodies)}
        loads = {load.name: f"/loads/{i}" for i, load in enumerate(self.scene.loads)}
        return f"{(loads | bodies)[place]}/density"

    def named_position(self, place: str) -> Named:
        """r with what it depends on: r(q₁, q₂, t)."""
        value = self.position(place)
        arguments = tuple(self.q(name) for name in self.coordinates_of(place))
        return Named(Quantity("position", place), value, arguments + ((self.t,) if value.has(self.t) else ()))

    def coordinates_of(self, place: str) -> tuple[str, ...]:
        """The free coordinates that the place depends on."""
        return tuple(name for name in self.free if self.position(place).has(self.q(name)))

    def tangent(self, place: str, coordinate: str) -> sp.ImmutableMatrix:
        """∂r/∂q"""
        return self.derivative(self.position(place), self.q(coordinate))

    @cached_method
    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        """δr = ∂r/∂qᵢ δqᵢ"""
        return column(self.collected(self.vary(component)) for component in self.position(place))

    @cached_method
    def velocity(self, place: str) -> sp.ImmutableMatrix:
        """v = dr/dt"""
        return self.display(column(self.time_derivative(component) for component in self.position(place)))

    def named_velocity(self, place: str) -> Named:
        """v under its symbol."""
        return Named(Quantity("velocity", place), self.velocity(place))

    @property
    def depends_on_time(self) -> bool:
        """Whether any place moves by itself: ∂r/∂t ≠ 0."""
        return any(self.position(place).has(self.t) for place in self.scene.places)
