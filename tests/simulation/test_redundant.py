"""Motions with constraints that follow from others: a platform on parallel rods is a pendulum, however many there are.

sin φ/2 = k cd(ω₀t | k²) (Landau, Lifshitz, Mechanics, §11); the rods together pull as that of the pendulum does.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.simulation.constrained import G, equation, particle, platform, scene
from tests.simulation.test_constraints import swing

from deltaq.errors import RequestError, SceneError
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.held_rounding import held_rounding
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.problem import Floats
from deltaq.simulation.service import problem_of, run

Document = dict[str, Any]
AMPLITUDE = float(np.arcsin(0.6))
METHODS = [name for name in method_ids() if name != "taylor"]


def places(times: Floats) -> Floats:
    """x, y and p of the platform let go at x = 0.6: shape (samples, 3)."""
    angle, _ = swing(times, AMPLITUDE)
    return np.column_stack([np.sin(angle), -np.cos(angle), np.zeros_like(angle)])


@pytest.mark.parametrize("positive", [False, True], ids=["any sign", "positive"])
@pytest.mark.parametrize("rods", [2, 3, 4])
@pytest.mark.parametrize("method", METHODS)
def test_it_swings_as_a_pendulum_by_every_method(method: str, rods: int, *, positive: bool) -> None:
    """The angle is zero but for rounding: that is no digit lost, and the rods' forces add up to the one there is."""
    tolerance = 1e-9 if get_method(method).order > 3 else 1e-4
    held = platform(rods, positive=positive)
    for t_end in (1.0, 4.0):
        found = simulate(problem_of(held, t_end, 101), get_method(method), tolerance=tolerance)
        assert found.outcome.status in ("ok", "tolerance_missed")
        assert found.estimate is not None
        assert found.estimate.horizon is None
        wrong = np.abs(found.values - places(found.times)).max(axis=1)
        assert (wrong <= found.estimate.errors + 1e-14).all()
        assert found.reactions is not None
        assert found.reactions.gaps.max() < 1e-14
        angle, square = swing(found.times, AMPLITUDE)
        pull = 2.0 * (square + G * np.cos(angle))
        assert np.abs(found.reactions.multipliers.sum(axis=1) - pull).max() < 300.0 * max(wrong.max(), 1e-13)


@pytest.mark.parametrize("rods", [3, 4])
def test_no_energy_is_lost_in_many_swings(rods: int) -> None:
    found = simulate(problem_of(platform(rods), 500.0, 401), get_method("dop853"), tolerance=1e-9)
    assert found.outcome.status == "ok"
    assert np.abs(found.values - places(found.times)).max() < 1e-9
    assert found.reactions is not None
    assert found.reactions.gaps.max() < 1e-14


def block_on_plate(aslant: float) -> Scene:
    """A block sticks to a plate on three rods of 1 m; the third leans by so much, which holds the plate if not zero."""
    rods = ((-1, "0"), (1, "0"), (0, "c"))
    plate: Document = {
        "name": "plate", "kind": "rigid", "mass": "3", "position": ["x", "y"], "inertia": "1", "angle": "p"
    }  # fmt: skip
    return scene(
        {"x": (0.0, 0.0), "y": (-1.0, 0.0), "p": (0.0, 0.0), "u": (0.0, 0.0)},
        {"c": aslant, "g": G},
        [particle("block", "u", "0", mass="1"), plate],
        [
            equation(f"rod{k}", f"(x + {at}*cos(p) - ({at}) - {off})^2 + (y + {at}*sin(p))^2 = 1 + ({off})^2")
            for k, (at, off) in enumerate(rods)
        ],
        loads=[
            {"kind": "friction", "name": "between", "coordinate": "u - x", "force": "2"},
            {"kind": "force", "name": "pull", "at": "block", "force": ["1", "0"]},
        ],
    )


@pytest.mark.parametrize(("method", "t_end"), [("dop853", 50.0), ("radau-5", 50.0), ("rk4", 5.0), ("gauss-4", 50.0)])
def test_what_is_held_at_zero_loses_no_digits(method: str, t_end: float) -> None:
    """The block sticks to a plate that the rods hold; what rounding moves it by is no motion whose digits are lost."""
    found = simulate(problem_of(block_on_plate(0.5), t_end, 51), get_method(method), tolerance=1e-8)
    assert found.estimate is not None
    assert (found.outcome.status, found.estimate.horizon) == ("ok", None)
    assert (np.abs(found.values[:, [0, 2, 3]]) <= found.estimate.errors[:, None]).all()


def test_constraints_that_follow_from_others_do_so_for_some_parameters_only() -> None:
    """What holds the block is found anew where the third rod, which said nothing new before, holds the plate."""
    found = [
        simulate(problem_of(block_on_plate(aslant), 0.5, 5), get_method("dop853"), tolerance=1e-8)
        for aslant in (0.0, 0.5)
    ]
    swings, stands = (each.values for each in found)
    assert [each.outcome.status for each in found] == ["ok", "ok"]
    assert swings[-1, 0] > 0.02
    assert np.abs(swings[:, 3] - swings[:, 0]).max() < 1e-12
    assert np.abs(stands - stands[0]).max() < 1e-12


@pytest.mark.parametrize("rods", [3, 5])
@pytest.mark.parametrize("begin", [(0.7, -0.8), (0.9, -1.5), (0.6, -0.80001)], ids=str)
def test_what_does_not_fit_yet_is_moved_to_where_it_does(begin: tuple[float, float], rods: int) -> None:
    """The nearest place of a particle on a circle is along its radius; the platform does not turn for it."""
    problem = problem_of(platform(rods, begin=begin), 1.0)
    nearest = np.array([*begin, 0.0]) / np.hypot(*begin)
    assert np.abs(np.array(problem.values) - nearest).max() < 1e-13
    assert problem.rank == 2


@pytest.mark.parametrize(("rods", "undetermined"), [(2, []), (3, ["S0", "S1", "S2"]), (4, ["S0", "S1", "S2", "S3"])])
def test_multipliers_that_are_not_unique_are_not_told(rods: int, undetermined: list[str]) -> None:
    told = run({"scene": write_scene(platform(rods)), "t_end": 1.0, "samples": 5})
    assert (told["status"], told["undetermined"]) == ("ok", undetermined)
    assert sorted({*told["multipliers"], *undetermined}) == [f"S{k}" for k in range(rods)]
    assert told["drift"] < 1e-14


@pytest.mark.parametrize(("rods", "undetermined"), [(1, []), (2, ["S0", "S1", "p"]), (3, ["S0", "S1", "S2", "p"])])
def test_a_moment_that_rods_could_take_is_not_told(rods: int, undetermined: list[str]) -> None:
    """One rod leaves the moment at the frozen angle one value; two hold the platform without any."""
    asked = {"scene": write_scene(platform(rods)), "freeze": ["p"], "release": ["p"], "t_end": 1.0, "samples": 5}
    told = run(asked)
    assert (told["status"], told["undetermined"]) == ("ok", undetermined)
    assert ("p" in told["multipliers"]) == (rods == 1)
    x = np.array(told["coordinates"]["x"])
    assert np.abs(x - places(np.array(told["t"]))[:, 0]).max() < 1e-5


def test_rods_in_line_with_the_platform_are_a_fork_and_no_redundancy() -> None:
    fork: Scene = platform(3, begin=(1.0, 0.0))
    assert fork.degrees_of_freedom == 1
    with pytest.raises(SceneError, match="constraints-locked"):
        problem_of(fork, 1.0)


def test_series_are_refused_as_with_other_constraints() -> None:
    with pytest.raises(RequestError, match="method-constraints"):
        simulate(problem_of(platform(3), 1.0), get_method("taylor"), tolerance=1e-6)


@pytest.mark.parametrize("rods", [2, 3, 4])
def test_a_wall_is_met_and_left_as_by_a_pendulum(rods: int) -> None:
    """An elastic wall at x = -0.2 turns the swing round: it is met again after twice the way to it from the turn."""
    document: Document = write_scene(platform(rods))
    document["events"] = [{"name": "wall", "value": "x + 0.2", "then": "bounce", "restitution": "1"}]
    told = run({"scene": document, "t_end": 3.0, "samples": 31, "tolerance": 1e-10})
    first, second = (event["time"] for event in told["events"])
    assert (told["status"], [event["kind"] for event in told["events"]]) == ("ok", ["impact", "impact"])
    assert places(np.array([first]))[0, 0] == pytest.approx(-0.2, abs=1e-9)
    assert second == pytest.approx(3.0 * first, abs=1e-9)


@pytest.mark.parametrize("rods", [2, 3, 4])
def test_dry_friction_brakes_it_alike(rods: int) -> None:
    """On the way to the first turn friction takes F Δx of the energy."""
    document: Document = write_scene(platform(rods))
    document["loads"].append({"kind": "friction", "name": "rub", "coordinate": "x", "force": "m*g/20"})
    told = run({"scene": document, "t_end": 1.5, "samples": 151, "tolerance": 1e-10})
    (turn,) = told["events"]
    assert (told["status"], turn["kind"]) == ("ok", "turn")
    after = min(range(151), key=lambda k: abs(told["t"][k] - turn["time"]))
    x, y = (turn["coordinates"][name] if "coordinates" in turn else told["coordinates"][name][after] for name in "xy")
    assert 2.0 * G * (-0.8 - y) == pytest.approx(2.0 * G / 20 * (0.6 - x), abs=3e-3)


def test_a_blow_between_steps_is_seen() -> None:
    """m Δv = ∫F dt sets the resting platform swinging, though steps had grown."""
    document: Document = write_scene(platform(3, begin=(0.0, -1.0)))
    force, width = 2000.0, 0.001
    document["parameters"] += [{"name": n, "value": x} for n, x in (("F", force), ("c", 1.37), ("w", width))]
    push = ["F*exp(-((t - c)/w)^2)", "0"]
    document["loads"].append({"kind": "force", "name": "blow", "at": "bar", "force": push})
    told = run({"scene": document, "t_end": 3.0, "samples": 301, "tolerance": 1e-8})
    speed = force * width * np.sqrt(np.pi) / 2.0
    assert told["status"] == "ok"
    assert max(told["coordinates"]["y"]) == pytest.approx(-1.0 + speed**2 / (2.0 * G), abs=1e-4)


def test_rounding_of_what_rods_hold_is_known() -> None:
    """Lengths of a metre are wrong by units of the last place, and so are angles that they hold at that distance."""
    problem = problem_of(platform(3), 1.0)
    states = problem.state[None, :]
    x, y, p = held_rounding(problem, np.zeros(1), states)[:, 0]
    assert 1e-16 < x < 1e-14
    assert 1e-16 < y < 1e-14
    assert 1e-16 < p < 1e-14
