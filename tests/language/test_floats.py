"""Expressions as plain numbers, NaN where they have no value."""

from __future__ import annotations

import math

import pytest
from tests.language.scene_names import NAMES

from deltaq.language.floats import evaluate, evaluate_beyond
from deltaq.language.parser import parse

POINT = {"m": 2.0, "l": 0.5, "phi": 1.0, "x": 3.0, "y": -4.0, "dot(phi)": 0.25, "ddot(phi)": 7.0}
POINT |= {"delta(phi)": 0.1, "dot(delta(phi))": 0.2, "d(phi)": 0.3, "t": 10.0}

ROWS = [
    ("2.5", 2.5),
    ("pi", math.pi),
    ("t", 10.0),
    ("m*l^2*ddot(phi)", 3.5),
    ("m/l", 4.0),
    ("-x - y", 1.0),
    ("dot(phi)^2", 0.0625),
    ("delta(phi)", 0.1),
    ("dot(delta(phi))", 0.2),
    ("d(phi)", 0.3),
    ("sin(phi)^2 + cos(phi)^2", 1.0),
    ("atan2(y, x)", math.atan2(-4.0, 3.0)),
    ("sqrt(x^2 + y^2)", 5.0),
    ("sign(y)*abs(y)", -4.0),
]
UNDEFINED = [
    ("1/(x - 3)", "division by zero"),
    ("sqrt(y)", "root of a negative number"),
    ("exp(x^8)", "too large"),
    ("diff(x^2, x)", "a derivative"),
    ("dot(x^2)", "a derivative by the time"),
    ("[x, y]", "a vector"),
    ("x = y", "an equation"),
]


@pytest.mark.parametrize(("text", "value"), ROWS, ids=[text for text, _ in ROWS])
def test_value(text: str, value: float) -> None:
    assert evaluate(parse(text, NAMES).tree, POINT) == pytest.approx(value)


@pytest.mark.parametrize("text", [text for text, _ in UNDEFINED], ids=[reason for _, reason in UNDEFINED])
def test_no_value(text: str) -> None:
    assert math.isnan(evaluate(parse(text, NAMES).tree, POINT))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1/cosh(1000*x)^2", 0.0),
        ("1/(1 + exp(x^8))", 0.0),
        ("atan(sinh(1000*y))", -math.pi / 2),
        ("1/(10^30*y)^11", -0.0),
        ("tanh(exp(x^8))", 1.0),
        ("exp(x^8)", math.inf),
        ("x^2", 9.0),
    ],
)
def test_value_of_parts_beyond_all_numbers(text: str, value: float) -> None:
    found = evaluate_beyond(parse(text, NAMES).tree, POINT)
    assert found == value
    assert math.copysign(1.0, found) == math.copysign(1.0, value)


@pytest.mark.parametrize(
    "text", ["1/(x - 3)", "sqrt(y)", "exp(x^8)/cosh(x^8)", "exp(x^8) - cosh(x^8)", "cos(exp(x^8))"]
)
def test_no_value_even_beyond_all_numbers(text: str) -> None:
    assert math.isnan(evaluate_beyond(parse(text, NAMES).tree, POINT))
