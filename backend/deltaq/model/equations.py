"""Equations of motion of a scene in the form M(q, t) q̈ = f(q, q̇, t), from its kinetic energy and its loads.

Lagrange's equations of the second kind (Lurie, Analytical Mechanics, ch. 4) are written for everything that moves:
the free coordinates, the guided ones and the clock (the time as a coordinate of rate 1),

    Mᵢⱼ q̈ⱼ + bᵢ = Qᵢ + λᵢ,   Mᵢⱼ = ∂²E/∂q̇ᵢ∂q̇ⱼ,   bᵢ = ∂²E/∂q̇ᵢ∂qⱼ q̇ⱼ − ∂E/∂qᵢ.

The rows of the free coordinates (λ = 0), with the guides substituted, are the model. The other rows give the
constraint forces λ; their power Σ λᵢ q̇ᵢ is what guides and explicit time dependence feed into the system.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import symengine as se

from ..language.expression import Expression
from ..mechanics.scene import Scene
from .constraints import NONE, ConstraintEquations, constraint_equations
from .convected import convected
from .functions import Expr
from .kinetic import ZERO, Vector, components, dot, kinetic_energy
from .loads import Work, works
from .slopes import gradient, slope
from .symbols import CLOCK, Symbols
from .symengine_algebra import to_symengine
from .trigonometry import shortened


@dataclass(frozen=True)
class Equations:
    """The model as expressions in q, q̇, t and the parameters; guides are substituted everywhere.

    The power P of all that is not in E + V is affine in the accelerations: P = power + acceleration_power · q̈.
    """

    symbols: Symbols
    mass_matrix: tuple[Vector, ...]
    forcing: Vector
    kinetic: Expr
    potential: Expr
    power: Expr
    acceleration_power: Vector
    forces: Vector  # generalized forces Q, those of potentials included
    guided: Mapping[str, tuple[Expr, Expr]]  # value and rate
    positions: Mapping[str, Vector]
    arrows: Mapping[str, Vector]  # force vectors by load, or by "load:place" where a load acts in several places
    events: Vector  # what is positive as long as the scene's events have not happened
    constraints: ConstraintEquations = NONE  # M q̈ = f + Aᵀλ where there are any; P then has −λ·b as well
    has_impacts: bool = False  # which take energy at once, though P may be zero between them

    @property
    def is_powered(self) -> bool:
        """Whether anything feeds power in or takes it that is not in E + V."""
        always = self.has_impacts or self.constraints.is_driven
        return always or any(part != 0 for part in (self.power, *self.acceleration_power))


def equations(scene: Scene) -> Equations:
    """The model of a scene."""
    symbols = Symbols.of(scene)
    guides = _Guides.of(scene, symbols)
    kinetic = shortened(sum((kinetic_energy(part, symbols) for body in scene.bodies for part in body.kinetics), ZERO))
    loads = works(scene, symbols)
    rows = _rows(kinetic, loads, symbols)
    count = len(symbols.free)
    given = guides.accelerations
    power, acceleration_power = _power(rows, loads, guides, count)
    return Equations(
        symbols,
        tuple(guides.into(row.mass[:count]) for row in rows[:count]),
        guides.into(tuple(row.forcing - dot(row.mass[count:], given) for row in rows[:count])),
        guides.into((kinetic,))[0],
        guides.into((sum((load.potential for load in loads), ZERO),))[0],
        guides.into((power,))[0],
        guides.into(acceleration_power),
        guides.into(tuple(sum((load.forces[i] for load in loads), ZERO) for i in range(count))),
        {name: guides.motion(name) for name in symbols.guided},
        {name: guides.into(_position(place, symbols)) for name, place in scene.places.items()},
        {name: guides.into(force) for name, force in _arrows(scene, loads).items()},
        guides.into(components(tuple(event.value.tree for event in scene.events), symbols)),
        constraint_equations(scene, symbols, guides.into),
    )


def guided_into(scene: Scene, expression: Expr) -> Expr:
    """An expression of the scene with the guides put in, and the clock's rate."""
    return _Guides.of(scene, Symbols.of(scene)).into((expression,))[0]


def _position(place: tuple[Expression, ...], symbols: Symbols) -> Vector:
    return components(tuple(x.tree for x in place), symbols)


@dataclass(frozen=True)
class _Row:
    """One of Lagrange's equations: mass · q̈ = forcing (+ the constraint force)."""

    rate: Expr
    mass: Vector
    forcing: Expr


def _rows(kinetic: Expr, loads: tuple[Work, ...], symbols: Symbols) -> tuple[_Row, ...]:
    rates = tuple(symbols.rates[name] for name in symbols.moving)
    mass = tuple(gradient(momentum, rates) for momentum in gradient(kinetic, rates))
    rest = convected(mass, tuple(symbols.values[name] for name in symbols.moving), rates)
    forces = (sum((load.forces[i] for load in loads), ZERO) for i in range(len(rates)))
    return tuple(map(_Row, rates, mass, (force - b for force, b in zip(forces, rest, strict=True))))


def _power(rows: tuple[_Row, ...], loads: tuple[Work, ...], guides: _Guides, count: int) -> tuple[Expr, Vector]:
    """The power of non-conservative forces and of the constraint forces λ = M q̈ − forcing of guides and clock."""
    held = rows[count:]
    by_loads = sum((load.power for load in loads), ZERO)
    by_guides = sum((row.rate * (dot(row.mass[count:], guides.accelerations) - row.forcing) for row in held), ZERO)
    with_accelerations = tuple(sum((row.rate * row.mass[j] for row in held), ZERO) for j in range(count))
    return by_loads + by_guides, with_accelerations


def _arrows(scene: Scene, loads: tuple[Work, ...]) -> dict[str, Vector]:
    arrows = [
        (contribution.source, *work.arrow)
        for contribution, work in zip(scene.contributions, loads, strict=True)
        if work.arrow is not None
    ]
    sources = [source for source, _, _ in arrows]
    return {(s if sources.count(s) == 1 else f"{s}:{place}"): force for s, place, force in arrows}


@dataclass(frozen=True)
class _Guides:
    """The motion that guides and the clock prescribe, to be substituted."""

    substitution: Mapping[Expr, Expr]
    values: Mapping[str, Expr]
    time: Expr

    @classmethod
    def of(cls, scene: Scene, symbols: Symbols) -> _Guides:
        values = {guide.coordinate: to_symengine(guide.value.tree, symbols) for guide in scene.guides}
        of_values = {symbols.values[name]: value for name, value in values.items()}
        of_rates = {symbols.rates[name]: slope(value, symbols.time) for name, value in values.items()}
        return cls(of_values | of_rates | {symbols.rates[CLOCK]: se.Integer(1)}, values, symbols.time)

    @property
    def accelerations(self) -> Vector:
        """The second derivatives of what is prescribed, the clock (which ticks evenly) last."""
        return (*(slope(slope(value, self.time), self.time) for value in self.values.values()), ZERO)

    def motion(self, name: str) -> tuple[Expr, Expr]:
        return self.values[name], slope(self.values[name], self.time)

    def into(self, expressions: Vector) -> Vector:
        """The expressions with the prescribed motion in place of guided coordinates and rates (chain rule included)."""
        return tuple(se.sympify(expression).subs(self.substitution) for expression in expressions)
