"""Whether an expression has a value at all: a root of what is always negative has none."""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Iterator, Mapping

from ..errors import Problem
from ..language.differentiation import MAX_RATE
from ..language.expression import Expression
from ..language.floats import evaluate, evaluate_beyond
from ..language.spelling import spell_rate
from .scene import Scene

POINTS = 12
REACH = 0.9  # around the initial values


def definedness_problems(scene: Scene, expressions: Iterable[tuple[str, Expression]]) -> Iterator[Problem]:
    """The expressions that are defined neither at the initial values nor anywhere near them, by their pointers."""
    points = tuple(points_around(scene))
    for pointer, expression in expressions:
        if expression.has_derivatives:
            continue
        if not any(math.isfinite(evaluate_beyond(expression.tree, point)) for point in points):
            yield Problem("never-defined", pointer, parameters={"expression": expression.text[:60]})


def points_around(scene: Scene) -> Iterator[Mapping[str, float]]:
    """The start, and random states around it: values of all names and rates, those of material coordinates too."""
    source = random.Random(1)
    for number in range(POINTS):
        reach = REACH if number else 0.0
        point = scene.parameter_values | {"t": abs(reach)}
        for c in scene.coordinates:
            point[c.name] = c.value + source.uniform(-reach, reach)
            point[spell_rate(c.name, 1)] = c.rate + source.uniform(-reach, reach)
            point |= {spell_rate(c.name, order): source.uniform(-reach, reach) for order in range(2, MAX_RATE + 1)}
        for m in scene.material:
            lower, upper = evaluate(m.lower.tree, point), evaluate(m.upper.tree, point)
            point[m.name] = lower + source.uniform(0.05, 0.95) * (upper - lower)
        yield point
