"""The same scene in other units: the same method, the same events, the same motion.

Lengths, masses and times are counted in units between a millionth and a million times those of the scene; a tolerance
of places goes along.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.toml import read_toml
from deltaq.mechanics.units import dimension_of
from deltaq.simulation.auto import choose
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

SPAN, TOLERANCE = 3.0, 1e-6
DRAWS = range(6)
FILES = {each.stem: each for each in (Path(__file__).parent / "scenes").glob("*.toml")}


class Units(NamedTuple):
    """How many times as large the numbers of lengths, masses and times become."""

    length: float = 1.0
    mass: float = 1.0
    time: float = 1.0

    def factor(self, unit: str) -> float:
        """Of a quantity with this unit; what has none is a number."""
        found = dimension_of(unit) if unit else None
        if found is None:
            return 1.0
        powers = float(found.length), float(found.mass), float(found.time)
        return float(np.prod([each**power for each, power in zip(self, powers, strict=True)]))

    def scene(self, scene: Scene) -> Scene:
        """The scene in these units; bounds of sliders do not matter."""
        coordinates = [
            replace(
                each,
                value=each.value * self.factor(each.unit),
                rate=each.rate * self.factor(each.unit) / self.time,
                min=None,
                max=None,
            )
            for each in scene.coordinates
        ]
        parameters = [
            replace(each, value=each.value * self.factor(each.unit), min=None, max=None) for each in scene.parameters
        ]
        return replace(scene, coordinates=tuple(coordinates), parameters=tuple(parameters))


def drawn(name: str, draw: int) -> Units:
    """Each to a power of ten by chance, or one of them alone to its end.

    Rates above 10⁶ and energies above 10¹⁰ are left out: numbers above 10¹⁵ are taken for those of a motion that
    diverges.
    """
    source = Random(f"{name} {draw}")
    while draw % 2:
        found = Units(*(10.0 ** source.uniform(-6.0, 6.0) for _ in Units._fields))
        if found.length < 1e6 * found.time and found.mass * (found.length / found.time) ** 2 < 1e10:
            return found
    return Units(**{source.choice(Units._fields): 10.0 ** source.choice((-6.0, 6.0))})


def falling(then: str) -> dict[str, Any]:
    """A mass on a spring that comes down to a floor at b, and has a ceiling at c, where its motion ends."""
    values = {"m": ("kg", 1.0), "k": ("N/m", 7.0), "g": ("m/s^2", 9.81), "b": ("m", -1.3), "c": ("m", 1.1)}
    end = [{"name": "ceiling", "value": "c - y"}]
    floor = {"name": "floor", "value": "y - b", "then": then} | ({"restitution": "1"} if then == "bounce" else {})
    loads = [
        {"kind": "gravity", "acceleration": ["0", "-g"]},
        {"kind": "force", "at": "mass", "force": ["0", "-k*y"]},
    ]
    return {
        "format": 1,
        "id": f"falling-{then}",
        "dimension": 2,
        "coordinates": [{"name": "y", "value": 0.9, "rate": 0.0, "unit": "m"}],
        "parameters": [{"name": n, "value": v, "unit": u, "positive": False} for n, (u, v) in values.items()],
        "bodies": [{"name": "mass", "kind": "particle", "mass": "m", "position": ["0", "y"]}],
        "loads": loads,
        "events": [floor, *end],
    }


OWN: Mapping[str, dict[str, Any]] = {"falling-end": falling("end"), "falling-bounce": falling("bounce")}
NAMES = (*scene_ids(), *FILES, *OWN)


def scene_named(name: str) -> Scene:
    if name in FILES:
        return read_scene(read_toml(FILES[name].read_text(encoding="utf-8")))
    return read_scene(OWN[name]) if name in OWN else load_scene(name)


class Seen(NamedTuple):
    """What a motion comes to, in units of its scene."""

    chosen: str
    status: str
    events: tuple[tuple[str, str], ...]
    times: tuple[float, ...]
    values: np.ndarray


@lru_cache(maxsize=16)
def seen(name: str, units: Units, method: str) -> Seen:
    """The motion of a scene in other units, turned back."""
    scene = units.scene(scene_named(name))
    problem = problem_of(scene, SPAN * units.time, 101)
    free = [units.factor(each.unit) for each in scene.coordinates if each.name in problem.model.layout.free]
    found = simulate(problem, get_method(method), tolerance=TOLERANCE * min(1.0, *free))
    event = () if found.event is None else ((scene.events[found.event.index].name, "end"),)
    at = () if found.event is None else (found.event.time / units.time,)
    return Seen(
        choose("auto", scene, problem, None, TOLERANCE).method.id,
        found.outcome.status.replace("tolerance_missed", "ok"),  # some tolerances are as small as rounding then
        (*((each.name, each.kind) for each in found.transitions), *event),
        (*(each.time / units.time for each in found.transitions), *at),
        found.values / np.array(free),
    )


def assert_alike(name: str, units: Units, method: str) -> None:
    ours, theirs = seen(name, Units(), method), seen(name, units, method)
    assert theirs[:3] == ours[:3], units
    np.testing.assert_allclose(theirs.times, ours.times, atol=1e-5)
    np.testing.assert_allclose(theirs.values, ours.values, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize(
    ("name", "units"),
    [
        pytest.param("magnetic-pendulum", Units(length=1e-6), id="differences for the choice of a method"),
        pytest.param("catching-pendulum", Units(time=1e6), id="what is left of the rate of a gap that opens"),
        pytest.param("braked-oscillator", Units(2e-6, 8e5, 8e4), id="rates of slipping that are as good as zero"),
    ],
)
def test_units_that_have_changed_something(name: str, units: Units) -> None:
    assert_alike(name, units, "dormand-prince-54")


@pytest.mark.one_in(6)
@pytest.mark.parametrize("draw", DRAWS)
@pytest.mark.parametrize("method", ["dop853", "dormand-prince-54"])
@pytest.mark.parametrize("name", NAMES)
def test_units_change_nothing(name: str, method: str, draw: int) -> None:
    assert_alike(name, drawn(name, draw), method)
