"""What of a motion that cannot be followed at all is told: that it cannot."""

from __future__ import annotations

import json
from typing import Any

import pytest

from deltaq.api.jobs import Parts, experiment
from deltaq.errors import RequestError

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of NumPy: overflows are what this is about


@pytest.mark.parametrize(
    ("name", "scene", "parameters"),
    [
        pytest.param("convergence", "pendulum", {"l": 1e155}, id="no second sample"),
        pytest.param("chaos", "elastic-pendulum", {"k": 1e153}, id="no reference"),
        pytest.param("energy-drift", "pendulum", {"m": 9.6e-60, "l": 1e200, "g": 1e16}, id="no energy"),
        pytest.param("stability", "elastic-pendulum", {"k": 1e155, "m": 1.2e240, "l": 7e178}, id="no linearization"),
    ],
)
def test_experiments_on_no_motion_say_so(name: str, scene: str, parameters: dict[str, float]) -> None:
    with pytest.raises(RequestError) as caught:
        list(experiment(question(name, scene, parameters)))
    assert [one.code for one in caught.value.problems] == ["no-motion"]


@pytest.mark.parametrize(
    ("scene", "parameters"),
    [
        pytest.param("two-mass-oscillator", {"kappa": 3.8e97}, id="no second sample"),
        pytest.param("double-pendulum", {"l1": 2.9e52, "m1": 1.7e308, "l2": 1e200}, id="no size"),
    ],
)
def test_of_no_motion_the_ladder_has_no_verdict(scene: str, parameters: dict[str, float]) -> None:
    last = answered(experiment(question("fidelity", scene, parameters)))
    json.dumps(last, allow_nan=False, default=vars)
    assert last["least"] == ""


def answered(running: Parts) -> dict[str, Any]:
    """What comes after all parts."""
    while True:
        try:
            next(running)
        except StopIteration as end:
            return dict(end.value)


def question(name: str, scene: str, parameters: dict[str, float]) -> dict[str, Any]:
    return {"experiment": name, "scene": scene, "parameters": parameters, "t_end": 0.5, "lang": "en"}
