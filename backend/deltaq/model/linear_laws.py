"""A scene's equations of motion linearized about rest, M₀ ẍ + D ẋ + K x = F(t), as the laws of a simpler scene.

Positions and angles become linear in x = q − q₀, which makes the kinetic energy ½ ẋᵀ M₀ ẋ. D, K and F are what the
linearized forces ask for beyond the inertia of those bodies.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1–6.2; Lurie, Analytical Mechanics, ch. 12.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import chain

import symengine as se

from ..errors import Problem, SceneError
from ..language.expression import Expression
from ..mechanics.scene import Scene
from .elimination import rewritten
from .equations import Equations, equations
from .functions import Expr
from .kinetic import ZERO, Vector
from .phase import vanishes
from .symbols import Symbols
from .symengine_algebra import to_symengine
from .writing import Writer

Coefficient = Expression | float
Entries = Mapping[tuple[str, ...], Coefficient]  # by pairs of coordinates, each pair once; what vanishes is left out


@dataclass(frozen=True)
class LinearLaws:
    """The scene with linear positions and without loads, and its forces F(t) − D ẋ − K x.

    K and D are taken apart into a symmetric part S and a skew part A, with the entries of the upper triangle.
    Coefficients are expressions in the parameters (and t), or numbers where they depend on q₀, which is itself known at
    the scene's own values of the parameters alone. F, by coordinate, is what is left at x = 0: the drive, and what the
    inertia of the bodies asks for where guides move them.
    """

    scene: Scene
    stiffness: Entries
    circulatory: Entries  # the skew part of K
    damping: Entries
    gyroscopic: Entries  # the skew part of D
    given: Mapping[str, Coefficient]


def is_linear(scene: Scene) -> bool:
    """Whether the equations of motion are linear as they are."""
    eqs = equations(scene)
    state = _state(eqs.symbols)
    slopes = (entry.diff(x) for row in eqs.mass_matrix for entry in row for x in state)
    curvatures = (force.diff(x).diff(y) for force in eqs.forcing for x in state for y in state)
    return all(map(vanishes, chain(slopes, curvatures)))


def linear_laws(scene: Scene, rest: Mapping[str, str]) -> LinearLaws:
    """The laws near rest; `rest` names the parameter that holds q₀ of each free coordinate, those at zero left out.

    Raises SceneError where M₀ is not constant, or has no bodies in a scene of format 1.
    """
    eqs = equations(scene)
    values = eqs.symbols.values
    origin = {values[name]: values[rest[name]] if name in rest else ZERO for name in eqs.symbols.free}
    near = _Near(scene, eqs.symbols, origin)
    bodies = near.bodies()
    plain = equations(bodies)
    if not near.agrees(eqs, plain):
        raise SceneError(Problem("ladder-linear", parameters={"name": scene.id}))
    forces = tuple(near.deviating(f) - g for f, g in zip(eqs.forcing, plain.forcing, strict=True))
    return near.laws(bodies, tuple(force.expand() for force in forces), frozenset(rest.values()))


def _state(symbols: Symbols) -> Vector:
    values = (symbols.values[name] for name in symbols.free)
    return (*values, *(symbols.rates[name] for name in symbols.free))


@dataclass(frozen=True)
class _Near:
    """A neighbourhood of rest."""

    scene: Scene
    symbols: Symbols
    origin: Mapping[Expr, Expr]  # q₀ of each free coordinate, by its symbol

    @property
    def _rates(self) -> Vector:
        return tuple(self.symbols.rates[name] for name in self.symbols.free)

    def _at_rest(self, expression: Expr) -> Expr:
        return se.sympify(expression).subs({**self.origin, **dict.fromkeys(self._rates, 0)})

    @property
    def _apart(self) -> Vector:
        """x = q − q₀"""
        return tuple(value - start for value, start in self.origin.items())

    def linear(self, expression: Expr) -> Expr:
        """The expression to first order in x and ẋ."""
        by_values = (self._at_rest(expression.diff(q)) * x for q, x in zip(self.origin, self._apart, strict=True))
        by_rates = (self._at_rest(expression.diff(u)) * u for u in self._rates)
        return self._at_rest(expression) + sum(by_values, ZERO) + sum(by_rates, ZERO)

    def deviating(self, force: Expr) -> Expr:
        """A force that vanishes at rest, to first order; what it has there by rounding is left out."""
        linear = self.linear(force)
        return linear if self._changes(force) else linear - self._at_rest(force)

    def _changes(self, expression: Expr) -> bool:
        return not vanishes(self._at_rest(expression).diff(self.symbols.time))

    def bodies(self) -> Scene:
        """The scene with all positions linear, and without loads."""
        symbols = self.symbols.within(self.scene.material)
        writer, moving = Writer(symbols, self.scene.names), set(self.symbols.free)

        def change(expression: Expression) -> Expression:
            if not expression.names & moving:
                return expression
            return writer.expression(self.linear(to_symengine(expression.tree, symbols)))

        points = tuple(rewritten(point, change) for point in self.scene.points)
        bodies = tuple(rewritten(body, change) for body in self.scene.bodies)
        return replace(self.scene, points=points, bodies=bodies, loads=(), labels={})

    def agrees(self, full: Equations, plain: Equations) -> bool:
        """Whether the linear bodies have the mass matrix of the full scene at rest."""
        pairs = zip(full.mass_matrix, plain.mass_matrix, strict=True)
        return all(vanishes(self._at_rest(a) - b) for row, other in pairs for a, b in zip(row, other, strict=True))

    def laws(self, bodies: Scene, forces: Vector, rest: frozenset[str]) -> LinearLaws:
        write = _Coefficients(bodies, self.symbols, frozenset(self.symbols.values[name] for name in rest))
        stiffness = [[-force.diff(q) for q in self.origin] for force in forces]
        damping = [[-force.diff(u) for u in self._rates] for force in forces]
        given = zip(self.symbols.free, map(self._at_rest, forces), strict=True)
        return LinearLaws(
            bodies,
            write.half(stiffness, 1),
            write.half(stiffness, -1),
            write.half(damping, 1),
            write.half(damping, -1),
            {name: write.coefficient(force) for name, force in given if not vanishes(force)},
        )


@dataclass(frozen=True)
class _Coefficients:
    """Writes entries of matrices."""

    scene: Scene
    symbols: Symbols
    rest: frozenset[Expr]  # the parameters that hold q₀

    def half(self, matrix: list[list[Expr]], sign: int) -> Entries:
        """The upper triangle of ½ (A + Aᵀ), or, with sign −1, of ½ (A − Aᵀ)."""
        names = self.symbols.free
        pairs = ((i, j) for j in range(len(names)) for i in range(j + 1))
        entries = {(names[i], names[j]): ((matrix[i][j] + sign * matrix[j][i]) / 2).expand() for i, j in pairs}
        return {pair: self.coefficient(entry) for pair, entry in entries.items() if not vanishes(entry)}

    def coefficient(self, entry: Expr) -> Coefficient:
        if not vanishes(entry.diff(self.symbols.time)):
            return self._plain(entry)
        entry = entry.subs({self.symbols.time: 0})
        if not entry.free_symbols & self.rest:
            return self._plain(entry)
        values = {self.symbols.values[each.name]: each.value for each in self.scene.parameters}
        return float(entry.subs(values).n(real=True))

    def _plain(self, entry: Expr) -> Expression:
        return Writer(self.symbols, self.scene.names).expression(entry)
