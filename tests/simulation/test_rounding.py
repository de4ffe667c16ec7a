"""Rounding to what the error supports."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.simulation.rounding import rounded, rounded_alone, rounded_to_bits, short, significant

VALUES = [
    pytest.param(1.23456789012, 1e-3, 1.234568, id="three guard digits"),
    pytest.param(1.23456789012, 3e-9, 1.23456789012, id="fine error"),
    pytest.param(123456.789, 50.0, 123456.79, id="large numbers keep decimals while in doubt"),
    pytest.param(123456.789, 1e9, 123457.0, id="never coarser than one"),
    pytest.param(2.0**51 + 0.5, 1e9, 2.0**51, id="the last numbers with a half, to even"),
    pytest.param(2.0**52 + 1.0, 1e9, 2.0**52 + 1.0, id="the first without decimals"),
    pytest.param(1 / 3, 0.0, 0.333333333333333, id="no error: fifteen decimals"),
    pytest.param(1e-6 / 3, 1e-21, 3.33333333333333e-7, id="small: fifteen behind the zeros"),
    pytest.param(1e-9 / 3, 1e-25, 1e-9 / 3, id="smaller than powers of ten reach"),
    pytest.param(-1e-9, 1e-3, 0.0, id="no negative zero"),
]


@pytest.mark.parametrize(("value", "error", "expected"), VALUES)
def test_value(value: float, error: float, expected: float) -> None:
    found = rounded(np.array([value]), np.array([error]))
    assert found.tolist() == [expected]
    assert not np.signbit(found[0]) or expected < 0


def test_numbers_that_are_not_measured_by_one_another() -> None:
    """Each as if it stood alone, whatever stands beside it."""
    values, errors, expected = (np.array(column) for column in zip(*(case.values for case in VALUES), strict=True))
    assert rounded_alone(values, errors).tolist() == expected.tolist()
    assert rounded_alone(values[:0], errors[:0]).tolist() == []


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        pytest.param(1 / 3, 2.0**-10, 43691 * 2.0**-17, id="a unit of 2⁻⁷ of the error"),
        pytest.param(1 / 3, 1.99 * 2.0**-10, 43691 * 2.0**-17, id="the same up to twice the error"),
        pytest.param(123456.789, 2.0**20, 15 * 2.0**13, id="coarser than one"),
        pytest.param(1 / 3, 0.0, 1 / 3, id="no error: all bits"),
        pytest.param(1e-6 / 3, 1e-22, 1e-6 / 3, id="small: as many as behind the zeros"),
        pytest.param(-1e-9, 1e-3, 0.0, id="no negative zero"),
    ],
)
def test_value_by_bits(value: float, error: float, expected: float) -> None:
    found = rounded_to_bits(np.array([[value, -value]]), np.array([error]))
    assert found.tolist() == [[expected, -expected]]
    assert not np.signbit(found[found == 0.0]).any()


@pytest.mark.parametrize("error", [0.0, 1e-12, 1.0])
def test_doubles_that_are_whole_numbers_by_their_size_stay(error: float) -> None:
    draw = np.random.default_rng(5)
    values = np.floor(2.0 ** draw.uniform(52.0, 62.0, 1000))
    assert rounded(values, np.full(1000, error)).tolist() == values.tolist()


def test_vectors_are_rounded_by_their_sample() -> None:
    values, errors = np.array([[1.23456789, 2.0], [1.23456789, 2.0]]), np.array([1e-1, 1e-4])
    assert rounded(values, errors).tolist() == [[1.2346, 2.0], [1.2345679, 2.0]]


@pytest.mark.parametrize(
    ("value", "digits", "expected"),
    [
        pytest.param(1.23456e-7, 3, 1.23e-7, id="small"),
        pytest.param(0.0, 3, 0.0, id="zero"),
        pytest.param(123456.0, 3, 123000.0, id="large"),
        pytest.param(-123456789012345678.0, 15, -123456789012346000.0, id="above the digits that are kept"),
        pytest.param(1.23456e25, 3, 1.23456e25, id="too large for powers of ten"),
        pytest.param(9.9999, 3, 10.0, id="a digit more"),
        pytest.param(0.1 + 0.2, 15, 0.3, id="fifteen"),
        pytest.param(1.23456e-20, 3, 1.23e-20, id="the last power of ten that is a double"),
        pytest.param(1.23456e-21, 3, 1.23456e-21, id="the first that is none"),
        pytest.param(1.23456e-25, 3, 1.23456e-25, id="too small for powers of ten"),
    ],
)
def test_significant_digits(value: float, digits: int, expected: float) -> None:
    assert significant(np.array([value, 1.0]), digits).tolist() == [expected, 1.0]


@pytest.mark.parametrize(("value", "shown"), [(123456.0, 123000.0), (0.00123456, 0.00123), (-9.996, -10.0), (0.0, 0.0)])
def test_numbers_for_people_have_three_digits(value: float, shown: float) -> None:
    assert short(value) == shown
    assert short(value, 15) == value


def test_sample_times_are_the_shortest_decimals() -> None:
    times = np.linspace(0.0, 10.0, 301)
    assert significant(times, 15).tolist() == [float(f"{t:.15g}") for t in times]


def test_rounding_never_leaves_the_range_of_doubles() -> None:
    """Whatever finite number is rounded to whatever digits, a finite one comes of it, and near it."""
    draw, largest = np.random.default_rng(8), np.finfo(np.float64).max
    values = np.concatenate([10.0 ** draw.uniform(-320, 308, 400), largest * draw.uniform(0.9, 1.0, 100)])
    values = np.concatenate([values, -values, [0.0, largest, -largest, 5e-324]])
    for error in (0.0, 1e-300, 1e-12, 1.0, 1e300):
        found = rounded(values, np.full(len(values), error))
        assert np.isfinite(found).all()
        assert (np.abs(found / 2 - values / 2) <= 0.5 * np.maximum(np.abs(values) * 1e-15, 0.5)).all()
        bits = rounded_to_bits(values, np.full(len(values), error))
        assert np.isfinite(bits).all()
        assert (np.abs(bits / 2 - values / 2) <= np.maximum(error, 1e-15) * 2.0**-8 + np.abs(values) * 1e-16).all()
    for digits in (1, 2, 3, 12):
        near = 5.1 * 10.0**-digits * np.abs(values) + 5e-324
        assert (np.abs(significant(values, digits) - values) <= near).all()
        assert (np.abs(np.array([short(float(v), digits) for v in values]) - values) <= near).all()
