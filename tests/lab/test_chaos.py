"""Lyapunov exponents where they are known, horizons, and the map of flips."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from deltaq.lab.divergence import exponents, twins
from deltaq.lab.experiments.chaos import horizon, run
from deltaq.lab.flips import Plane, first_flip
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of

FREE = np.zeros(1, dtype=np.int64)


def hill(force: float) -> Scene:
    """A particle on top of a hill (or in a well): ẍ = force · x."""
    return read_scene(
        {
            "id": "hill",
            "coordinates": [{"name": "x", "value": 0.0}],
            "parameters": [{"name": "m", "value": 1.0}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
            "loads": [{"kind": "potential", "name": "hill", "energy": f"{-force / 2}*x^2"}],
        }
    )


def wild(t_end: float = 30.0) -> Problem:
    return replace(problem_of(load_scene("double-pendulum"), t_end, 801), values=(2.0, 2.5))


@pytest.mark.parametrize(
    ("problem", "exponent", "within"),
    [
        pytest.param(problem_of(hill(1.0), 1.0), 1.0, 0.01, id="hill: 1"),
        pytest.param(problem_of(hill(4.0), 1.0), 2.0, 0.01, id="steeper hill: 2"),
        pytest.param(problem_of(hill(-1.0), 1.0), 0.0, 0.01, id="well: 0"),
        pytest.param(problem_of(load_scene("pendulum"), 1.0), 0.0, 0.03, id="pendulum: 0"),
    ],
)
def test_exponent_of_motions_that_are_known(problem: Problem, exponent: float, within: float) -> None:
    found = list(exponents(problem, 0.4))[-1]
    assert found.last == pytest.approx(exponent, abs=within)


def test_the_wild_double_pendulum_is_chaotic_and_a_digit_buys_what_its_exponent_says() -> None:
    found = list(exponents(wild(), 0.4))[-1]
    assert 1.0 < found.last < 2.5
    told = horizon(wild())
    assert told["per_digit"] == pytest.approx(math.log(10.0) / found.last, rel=0.35)


def test_twins_of_a_regular_motion_stay_together() -> None:
    times, distances = twins(problem_of(load_scene("pendulum"), 10.0), 1e-8, 101)
    assert distances[0] == pytest.approx(1e-8, rel=1e-6)
    assert distances.max() < 1e-6
    assert len(times) == 101


def test_a_regular_motion_loses_nothing() -> None:
    assert horizon(problem_of(load_scene("pendulum"), 5.0, 201))["points"] == []


def test_a_pendulum_from_rest_never_turns_over_and_a_fast_one_does() -> None:
    problem = problem_of(load_scene("pendulum"), 10.0)
    assert first_flip(replace(problem, values=(3.0,), rates=(0.0,)), FREE) == math.inf
    time = first_flip(replace(problem, values=(0.0,), rates=(1000.0,)), FREE)
    assert time == pytest.approx(math.pi / 1000.0, rel=0.05)


def test_the_map_of_the_double_pendulum_is_symmetric_and_empty_where_the_energy_is_too_low() -> None:
    problem = replace(problem_of(load_scene("double-pendulum"), 4.0), rates=(0.0, 0.0))
    side = (np.arange(16) + 0.5) / 16 * math.tau - math.pi
    found = list(Plane(problem, 0, 1, side, side).refined())
    assert [np.isnan(times).sum() for times in found] == [240, 192, 0]
    whole = found[-1]
    assert np.mean(np.isclose(whole, whole[::-1, ::-1], rtol=1e-2) | np.isinf(whole)) > 0.9
    assert np.isinf(whole[6:10, 6:10]).all()


@pytest.mark.parametrize("scene", ["kapitza", "guided-pendulum"])
def test_a_driven_scene_is_followed_over_whole_periods(scene: str) -> None:
    found = list(run({"scene": scene, "t_end": 5.0}))[-1].result["exponent"]
    assert isinstance(found, dict)
    assert math.isfinite(found["last"])


def test_a_scene_of_one_angle_has_no_map() -> None:
    assert list(run({"scene": "pendulum", "t_end": 5.0, "map": True}))[-1].result["map"] == {"missing": "angles"}
