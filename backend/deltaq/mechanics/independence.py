"""Whether constraints say different things, and gaps anything, in plain numbers.

Constraints whose rows depend on one another everywhere are functions of one another: one of them says nothing new, or
contradicts the others (`dependence`). Where rows do so only where all constraints hold (a platform on three parallel
rods), the motion is determined, and the multipliers are not (`redundancy`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..errors import Problem
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.gradients import gradient
from ..language.tree import Call, Negation, Node, Power, Product, Quotient
from .constraints.distance import DistanceConstraint
from .dependence import dependence_problems, random_points
from .loads.friction import DryFriction
from .scene import Scene


def independence_problems(scene: Scene) -> Iterator[Problem]:
    """Constraints without effect on what is free, those that follow from others, and those that contradict them."""
    if not scene.constraints:
        return
    yield from _lengths(scene)
    free, names = ([coordinate.name for coordinate in each] for each in (scene.free, scene.coordinates))
    yield from dependence_problems(scene.conditions, free, random_points(scene.start, names))


def gap_problems(scene: Scene) -> Iterator[Problem]:
    """Impacts whose gap no coordinate changes, and friction on what none moves: they would have no direction."""
    for index, event in enumerate(scene.events):
        if event.bounces and not event.value.rates and _is_still(scene, event.value):
            yield Problem("bounce-without-coordinates", f"/events/{index}/value")
        elif event.bounces and (flat := flat_part(event.value.tree, scene)) is not None:
            place, text = flat.span, event.value.text
            told = {"part": text[place.offset : place.offset + place.length][:80]}
            yield Problem("bounce-without-gradient", f"/events/{index}/value", place.offset, place.length, told)
    for index, load in enumerate(scene.loads):
        if isinstance(load, DryFriction) and _is_still(scene, load.coordinate):
            yield Problem("friction-without-coordinates", f"/loads/{index}/coordinate")


def flat_part(gap: Node, scene: Scene) -> Node | None:
    """A factor of a gap that is a power of a gap itself, other than the first, or a root: y^3, sqrt(y), 2*y^2*x.

    Where it closes its gradient is zero, or has no value: the impact along it has no direction, or an even power does
    not even change its sign.
    """
    moving = {coordinate.name for coordinate in scene.coordinates}
    return next((part for part in _factors(gap) if _is_flat(part) and Expression("", part).names & moving), None)


def _factors(gap: Node) -> Iterator[Node]:
    match gap:
        case Product(factors=factors):
            yield from (each for factor in factors for each in _factors(factor))
        case Quotient(numerator=above):
            yield from _factors(above)
        case Negation(operand=operand):
            yield from _factors(operand)
        case _:
            yield gap


def _is_flat(part: Node) -> bool:
    """Whether it is zero where its base is, and not as steep."""
    match part:
        case Call(function="sqrt"):
            return True
        case Power(exponent=exponent):
            power = evaluate(exponent, {}) if not Expression("", exponent).names else math.nan
            return power > 0.0 and power != 1.0
    return False


def _is_still(scene: Scene, value: Expression) -> bool:
    """Whether no coordinate changes a value, at random places where it is a number."""
    names = [coordinate.name for coordinate in scene.coordinates]
    points = random_points(scene.start, names)
    rows = [gradient(value.tree, point, names) for point in points]
    known = [row for row in rows if all(map(math.isfinite, row))]
    return bool(known) and not any(any(row) for row in known)


def _lengths(scene: Scene) -> Iterator[Problem]:
    """A rod without length has no direction in which its force could act."""
    start = scene.stated_values
    for index, constraint in enumerate(scene.constraints):
        if isinstance(constraint, DistanceConstraint) and (length := evaluate(constraint.length.tree, start)) <= 0:
            yield Problem(
                "length-not-positive", f"/constraints/{index}/length", parameters={"value": float(f"{length:g}")}
            )
