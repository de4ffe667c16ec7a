"""The error estimate on runs made by hand."""

from __future__ import annotations

import numpy as np
import pytest
from tests.simulation.scenes import oscillator

from deltaq.simulation.estimate import CLOSE, estimate
from deltaq.simulation.kernels.loop import Result
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Run, Steps
from deltaq.simulation.service import problem_of

TIMES = np.linspace(0.0, 10.0, 401)
FREQUENCY = 2.0  # of the oscillator's k = 4, m = 1


def run_of(phase: np.ndarray | float = 0.0, size: float = 1.0) -> Run:
    """cos(2t + phase) as if it had been computed."""
    angle = FREQUENCY * TIMES + phase
    states = size * np.column_stack([np.cos(angle), -FREQUENCY * np.sin(angle)])
    return Run(TIMES, states, Result(0, len(TIMES), 1, 0, 1, 10.0), 1.0, 0.0, Steps(0.1))


@pytest.fixture
def problem() -> Problem:
    return problem_of(oscillator(), 10.0)


def test_turning_points_do_not_hide_a_wrong_phase(problem: Problem) -> None:
    """A phase error ε is an error ε of a swing of size 1, also where the two curves cross."""
    found = estimate(problem, run_of(1e-6), run_of(), 1.0)
    np.testing.assert_allclose(found.errors[5:-5], 1e-6, rtol=0.1)
    assert found.horizon is None


def test_factor_scales_the_estimate(problem: Problem) -> None:
    one, two = (estimate(problem, run_of(1e-6), run_of(), factor) for factor in (1.0, 2.0))
    rounding = CLOSE  # which comes to both alike
    np.testing.assert_allclose(two.errors - rounding, 2 * (one.errors - rounding), rtol=1e-9)


def test_equal_runs_leave_rounding(problem: Problem) -> None:
    found = estimate(problem, run_of(), run_of(), 1.0)
    assert 0 < found.worst < 1e-15


def test_horizon_is_where_the_error_is_as_large_as_the_motion(problem: Problem) -> None:
    """A phase that runs away as 1e-6 e^(2t) is half a swing off at about t = 6.6; nothing is trusted after it."""
    away = run_of(1e-6 * np.exp(2 * TIMES))
    found = estimate(problem, away, run_of(), 1.0)
    assert found.horizon == pytest.approx(np.log(0.5 / 1e-6) / 2, abs=0.2)
    late = found.errors[found.horizon <= TIMES]
    assert np.all(np.diff(late) >= 0)
    assert late[0] >= 0.5


def test_small_motions_lose_their_digits_at_their_own_size(problem: Problem) -> None:
    found = estimate(problem, run_of(0.8, size=1e-4), run_of(size=1e-4), 1.0)
    assert found.horizon is not None


def test_the_shorter_run_decides_how_far(problem: Problem) -> None:
    short = Run(TIMES[:50], run_of(1e-6).states[:50], Result(1, 50, 1, 0, 1, 1.2), 1.0, 0.0, Steps(0.1))
    assert len(estimate(problem, short, run_of(), 1.0).errors) == 50
