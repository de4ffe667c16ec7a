"""Symplectic methods on constraints by kicks and drifts, against the road that solves for stages and what is known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.simulation.constrained import (
    G,
    double_pendulum,
    equation,
    four_bar,
    parallelogram,
    particle,
    pendulum,
    rod,
    scene,
)
from tests.simulation.test_constraints import balance, doubled, drift, moved, reactions, swing

from deltaq.mechanics.scene import Scene
from deltaq.simulation import integration, run
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Floats, Problem
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

METHODS = ("stormer-verlet", "symplectic-euler")
EITHER = pytest.mark.usefixtures("code")
LENGTHS = {"m1": 1.0, "m2": 0.5, "l1": 1.0, "l2": 0.7, "g": G}


@pytest.fixture(params=["by numbers", "by symbols"])
def code(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """The shortest runs are by numbers; others by what is solved for in symbols, as all are now."""
    name, limit = ("SHORT", 0) if request.param == "by symbols" else ("FEW", 10**9)
    monkeypatch.setattr(run, name, limit)


def stepped(problem: Problem, method: str, step: float) -> Trajectory:
    return simulate(problem, get_method(method), step=step, with_error=False)


def rods() -> Scene:
    return double_pendulum((1.0, 0.5), (0.3, 0.2), LENGTHS)


def loop() -> Scene:
    """The four-bar by the places of its joints; the middle of the coupler gives M entries beside its diagonal."""
    problem = problem_of(four_bar(), 1.0)
    (a, _, c), (va, _, vc), r, s, d = problem.values, problem.rates, 0.5, 1.2, 1.5
    return scene(
        {
            "x1": (r * np.cos(a), -r * np.sin(a) * va),
            "y1": (r * np.sin(a), r * np.cos(a) * va),
            "x2": (d + s * np.cos(c), -s * np.sin(c) * vc),
            "y2": (s * np.sin(c), s * np.cos(c) * vc),
        },
        {"m": 1.0, "r": r, "k": 1.6, "s": s, "d": d, "g": G},
        [
            particle("crank", "x1", "y1"),
            particle("middle", "(x1 + x2)/2", "(y1 + y2)/2"),
            particle("rocker", "x2", "y2"),
        ],
        [rod("R", "pivot", "crank", "r"), rod("K", "crank", "rocker", "k"), rod("S", "ground", "rocker", "s")],
        points={"pivot": ["0", "0"], "ground": ["d", "0"]},
    )


def wire() -> Scene:
    """A bead on a parabola in space, which turns with time: one constraint moves, and is no distance."""
    return scene(
        {"x": (0.4, 0.0), "y": (0.0, 0.8), "z": (0.16, 0.0)},
        {"m": 1.0, "g": G, "Omega": 2.0},
        [particle("bead", "x", "y", "z")],
        [equation("N", "z = x^2 + y^2"), equation("T", "y*cos(Omega*t) = x*sin(Omega*t)")],
        dimension=3,
    )


def string() -> Scene:
    """A pendulum on a string that is hauled in and let out: what its rate along the string is changes the force."""
    return scene(
        {"x": (1.0, 0.0), "y": (0.0, 0.0)},
        {"m": 1.0, "l": 1.0, "g": G, "a": 0.2, "Omega": 3.0},
        [particle("bob", "x", "y")],
        [equation("S", "x^2 + y^2 = (l + a*sin(Omega*t))^2")],
    )


def incline() -> Scene:
    """A bead on an inclined straight wire."""
    return scene(
        {"x": (0.0, 0.3), "y": (0.0, -0.21)},
        {"m": 1.0, "g": G, "k": 0.7},
        [particle("bead", "x", "y")],
        [equation("N", "y + k*x = 0")],
    )


def pushed() -> Scene:
    """A pendulum that a force pushes from a certain time on."""
    push = {"name": "push", "kind": "force", "at": "bob", "force": ["2*step(t - c)", "0"]}
    values = {"m": 1.0, "l": 1.0, "g": G, "c": 0.73}
    bob, held = particle("bob", "x", "y"), rod("S", "pivot", "bob")
    places = {"x": (1.0, 0.0), "y": (0.0, 0.0)}
    return scene(places, values, [bob], [held], points={"pivot": ["0", "0"]}, loads=[push])


HELD: dict[str, Callable[[float], Problem]] = {
    "one rod": lambda t_end: problem_of(pendulum(), t_end, 41),
    "two rods": lambda t_end: problem_of(rods(), t_end, 41),
    "four-bar, coupled masses": lambda t_end: problem_of(loop(), t_end, 41),
    "a rod beside the rod": lambda t_end: doubled(pendulum(), 1.25 * t_end),
    "moving pivot": lambda t_end: problem_of(pendulum(pivot=("0", "a*sin(Omega*t)")), t_end, 41),
    "string let out": lambda t_end: problem_of(string(), t_end, 41),
    "turning wire": lambda t_end: problem_of(wire(), t_end, 41),
    "a force that jumps": lambda t_end: problem_of(pushed(), t_end, 41),
    "almost folding": lambda t_end: problem_of(parallelogram(), min(t_end, 0.5), 21),
}


@EITHER
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("case", HELD)
@pytest.mark.parametrize("step", [0.025, 0.0025])
def test_kicks_and_drifts_lead_where_stages_solved_for_lead(
    case: str, method: str, step: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = HELD[case](2.0)
    found = stepped(problem, method, step)
    monkeypatch.setattr(integration, "is_split", lambda *_: False)
    known = stepped(problem, method, step)
    assert found.outcome.status == known.outcome.status == "ok"
    assert drift(found) < 1e-14
    np.testing.assert_allclose(found.values, known.values, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found.rates, known.rates, rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(reactions(found), reactions(known), rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("short", [0, run.SHORT], ids=["a long run", "a short run"])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("case", ["one rod", "two rods", "four-bar, coupled masses", "moving pivot", "turning wire"])
def test_runs_by_short_steps_need_no_numbers(
    case: str, method: str, short: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Left to numbers, a step looks at the motion where it begins, too; the work is two more looks."""
    problem = HELD[case](2.0)
    assert problem.model.pushes is not None
    monkeypatch.setattr(run, "SHORT", short)
    found = run.run(problem, get_method(method), np.array([0.0, 2.0]), np.zeros(1, dtype=np.int64), run.Steps(1e-3))
    assert found.is_complete
    looks = 3 if problem.model.layout.is_powered else 1
    assert found.result.evaluations <= looks * found.result.steps + 5


@pytest.mark.parametrize(("method", "late"), [(METHODS[0], 0.0), (METHODS[1], 1.0)])
def test_half_a_million_steps_lose_nothing_to_rounding(method: str, late: float) -> None:
    """On an incline the motion of both is known exactly: x = v₀t + ½at², or ½at(t + h)."""
    step, a = 2e-6, 0.7 * G / (1.0 + 0.7**2)
    found = stepped(problem_of(incline(), 1.0, 2), method, step)
    assert found.values[-1, 0] == pytest.approx(0.3 + 0.5 * a * (1.0 + late * step), abs=3e-15)
    assert found.rates[-1, 0] == pytest.approx(0.3 + a, abs=4e-15)


@EITHER
def test_a_four_bar_by_places_moves_as_by_angles() -> None:
    angles = moved(four_bar(), 2.0, samples=41).values
    r, s, d = 0.5, 1.2, 1.5
    known = np.column_stack(
        [r * np.cos(angles[:, 0]), r * np.sin(angles[:, 0]), d + s * np.cos(angles[:, 2]), s * np.sin(angles[:, 2])]
    )
    missed = [np.abs(stepped(problem_of(loop(), 2.0, 41), METHODS[0], h).values - known).max() for h in (2e-3, 1e-3)]
    assert missed[0] < 1e-3
    assert missed[0] / missed[1] == pytest.approx(4.0, rel=0.02)


def place_and_rate(angle: float, rate: float, t_end: float, method: str, step: float) -> Floats:
    """Angle and its rate of a pendulum by a rod, after a time."""
    c, s = np.cos(angle), np.sin(angle)
    found = stepped(problem_of(pendulum(s, -c, rate * c, rate * s), t_end, 2), method, step)
    (x, y), (u, v) = found.values[-1], found.rates[-1]
    return np.array([np.arctan2(x, -y), x * v - y * u])


@EITHER
@pytest.mark.parametrize("method", METHODS)
def test_areas_in_phase_space_are_kept(method: str) -> None:
    """Steps so long that energy errs by percents: the determinant of the map by angle and rate is 1."""
    nudge, at = 1e-5, (1.2, 0.4)
    columns = []
    for k in range(2):
        ahead, behind = (list(at), list(at))
        ahead[k] += nudge
        behind[k] -= nudge
        ends = [place_and_rate(*each, 3.0, method, 0.06) for each in (ahead, behind)]
        columns.append((ends[0] - ends[1]) / (2.0 * nudge))
    assert np.linalg.det(np.column_stack(columns)) == pytest.approx(1.0, abs=1e-7)


@EITHER
def test_a_way_back_leads_to_the_start() -> None:
    problem = problem_of(rods(), 6.0, 2)
    there = stepped(problem, METHODS[0], 0.01)
    back = replace(problem, values=tuple(there.values[-1]), rates=tuple(-there.rates[-1]))
    found = stepped(back, METHODS[0], 0.01)
    assert np.abs(found.values[-1] - problem.values).max() < 1e-10
    assert np.abs(found.rates[-1] + problem.rates).max() < 1e-10


@pytest.mark.parametrize("method", METHODS)
def test_energy_does_not_drift_in_two_thousand_periods(method: str) -> None:
    swinging, spans = pendulum(), []
    for t_end in (50.0, 4740.0):
        found = stepped(problem_of(swinging, t_end, 1001), method, 0.02)
        assert found.outcome.status == "ok"
        assert drift(found) < 1e-14
        spans.append(balance(swinging, found))
    assert spans[1] < 1.02 * spans[0], spans


@EITHER
@pytest.mark.parametrize(("method", "order"), [(METHODS[0], 2), (METHODS[1], 1)])
@pytest.mark.parametrize(
    "held",
    [pendulum(pivot=("0", "a*sin(Omega*t)")), wire(), string()],
    ids=["moving pivot", "turning wire", "string let out"],
)
def test_what_moves_a_constraint_feeds_in_what_energy_gains(held: Scene, method: str, order: int) -> None:
    gaps = [balance(held, stepped(problem_of(held, 3.0, 151), method, step)) for step in (0.004, 0.001)]
    assert gaps[1] < 0.05
    assert gaps[0] > 0.9 * 4**order * gaps[1]


@EITHER
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("step", [0.05, 0.01, 0.0031])
def test_a_fold_ends_the_motion(method: str, step: float) -> None:
    found = stepped(problem_of(parallelogram(), 2.0, 201), method, step)
    assert found.outcome.status == "singular_constraints"
    assert found.reached == pytest.approx(np.pi / 6, abs=1.01 * step)


@EITHER
def test_an_event_ends_the_motion_where_it_happens() -> None:
    """The bob falls through the height at which cos φ = 0.8, of which events are told within a step."""
    held = scene(
        {"x": (1.0, 0.0), "y": (0.0, 0.0)},
        {"m": 1.0, "l": 1.0, "g": G},
        [particle("bob", "x", "y")],
        [rod("S", "pivot", "bob")],
        points={"pivot": ["0", "0"]},
        events=[{"name": "gate", "value": "y + 4*l/5"}],
    )
    when = brentq(lambda t: np.cos(swing(np.array([t]))[0][0]) - 0.8, 0.1, 0.59, xtol=1e-14)
    missed = []
    for step in (0.01, 0.0025):
        found = stepped(problem_of(held, 2.0, 101), METHODS[0], step)
        assert found.outcome.code == "event"
        assert drift(found) < 1e-14
        missed.append(abs(found.reached - when))
    assert missed[0] < 1e-3
    assert missed[1] < 0.1 * missed[0]
