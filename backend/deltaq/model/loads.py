"""The generalized forces, the potential energy and the power that the contributions of a scene's loads add."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

import symengine as se

from ..language.tree import Node
from ..mechanics.contributions import PointForce, PotentialEnergy
from ..mechanics.scene import Scene
from .functions import Expr
from .kinetic import Vector, position, velocity
from .symbols import Symbols
from .symengine_algebra import to_symengine

ZERO = se.Integer(0)


@dataclass(frozen=True)
class Work:
    """What one contribution does: V (its potential energy) or Q (generalized forces, of all that moves) and P = Q·q̇."""

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
def _of_force(contribution: PointForce, scene: Scene, symbols: Symbols) -> Work:
    """δW = F·δr. A uniform force (one that depends on nothing that moves) has the potential V = −F·r."""
    force = _components(contribution.force, symbols)
    r = position(scene.place(contribution.place), symbols)
    arrow = (contribution.place, force)
    if _is_uniform(force, symbols):
        return _conservative(-_dot(force, r), symbols, arrow)
    forces = tuple(_dot(force, tuple(x.diff(symbols.values[name]) for x in r)) for name in symbols.moving)
    return Work(ZERO, forces, _dot(force, velocity(r, symbols)), arrow)


def _conservative(potential: Expr, symbols: Symbols, arrow: tuple[str, Vector] | None = None) -> Work:
    gradient = tuple(-potential.diff(symbols.values[name]) for name in symbols.moving)
    return Work(potential, gradient, ZERO, arrow)


def _components(force: tuple[Node, ...], symbols: Symbols) -> Vector:
    return tuple(to_symengine(component, symbols) for component in force)


def _dot(a: Vector, b: Vector) -> Expr:
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


def _is_uniform(force: Vector, symbols: Symbols) -> bool:
    moving = {symbols.values[name] for name in symbols.moving} | set(symbols.rates.values())
    return not any(component.free_symbols & moving for component in force)
