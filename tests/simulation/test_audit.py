"""Nothing is stepped over: drives, pulses and jumps at known times, narrow forces on the way, against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random

import numpy as np
import pytest
from tests.simulation.scenes import scene

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.simulation.audit import Audit, largest_gap
from deltaq.simulation.driver import simulate
from deltaq.simulation.kernels.motion import FINE
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.pieces import BlindStretch, Pieces
from deltaq.simulation.run import Mesh, Steps
from deltaq.simulation.run import run as run_once
from deltaq.simulation.service import problem_of, run
from deltaq.simulation.trajectory import Trajectory

CHEAP = ("rk4", "dop853", "dormand-prince-54", "gauss-4", "stormer-verlet", "newmark", "radau-5")


def driven(force: str, initial: float = 0.0, **parameters: float) -> Scene:
    """A mass of 1 kg on a line under a force of time (and x)."""
    load = {"kind": "force", "at": "mass", "force": [force, "0"]}
    return scene({"x": (initial, 0.0)}, {"m": 1.0, **parameters}, {"mass": ("m", ["x", "0"])}, [load])


def is_silent(found: Trajectory, truth: float) -> bool:
    """Whether the last value is wrong by more than it is said to be, and nothing else is said."""
    assert found.estimate is not None
    error = abs(found.values[-1, 0] - truth)
    return found.outcome.status == "ok" and error > 1.5 * found.estimate.errors[-1] + 1e-13


def test_a_drive_in_step_with_the_samples_is_seen() -> None:
    """x″ = −x + ω sin ωt from rest at 1: x = cos t + ω (sin ωt − ω sin t)/(1 − ω²); ω is that of steps, or near it."""
    source = Random(17)
    for method in CHEAP:
        for cycles in (200, 400, source.choice((100, 201, 399, 800))):
            w = 2.0 * math.pi * cycles / 10.0
            amplitude = w / (1.0 - w * w)
            truth = math.cos(10.0) - amplitude * w * math.sin(10.0) + amplitude * math.sin(w * 10.0)
            problem = problem_of(driven("w*sin(w*t) - x", 1.0, w=w), 10.0)
            found = simulate(problem, get_method(method), tolerance=1e-2)
            assert not is_silent(found, truth), (method, cycles, found.values[-1, 0], truth)


@pytest.mark.parametrize("method", CHEAP)
def test_a_step_that_cannot_see_the_drive_says_so(method: str) -> None:
    problem = problem_of(driven("w*sin(w*t) - x", 1.0, w=800.0 * math.pi), 1.0)
    found = simulate(problem, get_method(method), step=0.01)
    assert found.outcome.status == "step_blind"
    assert 0.0 < float(found.outcome.parameters["needed"]) < 0.005
    assert found.estimate is not None
    w = 800.0 * math.pi
    amplitude = w / (1.0 - w * w)
    truth = math.cos(1.0) - amplitude * w * math.sin(1.0) + amplitude * math.sin(w)
    assert abs(found.values[-1, 0] - truth) <= found.estimate.errors[-1]


@pytest.mark.parametrize("method", ["dop853", "rk4", "radau-5", "dormand-prince-54"])
def test_a_pulse_is_not_stepped_over(method: str) -> None:
    """A unit impulse at t0 moves a free mass by T − t0 in the end, however short it is."""
    source = Random(method)
    for _ in range(4):
        t0, width = source.uniform(0.5, 9.0), 10.0 ** source.uniform(-5.0, -2.0)
        pulse = "F*exp(-((t - t0)/w)^2)"
        problem = problem_of(driven(pulse, F=1.0 / (width * math.sqrt(math.pi)), t0=t0, w=width), 10.0)
        found = simulate(problem, get_method(method), tolerance=1e-4)
        assert found.outcome.status == "ok"
        off = abs(found.values[-1, 0] - (10.0 - t0))
        assert off <= found.estimate.errors[-1]
        assert off <= 1e-4 * max(1.0, 10.0 - t0)


@pytest.mark.parametrize("method", method_ids())
def test_forces_may_jump_at_known_times(method: str) -> None:
    """A rectangular push of 1 N from t1 to t2 on a free mass: x = d (T − t1) − d²/2 with d = t2 − t1."""
    t1, length = 3.0, 1e-3
    problem = problem_of(driven("F*(sign(t - t1) - sign(t - t2))/2", F=1.0, t1=t1, t2=t1 + length), 10.0)
    found = simulate(problem, get_method(method), tolerance=1e-6)
    assert found.outcome.status == "ok"
    assert found.values[-1, 0] == pytest.approx(length * (10.0 - t1) - length**2 / 2.0, abs=1e-6)


@pytest.mark.parametrize("method", method_ids())
def test_forces_may_jump_at_the_end_and_shortly_before(method: str) -> None:
    """At rest up to the jump, and hardly moved behind it; the last step is as short as rounding of its time."""
    source = Random(method)
    for exponent in (-17, -16, -15, -14, -12, -10, -8, -7, -7, -7, -6, -5, -3):
        end = source.choice((1.0, 10.0, math.pi, source.uniform(0.1, 30.0)))
        begin = end * (1.0 - source.uniform(1.0, 9.0) * 10.0**exponent)
        problem = problem_of(driven("F*(1 + sign(t - t1))/2", -3.0, F=2.0, t1=begin), end)
        found = simulate(problem, get_method(method), tolerance=1e-6)
        told = (method, exponent, end, begin)
        assert (found.outcome.status, found.times[-1]) == ("ok", end), told
        assert found.reached == pytest.approx(end, rel=1e-14), told
        assert found.values[-1, 0] == pytest.approx(-3.0 + (end - begin) ** 2, abs=2e-6), told
        assert np.ptp(found.values[: -max(3, len(found.times) // 50), 0]) == 0.0, told


NEAR = (-1e-12, -1e-14, -4e-15, -1e-15, 0.0, 1e-15, 1e-12)  # relative to the end
UNITS = (-9, -8, -1, 1, 9)  # in the last place of the end
BEFORE = (0.0, 2e-15, 3e-15, 1e-14)  # so much earlier there is another jump, except for 0
PLACES = [
    (1.0, at, first)
    for at in (*(1.0 + part for part in NEAR), *(1.0 + k * 2.0**-53 for k in UNITS))
    for first in BEFORE
]
PLACES += [(7.3, 7.3 + k * math.ulp(7.3), 0.0) for k in (*UNITS, 0)]


@pytest.mark.one_in(4)
@pytest.mark.parametrize("accuracy", [{"tolerance": 1e-6}, {"step": 1e-2}], ids=["tolerance", "step"])
@pytest.mark.parametrize("method", method_ids())
def test_a_run_comes_to_the_end_wherever_a_force_jumps_near_it(method: str, accuracy: dict[str, float]) -> None:
    """At rest up to the first jump; behind the last one there may be nothing left of the span at all."""
    for end, at, before in PLACES:
        force = "F*(1 + sign(t - t1))/2" + (" + F*(1 + sign(t - t2))/2" if before else "")
        problem = problem_of(driven(force, -3.0, F=2.0, t1=at, t2=at - before), end)
        found, told = simulate(problem, get_method(method), **accuracy), (method, end, at, before)
        assert found.outcome.status == "ok" or ("step" in accuracy and found.outcome.status == "step_blind"), told
        assert (found.reached, found.times[-1]) == (end, end), told
        assert found.estimate is not None
        assert np.all(np.abs(found.values[:, 0] + 3.0) <= 1.5 * found.estimate.errors + 1e-13), told


@pytest.mark.parametrize("method", method_ids())
def test_so_does_one_of_very_short_steps(method: str) -> None:
    """A millionth of the span is no longer than 10⁹ times the room that a jump is given."""
    end = 0.5
    problem = problem_of(driven("-k*x + F*(1 + sign(t - end))/2", 1.0, k=100.0, F=2.0, end=end), end)
    found = run_once(
        problem,
        get_method(method),
        np.array([0.0, end]),
        np.zeros(1, dtype=np.int64),
        Steps(4e-7, pieces=Audit(problem, get_method(method)).before(1e-6)),
    )
    assert (found.result.outcome, found.result.reached, found.times[-1]) == (FINE, end, end)
    assert found.result.steps == pytest.approx(end / 4e-7, rel=1e-3)
    assert found.states[-1, 0] == pytest.approx(math.cos(10.0 * end), abs=1e-4)


def test_a_switch_costs_no_order() -> None:
    """Steps end before a jump and begin behind it, so that the error still falls with h⁴."""
    problem = problem_of(driven("F*(1 + sign(cos(w*t) - c))/2 - x", 1.0, F=1.0, w=3.1, c=0.3), 30.0)
    truth = simulate(problem, get_method("dop853"), tolerance=1e-11).values[-1, 0]
    found = [simulate(problem, get_method("rk4"), tolerance=10.0**-n) for n in (3, 7)]
    assert [each.outcome.status for each in found] == ["ok", "ok"]
    assert abs(found[-1].values[-1, 0] - truth) < 1e-7
    assert found[-1].cost.steps < 20 * found[0].cost.steps


def test_what_was_seen_on_a_path_is_not_taken_for_the_start() -> None:
    """How forces depend on time is bounded at the initial values, whatever the mass has come to in between."""
    problem, method = problem_of(driven("100*x*sin(50*t)", 0.0, m=1.0), 10.0), get_method("dop853")
    moved = replace(problem, values=(3.0,), rates=(1.0,), t_end=0.1)
    recorded = Steps(0.01, is_recorded=True)
    path = run_once(moved, method, np.linspace(0.0, 0.1, 3), np.zeros(1, dtype=np.int64), recorded)
    audit = Audit(problem, method)
    before = audit.before(1e-6)
    assert len(path.mesh_times) > 2
    audit.after(path, 1e-6)
    assert audit.before(1e-6) == before


@pytest.mark.parametrize("count", [1, 2, 4])
@pytest.mark.parametrize("place", [0.5, 0.77, 0.8, 0.9, 0.99])
def test_a_hill_is_seen_from_steps_as_long_as_half_a_swing(place: float, count: int) -> None:
    """x = sin t from 0 to 0: the cubic through the ends of a single step comes to π/4 only."""
    energy = "m*x^2/2 + 0.1*exp(-((x - b)/w)^2)"
    swing = scene(
        {"x": (0.0, 1.0)},
        {"m": 1.0, "b": place, "w": 1e-3},
        {"mass": ("m", ["x", "0"])},
        [{"kind": "potential", "energy": energy}],
    )
    problem, times = problem_of(swing, math.pi), np.linspace(0.0, math.pi, count + 1)
    mesh = Mesh(problem, 0.0, times, np.column_stack([np.sin(times), np.cos(times)]), 1)
    assert Audit(problem, get_method("dop853")).after_each([mesh], 1e-6)


def test_a_narrow_wall_on_the_way_is_seen() -> None:
    """A hill of 0.6 J, narrower than a step, turns back a mass of 1 kg at 1 m/s."""
    source = Random(3)
    for method in ("dop853", "rk4", "radau-5"):
        x0, width = source.uniform(2.0, 8.0), 10.0 ** source.uniform(-3.0, -2.0)
        hill = "2*h*(x - x0)/w^2*exp(-((x - x0)/w)^2)"  # of the potential h exp(−((x − x0)/w)²)
        problem = problem_of(driven(hill, h=0.6, x0=x0, w=width), 10.0)
        problem = replace(problem, rates=(1.0,))
        found = simulate(problem, get_method(method), tolerance=1e-6)
        assert found.outcome.status != "ok" or found.values.max() < x0  # too high a hill turns it back


@pytest.mark.parametrize(("steps", "before"), [(65_537, 0.5), (98_303, 0.5), (131_071, 0.5), (131_071, 1.5)])
def test_a_hill_before_the_end_of_very_many_steps_is_seen(steps: int, before: float) -> None:
    """Of more steps than there is room for, the last ones are not recorded; the hill moves the mass by 1 mm."""
    step = 1.0 / steps
    place, width = 1.0 - before * step, step / 20.0
    force = f"{1e-3 / (width * math.sqrt(math.pi) * before * step)!r}*exp(-((x - {place!r})/{width!r})^2)"
    held = scene(
        {"x": (0.0, 1.0)},
        {"m": 1.0},
        {"mass": ("m", ["x", "0"])},
        [{"kind": "force", "name": "hill", "at": "mass", "force": [force, "0"]}],
    )
    found = simulate(problem_of(held, 1.0, 11), get_method("heun"), step=step)
    assert found.estimate is not None
    error = abs(found.values[-1, 0] - 1.001)
    assert error <= found.estimate.worst or found.outcome.status in {"unresolved", "step_blind"}


def test_a_free_mass_under_a_fast_drive_is_no_alarm() -> None:
    problem = problem_of(driven("F*sin(w*t)", F=1.0, w=100.0 * math.pi), 10.0)
    found = simulate(problem, get_method("dop853"), tolerance=1e-6)
    assert (found.outcome.status, found.estimate is not None and found.estimate.worst < 1e-6) == ("ok", True)


@pytest.mark.parametrize("force", ["-k*x^3", "F*sin(x) - 0.1*x*dot(x)", "-m*abs(x)"])
def test_forces_without_time_bound_steps_as_those_that_hardly_know_it(force: str) -> None:
    alone, driven_too = [
        Audit(problem_of(driven(each, m=1.0, k=2.0, F=3.0), 7.0), get_method("taylor")).before(1e-6)
        for each in (force, f"{force} + 1e-30*sin(t)")
    ]
    assert alone == driven_too


@pytest.mark.parametrize("name", scene_ids())
def test_scenes_of_the_library_need_no_second_look(name: str) -> None:
    """Nothing in them is so sudden that a run has to be made again."""
    problem = problem_of(load_scene(name), 5.0, 201)
    audit = Audit(problem, get_method("dop853"))
    assert (
        audit.before(1e-6).is_whole
        or load_scene(name).guides
        or any(
            "t" in each.names
            for load in load_scene(name).loads
            for each in vars(load).values()
            if hasattr(each, "names")
        )
    )
    found = simulate(problem, get_method("dop853"), tolerance=1e-6)
    assert found.outcome.status in {"ok", "event"}
    assert found.cost.runs <= 4


def test_a_guide_that_jumps_ends_the_motion_there() -> None:
    pendulum = load_scene("guided-pendulum")
    guide = {"coordinate": pendulum.guides[0].coordinate, "value": "0.05*abs(t - 2)"}
    document = {"scene": "elastic-pendulum", "guides": [guide], "t_end": 5.0}
    answer = run(document)
    assert answer["status"] == "guide_jumps"
    assert answer["t_reached"] == pytest.approx(2.0, abs=1e-9)
    assert answer["t"][-1] <= 2.0


@pytest.mark.parametrize("value", ["0.05*abs(t - 2)", "0.05*sign(t - 2)", "0.05*t*sign(t - 2)"])
def test_auto_expects_no_smoothness_of_a_guide_with_a_kink(value: str) -> None:
    answer = run({"scene": "elastic-pendulum", "guides": [{"coordinate": "y", "value": value}], "t_end": 1.0})
    assert answer["choice"]["code"] == "auto_kinks"


@pytest.mark.parametrize(
    ("method", "gap"),
    [("explicit-euler", 1.0), ("heun", 1.0), ("rk4", 0.5), ("gauss-4", 0.5774), ("newmark", 1.0), ("radau-5", 0.4899)],
)
def test_places_a_method_looks_at(method: str, gap: float) -> None:
    assert largest_gap(get_method(method)) == pytest.approx(gap, abs=1e-3)


@pytest.mark.parametrize(
    ("leaves", "ends", "largest"),
    [
        pytest.param([(0, 1, 9.0)], (1.0,), (1.0,), id="one"),
        pytest.param([(0, 0.5, 0.2), (0.5, 1, 0.3)], (1.0,), (0.2,), id="alike"),
        pytest.param([(0, 0.5, 0.01), (0.5, 1, 0.3)], (0.5, 1.0), (0.01, 0.3), id="unlike"),
        pytest.param([(0, 0.4, 1.0), (0.4, 0.5, 0.0), (0.5, 1, 1.0)], (0.4, 0.5, 1.0), (1.0, 0.0, 1.0), id="a jump"),
        pytest.param([(0, 0.4, 0.0), (0.4, 0.5, 0.0), (0.5, 1, 1.0)], (0.5, 1.0), (0.0, 1.0), id="jumps side by side"),
    ],
)
def test_pieces_are_joined(
    leaves: list[tuple[float, float, float]], ends: tuple[float, ...], largest: tuple[float, ...]
) -> None:
    found = Pieces.joined(1.0, leaves)
    assert found.ends == pytest.approx(ends, rel=1e-14)
    assert found.largest == largest


def test_fixed_steps_of_a_pair_share_no_time() -> None:
    """Nothing can be in step with both: apart from the ends of pieces their meshes are disjoint."""
    pieces = Pieces((3.0, 7.5, 10.0), (1.0, 0.003, 0.2))
    starts = (0.0, 3.0, 7.5)
    coarse, fine = pieces.steps(0.05), pieces.steps(0.05, 1.5 + 1.0 / math.sqrt(3.0))
    for start, end, h, k in zip(starts, pieces.ends, coarse, fine, strict=True):
        ours = start + h * np.arange(1, round((end - start) / h))
        theirs = start + k * np.arange(1, round((end - start) / k))
        shared = np.abs(ours[:, None] - theirs).min(axis=1) < 1e-3 * k if len(ours) else np.zeros(0)
        assert np.count_nonzero(shared) <= 0.1 * len(ours)
        assert 2.0 * k < h * (1.0 + 1e-9)


def test_steps_behind_an_event_count_from_there() -> None:
    """What is left of the first piece is 0.1 s."""
    pieces = Pieces((3.0, 10.0), (9.0, 9.0))
    np.testing.assert_allclose(pieces.steps(0.5, 4.0, start=2.9), [0.025, 0.125])


def test_the_first_stretch_that_a_step_misses() -> None:
    pieces = Pieces((1.0, 2.0, 2.1, 3.0), (3.0, 0.01, 3.0, 0.001))
    assert pieces.needed_by(0.1) == BlindStretch(1.0, 2.0, 0.01)
    assert pieces.needed_by(0.005) == BlindStretch(2.1, 3.0, 0.001)
    assert pieces.needed_by(0.001) is None


def test_pieces_follow_one_another() -> None:
    with pytest.raises(ValueError, match="pieces must follow one another, each with its largest step"):
        Pieces((1.0, 0.5), (1.0, 1.0))
    with pytest.raises(ValueError, match="pieces must follow one another, each with its largest step"):
        Pieces((1.0,), ())


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("light", "tolerance"), [(1e-5, 1e-11), (1.7e-7, 1e-11), (3.3e-8, 1e-9), (1e-10, 1e-6)])
def test_an_ill_conditioned_mass_matrix_is_told(light: float, tolerance: float) -> None:
    """A light mass and a heavy one, each on its own spring to the wall, in relative coordinates x1 and w = x2 − x1.

    They do not know of each other: x1 = a cos t, x2 = b cos 2t.
    """
    springs = {"kind": "potential", "energy": "m1*x^2/2 + 2*m2*(x + w)^2"}
    bodies = {"light": ("m1", ["x", "0"]), "heavy": ("m2", ["x + w", "0"])}
    coordinates = {"x": (0.3, 0.0), "w": (0.4, 0.0)}
    problem = problem_of(scene(coordinates, {"m1": light, "m2": 1.0}, bodies, [springs]), 20.0)
    found = simulate(problem, get_method("dop853"), tolerance=tolerance)
    truth = np.column_stack([0.3 * np.cos(found.times), 0.7 * np.cos(2.0 * found.times) - 0.3 * np.cos(found.times)])
    assert found.estimate is not None
    assert found.outcome.status in {"ok", "tolerance_missed"}
    errors = np.abs(found.values - truth).max(axis=1)
    assert (errors <= 1.5 * found.estimate.errors + 1e-14).all()
