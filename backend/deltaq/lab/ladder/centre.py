"""The state that amplitudes are counted from: rest, or steady motion where coordinates are cyclic.

The other coordinates stay at values q₀ at which their forces vanish, f(q₀, q̇_c, t) = 0 with the cyclic rates q̇_c that
the conserved momenta p ask for; where the laws depend on time, the mean of f (`mean.py`) vanishes.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1; Lurie, Analytical Mechanics, ch. 7 (steady motion).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ...mechanics.coordinate import Coordinate
from ...mechanics.scene import Scene
from .distance import Yardstick
from .steady import CLOSE, Steady


@dataclass(frozen=True)
class Centre:
    """A scene's own initial state, seen from its centre.

    `values` are those of all free coordinates at rest; in steady motion, of those that are not cyclic.
    """

    steady: Steady
    values: Mapping[str, float]

    def at(self, amplitude: float) -> Scene:
        """The scene with the deviation from the centre that many times larger, and the same momenta."""
        steady, free = self.steady, self.steady.scene.free
        place = np.array([_scaled(each.value, self.values.get(each.name, each.value), amplitude) for each in free])
        rates = steady.rates(place, amplitude * np.array([each.rate for each in free]))
        found = {c.name: (float(q), float(v)) for c, q, v in zip(free, place, rates, strict=True)}
        return starting(steady.scene, found)


def starting(scene: Scene, values: Mapping[str, tuple[float, float]]) -> Scene:
    """The scene with other initial values and rates of the coordinates named."""
    return replace(scene, coordinates=tuple(_set(each, values) for each in scene.coordinates))


def centre_of(scene: Scene, full: Yardstick) -> Centre | None:
    """The centre of a scene nearest to its initial state; one at which nothing grows, if there is such a one.

    `full` is the scene's motion, whose size is the measure of what is near.
    """
    if not len(full.times):
        return None
    steady = Steady.of(scene, full)
    found = [place for start in steady.starts() if (place := steady.settled(start)) is not None]
    if not found:
        return None
    here = np.array([each.value for each in scene.free])
    nearest = min(found, key=lambda place: (not steady.lasts(place), full.apart(place, here)))
    turns = steady.rates(nearest, np.zeros(len(nearest))) / full.units * full.problem.t_end
    stays = not np.any(np.abs(turns[~full.can_be_boosted]) > CLOSE)
    kept = [each.name for each in scene.free if stays or each.name not in steady.conserved.names]
    values = dict(zip((each.name for each in scene.free), nearest.tolist(), strict=True))
    return Centre(steady, {name: values[name] for name in kept})


def _scaled(value: float, rest: float, amplitude: float) -> float:
    return value if amplitude == 1.0 else rest + amplitude * (value - rest)


def _set(coordinate: Coordinate, found: Mapping[str, tuple[float, float]]) -> Coordinate:
    """The coordinate with its initial value and rate; the range of the slider gives way."""
    value, rate = found.get(coordinate.name, (coordinate.value, coordinate.rate))
    low = None if coordinate.min is None else min(coordinate.min, value)
    high = None if coordinate.max is None else max(coordinate.max, value)
    return replace(coordinate, value=value, rate=rate, min=low, max=high)
