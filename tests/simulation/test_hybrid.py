"""Motions that go on behind events, against closed forms: impacts, rest, strings, sticking and slipping, kinks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.simulation.scenes import document

from deltaq.errors import SceneError
from deltaq.mechanics.changes import change
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.toml import read_toml
from deltaq.mechanics.writing import write_scene
from deltaq.model.modes import modes_of
from deltaq.simulation.constraints import Finish
from deltaq.simulation.driver import simulate
from deltaq.simulation.hybrid import in_first_mode, run_on
from deltaq.simulation.integration import Workspace, motion_of, watch_of
from deltaq.simulation.library import get_method
from deltaq.simulation.reference import METHODS, Reference
from deltaq.simulation.run import Steps
from deltaq.simulation.run import run as run_once
from deltaq.simulation.service import problem_of, run
from deltaq.simulation.trajectory import Trajectory
from deltaq.simulation.transitions import begun, with_offsets

G = 9.81


CLOSED_FORMS = pytest.mark.parametrize("method", ["dop853", "taylor"])  # stages, and series
JUMPING = ("bouncing-ball", "braked-oscillator", "catching-pendulum", "stick-slip")


def scene_here(name: str) -> Scene:
    """A built-in scene, or one of the tests' own."""
    own = Path(__file__).parent / "scenes" / f"{name}.toml"
    return read_scene(read_toml(own.read_text(encoding="utf-8"))) if own.is_file() else load_scene(name)


def motion(scene: Scene, t_end: float, tolerance: float = 1e-10, method: str = "dop853") -> Trajectory:
    return simulate(problem_of(scene, t_end), get_method(method), tolerance=tolerance)


def kinds(found: Trajectory) -> list[str]:
    return [each.kind for each in found.transitions]


def on_line(loads: Sequence[dict[str, Any]], events: Sequence[dict[str, Any]] = (), **start: float) -> Scene:
    """A unit mass on a line, in the plane."""
    return read_scene(
        {
            "format": 1,
            "id": "line",
            "title": "line",
            "dimension": 2,
            "coordinates": [{"name": "x", **start}],
            "parameters": [{"name": "m", "value": 1.0}],
            "bodies": [{"name": "p", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
            "loads": list(loads),
            "events": list(events),
        }
    )


@pytest.mark.parametrize("name", JUMPING)
def test_runs_that_share_a_workspace_are_as_with_their_own(name: str) -> None:
    """Of a run before nothing is left there: neither its event, nor its parameters, nor its samples."""
    modes = modes_of(scene_here(name))
    assert modes is not None
    problem = in_first_mode(problem_of(modes.scene, 5.0), modes)
    other = replace(problem, parameters=tuple(1.01 * each for each in problem.parameters))
    method, flag, steps, workspace = get_method("dop853"), np.zeros(1, dtype=np.int64), Steps(0.05, 1e-9), Workspace()
    met = []
    for each, t_end in ((problem, 5.0), (other, 0.01), (other, 5.0), (problem, 0.01)):
        times = np.linspace(0.0, t_end, 51)
        shared, alone = (run_once(each, method, times, flag, steps, place) for place in (workspace, None))
        np.testing.assert_array_equal(shared.states, alone.states)
        assert (shared.result, shared.conditioning) == (alone.result, alone.conditioning)
        met.append(shared.event is not None)
    assert met == [True, False, True, False]


@pytest.mark.parametrize("name", JUMPING)
def test_what_a_workspace_hands_out_again_is_as_new(name: str) -> None:
    """Every array of what is watched, and of the right-hand side what a run does not write before it reads."""
    modes = modes_of(scene_here(name))
    assert modes is not None
    problem = in_first_mode(problem_of(modes.scene, 5.0), modes)
    scheme, flag, first = get_method("dop853").scheme, np.zeros(1, dtype=np.int64), 2 * problem.degrees + 1
    workspace, finish = Workspace(), Finish.of(get_method("dop853"))
    watch, motion = workspace.watch(problem, flag, scheme), workspace.motion(problem, is_long=False, finish=finish)
    for array in (*watch[4:5], *watch[6:12], motion.inputs, motion.conditioning):
        array.fill(-1.0)
    new, again = watch_of(problem, flag, scheme), workspace.watch(problem, flag, scheme)
    assert again.least is watch.least
    for fresh, used in zip(new[5:12], again[5:12], strict=True):
        np.testing.assert_array_equal(used, fresh)
    np.testing.assert_array_equal(again.inputs[first:], new.inputs[first:])
    own, motion = motion_of(problem), workspace.motion(problem, is_long=False, finish=finish)
    np.testing.assert_array_equal(motion.inputs[first:], own.inputs[first:])
    assert motion.conditioning == own.conditioning


@pytest.mark.parametrize("time", [1e3 + 0.1 * k for k in range(8)])
def test_a_contact_that_has_opened_is_not_closed_again_by_rounding_of_the_time(time: float) -> None:
    """On a table that goes up and down a gap of zero changes with the time by more than rounding of places."""
    modes = modes_of(scene_here("bouncing-ball"))
    assert modes is not None
    current = begun(replace(problem_of(modes.scene, 1.0), model=modes.model), modes)
    below = current.at(time, np.zeros(1), np.zeros(1))
    touching = current.at(time, np.array([-below.facts.gaps[0]]), np.zeros(1))
    found = with_offsets(touching)
    assert (found.at(time + 4.0 * math.ulp(time), found.q, found.v).watched > 0.0).all()


@pytest.mark.parametrize(
    ("name", "is_moved"), [("bouncing-ball", True), ("stick-slip", False), ("braked-oscillator", False)]
)
def test_whether_the_time_alone_moves_what_is_watched(name: str, is_moved: bool) -> None:
    modes = modes_of(scene_here(name))
    assert modes is not None
    assert modes.watches_time == is_moved


@CLOSED_FORMS
def test_twenty_impacts_on_a_table_at_rest(method: str) -> None:
    """Times of flight are 2v/g, and v falls by e; with every impact the part 1 − e² of the energy is lost."""
    found = motion(change(scene_here("bouncing-ball"), parameters={"a": 0.0}), 4.02, method=method)
    speed, times = math.sqrt(2.0 * G), [math.sqrt(2.0 / G)]
    while len(times) < 20:
        speed *= 0.8
        times.append(times[-1] + 2.0 * speed / G)
    assert kinds(found)[:20] == ["impact"] * 20
    assert np.abs(np.array([each.time for each in found.transitions[:20]]) - times).max() < 1e-13
    assert [each.loss for each in found.transitions[:20]] == pytest.approx(
        [G * 0.36 * 0.64**k for k in range(20)], rel=1e-10
    )
    balance = 0.5 * found.rates[:, 0] ** 2 + G * found.values[:, 0] - found.work
    assert np.ptp(balance) < 1e-12


@pytest.mark.parametrize("lost", [0.0, 1e-16, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3])
def test_impacts_that_take_little_or_nothing_are_no_rest(lost: float) -> None:
    """From 1 m it is up again at eᵏ of its first rate, after √(2h/g)(1 + 2e + 2e² + …), however near e is to 1."""
    e, g = 1.0 - lost, 9.81
    scene = change(scene_here("bouncing-ball"), parameters={"e": e, "a": 0.0, "omega": 0.0, "g": g})
    found = simulate(problem_of(scene, 10.0, 101), get_method("dop853"), tolerance=1e-9)
    assert found.outcome.status == "ok"
    assert {each.kind for each in found.transitions} == {"impact"}
    fall, flights = math.sqrt(2.0 / g), np.concatenate([[0.0], e ** np.arange(1, len(found.transitions))])
    times = fall * (1.0 + 2.0 * np.cumsum(flights))
    np.testing.assert_allclose([each.time for each in found.transitions], times, atol=1e-11)
    rates = [each.after[1] for each in found.transitions]
    np.testing.assert_allclose(rates, g * fall * e ** np.arange(1, len(rates) + 1), atol=1e-11)


@pytest.mark.parametrize(("e", "seconds"), [(0.3, 1e-7), (0.5, 1e-7), (0.8, 4e-7)])
def test_rebounds_that_pile_up_end_in_rest(e: float, seconds: float) -> None:
    """All rebounds from 1 m together last √(2h/g) (1 + e)/(1 − e); none is told that is lower than rounding lifts it.

    The `seconds` are those of the rebounds that are left out.
    """
    found = motion(change(scene_here("bouncing-ball"), parameters={"a": 0.0, "e": e}), 5.0)
    assert found.outcome.status == "ok"
    assert kinds(found)[-1] == "rest"
    assert kinds(found).count("rest") == 1
    assert found.transitions[-1].time == pytest.approx((1.0 + e) / (1.0 - e) * math.sqrt(2.0 / G), abs=seconds)
    heights = [each.after[1] ** 2 / (2.0 * G) for each in found.transitions[:-1]]
    assert np.finfo(float).eps < min(heights) < 1e-12
    late = found.times > found.transitions[-1].time
    assert np.abs(found.values[late]).max() < 1e-14
    assert not found.rates[late].any()


@pytest.mark.parametrize("restitution", [0.5, 0.8, 0.95])
def test_rebounds_pile_up_on_a_moving_table_too(restitution: float) -> None:
    """Where a table moves with less than g, the ball comes to lie on it, and then moves with it: z = a sin ωt."""
    scene = change(scene_here("bouncing-ball"), parameters={"e": restitution, "omega": 8.0})
    scene = replace(scene, coordinates=(replace(scene.coordinates[0], value=0.2),))
    found = motion(scene, 9.0, 1e-8)
    assert found.outcome.status == "ok"
    assert kinds(found)[-1] == "rest"
    late = found.times > found.transitions[-1].time
    assert late.any()
    assert found.values[late, 0] == pytest.approx(0.05 * np.sin(8.0 * found.times[late]), abs=1e-11)
    rebounds = np.diff([each.time for each in found.transitions])
    assert rebounds[-20:-1] == pytest.approx(restitution * rebounds[-21:-2], rel=0.02)


@pytest.mark.parametrize(
    ("restitution", "amplitude", "t_end"),
    [pytest.param(0.3, 0.47, 14.0, id="piles up"), pytest.param(0.0, 0.5, 90.0, id="lands")],
)
def test_a_ball_that_comes_to_rest_in_every_period_does_so_at_late_times(
    restitution: float, amplitude: float, t_end: float
) -> None:
    """It leaves where g = a ω² sin ωt. Rounding of the time moves a table by more than that of places."""
    omega = math.tau
    scene = change(load_scene("bouncing-ball"), parameters={"e": restitution, "a": amplitude, "omega": omega, "g": G})
    found = motion(scene, t_end, 1e-9, "taylor")
    assert found.outcome.status == "ok"
    leaves = math.asin(G / (amplitude * omega**2)) / omega
    released = [each.time for each in found.transitions if each.kind == "release"]
    np.testing.assert_allclose(released, leaves + np.arange(len(released)) + round(released[0] - leaves), atol=2e-13)
    assert len(released) >= t_end - 2.0


def test_a_table_that_falls_faster_than_the_ball_lets_it_go() -> None:
    """z = a sin ωt rests on the table until −aω² sin ωt = −g, then it flies."""
    scene = change(scene_here("bouncing-ball"), parameters={"e": 0.0, "a": 0.05, "omega": 20.0})
    found = motion(scene, 1.2)
    assert kinds(found)[:2] == ["rest", "release"]
    leaves = found.transitions[1].time
    turn = math.asin(G / (0.05 * 400.0))
    assert (20.0 * leaves - turn) % (2.0 * math.pi) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("method", ["dop853", "dormand-prince-54", "radau-5", "gauss-6", "taylor"])
def test_an_estimate_stays_true_across_impacts(method: str) -> None:
    """Against a much more accurate run, on the vibrating table."""
    scene = scene_here("bouncing-ball")
    found, truth = motion(scene, 2.0, 1e-6, method), motion(scene, 2.0, 1e-12)
    assert found.estimate is not None
    assert (np.abs(found.values - truth.values)[:, 0] <= found.estimate.errors + 1e-12).all()
    for one, other in zip(found.transitions, truth.transitions, strict=True):
        assert one.error is not None
        assert abs(one.time - other.time) <= 2.0 * one.error + 1e-12


@CLOSED_FORMS
def test_a_string_goes_slack_and_catches(method: str) -> None:
    """Slack where v0² = 3 g y + 2 g l, a parabola from there; the jerk takes what went along the string."""
    found = motion(scene_here("catching-pendulum"), 1.4, method=method)
    assert kinds(found)[:2] == ["release", "rest"]
    slack, taut = (each.time for each in found.transitions[:2])
    y = (5.8**2 - 2.0 * G) / (3.0 * G)
    x, speed = math.sqrt(1.0 - y * y), math.sqrt(G * y)
    vx, vy = -speed * y, speed * x
    flight = 4.0 * vy / G - 0.0  # of x² + y² = l² along the parabola: t = 4 v_y/g for a start with v² = g y
    assert taut - slack == pytest.approx(flight, rel=1e-8)
    late = vx**2 + (vy - G * flight) ** 2
    end = np.array([x + vx * flight, y + vy * flight - 0.5 * G * flight**2])
    along = float(end @ [vx, vy - G * flight])
    assert found.transitions[1].loss == pytest.approx(0.5 * along**2, rel=1e-7)
    assert late > along**2
    assert np.hypot(*found.values.T).max() < 1.0 + 1e-9


def test_a_string_goes_slack_and_catches_as_scipy_has_it() -> None:
    """Angle and tension while it is taut, x and y while it is slack: DOP853 with events, over all its flights."""
    found = motion(scene_here("catching-pendulum"), 6.0, 1e-11)

    def circle(_t: float, s: Sequence[float]) -> list[float]:  # x = sin φ, y = −cos φ
        return [s[1], -G * math.sin(s[0])]

    def flight(_t: float, s: Sequence[float]) -> list[float]:
        return [s[2], s[3], 0.0, -G]

    def tension(_t: float, s: Sequence[float]) -> float:
        return s[1] ** 2 + G * math.cos(s[0])

    def slack(_t: float, s: Sequence[float]) -> float:
        return 1.0 - math.hypot(s[0], s[1]) if _t > begun + 1e-3 else 1.0

    exact = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14, "dense_output": True}
    for event in (tension, slack):
        event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
    swing = solve_ivp(circle, (0.0, 6.0), [0.0, 5.8], events=tension, **exact)
    begun, (phi, omega) = float(swing.t[-1]), swing.y[:, -1]
    start = [math.sin(phi), -math.cos(phi), omega * math.cos(phi), omega * math.sin(phi)]
    fly = solve_ivp(flight, (begun, 6.0), start, events=slack, **exact)
    caught, (x, y, vx, vy) = float(fly.t[-1]), fly.y[:, -1]
    again = solve_ivp(circle, (caught, 6.0), [math.atan2(x, -y), vy * x - vx * y], events=tension, **exact)
    assert again.t[-1] == 6.0  # it stays taut
    assert [each.time for each in found.transitions] == pytest.approx([begun, caught], abs=1e-9)
    for t, position in zip(found.times, found.values, strict=True):
        if t < begun or t >= caught:
            (angle, _) = (swing if t < begun else again).sol(t)
            assert position == pytest.approx([math.sin(angle), -math.cos(angle)], abs=1e-9)
        else:
            assert position == pytest.approx(fly.sol(t)[:2], abs=1e-9)


@CLOSED_FORMS
def test_dry_friction_shifts_the_centre_of_every_half_swing(method: str) -> None:
    """Den Hartog: cosines about ±μ m g/k, until the spring no longer gets away."""
    found = motion(scene_here("braked-oscillator"), 6.0, 1e-9, method)
    omega, shift = math.sqrt(20.0), 0.15 * G / 20.0
    half, start, truth = math.pi / omega, 1.0, np.zeros(len(found.times))
    stop = found.times[-1]
    for k in range(100):
        side = math.copysign(shift, start)
        inside = (found.times >= k * half) & (found.times <= (k + 1) * half)
        truth[inside] = side + (start - side) * np.cos(omega * (found.times[inside] - k * half))
        start = 2.0 * side - start
        if abs(start) <= shift:
            stop = (k + 1) * half
            break
    truth[found.times > stop] = start
    assert kinds(found) == ["turn"] * 6 + ["stick"]
    assert found.transitions[-1].time == pytest.approx(stop, abs=1e-10)
    assert np.abs(found.values[:, 0] - truth).max() < 1e-9
    assert found.outcome.status == "ok"


@pytest.mark.parametrize("pattern", range(4))
@pytest.mark.parametrize("stiffness", [20.0, 2e3, 2e7])
def test_a_run_whose_rates_are_moved_by_rounding_turns_as_often_as_another(stiffness: float, pattern: int) -> None:
    """Half swings last π/ω. At late times the acceleration is large beside the rate, which is 0 where it turns."""
    spring = {"kind": "potential", "name": "spring", "energy": f"{stiffness}*x^2/2"}
    friction = {"kind": "friction", "name": "mu", "coordinate": "x", "force": f"{stiffness}/1000"}
    scene = on_line([spring, friction], value=1.0)
    half = math.pi / math.sqrt(stiffness)
    problem, modes = problem_of(scene, 40.5 * half, 2), modes_of(scene)
    assert modes is not None
    own, flag = replace(problem, model=modes.model), np.zeros(1, dtype=np.int64)
    times, method = np.linspace(0.0, problem.t_end, 2), get_method("dop853")
    found = run_on(own, modes, method, times, flag, Steps(0.1 * half, 1e-11, shaken=pattern))
    assert [each.kind for each in found.transitions] == ["turn"] * 40
    assert [each.time for each in found.transitions] == pytest.approx([half * k for k in range(1, 41)], rel=1e-9)


@CLOSED_FORMS
def test_a_block_on_a_belt_sticks_until_the_spring_pulls_it_off(method: str) -> None:
    """With constant sliding friction every phase is known (Den Hartog): it sticks for 2 (F₀ − F)/(k v)."""
    load = {"kind": "friction", "name": "belt", "coordinate": "x", "force": "1", "static": "3", "surface_rate": "1/2"}
    spring = {"kind": "potential", "name": "spring", "energy": "2*x^2"}
    found = motion(on_line([spring, load], value=0.75, rate=0.5), 8.0, 1e-11, method)
    assert kinds(found)[:4] == ["slip", "stick", "slip", "stick"]
    slips = [each.time for each in found.transitions if each.kind == "slip"]
    sticks = [each.time for each in found.transitions if each.kind == "stick"]
    assert slips[0] == pytest.approx(0.0, abs=1e-12)
    assert slips[1] - sticks[0] == pytest.approx(2.0 * (3.0 - 1.0) / (4.0 * 0.5), abs=1e-10)
    slide = (math.pi + 2.0 * math.atan2(0.5, 2.0 * (3.0 - 1.0) / 4.0)) / 2.0  # about x = 1/4 with ω = 2
    assert sticks[0] - slips[0] == pytest.approx(slide, abs=1e-10)


@CLOSED_FORMS
def test_two_frictions_stick_and_slip_by_themselves(method: str) -> None:
    """Two blocks on one spring: the heavier friction holds, the other block swings against its own."""
    block = {"kind": "particle", "mass": "m"}
    scene = read_scene(
        {
            "format": 1, "id": "two", "title": "two", "dimension": 2,
            "coordinates": [{"name": "x", "value": -1.0}, {"name": "y", "value": 1.0}],
            "parameters": [{"name": "m", "value": 1.0}],
            "bodies": [{"name": "a", **block, "position": ["x", "0"]}, {"name": "b", **block, "position": ["y", "0"]}],
            "loads": [
                {"kind": "potential", "name": "spring", "energy": "2*(y - x)^2"},
                {"kind": "friction", "name": "heavy", "coordinate": "x", "force": "9"},
                {"kind": "friction", "name": "light", "coordinate": "y", "force": "1"},
            ],
        }
    )  # fmt: skip
    found = motion(scene, 4.0, 1e-10, method)
    assert (found.values[:, 0] == -1.0).all()  # the spring pulls with 8 at most
    t = found.times[found.times < math.pi / 2.0]
    assert found.values[: len(t), 1] == pytest.approx(-0.75 + 1.75 * np.cos(2.0 * t), abs=1e-9)
    assert [(each.name, each.kind) for each in found.transitions] == [("light", "turn")] * 2


@pytest.mark.parametrize("method", ["dop853", "taylor", "rk4", "radau-5"])
@pytest.mark.parametrize("at", [0.0, 1e-200])
def test_nothing_sticks_at_a_dead_centre(method: str, at: float) -> None:
    """On c = x² friction has no direction at x = 0, where nothing slips: ẍ = 1 − 2F x from there on, F = 1/2."""
    pull = {"kind": "force", "name": "pull", "at": "p", "force": ["1", "0"]}
    friction = {"kind": "friction", "name": "mu", "coordinate": "x^2", "force": "1/2"}
    moved, still = (motion(on_line(loads, value=at), 2.0, 1e-6, method) for loads in ([pull, friction], [friction]))
    assert (moved.outcome.status, still.outcome.status) == ("ok", "ok")
    assert np.abs(moved.values[:, 0] - 1.0 + np.cos(moved.times)).max() < 1e-6
    assert np.abs(still.values).max() < 1e-15


@CLOSED_FORMS
def test_no_step_runs_over_the_kink_of_a_spring_on_one_side(method: str) -> None:
    """A buffer k max(0, −x): free flight, then half a period π/ω in it, and back as fast as it came."""
    buffer = {"kind": "potential", "name": "buffer", "energy": "8*max(-x, 0)^2"}
    found = motion(on_line([buffer], value=1.0, rate=-2.0), 3.0, 1e-12, method)
    t, truth = found.times, np.zeros(len(found.times))
    hits, leaves = 0.5, 0.5 + math.pi / 4.0
    truth = np.where(t < hits, 1.0 - 2.0 * t, np.where(t < leaves, -0.5 * np.sin(4.0 * (t - hits)), 2.0 * (t - leaves)))
    assert np.abs(found.values[:, 0] - truth).max() < 1e-13
    assert found.transitions == ()


def test_steps_that_are_unstable_between_two_switches_end_soon_and_it_is_said() -> None:
    """On the buffer ω = 400/s, and steps of 1/40 s: what they throw back is too fast for all that comes after."""
    buffer = {"kind": "potential", "name": "buffer", "energy": "80000*max(-x, 0)^2 + 9.81*x"}
    scene = write_scene(on_line([buffer], value=1.0, rate=0.0))
    answer: Any = run({"scene": scene, "t_end": 4, "step": 0.025, "method": "rk4"})
    assert (answer["status"], answer["cost"]["steps"] < 3000) == ("step_limit", True)
    assert answer["reason"]["code"] == answer["remedy"]["code"] == "switches_within_steps"
    told = answer["reason"]["parameters"]
    assert (told["step"], told["method"], told["t"]) == (0.025, "rk4", pytest.approx(answer["t_reached"], abs=1e-3))
    sound: Any = run({"scene": scene, "t_end": 4, "tolerance": 1e-6, "method": "rk4"})
    assert sound["status"] == "ok"
    free = [t for t in answer["t"] if t < math.sqrt(2.0 / 9.81)]  # up to the buffer the part that was computed is good
    assert len(free) > 30
    off = [abs(x - 1.0 + 9.81 * t**2 / 2.0) for t, x in zip(free, answer["coordinates"]["x"], strict=False)]
    assert all(error <= told + 1e-12 for error, told in zip(off, answer["error"]["estimate"], strict=False))
    assert max(off[:-3]) < 1e-9


def test_the_answer_tells_events() -> None:
    found = run({"scene": write_scene(scene_here("braked-oscillator")), "t_end": 6, "tolerance": 1e-6})
    assert found["status"] == "ok"
    events = found["events"]
    assert isinstance(events, list)
    assert [each["kind"] for each in events] == ["turn"] * 6 + ["stick"]
    assert {each["name"] for each in events} == {"friction"}


def test_events_are_told_by_the_names_of_the_scene_that_is_asked_for() -> None:
    scene = load_scene("bouncing-ball")
    renamed = replace(scene, events=tuple(replace(each, name="table") for each in scene.events))
    for each in (scene, renamed):  # the same mechanics
        found: Any = run({"scene": write_scene(each), "t_end": 1.0, "tolerance": 1e-6})
        assert {event["name"] for event in found["events"]} == {event.name for event in each.events}


@pytest.mark.parametrize("name", JUMPING)
def test_scenes_that_jump_balance(name: str) -> None:
    """Energy, work and what impacts and friction take add up."""
    answer: Any = run({"scene": write_scene(scene_here(name)), "t_end": 3, "tolerance": 1e-8})
    assert answer["status"] == "ok"
    assert max(answer["error"]["estimate"]) < 1e-8
    size = np.abs(answer["energy"]["kinetic"]).max() + np.abs(answer["energy"]["potential"]).max()
    assert np.ptp(answer["energy"]["balance"]) < 1e-7 * size


def test_work_inside_long_steps_is_integrated_as_well() -> None:
    """Radau 5 takes steps of a quarter of a swing here, and friction turns in the middle of them."""
    scene = write_scene(scene_here("braked-oscillator"))
    answer: Any = run({"scene": scene, "t_end": 6, "tolerance": 1e-8, "method": "radau-5"})
    size = np.abs(answer["energy"]["kinetic"]).max() + np.abs(answer["energy"]["potential"]).max()
    assert np.ptp(answer["energy"]["balance"]) < 1e-8 * size


def test_the_power_of_what_sticks_is_that_of_its_reaction() -> None:
    """A belt that carries a block along against a spring feeds k x v; where the block slips, friction takes F ẋ."""
    answer: Any = run({"scene": write_scene(scene_here("stick-slip")), "t_end": 4, "tolerance": 1e-10})
    x, rate, power = (
        np.array(part) for part in (answer["coordinates"]["x"], answer["rates"]["x"], answer["energy"]["power"])
    )
    held = np.abs(rate - 0.3) < 1e-12
    inside = held & np.roll(held, 1) & np.roll(held, -1)
    assert inside.sum() > 50
    assert power[inside] == pytest.approx(20.0 * x[inside] * 0.3, abs=1e-8)
    sliding = G * (0.2 + 0.2 * np.exp(-np.abs(rate - 0.3) / 0.5))
    assert power[~held] == pytest.approx((-np.sign(rate - 0.3) * sliding * rate)[~held], abs=1e-7)


@pytest.mark.parametrize(
    ("value", "rate", "gap"), [(0.0, 1.0, "r"), (0.0, 1.0, "r + 1"), (1.0, -1.0, "r")], ids=["at", "away", "comes"]
)
def test_contacts_where_the_masses_have_no_inverse_end_the_motion_as_it_ends_without_them(
    value: float, rate: float, gap: str
) -> None:
    """In polar coordinates no force turns what is at r = 0."""
    polar = document({"r": (value, rate), "a": (0.3, 0.0)}, {"m": 1.0}, {"p": ("m", ["r*cos(a)", "r*sin(a)"])})
    bounce = {"name": "hit", "value": gap, "then": "bounce", "restitution": "1/2"}
    found: Any = run({"scene": polar | {"events": [bounce]}, "t_end": 3.0, "tolerance": 1e-6})
    assert found["status"] == "singular_mass_matrix"
    assert found["t_reached"] == pytest.approx(value, abs=1e-6)


@pytest.mark.parametrize("rate", [1e-9, 1.0, 1e9, 1e14])
def test_impacts_are_counted_whatever_the_time_between_them(rate: float) -> None:
    """Between two walls one metre apart: seventy impacts, and 0.7 m from the first wall behind 70.2 m."""
    walls = [
        {"name": name, "value": gap, "then": "bounce", "restitution": "1"}
        for name, gap in (("left", "x"), ("right", "1 - x"))
    ]
    found = motion(on_line([], walls, value=0.5, rate=rate), 70.2 / rate, 1e-6)
    assert found.outcome.status == "ok"
    assert len(found.transitions) == 70
    assert found.values[-1, 0] == pytest.approx(0.7, abs=1e-9)


def test_a_contact_without_a_direction_is_refused() -> None:
    """Of a string that hangs straight down and whose y is held nothing can be moved along ∂g/∂x = −2x = 0."""
    asked = {"scene": write_scene(scene_here("catching-pendulum")), "freeze": ["y"], "t_end": 1}
    with pytest.raises(SceneError) as caught:
        run(asked)
    assert [(each.code, each.pointer) for each in caught.value.problems] == [
        ("contact-without-direction", "/scene/events/0/value")
    ]


def test_impacts_at_the_start_that_do_not_end_are_refused() -> None:
    """A ball that moves, between two walls that both touch it and give all speed back."""
    bounces = {"then": "bounce", "restitution": "1"}
    events = [{"name": "left", "value": "x", **bounces}, {"name": "right", "value": "-x", **bounces}]
    scene = document({"x": (0.0, 1.0)}, {"m": 1.0}, {"ball": ("m", ["x", "0"])}) | {"events": events}
    with pytest.raises(SceneError) as caught:
        run({"scene": scene, "t_end": 1})
    assert [(each.code, each.pointer, each.parameters["name"]) for each in caught.value.problems] == [
        ("contacts-at-start", "/scene/events/0/value", "left")
    ]


def test_a_contact_that_loses_its_direction_later_ends_the_motion_with_a_reason() -> None:
    """g = 1 − x² + h with a table h that comes up under x = 0: there ∂g/∂x = 0."""
    event = {"name": "table", "value": "1/10 - t - x^2", "then": "bounce", "restitution": "1/2"}
    found = motion(on_line([], [event]), 1.0)
    assert (found.outcome.status, found.outcome.code) == ("unresolved", "contact_without_direction")
    assert found.reached == pytest.approx(0.1, abs=1e-9)


def test_a_reference_is_compared_at_the_same_times() -> None:
    """Two motions of which one has an event more, whose time stands twice: samples behind it are not shifted."""
    scene = scene_here("braked-oscillator")
    one, other = motion(scene, 3.0, 1e-9), motion(change(scene, parameters={"mu": 0.1500001}), 3.0, 1e-9)
    trusted = Reference(one.times, one.values, np.zeros(len(one.times)), METHODS)
    extra = replace(
        other,
        times=np.insert(other.times, 10, [0.05, 0.05]),
        values=np.insert(other.values, 10, [[0.0], [0.0]], axis=0),
    )
    assert trusted.errors_of(extra).max() == pytest.approx(np.max(trusted.errors_of(other)))
    assert trusted.errors_of(extra).max() < 1e-5
