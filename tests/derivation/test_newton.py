"""Roots of small systems, and the linear systems below them, in floats and in exact fractions."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import pytest

from deltaq.derivation.newton import Row, Vector, root, solved


@pytest.mark.parametrize(
    ("matrix", "right", "expected"),
    [
        pytest.param([[0, 1], [1, 0]], [2, 3], [3, 2], id="zero on the diagonal"),
        pytest.param([[2, 1], [1, 3]], [3, 5], [Fraction(4, 5), Fraction(7, 5)], id="two equations"),
        pytest.param([[1, 2], [2, 4]], [1, 2], None, id="dependent rows"),
    ],
)
def test_linear_systems_are_solved_exactly(
    matrix: list[list[int]], right: list[int], expected: list[Fraction] | None
) -> None:
    assert solved([[Fraction(a) for a in row] for row in matrix], [Fraction(b) for b in right]) == expected


@pytest.mark.parametrize(
    ("field", "slopes", "start", "expected"),
    [
        pytest.param(lambda x: [x[0] ** 2 - 2], lambda x: [{0: 2 * x[0]}], [1.0], [math.sqrt(2)], id="square root"),
        pytest.param(lambda x: [math.atan(x[0])], lambda x: [{0: 1 / (1 + x[0] ** 2)}], [3.0], [0.0], id="overshoots"),
        pytest.param(
            lambda x: [x[0] + x[1] - 3, x[0] * x[1] - 2],
            lambda x: [{0: 1.0, 1: 1.0}, {0: x[1], 1: x[0]}],
            [0.5, 2.5],
            [1.0, 2.0],
            id="two equations",
        ),
        pytest.param(lambda x: [x[0] ** 2 + 1], lambda x: [{0: 2 * x[0]}], [1.0], None, id="no real root"),
        pytest.param(lambda _: [math.nan], lambda _: [{0: 1.0}], [1.0], None, id="not defined"),
    ],
)
def test_root_near_the_start(
    field: Callable[[Vector], Vector], slopes: Callable[[Vector], list[Row]], start: Vector, expected: Vector | None
) -> None:
    found = root(field, slopes, start, 1.0)
    assert found == (None if expected is None else pytest.approx(expected, abs=1e-9))
