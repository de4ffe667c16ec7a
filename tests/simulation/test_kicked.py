"""Kicks that keep an implicit method on constraints, by symbols in long runs, against the same by numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.simulation.constrained import four_bar, parallelogram, pendulum
from tests.simulation.test_constraints import balance, doubled, drift, moved
from tests.simulation.test_rattle import HELD, place_and_rate, stepped

from deltaq.model.model import Model
from deltaq.simulation import integration, run
from deltaq.simulation.kernels import compiler, newton
from deltaq.simulation.kernels.implicit_runge_kutta import integrate_implicit
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

METHODS = ("implicit-midpoint", "variational-midpoint", "symplectic-euler")
CASES = HELD | {"four-bar by angles": lambda t_end: problem_of(four_bar(), t_end, 41)}


@pytest.fixture(autouse=True)
def _by_symbols(monkeypatch: pytest.MonkeyPatch) -> None:
    """All runs count as long; symplectic Euler, too, has its stage solved for."""
    monkeypatch.setattr(run, "SHORT", 0)
    monkeypatch.setattr(integration, "is_split", lambda *_: False)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("step", [0.025, 0.0025])
def test_symbols_lead_where_numbers_lead(case: str, method: str, step: float, monkeypatch: pytest.MonkeyPatch) -> None:
    problem = CASES[case](2.0)
    found = stepped(problem, method, step)
    monkeypatch.setattr(integration, "kicked_of", lambda *_: None)
    known = stepped(problem, method, step)
    assert found.outcome.status == known.outcome.status == "ok"
    assert drift(found) < 1e-14
    np.testing.assert_allclose(found.values, known.values, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found.rates, known.rates, rtol=0.0, atol=1e-11)


@pytest.mark.parametrize("case", ["one rod", "two rods", "four-bar, coupled masses", "four-bar by angles"])
def test_long_runs_need_no_numbers(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where symbols hold, the stages are never evaluated by numbers, and as many corrections are made."""
    problem, count, evaluate = CASES[case](0.1), [0], newton.evaluate

    def counted(*given: Any) -> None:
        count[0] += 1
        evaluate(*given)

    monkeypatch.setattr(compiler.Interpretation, "takes", lambda *_: True)
    monkeypatch.delitem(integrate_implicit.__dict__, "compiled", raising=False)
    monkeypatch.setattr(newton, "evaluate", counted)

    def evaluations() -> int:
        method, flag = get_method("implicit-midpoint"), np.zeros(1, dtype=np.int64)
        found = run.run(problem, method, np.array([0.0, 0.1]), flag, run.Steps(1e-3))
        assert found.is_complete
        return int(found.result.evaluations)

    by_symbols = compiler.interpreted(evaluations, 60.0)
    assert count == [0]
    monkeypatch.setattr(integration, "kicked_of", lambda *_: None)
    assert abs(compiler.interpreted(evaluations, 60.0) - by_symbols) <= 5
    assert count[0] > 0


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("step", [0.05, 0.01, 0.0031])
def test_a_fold_ends_the_motion(method: str, step: float) -> None:
    found = stepped(problem_of(parallelogram(), 2.0, 201), method, step)
    assert found.outcome.status == "singular_constraints"
    assert found.reached == pytest.approx(np.pi / 6, abs=1.01 * step)


@pytest.mark.parametrize("method", METHODS)
def test_areas_in_phase_space_are_kept(method: str) -> None:
    """Steps so long that energy errs by percents: the determinant of the map by angle and rate is 1."""
    nudge, at = 1e-5, (1.2, 0.4)
    columns = []
    for k in range(2):
        ahead, behind = (list(at), list(at))
        ahead[k] += nudge
        behind[k] -= nudge
        ends = [place_and_rate(angle, rate, 3.0, method, 0.06) for angle, rate in (ahead, behind)]
        columns.append((ends[0] - ends[1]) / (2.0 * nudge))
    assert np.linalg.det(np.column_stack(columns)) == pytest.approx(1.0, abs=1e-7)


@pytest.mark.parametrize("method", METHODS)
def test_nothing_drifts_in_a_thousand_periods(method: str) -> None:
    swinging, spans = pendulum(), []
    for t_end in (25.0, 2370.0):
        found = stepped(problem_of(swinging, t_end, 1001), method, 0.02)
        assert found.outcome.status == "ok"
        assert drift(found) < 1e-13
        spans.append(balance(swinging, found))
    assert spans[1] < 1.05 * spans[0], spans


def test_four_bars_keep_together_in_a_thousand_periods() -> None:
    problem = problem_of(four_bar(), 500.0, 401)
    found = stepped(problem, "implicit-midpoint", 0.005)
    assert found.outcome.status == "ok"
    assert drift(found) < 1e-13
    angles = moved(four_bar(), 0.5, samples=41).values
    near = stepped(problem_of(four_bar(), 0.5, 41), "implicit-midpoint", 1e-4).values
    assert np.abs(near - angles).max() < 1e-5


def test_a_rod_beside_the_rod_is_left_to_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Kicks that are not unique have no solution in symbols, and none is made."""
    monkeypatch.setattr(Model, "kicks", property(lambda _self: pytest.fail("asked for")))
    assert stepped(doubled(pendulum(), 1.0), "implicit-midpoint", 0.01).outcome.status == "ok"
