"""Slopes in plain numbers: every function against mpmath, and numbers beside which a step would be lost."""

from __future__ import annotations

import math

import pytest
from mpmath import mp, mpf

from deltaq.language.functions import FUNCTIONS
from deltaq.language.gradients import gradient
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.tree import Name, Node, Power

NAMES = Names((Symbol("x", "coordinate"), Symbol("y", "coordinate"), Symbol("l", "parameter")))
AT = {"x": 0.37, "y": -0.6, "l": 1.7, "dot(x)": 0.21, "dot(y)": -1.3}
OUTSIDE = {"acosh": 1.9}
BY_MPMATH = {"abs": abs, "sign": mp.sign, "max": max, "min": min, "step": lambda x: mpf(x > 0)}


def tree(text: str) -> Node:
    return parse(text, NAMES).tree


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_each_function_by_each_argument(name: str) -> None:
    first = OUTSIDE.get(name, 0.37)
    text, at = (f"{name}(x, y)", (first, -0.6)) if FUNCTIONS[name].arguments == 2 else (f"{name}(x)", (first,))
    function = BY_MPMATH.get(name) or getattr(mp, name)
    with mp.workdps(40):
        orders = [tuple(int(i == k) for i in range(len(at))) for k in range(len(at))]
        known = [float(mp.diff(function, tuple(map(mpf, at)), order)) for order in orders]
    found = gradient(tree(text), {**AT, "x": first}, ["x", "y"][: len(at)])
    assert found == pytest.approx(known, rel=1e-14, abs=1e-15)


@pytest.mark.parametrize(
    ("text", "names", "slopes"),
    [
        pytest.param(
            "x*y*x/l", ["x", "y", "l"], (2 * 0.37 * -0.6 / 1.7, 0.37**2 / 1.7, 0.37**2 * 0.6 / 1.7**2), id="*"
        ),
        pytest.param("x^1.7", ["x"], (1.7 * 0.37**0.7,), id="a power"),
        pytest.param("y^3 - (-y)^2", ["y"], (3 * 0.36 + 1.2,), id="powers of what is negative"),
        pytest.param("dot(x)^2*y - dot(y)", ["dot(x)", "dot(y)", "x"], (2 * 0.21 * -0.6, -1.0, 0.0), id="rates"),
        pytest.param("sin(x)^2 + cos(x)^2", ["x"], (0.0,), id="terms that cancel"),
        pytest.param("(x + y)^2 - x^2 - 2*x*y - y^2", ["x", "y"], (0.0, 0.0), id="more of them"),
        pytest.param("l", ["x"], (0.0,), id="another name"),
    ],
)
def test_rules(text: str, names: list[str], slopes: tuple[float, ...]) -> None:
    assert gradient(tree(text), AT, names) == pytest.approx(slopes, rel=1e-14, abs=1e-300)


def test_exponents_may_move() -> None:
    found = gradient(Power(Name("x"), Name("l")), AT, ["x", "l"])
    assert found == pytest.approx((1.7 * 0.37**0.7, 0.37**1.7 * math.log(0.37)), rel=1e-14)


@pytest.mark.parametrize("text", ["sqrt(x - 0.37)", "log(y)", "1/(x - 0.37)", "asin(x + 0.63)", "y^1.5", "exp(x*10^4)"])
def test_what_has_no_slope_is_no_number(text: str) -> None:
    assert all(map(math.isnan, gradient(tree(text), AT, ["x", "y"])))


@pytest.mark.parametrize("exponent", range(-15, 16, 3))
def test_numbers_may_be_of_any_size(exponent: int) -> None:
    size = 10.0**exponent
    place = {"x": 3 * size, "y": -4 * size, "l": 5 * size}
    assert gradient(tree("sqrt(x^2 + y^2) - l"), place, ["x", "y"]) == pytest.approx((0.6, -0.8), rel=1e-14)
    assert gradient(tree("x - y + l"), place, ["x", "y", "l"]) == (1.0, -1.0, 1.0)
    assert gradient(tree("l*sin(x/l) + 1"), place, ["x"]) == pytest.approx((math.cos(0.6),), rel=1e-14)
