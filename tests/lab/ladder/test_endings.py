"""Verdicts are for as long as the full motion is known: it may be undetermined behind a state, or run out of digits."""

from __future__ import annotations

import math
import random
from dataclasses import replace

import numpy as np
import pytest
from tests.lab.ladder.climbing import climbed
from tests.lab.ladder.observers import Observer

from deltaq.lab.experiments.fidelity import EXPERIMENT
from deltaq.lab.ladder.centre import starting
from deltaq.lab.ladder.ending import DIGITS, EVENT, PASSAGE, START, WHOLE, known
from deltaq.lab.ladder.findings import FULL
from deltaq.lab.ladder.measurement import Accuracy, run_rung, yardstick
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method

FLAG = np.zeros(1, dtype=np.int64)
FAR = Observer("far origins", metre=1e3, second=10.0, in_degrees=True, origins=(-31.0, 57.0))


def with_parameters(scene: Scene, **values: float) -> Scene:
    found = (replace(each, value=values.get(each.name, each.value), min=None, max=None) for each in scene.parameters)
    return replace(scene, parameters=tuple(found))


def straight_atwood(seed: int) -> tuple[Scene, float]:
    """A bob that hangs straight and is pulled up: it meets the pulley after √(2 r (M + m)/(g (M − m)))."""
    source = random.Random(seed)
    r, g, light, heavy = (source.uniform(*each) for each in ((0.4, 1.8), (4.0, 15.0), (0.5, 1.5), (2.0, 6.0)))
    scene = with_parameters(load_scene("swinging-atwood"), m=light, M=heavy, g=g)
    return starting(scene, {"r": (r, 0.0), "theta": (0.0, 0.0)}), math.sqrt(
        2.0 * r * (heavy + light) / (g * (heavy - light))
    )


@pytest.mark.one_in(2)
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("observer", [Observer("own"), FAR], ids=lambda each: each.name)
def test_the_verdict_ends_where_the_bob_meets_the_pulley(seed: int, observer: Observer) -> None:
    """Until then it moves straight up; whatever misses the pulley by ever so little is thrown back."""
    scene, meets = straight_atwood(seed)
    span = 3.0 * meets
    found = climbed(observer.sees(scene), span * observer.second, tolerance=0.1).least
    assert (found.rung, found.ending) == ("frozen:theta", PASSAGE)
    assert 0.99 * meets < found.until / observer.second <= meets


def polar(rate: float) -> Scene:
    """A free particle in polar coordinates, 1 from their centre."""
    return read_scene(
        {
            "coordinates": [
                {"name": "r", "value": 1.0, "rate": -1.0, "unit": "m"},
                {"name": "phi", "value": 0.3, "rate": rate, "unit": "rad"},
            ],
            "parameters": [{"name": "m", "value": 2.0, "unit": "kg"}],
            "bodies": [
                {"name": "b", "kind": "particle", "mass": "m", "position": ["r*cos(phi)", "r*sin(phi)"]},
            ],
        }
    )


@pytest.mark.parametrize(
    ("scene", "rung"),
    [
        pytest.param(polar(0.0), "frozen:phi", id="free, through the centre"),
        pytest.param(
            starting(load_scene("spherical-pendulum"), {"theta": (0.9, 0.0), "psi": (0.0, 0.0)}),
            "frozen:psi",
            id="plane pendulum, through the pole",
        ),
    ],
)
def test_where_only_coordinates_jump_the_verdict_goes_on(scene: Scene, rung: str) -> None:
    found = climbed(scene, 3.0).least
    assert (found.rung, found.until, found.ending) == (rung, 3.0, WHOLE)


@pytest.mark.parametrize("observer", [Observer("own"), FAR], ids=lambda each: each.name)
@pytest.mark.parametrize("identifier", ["spherical-pendulum", "conical-pendulum", "heavy-top"])
def test_where_the_motion_cannot_begin_there_is_no_verdict(identifier: str, observer: Observer) -> None:
    """At a pole there is no azimuth; upright, a top's two angles are one."""
    scene = observer.sees(starting(load_scene(identifier), {"theta": (0.0, 0.0)}))
    found = climbed(scene, 2.0 * observer.second)
    assert found.measured[FULL].outcome.status == "singular_mass_matrix"
    assert (found.least.rung, found.least.until, found.least.ending) == (None, 0.0, START)
    assert not any(each.survives for each in found.measured.values())


def test_no_rung_is_lost_because_it_is_asked_to_be_finer_than_its_own_rounding() -> None:
    """Near upright the reduced top is a small difference of large numbers: it is computed as finely as can be."""
    scene = load_scene("heavy-top")
    nearly = starting(scene, {"theta": (0.014, 0.0)})
    seen = Observer("km, h", metre=1e-3, second=1 / 3600.0)
    assert climbed(seen.sees(nearly), 6.0 * seen.second).least.rung == "cyclic:psi,phi"


@pytest.mark.parametrize("tolerance", [0.3, 0.01])
def test_the_full_motion_is_known_only_as_long_as_it_is_far_finer_than_what_is_allowed(tolerance: float) -> None:
    """Chaos: the error of a rough run grows to all of the motion, and at the end told it is still below the allowed."""
    scene, span = starting(load_scene("double-pendulum"), {"phi1": (2.5, 0.0), "phi2": (2.0, 0.0)}), 12.0
    fine = run_rung(scene, span, FLAG, Accuracy(1e-11, 1601))
    rough = replace(fine, trajectory=simulate(fine.problem, get_method("rk4"), step=0.005))
    full, ending = known(rough, tolerance)
    truth = yardstick(fine)
    assert ending == DIGITS
    assert 1.0 < full.end < span
    names = truth.problem.model.layout.free
    apart = truth.errors(dict(zip(names, rough.trajectory.values.T, strict=True))) / truth.extent
    times = truth.times[: len(apart)]
    assert apart[times <= full.end].max() < tolerance
    assert apart.max() > tolerance


def test_small_orbits_far_from_the_origin_are_judged_as_long_as_they_are_known() -> None:
    """Where rounding lets no fine run get far, the verdict is for a part, and the same as from near by."""
    scene, span = starting(load_scene("swinging-atwood"), {"r": (0.02, 0.0), "theta": (0.03, 0.0)}), 1.0
    far = Observer("origins", origins=(0.7, -1.3))
    near, other = climbed(scene, span, tolerance=0.3).least, climbed(far.sees(scene), span, tolerance=0.3).least
    assert (near.rung, near.ending) == (FULL, WHOLE)
    assert other.rung == FULL
    assert other.until > 0.1


def test_an_event_is_told() -> None:
    found = climbed(load_scene("string-pendulum"), 5.0).least
    assert found.ending == EVENT
    assert found.until < 5.0


def test_the_lab_tells_how_long_and_why() -> None:
    scene, meets = straight_atwood(1)
    *_, last = EXPERIMENT.run({"scene": write_scene(scene), "t_end": 2.0 * meets})
    assert (last.result["least"], last.result["ending"]) == ("frozen:theta", PASSAGE)
    assert last.result["until"] == pytest.approx(meets, rel=0.01)


def test_the_lab_comes_to_an_end_where_the_motion_cannot_begin() -> None:
    *_, last = EXPERIMENT.run(
        {"scene": write_scene(starting(load_scene("heavy-top"), {"theta": (0.0, 0.0)})), "t_end": 1.0}
    )
    assert (last.result["least"], last.result["ending"], last.result["points"]) == ("", START, [])
    assert last.done == last.total
    assert EXPERIMENT.charts(last.result, lambda key, **_: key) == []
