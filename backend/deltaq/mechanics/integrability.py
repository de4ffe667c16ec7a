"""Whether the integral of a density exists: ∫ of a pole such as 1/s has no value, however finely it is summed.

The interval is halved where halves and whole differ. At an integrable singularity the parts fade away with their
length; at a pole they never do.
Source: Davis, Rabinowitz, Methods of Numerical Integration, 2nd ed., §6.2 (adaptive integration).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial

from ..errors import Problem
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.spelling import spell_rate
from .mass import GAUSS
from .material import Material
from .scene import Scene

DEPTH = 50
PANELS = 3
TOLERANCE = 1e-3  # of the sum over the panels
GROWTH = 1e6  # a part that is found so much larger grows without end

Function = Callable[[float], float]


def integrability_problems(scene: Scene) -> Iterator[Problem]:
    """The densities of continua and distributed forces that cannot be integrated along a material coordinate."""
    values = scene.parameter_values | {c.name: c.value + 0.3 for c in scene.coordinates}
    values |= {spell_rate(c.name, 1): c.rate + 0.3 for c in scene.coordinates} | {"t": 0.3}
    for key, things in {"bodies": scene.bodies, "loads": scene.loads}.items():
        for index, thing in enumerate(things):
            material, density = getattr(thing, "material", ()), getattr(thing, "density", ())
            for part in density if isinstance(density, tuple) else (density,):
                for name in _poles(part, material, values):
                    yield Problem("divergent-integral", f"/{key}/{index}/density", parameters={"name": name})
                    break


def _poles(density: Expression, material: tuple[Material, ...], values: dict[str, float]) -> Iterator[str]:
    """The material coordinates along which the density has one, the others in the middle."""
    ends = {m.name: (evaluate(m.lower.tree, values), evaluate(m.upper.tree, values)) for m in material}
    middle = values | {name: lower + 0.43 * (upper - lower) for name, (lower, upper) in ends.items()}
    for name, (lower, upper) in ends.items():
        if not is_integrable(partial(_along, name, density, middle), lower, upper):
            yield name


def _along(name: str, density: Expression, middle: dict[str, float], s: float) -> float:
    return evaluate(density.tree, {**middle, name: s})


def is_integrable(function: Function, lower: float, upper: float) -> bool:
    """Whether ∫ |f| converges from the lower to the upper bound."""
    panels = [(lower + k * (upper - lower) / PANELS, (upper - lower) / PANELS) for k in range(PANELS)]
    sums = [_sum(function, start, width) for start, width in panels]
    allowed = TOLERANCE * sum(filter(math.isfinite, sums))
    pairs = zip(panels, sums, strict=True)
    return all(_converges(function, start, width, whole, allowed, DEPTH) for (start, width), whole in pairs)


def _converges(function: Function, start: float, width: float, whole: float, allowed: float, depth: int) -> bool:
    """Whether halving comes to an end; `whole` is the sum over the part as it is."""
    half = width / 2
    left, right = _sum(function, start, half), _sum(function, start + half, half)
    if abs(left + right - whole) <= allowed:
        return True
    if depth == 0 or left + right > GROWTH * allowed:
        return False
    parts = ((start, left), (start + half, right))
    return all(_converges(function, place, half, part, allowed, depth - 1) for place, part in parts)


def _sum(function: Function, start: float, width: float) -> float:
    return sum(weight * width * abs(function(start + place * width)) for place, weight in GAUSS)
