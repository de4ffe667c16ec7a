"""The error told of coarse runs, whose steps are so long that errors do not fall as the order of a method says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.simulation.four_bar import followed

from deltaq.mechanics.library import load_scene
from deltaq.simulation.consistency import consistent
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Floats, Problem
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

SAMPLES, DOUBT = 201, 5e-9  # of the truth after twenty seconds, at most


def four_bar(crank: float, rate: float, span: float) -> tuple[Problem, Floats]:
    """From where the crank is and how fast it turns, and its truth."""
    truth = followed(crank, rate, np.linspace(0.0, span, SAMPLES))
    given = problem_of(load_scene("four-bar"), span, SAMPLES)
    return consistent(replace(given, values=tuple(truth[0, :3]), rates=tuple(truth[0, 3:]))), truth[:, :3]


def short(found: Trajectory, truth: Floats, doubt: float) -> float:
    """The largest ratio of the true error to that told, at any sample."""
    assert found.outcome.status == "ok"
    assert found.estimate is not None
    true = np.abs(found.values - truth).max(axis=1)
    return float(np.max((true - doubt) / np.maximum(found.estimate.errors, 1e-300)))


@pytest.mark.parametrize(
    ("method", "tolerance", "span", "crank", "rate"),
    [
        ("heun", 1e-2, 3.0, 1.3, 6.1),
        ("rk4", 1e-4, 3.0, 0.52, 12.3),
        ("gauss-4", 1e-2, 20.0, 0.88, 9.08),
        ("gauss-4", 1e-2, 20.0, 1.14, 6.2),
        ("gauss-4", 1e-2, 20.0, 0.968, 7.17),
        ("gauss-6", 1e-3, 20.0, 0.756, 8.31),
        ("dormand-prince-54", 1e-2, 20.0, 0.7562, 8.307),
        ("dop853", 1e-2, 3.0, 1.298, 6.105),
        ("dop853", 1e-3, 3.0, 0.52, 12.3),
        ("dop853", 1e-3, 3.0, 1.3, 6.1),
        ("dop853", 1e-4, 3.0, 0.52, 12.3),
        ("radau-5", 1e-2, 20.0, 1.13, 5.02),
        ("radau-5", 1e-3, 20.0, 0.756, 8.31),
        ("radau-5", 1e-6, 3.0, 1.048, 9.07),
    ],
)
def test_a_four_bar_is_no_further_off_than_is_told(
    method: str, tolerance: float, span: float, crank: float, rate: float
) -> None:
    """Two runs of a pair may be wrong by about the same here; by 1.2 to 18 times more than their difference told."""
    problem, truth = four_bar(crank, rate, span)
    found = simulate(problem, get_method(method), tolerance=tolerance)
    assert short(found, truth, DOUBT) <= 1.0


@pytest.mark.parametrize("scale", [0.9, 1.0, 1.1])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_neither_is_a_pendulum_that_comes_to_rest_over_magnets(tolerance: float, scale: float) -> None:
    """At rest steps are as long as may be and two runs agree to the last digit; truth is a far finer run by another."""
    given = problem_of(load_scene("magnetic-pendulum"), 20.0, SAMPLES)
    problem = replace(given, values=tuple(scale * value for value in given.values))
    truth = simulate(problem, get_method("dop853"), tolerance=1e-12)
    found = simulate(problem, get_method("radau-5"), tolerance=tolerance)
    assert short(found, truth.values, 1e-11) <= 1.0


@pytest.mark.parametrize(("crank", "rate"), [(0.9, 8.0), (1.05, 9.07), (0.828, 6.03)])
def test_what_newton_leaves_of_stages_does_not_rule_the_error(crank: float, rate: float) -> None:
    """Errors of Radau's method fall with the local tolerance, and so a pair's difference tells the finer one's."""
    problem, truth = four_bar(crank, rate, 3.0)
    coarse, fine = (simulate(problem, get_method("radau-5"), tolerance=each) for each in (1e-5, 3e-7))
    off = [float(np.abs(each.values - truth).max()) for each in (coarse, fine)]
    assert off[1] < 0.2 * off[0] + 1e-10


@pytest.mark.parametrize("method", ["newmark", "implicit-midpoint", "dop853"])
def test_a_force_that_fades_away_is_not_said_to_be_unknown(method: str) -> None:
    """A sleigh comes to run straight on and λ vanishes as the square of a secant: so does its error."""
    problem = problem_of(load_scene("chaplygin-sleigh"), 20.0, SAMPLES)
    found, true = (simulate(problem, get_method(name), tolerance=t) for name, t in ((method, 1e-3), ("dop853", 1e-12)))
    assert found.reactions is not None
    assert true.reactions is not None
    assert found.estimate is not None
    assert found.estimate.multipliers is not None
    wrong = np.abs(found.reactions.multipliers - true.reactions.multipliers)[:, 0]
    told, sure = found.estimate.multipliers[:, 0], wrong > 1e-11
    assert np.all(wrong[sure] <= told[sure])
    assert np.median(told[sure] / wrong[sure]) <= 1000.0
