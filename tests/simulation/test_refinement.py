"""What the difference of two runs tells of their error, and what it does not: rounding, which chaos magnifies."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from tests.simulation.scenes import double_pendulum

from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.refinement import FINEST_TOLERANCE, ByTolerance
from deltaq.simulation.service import problem_of

Extended = np.ndarray  # of np.longdouble
STEP, COLUMNS = 0.0125, 8  # of the extrapolation: its own error stays below 1e-19 for each step

pytestmark = pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="this processor has no extended precision")


def rhs_of(problem: Problem) -> Callable[[Extended], Extended]:
    """Lagrange's equations of the double pendulum, written by hand."""
    m1, m2, l1, l2, g = (np.longdouble(value) for value in problem.parameters)

    def rhs(y: Extended) -> Extended:
        a, b, u, v = y
        s, c = np.sin(a - b), np.cos(a - b)
        m11, m12, m22 = (m1 + m2) * l1 * l1, m2 * l1 * l2 * c, m2 * l2 * l2
        f1 = -m2 * l1 * l2 * s * v * v - (m1 + m2) * g * l1 * np.sin(a)
        f2 = m2 * l1 * l2 * s * u * u - m2 * g * l2 * np.sin(b)
        det = m11 * m22 - m12 * m12
        return np.array([u, v, (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det])

    return rhs


def extrapolated(rhs: Callable[[Extended], Extended], y: Extended) -> Extended:
    """One step of Gragg's extrapolation (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.9)."""
    table: list[list[Extended]] = []
    for k in range(COLUMNS):
        count = 2 * (k + 1)
        h = np.longdouble(STEP) / count
        last, now = y, y + h * rhs(y)
        for _ in range(count - 1):
            last, now = now, last + 2 * h * rhs(now)
        row = [(last + now + h * rhs(now)) / 2]
        for j in range(1, k + 1):
            ratio = np.longdouble(k + 1) / (k + 1 - j)
            row.append(row[j - 1] + (row[j - 1] - table[k - 1][j - 1]) / (ratio * ratio - 1))
        table.append(row)
    return table[-1][-1]


@cache
def exact() -> tuple[Problem, Extended]:
    """The double pendulum for 11 s, and its angles at 111 samples."""
    problem = problem_of(double_pendulum(), 11.0, 111)
    rows = [np.array([*problem.values, *problem.rates], dtype=np.longdouble)]
    rhs = rhs_of(problem)
    for _ in range(round(problem.t_end / STEP)):
        rows.append(extrapolated(rhs, rows[-1]))
    return problem, np.array(rows[:: round(0.1 / STEP)])[:, :2]


def test_rounding_that_chaos_magnifies_is_told() -> None:
    """Two runs at the finest tolerance differ by less than both are wrong: they share the rounding of the model."""
    problem, angles = exact()
    for tolerance in (1e-9, 1e-10):
        found = simulate(problem, get_method("dop853"), tolerance=tolerance)
        assert found.outcome.status == "tolerance_missed"
        true = np.abs(found.values - angles).max(axis=1)
        assert true[-1] > 1e-9
        assert np.all(true <= found.estimate.errors)


@pytest.mark.parametrize("exponent", np.linspace(-9.0, -4.0, 31).round(3).tolist())
def test_a_nudge_hides_no_error_of_a_series(exponent: float) -> None:
    """What a finer run is nudged by, and what the steps of the coarser one do, may be equal and cancel out."""
    problem, angles = exact()
    found = simulate(problem, get_method("taylor"), tolerance=10.0**exponent)
    assert np.all(np.abs(found.values - angles).max(axis=1) <= found.estimate.errors)


def test_only_next_to_the_finest_tolerance_is_the_difference_mistrusted() -> None:
    how = ByTolerance(10.0, 8)
    assert how.least_part(1e-10, 1e-12) == 0.0
    assert how.least_part(1e-10, FINEST_TOLERANCE) == pytest.approx(1e-4)
