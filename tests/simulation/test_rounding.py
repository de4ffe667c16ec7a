"""Rounding to what the error supports."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.simulation.rounding import rounded, short


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        pytest.param(1.23456789012, 1e-3, 1.234568, id="three guard digits"),
        pytest.param(1.23456789012, 3e-9, 1.23456789012, id="fine error"),
        pytest.param(123456.789, 50.0, 123456.79, id="large numbers keep decimals while in doubt"),
        pytest.param(123456.789, 1e9, 123457.0, id="never coarser than one"),
        pytest.param(1 / 3, 0.0, 0.333333333333333, id="no error: fifteen decimals"),
        pytest.param(-1e-9, 1e-3, 0.0, id="no negative zero"),
    ],
)
def test_value(value: float, error: float, expected: float) -> None:
    found = rounded(np.array([value]), np.array([error]))
    assert found.tolist() == [expected]
    assert not np.signbit(found[0]) or expected < 0


def test_vectors_are_rounded_by_their_sample() -> None:
    values, errors = np.array([[1.23456789, 2.0], [1.23456789, 2.0]]), np.array([1e-1, 1e-4])
    assert rounded(values, errors).tolist() == [[1.2346, 2.0], [1.2345679, 2.0]]


def test_short() -> None:
    assert short(np.array([1.23456e-7, 0.0])) == [1.23e-7, 0.0]
