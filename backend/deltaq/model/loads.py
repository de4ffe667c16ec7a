"""The generalized forces, the potential energy and the power that the contributions of a scene's loads add."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

from ..mechanics.contributions import (
    DissipationFunction,
    DistributedForce,
    Friction,
    GeneralizedPotential,
    Moment,
    PointForce,
    PotentialEnergy,
)
from ..mechanics.scene import Scene
from .functions import Expr, sign
from .kinetic import ZERO, Vector, components, dot, velocity
from .quadrature import integral
from .slopes import gradient
from .symbols import Symbols
from .symengine_algebra import to_symengine


@dataclass(frozen=True)
class Work:
    """What one contribution does: V (its potential energy) or Q (generalized forces, of all that moves) and P = Q·q̇.

    A load that depends on nothing that moves is uniform, and has a potential: −F·r, −M φ.
    """

    potential: Expr
    forces: Vector
    power: Expr
    arrow: tuple[str, Vector] | None = None  # a force to be drawn: its place and components


def works(scene: Scene, symbols: Symbols) -> tuple[Work, ...]:
    """The work of every contribution, in their order."""
    return tuple(_work(contribution, scene, symbols) for contribution in scene.contributions)


@singledispatch
def _work(contribution: object, _scene: Scene, _symbols: Symbols) -> Work:
    raise TypeError(f"no work is known for {type(contribution).__name__}")


@_work.register
def _of_potential(contribution: PotentialEnergy, _scene: Scene, symbols: Symbols) -> Work:
    """δW = −δV"""
    return _conservative(to_symengine(contribution.energy, symbols), symbols)


@_work.register
def _of_generalized_potential(contribution: GeneralizedPotential, _scene: Scene, symbols: Symbols) -> Work:
    """Q = d/dt ∂U/∂q̇ − ∂U/∂q with U = U₀ + Σ aᵢ q̇ᵢ: Qᵢ = Σ (∂aᵢ/∂qⱼ − ∂aⱼ/∂qᵢ) q̇ⱼ − ∂U₀/∂qᵢ over all that moves.

    What hangs on the rates has no power if the clock is counted among what moves.
    """
    function = to_symengine(contribution.energy, symbols)
    values = _values(symbols)
    rates = tuple(symbols.rates[name] for name in symbols.moving)
    slopes = gradient(function, rates)
    changes = [gradient(each, values) for each in slopes]
    forces = tuple(
        sum(((changes[i][j] - changes[j][i]) * rate for j, rate in enumerate(rates)), ZERO) for i in range(len(values))
    )
    still = _conservative(function.subs(dict.fromkeys(rates, 0)), symbols)
    return Work(still.potential, tuple(a + b for a, b in zip(forces, still.forces, strict=True)), ZERO)


@_work.register
def _of_force(contribution: PointForce, scene: Scene, symbols: Symbols) -> Work:
    """δW = F·δr"""
    force = components(contribution.force, symbols)
    r = components(tuple(x.tree for x in scene.place(contribution.place)), symbols)
    arrow = (contribution.place, force)
    if _is_uniform(force, symbols):
        return _conservative(-dot(force, r), symbols, arrow)
    return Work(ZERO, _along(force, r, symbols), dot(force, velocity(r, symbols)), arrow)


@_work.register
def _of_moment(contribution: Moment, _scene: Scene, symbols: Symbols) -> Work:
    """δW = M δφ"""
    moment, angle = (to_symengine(contribution.moment, symbols),), (to_symengine(contribution.angle, symbols),)
    if _is_uniform(moment, symbols):
        return _conservative(-moment[0] * angle[0], symbols)
    return Work(ZERO, _along(moment, angle, symbols), dot(moment, velocity(angle, symbols)))


@_work.register
def _of_dissipation(contribution: DissipationFunction, _scene: Scene, symbols: Symbols) -> Work:
    """δW = −∂R/∂q̇ᵢ δqᵢ"""
    function = to_symengine(contribution.function, symbols)
    rates = tuple(symbols.rates[name] for name in symbols.moving)
    forces = tuple(-each for each in gradient(function, rates))
    return Work(ZERO, forces, dot(forces, rates))


@_work.register
def _of_friction(contribution: Friction, _scene: Scene, symbols: Symbols) -> Work:
    """δW = −F sgn(ċ − u) δc; what sticks is told by `modes`."""
    c = (to_symengine(contribution.coordinate, symbols),)
    slip = velocity(c, symbols)[0] - to_symengine(contribution.surface_rate, symbols)
    force = (-to_symengine(contribution.force, symbols) * sign(slip),)
    return Work(ZERO, _along(force, c, symbols), dot(force, velocity(c, symbols)))


@_work.register
def _of_distributed_force(contribution: DistributedForce, _scene: Scene, symbols: Symbols) -> Work:
    """δW = ∫ f·δr d(material)"""
    inside = symbols.within(contribution.material)
    density, r = components(contribution.density, inside), components(contribution.position, inside)

    def total(part: Expr) -> Expr:
        return integral(part, contribution.material, inside)

    if _is_uniform(density, inside):
        return _conservative(total(-dot(density, r)), symbols)
    forces = tuple(total(part) for part in _along(density, r, inside))
    return Work(ZERO, forces, total(dot(density, velocity(r, inside))))


def _conservative(potential: Expr, symbols: Symbols, arrow: tuple[str, Vector] | None = None) -> Work:
    forces = tuple(-each for each in gradient(potential, _values(symbols)))
    return Work(potential, forces, ZERO, arrow)


def _along(force: Vector, r: Vector, symbols: Symbols) -> Vector:
    """Q = F·∂r/∂q for all that moves."""
    slopes = [gradient(x, _values(symbols)) for x in r]
    return tuple(dot(force, tuple(each[i] for each in slopes)) for i in range(len(symbols.moving)))


def _values(symbols: Symbols) -> Vector:
    return tuple(symbols.values[name] for name in symbols.moving)


def _is_uniform(force: Vector, symbols: Symbols) -> bool:
    moving = {symbols.values[name] for name in symbols.moving} | set(symbols.rates.values())
    return not any(component.free_symbols & moving for component in force)
