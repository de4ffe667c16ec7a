"""What climbing does with bad numbers, with scenes that fail, and when it is cancelled."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest
from tests.lab.ladder.climbing import climbed

from deltaq.errors import RequestError
from deltaq.lab.ladder.climb import climb
from deltaq.lab.ladder.findings import FULL, Ladder, Measured
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene


def test_every_number_out_of_bounds_is_told() -> None:
    with pytest.raises(RequestError) as caught:
        next(climb(load_scene("pendulum"), 0.0, (1.0, -1.0), 20.0, 0))
    assert [(each.code, each.pointer, dict(each.parameters)) for each in caught.value.problems] == [
        ("request-outside", "/t_end", {"value": 0.0, "min": 0.0, "max": 1000.0}),
        ("request-outside", "/tolerance", {"value": 20.0, "min": 0.0, "max": 10.0}),
        ("request-outside", "/repeats", {"value": 0, "min": 0, "max": 25}),
        ("request-outside", "/amplitudes/1", {"value": -1.0, "min": 0.0, "max": 10.0}),
    ]


def test_too_many_amplitudes_are_refused() -> None:
    with pytest.raises(RequestError, match="request-outside at /amplitudes"):
        next(climb(load_scene("pendulum"), 1.0, tuple(0.1 * k for k in range(1, 10))))


def test_a_cancelled_climb_ends() -> None:
    flag = np.zeros(1, dtype=np.int64)
    findings = climb(load_scene("elastic-pendulum"), 5.0, cancelled=flag)
    assert isinstance(next(findings), Ladder)
    assert isinstance(next(findings), Measured)
    flag[0] = 1
    assert list(findings) == []


def test_the_tolerance_decides_which_rung_is_least() -> None:
    scene = load_scene("coupled-pendulums")
    assert {limit: climbed(scene, 5.0, tolerance=limit).least.rung for limit in (1e-3, 0.1, 0.5)} == {
        1e-3: FULL,
        0.1: "linearized",
        0.5: "frozen:phi2",
    }


def test_simpler_rungs_take_fewer_operations() -> None:
    found = climbed(load_scene("double-pendulum"), 1.0)
    costs = {name: each.cost.operations.total for name, each in found.measured.items() if each.cost}
    assert costs["frozen:phi1"] < costs["linearized"] < costs[FULL]


def test_without_rest_there_is_one_amplitude() -> None:
    found = climbed(load_scene("atwood"), 1.0, (0.1, 0.5))
    assert found.ladder.amplitudes == (1.0,)
    assert dict(found.ladder.centre) == {}
    assert dict(found.growth) == {}


def test_the_same_motion_is_measured_where_amplitude_is_one() -> None:
    found = climbed(load_scene("elastic-pendulum"), 2.0, (0.5,))
    assert len(found.growth) == len(found.ladder.rungs) - 1
    for rung, growth in found.growth.items():
        assert growth.relative[1] == pytest.approx(found.relative(rung), rel=1e-6)


PARTICLE = {"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "0"]}


def potential(energy: str) -> Scene:
    return read_scene(
        {
            "coordinates": [{"name": "x", "value": 0.3, "rate": 0.1}],
            "parameters": [{"name": "m", "value": 1.0}, {"name": "k", "value": 3.0}, {"name": "E", "value": 2.0}],
            "bodies": [PARTICLE],
            "loads": [{"kind": "potential", "name": "well", "energy": energy}],
        }
    )


@pytest.mark.parametrize(
    ("energy", "status"),
    [
        pytest.param("-k/x", "singular", id="falls into the centre"),
        pytest.param("-k*x^4*1000", "diverged", id="runs away"),
        pytest.param("k*sqrt(x)", "singular", id="leaves the domain"),
        pytest.param("k*x^4", "ok", id="no linear force at rest"),
        pytest.param("0", "ok", id="no force at all"),
        pytest.param("E*exp(1)*x^2/2 + k*x^4", "ok", id="a parameter called E"),
    ],
)
def test_scenes_that_fail_are_measured_as_far_as_they_go(energy: str, status: str) -> None:
    found = climbed(potential(energy), 5.0, (0.5, 1.0))
    assert found.measured[FULL].outcome.status == status
    assert (found.measured[FULL].cost is None) is (status != "ok")
    assert found.least.rung in found.measured


def test_the_constant_e_is_not_the_parameter_of_that_name() -> None:
    """x = 0.3: the linear oscillator with E·e instead of k, to first order of its amplitude."""
    slope = climbed(potential("E*exp(1)*x^2/2 + k*x^4"), 2.0, (0.01, 0.02)).growth["linearized"].slope
    assert slope == pytest.approx(2.0, abs=0.3)


def spherical(**changes: object) -> Scene:
    return read_scene(write_scene(load_scene("spherical-pendulum")) | changes)


def starting(theta: float, rate: float) -> list[dict[str, object]]:
    first, second = cast("list[dict[str, object]]", write_scene(load_scene("spherical-pendulum"))["coordinates"])
    return [first | {"value": theta, "min": None}, second | {"rate": rate}]


def test_without_angular_momentum_the_plane_pendulum_is_enough() -> None:
    assert climbed(spherical(coordinates=starting(0.9, 0.0)), 4.0).least.rung == "frozen:psi"


def test_an_event_ends_the_comparison() -> None:
    """The string goes slack; both motions are compared as far as both go."""
    found = climbed(load_scene("string-pendulum"), 5.0)
    full, rung = found.measured[FULL], found.measured["linearized"]
    assert (full.outcome.status, rung.outcome.status) == ("event", "event")
    assert full.deviation is not None
    assert rung.deviation is not None
    assert full.deviation.times[-1] < 5.0
    assert rung.deviation.times[-1] <= full.deviation.times[-1]


def test_a_rung_that_ends_too_early_is_not_least() -> None:
    """With the azimuth held, nothing keeps the pendulum away from the vertical, where the event is."""
    found = climbed(spherical(events=[{"name": "low", "value": "theta - 0.4"}]), 5.0, (0.5,), tolerance=0.5)
    assert found.measured[FULL].outcome.status == "ok"
    assert found.measured["frozen:psi"].outcome.status == "event"
    assert found.relative("frozen:psi") < 0.5
    assert found.least.rung == "cyclic:psi"


def test_events_that_need_a_cyclic_rate_are_left_out_of_the_reduced_scene() -> None:
    events = [{"name": "fast", "value": "20 - dot(psi)"}, {"name": "low", "value": "theta - 0.1"}]
    found = climbed(spherical(events=events), 0.5)
    kept = {
        rung.id: [event["name"] for event in cast("list[dict[str, str]]", rung.scene.get("events", []))]
        for rung in found.ladder.rungs
        if rung.scene is not None
    }
    assert kept["cyclic:psi"] == ["low"]
    assert kept["frozen:psi"] == ["fast", "low"]
