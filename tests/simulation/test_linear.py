"""Small linear systems of the kernels against NumPy's."""

from __future__ import annotations

import numpy as np
import pytest
from tests.simulation.called import called

from deltaq.simulation.kernels import linear

decompose, substitute = called(linear.decompose), called(linear.substitute)
RANDOM = np.random.default_rng(3)


@pytest.mark.parametrize(
    "matrix",
    [
        pytest.param(np.array([[2.0]]), id="one equation"),
        pytest.param(np.array([[0.0, 1.0], [1.0, 0.0]]), id="zero on the diagonal"),
        pytest.param(np.array([[1e-20, 1.0], [1.0, 1.0]]), id="tiny pivot"),
        pytest.param(np.array([[0.0, 2.0, 1.0], [1.0, 1.0, 0.0], [3.0, 0.0, 0.0]]), id="rows turned round"),
        pytest.param(RANDOM.normal(size=(8, 8)), id="eight equations"),
    ],
)
def test_solution_is_that_of_numpy(matrix: np.ndarray) -> None:
    right = RANDOM.normal(size=len(matrix))
    decomposed, places, x = matrix.copy(), np.zeros(len(matrix), dtype=np.int64), right.copy()
    assert decompose(decomposed, places) is True
    substitute(decomposed, places, x)
    assert x == pytest.approx(np.linalg.solve(matrix, right), rel=1e-12)


@pytest.mark.parametrize(
    "matrix",
    [
        pytest.param([[0.0]], id="zero"),
        pytest.param([[1.0, 2.0], [2.0, 4.0]], id="dependent rows"),
        pytest.param([[np.nan, 1.0], [1.0, 1.0]], id="not a number"),
        pytest.param([[np.inf, 1.0], [1.0, 1.0]], id="infinite"),
        pytest.param([[1e-310]], id="smaller than what has an inverse"),
    ],
)
def test_what_has_no_solution(matrix: list[list[float]]) -> None:
    assert decompose(np.array(matrix), np.zeros(len(matrix), dtype=np.int64)) is False
