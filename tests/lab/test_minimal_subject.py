"""Experiments that linearize take scenes with constraints in coordinates that keep them."""

from __future__ import annotations

import math
from typing import Any

import pytest

from deltaq.errors import RequestError
from deltaq.lab.library import get_experiment


def test_a_pendulum_by_a_rod_fails_where_the_one_by_an_angle_does() -> None:
    """λ = ±i √(g/l), and |R(ih√(g/l))| = 1 of RK4 at h √(g/l) = 2√2."""
    request = {"scene": "cartesian-pendulum", "methods": ["rk4"], "at": "rest", "t_end": 4.0}
    *_, last = get_experiment("stability").run(request)
    result: Any = last.result
    assert result["minimal"] == ["phi"]
    turning = math.sqrt(9.81)
    assert sorted(result["eigenvalues"]) == [
        [0.0, pytest.approx(-turning, rel=1e-5)],
        [0.0, pytest.approx(turning, rel=1e-5)],
    ]
    (row,) = result["methods"]
    assert row["predicted"] == pytest.approx(2 * math.sqrt(2) / turning, rel=0.01)
    assert result["rest"]


def test_what_has_no_closed_solution_is_refused_with_what_to_do() -> None:
    with pytest.raises(RequestError) as caught:
        next(iter(get_experiment("stability").run({"scene": "four-bar", "t_end": 1.0})))
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer, dict(problem.parameters)) == ("lab-constraints", "/scene", {"count": 2})
