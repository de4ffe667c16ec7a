"""Each function of the language has SymPy's values, by plain numbers and by balls, and is read as it is written."""

from __future__ import annotations

import math

import pytest
import sympy
from tests.language.scene_names import NAMES, SYMBOLS, problem_of, read

from deltaq.language.canonical import is_zero
from deltaq.language.floats import evaluate
from deltaq.language.functions import FUNCTIONS
from deltaq.language.intervals import sample_zero
from deltaq.language.latex_printer import Typography, latex
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.plain_printer import plain
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy

X, Y, L = SYMBOLS.name("x"), SYMBOLS.name("y"), SYMBOLS.name("l")

# Every name, its function in SymPy, and where it is compared.
FUNCTION_OF = [
    ("sin", sympy.sin, (-2.0, 0.3)), ("cos", sympy.cos, (-2.0, 0.3)), ("tan", sympy.tan, (-2.0, 0.3)),
    ("cot", sympy.cot, (-2.0, 0.3)), ("sec", sympy.sec, (-2.0, 0.3)), ("csc", sympy.csc, (-2.0, 0.3)),
    ("asin", sympy.asin, (-0.9, 0.3)), ("acos", sympy.acos, (-0.9, 0.3)), ("atan", sympy.atan, (-2.0, 0.3)),
    ("sinh", sympy.sinh, (-2.0, 0.3)), ("cosh", sympy.cosh, (-2.0, 0.3)), ("tanh", sympy.tanh, (-2.0, 0.3)),
    ("asinh", sympy.asinh, (-2.0, 0.3)), ("acosh", sympy.acosh, (1.2, 3.0)), ("atanh", sympy.atanh, (-0.9, 0.3)),
    ("exp", sympy.exp, (-2.0, 0.3)), ("log", sympy.log, (0.2, 3.0)), ("sqrt", sympy.sqrt, (0.2, 3.0)),
    ("abs", sympy.Abs, (-2.0, 0.3)), ("sign", sympy.sign, (-2.0, 0.0, 0.3)),
    ("step", sympy.Heaviside, (-2.0, 0.0, 0.3)),
]  # fmt: skip
SPELLINGS = [
    ("cotan", "cot"), ("cosec", "csc"), ("arcsin", "asin"), ("arccos", "acos"), ("arctan", "atan"), ("arsinh", "asinh"),
    ("arcsinh", "asinh"), ("arcosh", "acosh"), ("arccosh", "acosh"), ("artanh", "atanh"), ("arctanh", "atanh"),
    ("ln", "log"), ("sgn", "sign"), ("signum", "sign"), ("heaviside", "step"),
]  # fmt: skip


def test_all_functions_are_here() -> None:
    assert {name for name, *_ in FUNCTION_OF} | {"atan2", "max", "min"} == set(FUNCTIONS)


@pytest.mark.parametrize(("name", "function", "points"), FUNCTION_OF, ids=[name for name, *_ in FUNCTION_OF])
def test_values(name: str, function: sympy.Function, points: tuple[float, ...]) -> None:
    tree = parse(f"{name}(x)", NAMES).tree
    for point in points:
        assert evaluate(tree, {"x": point}) == pytest.approx(float(function(sympy.Float(point))), abs=1e-15)
    assert read(f"{name}(x)") == function(X)


def test_the_angle_of_a_vector() -> None:
    tree = parse("atan2(y, x)", NAMES).tree
    for x, y in ((3.0, -4.0), (-1.0, 2.0), (-1.0, -2.0)):
        assert evaluate(tree, {"x": x, "y": y}) == pytest.approx(math.atan2(y, x))
    assert read("arctan2(y, x)") == sympy.atan2(Y, X)


# What is read, and what is printed of it as plain text and as LaTeX.
LARGEST = [
    ("max(y, x)", "max(x, y)", r"\max(x, q_1)"),
    ("min(x, 0)", "min(0, x)", r"\min(0, x)"),
    ("max(x, y, l)", "max(l, x, y)", r"\max(l, x, q_1)"),
    ("max(2, 3, 1)", "3", "3"),
    ("diff(max(x^2, y), x)", "2*x*step(x^2 - y)", r"2 x \operatorname{step}(x^{2} - q_1)"),
]


@pytest.mark.parametrize(("written", "as_text", "as_latex"), LARGEST, ids=[row[0] for row in LARGEST])
def test_the_largest_and_the_smallest(written: str, as_text: str, as_latex: str) -> None:
    value = read(written)
    assert plain(value) == as_text
    assert latex(value, Typography(NAMES)) == as_latex
    assert read(as_text) == read(as_latex, "latex") == value


@pytest.mark.parametrize("name", ["max", "min"])
def test_of_three_the_first_two_are_compared_first(name: str) -> None:
    assert parse(f"{name}(x, y, l)", NAMES).tree == parse(f"{name}({name}(x, y), l)", NAMES).tree


@pytest.mark.parametrize(
    "equal",
    ["max(x, y) = -min(-x, -y)", "max(x, y) + min(x, y) = x + y", "max(l*x, l*y) = l*max(x, y)",
     "step(x) = (1 + sign(x))/2", "max(x, 0) = x*step(x)", "abs(x - y)*sign(x - y) = x - y"],
)  # fmt: skip
def test_kinks_that_are_the_same(equal: str) -> None:
    assert is_zero(read(equal), SYMBOLS)


def test_a_scene_may_have_names_of_younger_functions() -> None:
    own = Names((Symbol("x", "coordinate"), Symbol("step", "parameter"), Symbol("max", "parameter")))
    assert plain(to_sympy(parse("max*x + step", own).tree, Symbols(own))) == "max*x + step"


@pytest.mark.parametrize(("spelling", "name"), SPELLINGS)
def test_other_spellings(spelling: str, name: str) -> None:
    assert read(f"{spelling}(x)") == read(f"{name}(x)")
    assert read(f"\\operatorname{{{spelling}}}(x)", "latex") == read(f"{name}(x)")


@pytest.mark.parametrize("name", [name for name, *_ in FUNCTION_OF])
def test_written_and_read_back(name: str) -> None:
    value = read(f"{name}(x*l + 1)")
    assert read(plain(value)) == value
    assert read(latex(value, Typography(NAMES)), "latex") == value


@pytest.mark.parametrize("name", [name for name, *_ in FUNCTION_OF])
def test_a_power_after_the_name(name: str) -> None:
    if name in ("sqrt", "abs", "sign", "step"):
        assert problem_of(f"{name}^2(x)").code == "function-power"
    else:
        assert read(f"{name}^2(x)") == read(f"{name}(x)^2")


IDENTITIES = [
    pytest.param(sympy.tan(X) - sympy.sin(X) / sympy.cos(X), id="tan"),
    pytest.param(sympy.cot(X) - sympy.cos(X) / sympy.sin(X), id="cot"),
    pytest.param(sympy.sec(X) - 1 / sympy.cos(X), id="sec"),
    pytest.param(sympy.csc(X) - 1 / sympy.sin(X), id="csc"),
    pytest.param(sympy.asin(X / sympy.sqrt(1 + X**2)) - sympy.atan(X), id="asin, atan"),
    pytest.param(sympy.acos(1 / sympy.sqrt(1 + L**2)) - sympy.atan(L), id="acos"),
    pytest.param(sympy.atan2(L, Y) - 2 * sympy.atan(L / (sympy.sqrt(L**2 + Y**2) + Y)), id="atan2"),
    pytest.param(2 * sympy.sinh(X) - sympy.exp(X) + sympy.exp(-X), id="sinh, exp"),
    pytest.param(2 * sympy.cosh(X) - sympy.exp(X) - sympy.exp(-X), id="cosh"),
    pytest.param(sympy.tanh(X) * sympy.cosh(X) - sympy.sinh(X), id="tanh"),
    pytest.param(sympy.asinh(X) - sympy.log(X + sympy.sqrt(1 + X**2)), id="asinh, log"),
    pytest.param(sympy.acosh(1 + L) - sympy.log(1 + L + sympy.sqrt((1 + L) ** 2 - 1)), id="acosh"),
    pytest.param(2 * sympy.atanh(X / (1 + sympy.Abs(X))) - sympy.log(1 + X / (1 + sympy.Abs(X)))
                 + sympy.log(1 - X / (1 + sympy.Abs(X))), id="atanh"),
    pytest.param(sympy.sign(X) * sympy.Abs(X) - X, id="sign, abs"),
    pytest.param((1 + L) ** sympy.pi - sympy.exp(sympy.pi * sympy.log(1 + L)), id="power of pi"),
]  # fmt: skip


@pytest.mark.parametrize("zero", IDENTITIES)
def test_balls_know_the_identities(zero: sympy.Expr) -> None:
    assert sample_zero(zero) == (True, 12)
    assert sample_zero(zero + sympy.Rational(1, 10**40)) == (False, 1)
