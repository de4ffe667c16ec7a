"""What makes motions of a scene follow several sets of equations: impacts, and dry friction, which sticks and slips."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..errors import Problem
from ..language.tree import Name, walk
from .contributions import Friction
from .loads.friction import DryFriction
from .reader import NOTHING
from .scene import Scene

MOST = 80  # characters of names in a sentence


def impacts_of(scene: Scene) -> tuple[str, ...]:
    """The names of events behind which the motion goes on with other velocities."""
    return tuple(event.name for event in scene.events if event.bounces)


def frictions_of(scene: Scene) -> tuple[Friction, ...]:
    """Dry friction on coordinates that are free; a guided one moves as it is told."""
    guided = {guide.coordinate for guide in scene.guides}
    found = (part for part in scene.contributions if isinstance(part, Friction))
    return tuple(part for part in found if not _names(part) <= guided)


def without_dry_friction(scene: Scene) -> Scene:
    """The scene without the forces of dry friction, which are reactions where something sticks."""
    rubbing = {part.source for part in frictions_of(scene)}
    loads = (
        replace(load, force=NOTHING) if isinstance(load, DryFriction) and load.name in rubbing else load
        for load in scene.loads
    )
    return replace(scene, loads=tuple(loads))


def _names(part: Friction) -> set[str]:
    return {node.name for node in walk(part.coordinate) if isinstance(node, Name)}


def jumps(scene: Scene, impacts: Problem, friction: Problem) -> Iterator[Problem]:
    """One problem of each kind that the scene has, with the names of what it is: what to do instead differs."""
    rubbing = tuple(dict.fromkeys(part.source for part in frictions_of(scene)))
    for problem, names in ((impacts, impacts_of(scene)), (friction, rubbing)):
        if names:
            yield Problem(problem.code, problem.pointer, parameters={"names": ", ".join(names)[:MOST]})
