"""How the numbers of an answer are written."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.simulation.columns import as_numbers
from deltaq.simulation.problem import Floats


@pytest.mark.parametrize(
    "values",
    [
        pytest.param(np.array([0.1, 0.2, 0.1]), id="what moves"),
        pytest.param(np.array([0.1, 0.1, 0.1]), id="what rests"),
        pytest.param(np.array([[1.0, 2.0], [1.0, 3.0]]), id="a point that moves one way"),
        pytest.param(np.array([[1.0, 2.0], [1.0, 2.0]]), id="a point that rests"),
        pytest.param(np.array([5.0]), id="one sample"),
        pytest.param(np.zeros(0), id="no sample"),
        pytest.param(np.zeros((0, 2)), id="no sample of a point"),
    ],
)
def test_numbers_are_those_of_the_samples(values: Floats) -> None:
    assert as_numbers(values) == [list(each) if values.ndim > 1 else each for each in values]
