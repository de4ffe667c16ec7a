"""Each student's own values: the parameters of a scene drawn from a seed, the same ones every time."""

from __future__ import annotations

import random
from dataclasses import replace

from ..mechanics.parameter import Parameter
from ..mechanics.scene import Scene

FACTORS = (0.5, 0.6, 0.75, 0.8, 1.2, 1.25, 1.5, 1.6, 2.0)


def seeded(scene: Scene, seed: str) -> Scene:
    """The scene with every parameter but the acceleration of gravity times a plain factor, within its range."""
    source = random.Random(f"{scene.id}/{seed}")
    return replace(scene, parameters=tuple(_drawn(parameter, source) for parameter in scene.parameters))


def _drawn(parameter: Parameter, source: random.Random) -> Parameter:
    factor = source.choice(FACTORS)
    if parameter.unit == "m/s^2":
        return parameter
    value = float(f"{parameter.value * factor:.2g}")
    low = parameter.value if parameter.min is None else parameter.min
    high = parameter.value if parameter.max is None else parameter.max
    outside = (parameter.min is not None and value < low) or (parameter.max is not None and value > high)
    return parameter if outside else replace(parameter, value=value)
