"""A rung that agrees by symmetry alone is told from one that would hold in the real world."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.lab.ladder.climbing import climbed

from deltaq.lab.experiments.fidelity import EXPERIMENT
from deltaq.lab.ladder.findings import FULL
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of


def starting(scene: Scene, **values: float) -> Scene:
    found = (
        replace(each, value=values[each.name], min=None, max=None) if each.name in values else each
        for each in scene.coordinates
    )
    return replace(scene, coordinates=tuple(found))


STRAIGHT, LONG = {"r": 1.1, "phi": 0.0}, 60.0


def test_internal_resonance_is_found_behind_a_straight_start() -> None:
    """The spring pendulum of the library is near 2:1 (ω_r² ≈ 4 ω_φ²): the vertical motion hands its energy over."""
    found = climbed(starting(load_scene("spring-pendulum"), **STRAIGHT), LONG)
    assert found.relative("frozen:phi") < 1e-6
    assert found.measured["frozen:phi"].survives is False
    assert found.measured["linearized"].survives is False
    assert found.least.rung == FULL


@pytest.mark.parametrize("angle", [pytest.param(1e-6, id="ahead"), pytest.param(-3e-6, id="behind")])
def test_the_verdict_is_that_of_a_start_that_is_really_nudged(angle: float) -> None:
    scene = load_scene("spring-pendulum")
    really = climbed(starting(scene, **(STRAIGHT | {"phi": angle})), LONG)
    seeming = climbed(starting(scene, **STRAIGHT), LONG)
    assert really.least.rung == seeming.least.rung
    after = seeming.measured["frozen:phi"].nudged
    assert after == pytest.approx(really.relative("frozen:phi"), rel=0.5)


def test_before_the_resonance_has_grown_a_rung_will_do() -> None:
    found = climbed(starting(load_scene("spring-pendulum"), **STRAIGHT), 5.0)
    assert found.measured["frozen:phi"].survives
    assert found.least.rung == "frozen:phi"


def saddle(k: float) -> Scene:
    """x on a ridge, y in a valley, and no force between them."""
    return read_scene(
        {
            "coordinates": [{"name": "x", "value": 0.0, "unit": "m"}, {"name": "y", "value": 0.3, "unit": "m"}],
            "parameters": [{"name": "m", "value": 1.0}, {"name": "k", "value": k}, {"name": "c", "value": 4.0}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "loads": [{"kind": "potential", "name": "field", "energy": "-k*x^2/2 + c*y^2/2"}],
        }
    )


@pytest.mark.parametrize("growth", [pytest.param(6.0, id="too little"), pytest.param(14.0, id="too much")])
def test_an_unstable_equilibrium_counts_by_what_it_makes_of_the_nudge(growth: float) -> None:
    """x ~ 10⁻⁶ e^(√k t)/2, against a hundredth of the extent 0.6."""
    found = climbed(saddle((growth / 5.0) ** 2), 5.0)
    assert found.relative("frozen:x") < 1e-9
    assert found.measured["frozen:x"].survives is (1e-6 * math.exp(growth) < 0.006)


def test_chaos_of_the_full_model_is_no_fault_of_an_exact_rung() -> None:
    """A double pendulum on a cart: nearby motions part, but without the cyclic cart each is found as it is."""
    scene, span = double_pendulum_on_a_cart(), 12.0
    runs = [
        simulate(problem_of(starting(scene, a=angle), span), get_method("dop853"), tolerance=1e-11)
        for angle in (2.5, 2.5 + 1e-6)
    ]
    assert np.abs(runs[0].values - runs[1].values).max() > 0.05
    found = climbed(scene, span)
    assert found.measured["cyclic:x"].survives
    assert found.least.rung == "cyclic:x"


def double_pendulum_on_a_cart() -> Scene:
    first, second = ["x + l*sin(a)", "l*cos(a)"], ["x + l*(sin(a) + sin(b))", "l*(cos(a) + cos(b))"]
    positions = {"cart": ["x", "0"], "one": first, "two": second}
    return read_scene(
        {
            "coordinates": [
                {"name": "x", "value": 0.0, "unit": "m"},
                {"name": "a", "value": 2.5, "unit": "rad"},
                {"name": "b", "value": 2.0, "unit": "rad"},
            ],
            "parameters": [
                {"name": "m", "value": 1.0, "unit": "kg"},
                {"name": "l", "value": 1.0, "unit": "m"},
                {"name": "g", "value": 9.81, "unit": "m/s^2"},
            ],
            "bodies": [
                {"name": name, "kind": "particle", "mass": "m", "position": position}
                for name, position in positions.items()
            ],
            "loads": [{"kind": "gravity", "name": "weight", "acceleration": ["0", "g"]}],
        }
    )


@pytest.mark.parametrize(
    ("scene", "rung"),
    [
        pytest.param(load_scene("conical-pendulum"), "frozen:theta", id="steady motion"),
        pytest.param(starting(load_scene("coupled-pendulums"), phi1=0.0), "linearized", id="rest"),
        pytest.param(starting(load_scene("cart-pendulum"), phi=0.02), "cyclic:x+linearized", id="small oscillations"),
    ],
)
def test_what_is_stable_survives(scene: Scene, rung: str) -> None:
    found = climbed(scene, 10.0).measured[rung]
    assert found.survives
    assert found.nudged is not None
    assert found.deviation is not None
    assert found.nudged == pytest.approx(found.deviation.relative or 0.0, abs=1e-4)


def test_at_rest_the_motion_after_a_nudge_is_what_counts() -> None:
    """As it does where the pendulums are really a millionth off."""
    scene = load_scene("coupled-pendulums")
    still, nearly = (climbed(starting(scene, phi1=angle), 10.0) for angle in (0.0, 1e-6))
    assert still.measured["frozen:phi2"].survives is False
    assert still.least.rung == nearly.least.rung == "linearized"


def test_what_is_out_of_tolerance_is_not_tried() -> None:
    found = climbed(load_scene("double-pendulum"), 1.0).measured["frozen:phi1"]
    assert (found.nudged, found.survives) == (None, None)


def test_the_exact_rung_stays_exact_over_hundreds_of_turns() -> None:
    """The cyclic angle is found by integrating its rate over samples: these must be as dense as the motion asks."""
    assert climbed(load_scene("spherical-pendulum"), 200.0).relative("cyclic:psi") < 1e-5


def test_the_lab_tells_it() -> None:
    scene = write_scene(starting(load_scene("spring-pendulum"), **STRAIGHT))
    *_, last = EXPERIMENT.run({"scene": scene, "t_end": LONG})
    told = {one["rung"]: one for one in last.result["measured"]}
    assert told["frozen:phi"]["survives"] is False
    assert told["frozen:phi"]["nudged"] > 0.5
    assert told[FULL]["until"] == LONG
    assert last.result["least"] == FULL
