"""Damping left out: dampers, dissipation functions and drag, so that a motion that dies out goes on for ever.

Drag is a force or moment that depends on rates, vanishes at rest and only ever takes energy.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5 (Rayleigh's function).
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import singledispatch

from ....language.floats import evaluate
from ....language.tree import Node, Rate, walk
from ....mechanics.contributions import DissipationFunction, DistributedForce, Moment, PointForce
from ....mechanics.loads import Load
from ....mechanics.scene import Scene
from ..findings import Part
from ..names import with_loads
from ..simplification import Kind, SimplificationContext, Simplified

POINTS, STEP, ROUNDING = 12, 1e-5, 1e-7


@dataclass(frozen=True)
class _Push:
    """A generalized push: force components, and the places or angles they work on."""

    force: tuple[Node, ...]
    position: tuple[Node, ...]


def _offered(context: SimplificationContext) -> Iterator[Part]:
    if any(_is_damping(load, context.scene) for load in context.scene.loads):
        yield Part("undamped", {})


def _simplify(context: SimplificationContext, _part: Part) -> Simplified:
    scene = context.scene
    kept = tuple(load for load in scene.loads if not _is_damping(load, scene))
    return Simplified(with_loads(scene, kept))


def _is_damping(load: Load, scene: Scene) -> bool:
    parts = load.contributions(scene.places, scene.bodies)
    return bool(parts) and all(_takes_energy(part, scene) for part in parts)


@singledispatch
def _takes_energy(_contribution: object, _scene: Scene) -> bool:
    return False


@_takes_energy.register
def _(_contribution: DissipationFunction, _scene: Scene) -> bool:
    return True


@_takes_energy.register
def _(contribution: PointForce, scene: Scene) -> bool:
    place = tuple(component.tree for component in scene.place(contribution.place))
    return _is_drag(_Push(contribution.force, place), scene)


@_takes_energy.register
def _(contribution: Moment, scene: Scene) -> bool:
    return _is_drag(_Push((contribution.moment,), (contribution.angle,)), scene)


@_takes_energy.register
def _(contribution: DistributedForce, scene: Scene) -> bool:
    return _is_drag(_Push(contribution.density, contribution.position), scene)


def _is_drag(push: _Push, scene: Scene) -> bool:
    if not any(isinstance(node, Rate) for part in push.force for node in walk(part)):
        return False
    points = [_point(scene, random.Random(seed)) for seed in range(POINTS)]
    at_rest = [_force(push, _resting(scene, point)) for point in points]
    powers = [_power(push, scene, point) for point in points]
    size = max(map(abs, powers))
    return all(abs(x) <= ROUNDING for force in at_rest for x in force) and max(powers) <= ROUNDING * size


def _point(scene: Scene, source: random.Random) -> dict[str, float]:
    """A configuration and rates at random, with the parameters as they are."""
    moving = {each.name: each.value + source.uniform(-1, 1) for each in scene.coordinates}
    rates = {f"dot({name})": source.uniform(-2, 2) for name in moving}
    material = {each.name: source.uniform(0, 1) for each in scene.material}
    return scene.parameter_values | moving | rates | material | {"t": source.random()}


def _resting(scene: Scene, point: Mapping[str, float]) -> dict[str, float]:
    return {**point, **{f"dot({each.name})": 0.0 for each in scene.coordinates}}


def _force(push: _Push, point: Mapping[str, float]) -> list[float]:
    return [evaluate(component, point) for component in push.force]


def _power(push: _Push, scene: Scene, point: Mapping[str, float]) -> float:
    """F·v, v by a difference along the rates."""
    ahead, behind = (
        [evaluate(x, {**point, **_moved(scene, point, sign * STEP)}) for x in push.position] for sign in (1, -1)
    )
    speeds = [(a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True)]
    return sum(f * v for f, v in zip(_force(push, point), speeds, strict=True))


def _moved(scene: Scene, point: Mapping[str, float], time: float) -> dict[str, float]:
    return {each.name: point[each.name] + time * point[f"dot({each.name})"] for each in scene.coordinates}


KIND = Kind("undamped", _offered, _simplify, ("rigid", "cyclic", "linearized"))
