"""Derivatives where a factor on the way is zero or infinite, against differences in many digits."""

from __future__ import annotations

import pytest
import symengine as se
from mpmath import mp, mpf

from deltaq.model.compiled import compile_expressions
from deltaq.model.functions import absolute, sign
from deltaq.model.slopes import gradient, slope

T, X, Y = se.symbols("t x y")
HALF = se.Rational(1, 2)
ROOT = absolute(X) ** HALF

POINTS = [
    pytest.param(se.atan2(T + 1, T), lambda t, _x: mp.atan2(t + 1, t), T, (0.0, 0.0), id="angle straight up"),
    pytest.param(se.atan2(X, T) ** 2, lambda t, x: mp.atan2(x, t) ** 2, X, (0.0, -1.0), id="angle straight down"),
    pytest.param(
        se.atan2(se.sin(T), se.atan2(X, T)), lambda t, x: mp.atan2(mp.sin(t), mp.atan2(x, t)), T, (0.3, 0.0),
        id="nested",
    ),
    pytest.param(absolute(X) ** 3 * HALF, lambda _t, x: abs(x) ** 3 / 2, X, (0.0, 0.0), id="cube of a modulus"),
    pytest.param(X**2 * ROOT, lambda _t, x: x**2 * mp.sqrt(abs(x)), X, (0.0, 0.0), id="square and root"),
    pytest.param(X * T * ROOT, lambda t, x: x * t * mp.sqrt(abs(x)), X, (2.0, 0.0), id="root and factor"),
    pytest.param(T * ROOT, lambda t, x: t * mp.sqrt(abs(x)), T, (2.0, 0.0), id="root beside the variable"),
    pytest.param(
        T * absolute(X * Y) ** HALF, lambda t, x: t * mp.sqrt(abs(x)) * 0, T, (2.0, 0.0), id="root of another"
    ),
    pytest.param(
        absolute(se.atan2(X, T)) ** (3 * HALF), lambda t, x: abs(mp.atan2(x, t)) ** 1.5, T, (1.0, 0.0), id="in a root"
    ),
]  # fmt: skip


@pytest.mark.parametrize(("expression", "function", "variable", "at"), POINTS)
def test_slopes_where_a_factor_has_no_value(expression, function, variable, at) -> None:  # type: ignore[no-untyped-def]
    """Central differences of the function itself at 60 digits: no derivative is taken on the way to them."""
    found = compile_expressions([T, X, Y], [slope(expression, variable)]).table([[*at, 0.0]])[0, 0]
    with mp.workdps(60):
        h, (t, x) = mpf(10) ** -25, map(mpf, at)
        moved = [(t + k * h, x) if variable == T else (t, x + k * h) for k in (1, -1)]
        known = (function(*moved[0]) - function(*moved[1])) / (2 * h)
    assert found == pytest.approx(float(known), abs=1e-12, rel=1e-14)


@pytest.mark.parametrize("of", [sign(X), absolute(Y), absolute(Y) ** HALF, se.atan2(Y, 1 + Y**2)])
def test_what_does_not_move_has_no_slope(of: object) -> None:
    assert gradient(of, (T, se.Symbol("p"))) == (0, 0)


def test_second_slopes_of_an_angle_have_no_pole_where_it_is_upright() -> None:
    """atan2(t + 1, t)″ = (4t + 2)/(2t² + 2t + 1)², which is 2 at t = 0."""
    twice = slope(slope(se.atan2(T + 1, T), T), T)
    table = compile_expressions([T], [twice]).table([[0.0], [0.7], [-0.5]])[:, 0]
    assert table == pytest.approx([2.0, 4.8 / 3.38**2, 0.0], rel=1e-14)
