"""Bounds that values must keep, whoever gives them: friction that opposes, restitution from 0 to 1, masses that are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ..errors import Parameter, Problem
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.spelling import spell_rate
from ..language.tree import Name, Node, Rate, walk
from .contributions import Friction
from .inertia import light_problems, names_of_mass
from .scene import Scene, restitution_problem

SAME = 1e-12  # of a friction force: what two ways to write the same may differ by


@dataclass(frozen=True)
class Bound:
    """A problem of some values, and the names of what the value that breaks the bound is made of."""

    problem: Problem
    names: frozenset[str]


def start_of(scene: Scene) -> dict[str, float]:
    """Parameters, coordinates and rates at t = 0 by name, as they are stated, guided coordinates as they move."""
    return scene.start | {spell_rate(c.name, 1): c.rate for c in scene.coordinates}


def value_problems(scene: Scene) -> Iterator[Problem]:
    """What is wrong with the values that a scene has now, where the motion begins."""
    yield from (each.problem for each in broken_bounds(scene, start_of(scene)))


def broken_bounds(scene: Scene, values: Mapping[str, float]) -> Iterator[Bound]:
    """The same with other values of parameters, coordinates and rates, by name."""
    yield from friction_bounds(scene, values)
    yield from _restitutions(scene, values)
    for body, problem in light_problems(scene, values):
        yield Bound(problem, names_of_mass(body))


def friction_bounds(scene: Scene, values: Mapping[str, float]) -> Iterator[Bound]:
    """Friction that would push, and such as holds less than it slips with: nothing could stick then."""
    for index, load in enumerate(scene.loads):
        for part in load.contributions(scene.places, scene.bodies):
            if isinstance(part, Friction):
                yield from _of_friction(f"/loads/{index}", part, values)


def _of_friction(pointer: str, part: Friction, values: Mapping[str, float]) -> Iterator[Bound]:
    for key, tree in (("force", part.force), ("static", part.static)):
        found = evaluate(tree, values)
        if found < 0.0:
            told: dict[str, Parameter] = {"name": part.source, "value": float(f"{found:g}")}
            yield Bound(Problem("friction-negative", f"{pointer}/{key}", parameters=told), _names(tree))
            return
    at_rest = _at_rest(part, values)
    if part.static == part.force or at_rest is None:
        return
    slipping, holding = evaluate(part.force, at_rest), evaluate(part.static, at_rest)
    if holding < slipping * (1.0 - SAME):
        told = {"name": part.source, "kinetic": float(f"{slipping:g}"), "static": float(f"{holding:g}")}
        names = _names(part.force) | _names(part.static)
        yield Bound(Problem("static-below-kinetic", f"{pointer}/static", parameters=told), names)


def _at_rest(part: Friction, values: Mapping[str, float]) -> Mapping[str, float] | None:
    """The values with a slipping coordinate that does not slip; None where that cannot be told of an expression."""
    rates = {node.name for tree in (part.force, part.static) for node in walk(tree) if isinstance(node, Rate)}
    if not rates:
        return values
    if not isinstance(part.coordinate, Name) or rates != {part.coordinate.name}:
        return None
    return {**values, spell_rate(part.coordinate.name, 1): evaluate(part.surface_rate, values)}


def _restitutions(scene: Scene, values: Mapping[str, float]) -> Iterator[Bound]:
    for index, event in enumerate(scene.events):
        if event.restitution is None:
            continue
        value = evaluate(event.restitution.tree, values)
        if not 0.0 <= value <= 1.0:
            yield Bound(restitution_problem(f"/events/{index}/restitution", value), event.restitution.names)


def _names(tree: Node) -> frozenset[str]:
    return Expression("", tree).names
