"""The right-hand side at many states, beside the mass matrix and forces that the model itself gives."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.mechanics.library import load_scene
from deltaq.simulation.derivatives import accelerations, derivatives, power
from deltaq.simulation.problem import Floats, Problem
from deltaq.simulation.service import problem_of

SCENES = ["pendulum", "elastic-pendulum", "guided-pendulum", "triple-pendulum", "heavy-top"]


def some_states(problem: Problem, count: int = 7) -> tuple[Floats, Floats]:
    """Times, and states near the first one."""
    rows = problem.state[: 2 * problem.degrees] + 0.3 * np.random.default_rng(1).random((count, 2 * problem.degrees))
    return np.linspace(0.0, 2.0, count), rows


@pytest.mark.parametrize("scene", SCENES)
def test_they_solve_the_equations_of_motion(scene: str) -> None:
    problem = problem_of(load_scene(scene), 2.0)
    n, (times, states) = problem.degrees, some_states(problem)
    table = problem.model.motion.table(problem.inputs(times, states))
    for row, found, rates in zip(table, accelerations(problem, times, states), states[:, n:], strict=True):
        lower = np.zeros((n, n))
        lower[np.tril_indices(n)] = row[: n * (n + 1) // 2]
        mass = lower + np.tril(lower, -1).T
        np.testing.assert_allclose(mass @ found, row[n * (n + 1) // 2 :][:n], rtol=1e-10, atol=1e-10)
        assert np.isfinite(rates).all()
    found = derivatives(problem, times, states)
    np.testing.assert_array_equal(found[:, :n], states[:, n:])
    more = np.hstack([states, np.full((len(times), 1), np.nan)])  # as of a run that has the work beside its state
    np.testing.assert_array_equal(derivatives(problem, times, more), found)


def test_power_is_that_of_the_guide() -> None:
    """P = P₀ + p₁·q̈, as the model has it; none where nothing is guided, damped or driven."""
    problem = problem_of(load_scene("guided-pendulum"), 2.0)
    n, (times, states) = problem.degrees, some_states(problem)
    table = problem.model.motion.table(problem.inputs(times, states))[:, n * (n + 1) // 2 + n :]
    expected = table[:, 0] + (table[:, 1:] * accelerations(problem, times, states)).sum(axis=1)
    np.testing.assert_allclose(power(problem, times, states), expected, rtol=1e-12)
    free = problem_of(load_scene("pendulum"), 2.0)
    assert not power(free, *some_states(free)).any()


@pytest.mark.parametrize(
    "value", [pytest.param(0.0, id="at the pole, where M has no inverse"), pytest.param(np.inf, id="infinitely far")]
)
def test_what_has_no_value_is_zero(value: float) -> None:
    problem = problem_of(load_scene("spherical-pendulum"), 2.0)
    states = np.array([[value, 0.0, 0.0, 1.0]])
    assert not accelerations(problem, np.zeros(1), states).any()
