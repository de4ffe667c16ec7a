"""What holds released quantities along a motion, and what answers say of constraints."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.simulation.constrained import G
from tests.simulation.test_constraints import swing

from deltaq.errors import Problem, RequestError, UnknownNameError
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.service import run

PENDULUM = {"scene": "pendulum", "t_end": 5.0, "samples": 51, "tolerance": 1e-11}


def test_the_rod_of_a_pendulum_pulls_with_weight_and_centripetal_force() -> None:
    start = {"initial": {"phi": {"value": np.pi / 2, "rate": 0.0}}, "parameters": {"m": 1.0, "l": 1.0, "g": G}}
    found: Any = run({**PENDULUM, **start, "release": ["l"]})
    angle, square = swing(np.array(found["t"]))
    wrong = np.abs(np.array(found["multipliers"]["l"]) + square + G * np.cos(angle))
    assert wrong.max() < 1e-9
    assert (wrong <= np.array(found["error"]["multipliers"]["l"])).all()


def test_the_force_of_a_guide_does_the_work_that_the_motion_takes_up() -> None:
    found: Any = run({"scene": "kapitza", "release": ["y"], "t_end": 0.5, "samples": 5001, "tolerance": 1e-11})
    power = np.array(found["multipliers"]["y"]) * np.array(found["rates"]["y"])
    total = np.array(found["energy"]["kinetic"]) + np.array(found["energy"]["potential"])
    work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(found["t"]))])
    assert np.ptp(work) > 1.0
    assert np.abs(work - (total - total[0])).max() < 1e-4 * np.ptp(work)


def test_no_reaction_is_told_where_accelerations_are_those_of_several_modes() -> None:
    rough: Any = write_scene(load_scene("pendulum"))
    rough["loads"].append({"name": "rough", "kind": "friction", "coordinate": "phi", "force": "0.1*m"})
    assert run({**PENDULUM, "scene": rough})["status"] == "ok"
    with pytest.raises(RequestError) as caught:
        run({**PENDULUM, "scene": rough, "release": ["l"]})
    assert caught.value.problems == (Problem("release-with-friction", "/release", parameters={"names": "rough"}),)


def test_what_nothing_holds_is_refused_where_it_is_asked() -> None:
    with pytest.raises(UnknownNameError) as caught:
        run({**PENDULUM, "release": ["l", "phi"]})
    assert [(problem.code, problem.pointer) for problem in caught.value.problems] == [("cannot-release", "/release/1")]


def test_an_answer_tells_of_constraints_only_where_there_are_some() -> None:
    found = run(dict(PENDULUM))
    assert not {"multipliers", "undetermined", "drift", "moved"} & found.keys()
