"""Difference quotients: errors fall with the order of the quotient, then rounding takes over where theory says."""

from __future__ import annotations

import math

import pytest
from flint import arb

from deltaq.derivation.difference_quotient import SIZES, Comparison, Line, compare


def comparison(rounded: object = math.exp, exact: object = arb.exp) -> Comparison:
    return compare(Line(rounded, exact))  # type: ignore[arg-type]


def test_sizes_run_from_one_to_the_last_digit() -> None:
    assert (SIZES[0], SIZES[-1], len(SIZES)) == (1.0, 1e-16, 65)


def test_value_and_derivative() -> None:
    found = comparison(lambda h: math.sin(1 + h), lambda h: (1 + h).sin())
    assert (found.value, found.derivative) == (pytest.approx(math.sin(1)), pytest.approx(math.cos(1)))


@pytest.mark.parametrize(("kind", "order"), [("one_sided", 1), ("central", 2)])
def test_truncation_falls_with_the_order(kind: str, order: int) -> None:
    truncation = comparison().quotients[kind].truncation
    for one, two in zip(truncation[8:32:4], truncation[12:36:4], strict=True):
        assert math.log10(abs(one / two)) == pytest.approx(order, abs=0.02)


@pytest.mark.parametrize("kind", ["one_sided", "central"])
def test_error_is_truncation_and_rounding(kind: str) -> None:
    found = comparison().quotients[kind]
    for error, truncation, rounding in zip(found.error, found.truncation, found.rounding, strict=True):
        assert error == pytest.approx(truncation + rounding, rel=1e-12, abs=1e-300)


@pytest.mark.parametrize(("kind", "predicted"), [("one_sided", 2.1e-8), ("central", 6.9e-6)])
def test_where_it_stops_improving(kind: str, predicted: float) -> None:
    found = comparison().quotients[kind]
    assert found.predicted == pytest.approx(predicted, rel=0.02)
    assert found.best is not None
    assert abs(math.log10(SIZES[found.best] / predicted)) < 1.6
    assert abs(found.error[-1]) > 1e3 * abs(found.error[found.best])


def test_a_line_has_no_optimum() -> None:
    found = comparison(lambda h: 3 * h, lambda h: 3 * h)
    assert all(math.isnan(quotients.predicted) for quotients in found.quotients.values())
    assert found.derivative == 3.0


def test_where_the_function_ends_there_is_no_quotient() -> None:
    """√(1/2 − h) has a value for small h only."""

    def rounded(h: float) -> float:
        return math.sqrt(0.5 - h) if h <= 0.5 else math.nan

    found = comparison(rounded, lambda h: (arb(0.5) - h).sqrt()).quotients["one_sided"]
    assert math.isnan(found.quotient[0])
    assert math.isfinite(found.quotient[8])
    assert found.best is not None
    assert found.best > 8
