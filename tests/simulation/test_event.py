"""Events against the closed form of a string that goes slack; how sure their times are; what the answer says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipkinc
from tests.simulation.scenes import oscillator

from deltaq.errors import Problem, SceneError
from deltaq.mechanics.changes import change
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.model.model import compile_model
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import problem_of, run
from deltaq.simulation.trajectory import Trajectory

G = 9.81
ACCURACIES = ({"step": 0.02}, {"step": 0.003}, {"tolerance": 1e-4}, {"tolerance": 1e-8})
TIMED = {"event", "event_timed"}  # the latter where the error shows in six digits
STARTS = ((-1.2, 4.5), (0.0, 5.0), (0.0, 6.9), (0.8, 4.6))  # angle and rate


def on_string(angle: float, rate: float) -> Scene:
    """The library's pendulum on a string of length 1, started otherwise."""
    scene = load_scene("string-pendulum")
    return replace(scene, coordinates=(replace(scene.coordinates[0], value=angle, rate=rate),))


def slack(angle: float, rate: float) -> tuple[float, float]:
    """Time and angle at which the string goes slack: with v₀ the speed at the bottom, cos φ = −(v₀²/gℓ − 2)/3.

    From φ̇ = v₀/ℓ √(1 − k² sin²(φ/2)), k² = 4gℓ/v₀², the time is an elliptic integral of the first kind; for k > 1 by
    the reciprocal modulus (Whittaker, Analytical Dynamics, §44; Byrd, Friedman, 162.02).
    """
    v2 = rate**2 + 2 * G * (1 - np.cos(angle))
    end, k = np.arccos(-(v2 / G - 2) / 3), np.sqrt(4 * G / v2)

    def first_kind(phi: float) -> float:
        if k < 1:
            return float(ellipkinc(phi / 2, k**2))
        return float(ellipkinc(np.arcsin(k * np.sin(phi / 2)), 1 / k**2) / k)

    return 2 / np.sqrt(v2) * (first_kind(end) - first_kind(angle)), float(end)


def simulated(start: tuple[float, float], method: str, t_end: float = 10.0, **accuracy: float) -> Trajectory:
    return simulate(problem_of(on_string(*start), t_end), get_method(method), **accuracy)


@pytest.mark.one_in(4)
@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("method", method_ids())
def test_every_method_finds_when_the_string_goes_slack(method: str, start: tuple[float, float]) -> None:
    """True error of time and angle ≤ estimate; the motion ends at the event."""
    time, angle = slack(*start)
    for accuracy in ACCURACIES:
        found = simulated(start, method, **accuracy)
        if found.outcome.code not in TIMED:  # so coarse that it cannot be told
            assert (method in {"explicit-euler", "symplectic-euler"}, accuracy) == (True, ACCURACIES[0])
            continue
        assert abs(found.event.time - time) <= found.event.error <= 0.2
        assert abs(found.values[-1, 0] - angle) <= found.estimate.errors[-1] + found.event.error * abs(
            found.rates[-1, 0]
        )
        assert found.times[-1] == found.event.time == found.reached
        assert np.all(np.diff(found.times) > 0)
        assert len(found.times) == len(found.values) == len(found.estimate.errors) == int(time / 0.02) + 2


def test_the_error_of_the_time_is_rarely_a_hundred_times_too_large() -> None:
    ratios = []
    for start in STARTS:
        time = slack(*start)[0]
        for method in method_ids():
            found = [simulated(start, method, **accuracy) for accuracy in ACCURACIES]
            timed = [each.event for each in found if each.outcome.code in TIMED]
            ratios += [event.error / max(abs(event.time - time), 2e-16) for event in timed]
    assert np.mean(np.array(ratios) <= 100) >= 0.9


GRAZING = [
    pytest.param(1e-6, "dop853", {"tolerance": 1e-3}, "event", id="just slack"),
    pytest.param(1e-9, "dormand-prince-54", {"tolerance": 1e-6}, "event", id="slack for 20 microseconds"),
    pytest.param(1e-9, "radau-5", {"tolerance": 1e-8}, "event", id="slack for 20 microseconds, implicitly"),
    pytest.param(1e-9, "rk4", {"step": 0.01}, "event_doubtful", id="too coarse to tell"),
    pytest.param(-1e-9, "rk4", {"step": 0.01}, "event_doubtful", id="too coarse to tell that nothing happens"),
    pytest.param(1e-4, "heun", {"step": 0.01}, "event_doubtful", id="far too coarse to tell"),
    pytest.param(-1e-9, "dop853", {"tolerance": 1e-6}, "ok", id="just taut"),
    pytest.param(-1e-6, "gauss-4", {"step": 0.01}, "ok", id="just taut, fixed steps"),
]


@pytest.mark.parametrize(("short", "method", "accuracy", "code"), GRAZING)
def test_what_is_too_close_to_tell_is_told(short: float, method: str, accuracy: dict[str, float], code: str) -> None:
    """At v₀² = 5gℓ the tension just falls to zero at the top: short of it the string goes slack, beyond it never."""
    rate = float(np.sqrt(G * (5 - short)))
    found = simulated((0.0, rate), method, 2.0, **accuracy)
    assert found.outcome.code == code
    assert (found.outcome.status, len(found.times) < 501) == (("ok", False) if code == "ok" else ("event", True))
    if code == "event":
        assert abs(found.event.time - slack(0.0, rate)[0]) <= found.event.error <= 1e-5
    if code == "event_doubtful":
        assert found.event.error is None
        assert 0.6 < found.times[-1] <= found.reached < 0.65


def moved(*values: str) -> Scene:
    """The oscillator x = cos 2t with events."""
    events = [{"name": f"event{number}", "value": value} for number, value in enumerate(values)]
    return read_scene({**write_scene(oscillator()), "events": events})


EVERYTHING = brentq(lambda t: 4 / 8 + 2 * np.cos(2 * t) * np.sin(2 * t) * np.cos(t) - t, 0.5, 2.0)


@pytest.mark.parametrize("method", ["dop853", "rk4", "stormer-verlet", "gauss-4", "newmark", "radau-5"])
@pytest.mark.parametrize(
    ("value", "time"),
    [
        pytest.param("x", np.pi / 4, id="a coordinate"),
        pytest.param("1 + dot(x)", np.pi / 12, id="a rate"),
        pytest.param("1.25 - t", 1.25, id="the time"),
        pytest.param("k/8 - x*dot(x)*cos(t) - t", EVERYTHING, id="everything"),
        pytest.param("1e-12*x", np.pi / 4, id="a tiny value"),
    ],
)
def test_a_value_may_depend_on_all_that_moves(value: str, time: float, method: str) -> None:
    accuracy = {"tolerance": 1e-7} if get_method(method).is_adaptive else {"step": 0.005}
    found = simulate(problem_of(moved(value), 3.0), get_method(method), **accuracy)
    assert found.outcome.code in TIMED
    assert (found.outcome.code == "event_timed") == (found.event.error > 1e-5 * found.event.time)
    assert abs(found.event.time - time) <= found.event.error <= 1e-3


@pytest.mark.parametrize("method", ["dormand-prince-54", "radau-5", "implicit-midpoint", "newmark"])
@pytest.mark.parametrize(
    ("value", "time"),
    [
        pytest.param("0.05 - y", np.pi / 6, id="a guided coordinate"),
        pytest.param("dot(y) - 0.05", np.pi / 3, id="its rate"),
    ],
)
def test_a_value_may_depend_on_what_is_guided(value: str, time: float, method: str) -> None:
    """y = 0.1 sin t feeds power in, so that the work is among the states."""
    document = {**write_scene(load_scene("base-pendulum")), "events": [{"name": "met", "value": value}]}
    scene = change(read_scene(document), guides=[{"coordinate": "y", "value": "0.1*sin(t)"}])
    found = simulate(problem_of(scene, 3.0), get_method(method), tolerance=1e-5)
    assert found.outcome.status == "event"
    assert abs(found.event.time - time) <= found.event.error <= 1e-4
    assert len(found.work) == len(found.times)


@pytest.mark.parametrize("samples", [2, 7, 501, 5001])
def test_an_event_is_found_however_few_samples_are_asked_for(samples: int) -> None:
    found = simulate(problem_of(moved("x"), 3.0, samples), get_method("dop853"), tolerance=1e-9)
    assert found.event.time == pytest.approx(np.pi / 4, abs=1e-9)
    assert found.times.tolist() == pytest.approx([*np.linspace(0, 3, samples)[: len(found.times) - 1], np.pi / 4])


def test_the_first_of_several_events_ends_the_motion() -> None:
    found = simulate(problem_of(moved("2 - t", "x", "1.9 + dot(x)"), 3.0), get_method("dop853"), tolerance=1e-9)
    assert (found.event.index, found.event.time) == (2, pytest.approx(np.arcsin(0.95) / 2, abs=1e-9))


def test_an_event_beyond_the_end_does_not_count() -> None:
    """A fixed step of an implicit method goes past the end."""
    found = simulate(problem_of(moved("1.02 - t"), 1.0), get_method("gauss-4"), step=0.3)
    assert (found.outcome.status, found.event, found.times[-1]) == ("ok", None, 1.0)


def test_without_an_error_estimate_the_event_is_there_without_one() -> None:
    found = simulate(problem_of(moved("x"), 3.0), get_method("dop853"), tolerance=1e-9, with_error=False)
    assert (found.outcome.code, found.event.error, found.cost.runs) == ("event", None, 1)
    assert found.event.time == pytest.approx(np.pi / 4, abs=1e-9)


def test_parameters_are_inputs() -> None:
    """Other values need no other machine code."""
    scene = load_scene("string-pendulum")
    longer = replace(scene, parameters=tuple(replace(p, value=1.5 * p.value, max=25.0) for p in scene.parameters))
    assert compile_model(longer).events is compile_model(scene).events
    assert compile_model(replace(scene, events=())).events is None


def test_the_answer_names_the_event() -> None:
    asked = {"scene": "string-pendulum", "t_end": 5.0, "samples": 51, "tolerance": 1e-9}
    answer = run(asked)
    time = slack(-1.2, 4.5)[0]
    assert answer["status"] == "event"
    assert answer["reason"] == answer["remedy"]
    assert (answer["reason"]["code"], answer["reason"]["parameters"]["t"]) == ("event", 0.707723)
    assert answer["event"]["name"] == "slack"
    assert set(answer["event"]["title"]) == {"de", "en"}
    assert abs(answer["event"]["t"] - time) <= answer["event"]["error"] <= 1e-5
    assert answer["t"] == pytest.approx([0.1 * number for number in range(8)] + [time])
    assert run(asked | {"t_end": 0.5})["status"] == "ok"
    assert run(asked | {"include": ["coordinates"]})["event"]["error"] is None


def test_what_has_happened_at_the_start_is_a_problem() -> None:
    parameters = {"name": "slack", "value": "m*(g*cos(phi) + l*dot(phi)^2)", "found": -9.71}
    with pytest.raises(SceneError) as caught:
        run({"scene": "string-pendulum", "t_end": 1.0, "initial": {"phi": {"value": 3.0, "rate": 0.0}}})
    assert caught.value.problems == (Problem("event-at-start", "/scene/events/0/value", parameters=parameters),)


@pytest.mark.parametrize(("angle", "starts"), [(1e-9, True), (0.0, False), (-1e-9, False)])
def test_an_event_that_is_reached_as_the_motion_begins_has_happened(angle: float, starts: bool) -> None:
    document = write_scene(oscillator("-k*x", x=angle, u=1.0))
    asked = {"scene": document | {"events": [{"name": "wall", "value": "x"}]}, "t_end": 1.0}
    if starts:
        assert run(asked)["status"] == "ok"
    else:
        with pytest.raises(SceneError, match="event-at-start"):
            run(asked)


@pytest.mark.parametrize(
    ("gap", "offset", "starts"),
    [
        pytest.param(-0.5e-11, 0.0, True, id="touching"),
        pytest.param(-2e-11, 0.0, False, id="behind the wall"),
        pytest.param(-500e-11, 1000.0, True, id="touching, as far as 1000 tells"),
        pytest.param(-2000e-11, 1000.0, False, id="behind it even there"),
        pytest.param(-0.5e-11, -0.001, True, id="near the origin as at 1"),
    ],
)
def test_a_contact_may_begin_as_deep_as_rounding_goes(gap: float, offset: float, starts: bool) -> None:
    """10⁻¹¹ of the coordinates, or of 1 m where they are smaller."""
    wall = {"name": "wall", "value": f"x - ({offset + abs(gap)!r})", "then": "bounce", "restitution": "1/2"}
    document = write_scene(oscillator("0", x=offset, u=1.0)) | {"events": [wall]}
    if starts:
        assert run({"scene": document, "t_end": 0.1})["status"] == "ok"
    else:
        with pytest.raises(SceneError, match="event-at-start"):
            run({"scene": document, "t_end": 0.1})


@pytest.mark.parametrize("length", [80, 81, 300])
def test_an_endless_event_is_told_by_its_beginning(length: int) -> None:
    value = "x - 1" + " " * (length - 9) + " + 0"
    document = write_scene(oscillator("0", x=0.5, u=1.0)) | {"events": [{"name": "wall", "value": value}]}
    with pytest.raises(SceneError) as caught:
        run({"scene": document, "t_end": 0.1})
    (problem,) = caught.value.problems
    assert problem.parameters["value"] == value[:80]


@pytest.mark.parametrize("width", [0.1, 1e-2, 1e-4, 1e-5])
@pytest.mark.parametrize("door", ["x - 1.2345", "t - 1.2345"])
@pytest.mark.parametrize("method", ["auto", "dop853", "radau-5", "taylor"])
def test_a_value_that_dips_below_zero_for_less_than_a_step_ends_a_motion(door: str, width: float, method: str) -> None:
    """1 − 2 exp(−z²) is 0 at z = −√ln 2 first, where x = t; one that leaves a hundredth ends nothing."""
    for depth, status in ((2.0, "event"), (0.99, "ok")):
        scene = write_scene(oscillator("0", x=0.0, u=1.0))
        scene["parameters"].append({"name": "w", "value": width})
        events = [{"name": "door", "value": f"1 - {depth}*exp(-(({door})/w)^2)"}]
        found = run({"scene": scene | {"events": events}, "t_end": 2.2, "method": method, "tolerance": 1e-6})
        assert found["status"] == status
        if status == "event":
            assert found["event"]["t"] == pytest.approx(1.2345 - width * np.sqrt(np.log(2.0)), abs=1e-9)
