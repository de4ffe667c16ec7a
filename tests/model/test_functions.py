"""Every function of the language in SymEngine: value, and derivative by differences."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import symengine as se
from mpmath import mp

from deltaq.language.functions import FUNCTIONS as LANGUAGE
from deltaq.model.compiled import QUICK, THOROUGH, compile_expressions
from deltaq.model.functions import FUNCTIONS

POINT = {"acosh": (1.7,), "atan2": (0.4, -0.7), "max": (0.4, -0.7), "min": (0.4, -0.7)}


def test_the_model_knows_exactly_the_functions_of_the_language() -> None:
    assert set(FUNCTIONS) == set(LANGUAGE)


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_value_and_derivative(name: str) -> None:
    at = POINT.get(name, (0.4,))
    symbols = se.symbols("x y")[: len(at)]
    expression = FUNCTIONS[name](*symbols)
    compiled = compile_expressions(symbols, [expression, expression.diff(symbols[0])])
    value, slope = compiled.table(np.array([at]))[0]
    evaluate, h = LANGUAGE[name].evaluate, 1e-6
    assert value == pytest.approx(evaluate(*at), rel=1e-13)
    differences = (evaluate(at[0] + h, *at[1:]) - evaluate(at[0] - h, *at[1:])) / (2 * h)
    assert slope == pytest.approx(differences, rel=1e-8)


@pytest.mark.parametrize(
    ("name", "x", "value"),
    [
        ("abs", -2.0, 2.0),
        ("abs", 0.0, 0.0),
        ("sign", -2.0, -1.0),
        ("sign", 0.0, 0.0),
        ("sign", 3.0, 1.0),
        ("step", -2.0, 0.0),
        ("step", 0.0, 0.5),
        ("step", 3.0, 1.0),
    ],
)
def test_kinks(name: str, x: float, value: float) -> None:
    symbol = se.Symbol("x")
    assert compile_expressions([symbol], [FUNCTIONS[name](symbol)]).table(np.array([[x]]))[0, 0] == value


@pytest.mark.parametrize("exponent", ["1/2", "-1/2", "3/2", "-3/2", "5/2", "-7/2", "1/3", "-4/3", "2", "-3", "9/4"])
@pytest.mark.parametrize("x", [1e-3, 0.7, 1.0, 2.0, 3e5, 0.0, np.inf, -1.3])
def test_powers(exponent: str, x: float) -> None:
    """Within six units in the last place of the power at 40 digits, alone and beside others of the same base."""
    base, part = se.Symbol("x"), Fraction(exponent)
    power, root = base ** se.Rational(part.numerator, part.denominator), base ** se.Rational(1, 2)
    outputs = [power, power * root + 1, 2 * (power - base) / root]
    quick, thorough = (
        compile_expressions([base], outputs, each).table(np.array([[x]]))[0] for each in (QUICK, THOROUGH)
    )
    np.testing.assert_array_equal(quick, thorough)
    with mp.workdps(40):
        known = mp.power(x, mp.mpf(part.numerator) / part.denominator) if x != 0.0 or part > 0 else mp.inf
    if isinstance(known, mp.mpc) and known.imag != 0:
        assert np.isnan(quick[0])
    else:
        assert quick[0] == pytest.approx(float(known.real), rel=6 * 2.0**-53)
