"""Lagrange's equations of a scene by SymPy's own LagrangesMethod, straight from the texts of the scene.

Kinetic energies and generalized forces are put together here a second time, integrals by `sympy.integrate`; nothing of
the derivation is used. Symbols of the result are called as in the scene: `phi`, `dot(phi)`, `ddot(phi)`, `t`, `m`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from deltaq.language.tree import Node, fold
from deltaq.mechanics.contributions import (
    Contribution,
    DissipationFunction,
    DistributedForce,
    Friction,
    GeneralizedPotential,
    Moment,
    PointForce,
    PotentialEnergy,
)
from deltaq.mechanics.kinetics import Distribution, Kinetics, Rotation, Translation
from deltaq.mechanics.material import Material
from deltaq.mechanics.scene import Scene

T = dynamicsymbols._t


@dataclass(frozen=True)
class Reading:
    """Just enough of an algebra to read scenes; coordinates are functions of time from the outset."""

    values: dict[str, Any]

    def number(self, value: Any) -> Any:
        return sp.Rational(value.numerator, value.denominator)

    def name(self, name: str) -> Any:
        return self.values[name]

    def rate(self, name: str, order: int) -> Any:
        return self.values[name].diff(T, order)

    def sum(self, terms: Any) -> Any:
        return sp.Add(*terms)

    def product(self, factors: Any) -> Any:
        return sp.Mul(*factors)

    def quotient(self, numerator: Any, denominator: Any) -> Any:
        return numerator / denominator

    def negation(self, operand: Any) -> Any:
        return -operand

    def power(self, base: Any, exponent: Any) -> Any:
        return base**exponent

    def call(self, function: str, arguments: Any) -> Any:
        return (sp.Abs if function == "abs" else getattr(sp, function))(*arguments)

    def time_derivative(self, operand: Any) -> Any:
        return operand.diff(T)


@dataclass(frozen=True)
class Peer:
    """A scene as SymPy functions of time."""

    scene: Scene

    @property
    def q(self) -> dict[str, Any]:
        return {c.name: dynamicsymbols(f"Q_{c.name}") for c in self.scene.free}

    def read(self, node: Node) -> Any:
        constants = [*self.scene.parameters, *self.scene.material]
        values = {**self.q, **{p.name: sp.Symbol(p.name, positive=True) for p in constants}, "t": T, "pi": sp.pi}
        for guide in self.scene.guides:
            values[guide.coordinate] = fold(guide.value.tree, Reading(values))
        return fold(node, Reading(values))

    def vector(self, nodes: tuple[Node, ...]) -> sp.Matrix:
        return sp.Matrix([self.read(node) for node in nodes])

    def integrate(self, density: Any, material: tuple[Material, ...]) -> Any:
        for each in reversed(material):
            s = sp.Symbol(each.name, positive=True)
            density = sp.integrate(sp.expand(density), (s, self.read(each.lower.tree), self.read(each.upper.tree)))
        return density

    def kinetic(self, part: Kinetics) -> Any:
        match part:
            case Translation(mass=mass, position=position):
                return self.read(mass) * self._square(position) / 2
            case Rotation(entries=entries, angular_velocity=nodes):
                omega = self.vector(nodes)
                tensor = sp.zeros(len(omega), len(omega))
                for k, l, entry in entries:
                    tensor[k, l] = tensor[l, k] = self.read(entry)
                return (omega.T * tensor * omega)[0] / 2
            case Distribution(density=density, position=position, material=material):
                return self.integrate(self.read(density) * self._square(position) / 2, material)

    def _square(self, position: tuple[Node, ...]) -> Any:
        velocity = self.vector(position).diff(T)
        return velocity.dot(velocity)

    def force(self, load: Contribution, coordinate: str) -> Any:  # noqa: PLR0911 - one case for each kind
        """Qᵢ of a load, by its definition."""
        q = self.q[coordinate]
        match load:
            case PointForce(place=place, force=force):
                position = self.vector(tuple(x.tree for x in self.scene.place(place)))
                return self.vector(force).dot(position.diff(q))
            case Moment(angle=angle, moment=moment):
                return self.read(moment) * self.read(angle).diff(q)
            case PotentialEnergy(energy=energy):
                return -self.read(energy).diff(q)
            case DissipationFunction(function=function):
                return -self.read(function).doit().diff(q.diff(T))
            case GeneralizedPotential(energy=energy):
                function = self.read(energy).doit()
                return function.diff(q.diff(T)).diff(T) - function.diff(q)
            case Friction(coordinate=c, force=force, surface_rate=rate):
                slipping = self.read(c)
                return -self.read(force) * sp.sign(slipping.diff(T) - self.read(rate)) * slipping.diff(q)
            case DistributedForce(density=density, position=position, material=material):
                return self.integrate(self.vector(density).dot(self.vector(position).diff(q)), material)

    def equations(self) -> list[Any]:
        """d/dt ∂E/∂q̇ − ∂E/∂q − Q − Σ λ a for every free coordinate.

        SymPy takes holonomic constraints first, and its multipliers stand on the left with the other sign.
        """
        energy = sum(self.kinetic(part) for body in self.scene.bodies for part in body.kinetics)
        kept: dict[bool, list[Any]] = {True: [], False: []}
        names: dict[bool, list[str]] = {True: [], False: []}
        for condition, symbol in zip(self.scene.conditions, self.scene.multipliers, strict=True):
            kept[condition.is_holonomic].append(self.read(condition.value).doit())
            names[condition.is_holonomic].append(symbol.name)
        method = LagrangesMethod(energy, list(self.q.values()), hol_coneqs=kept[True], nonhol_coneqs=kept[False])
        left = method.form_lagranges_equations()
        multipliers = [*(method.lam_vec if self.scene.constraints else [])]
        known = {theirs: -sp.Symbol(name) for theirs, name in zip(multipliers, names[True] + names[False], strict=True)}
        forces = [sum(self.force(load, name) for load in self.scene.contributions) for name in self.q]
        return [self._named((side - force).doit().subs(known)) for side, force in zip(left, forces, strict=True)]

    def _named(self, expression: Any) -> Any:
        for order, form in ((2, "ddot({})"), (1, "dot({})")):
            rates = {f.diff(T, order): sp.Symbol(form.format(name)) for name, f in self.q.items()}
            expression = expression.subs(rates)
        return expression.subs({f: sp.Symbol(name) for name, f in self.q.items()}).subs(T, sp.Symbol("t"))
