"""Whether constraints say different things, and gaps anything, in plain numbers.

Constraints whose rows depend on one another everywhere are functions of one another: one of them says nothing new, or
contradicts the others (`dependence`). Where rows do so only where all constraints hold (a platform on three parallel
rods), the motion is determined, and the multipliers are not (`redundancy`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..errors import Problem
from ..language.floats import evaluate
from .constraints.distance import DistanceConstraint
from .dependence import dependence_problems, random_points
from .rows import STEP, growth
from .scene import Scene


def independence_problems(scene: Scene) -> Iterator[Problem]:
    """Constraints without effect on what is free, those that follow from others, and those that contradict them."""
    if not scene.constraints:
        return
    yield from _lengths(scene)
    free, names = ([coordinate.name for coordinate in each] for each in (scene.free, scene.coordinates))
    yield from dependence_problems(scene.conditions, free, random_points(scene.start, names))


def gap_problems(scene: Scene) -> Iterator[Problem]:
    """Impacts whose gap no coordinate changes, so that they would have no direction."""
    names = [coordinate.name for coordinate in scene.coordinates]
    for index, event in enumerate(scene.events):
        if not event.bounces or event.value.rates:
            continue
        points = random_points(scene.start, names)
        rows = [[growth(event.value.tree, point, name, STEP) for name in names] for point in points]
        known = [row for row in rows if all(map(math.isfinite, row))]
        if known and not any(any(row) for row in known):
            yield Problem("bounce-without-coordinates", f"/events/{index}/value")


def _lengths(scene: Scene) -> Iterator[Problem]:
    """A rod without length has no direction in which its force could act."""
    start = scene.stated_values
    for index, constraint in enumerate(scene.constraints):
        if isinstance(constraint, DistanceConstraint) and (length := evaluate(constraint.length.tree, start)) <= 0:
            yield Problem("length-not-positive", f"/constraints/{index}/length", parameters={"value": f"{length:g}"})
