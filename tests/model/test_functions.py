"""Every function of the language in SymEngine: value, and derivative by differences."""

from __future__ import annotations

import numpy as np
import pytest
import symengine as se

from deltaq.language.functions import FUNCTIONS as LANGUAGE
from deltaq.model.compiled import compile_expressions
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
