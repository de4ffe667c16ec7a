"""What is printed is read back as the same expression, in both syntaxes."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tests.language.scene_names import NAMES, SYMBOLS, read

from deltaq.errors import ExpressionError
from deltaq.language.canonical import is_zero, zero_test
from deltaq.language.latex_printer import Typography, latex
from deltaq.language.order import Order
from deltaq.language.parser import Syntax
from deltaq.language.plain_printer import plain

_COORDINATES = ("y", "phi", "x")
_PARAMETERS = ("m", "l", "g", "k", "c", "omega", "y0", "F0", "m1", "a", "s", "t", "pi")
_FUNCTIONS = (sympy.sin, sympy.cos, sympy.tan, sympy.exp, sympy.Abs, sympy.atan, sympy.sinh, sympy.sign)

_numbers = st.one_of(
    st.integers(-12, 12).map(sympy.Integer),
    st.tuples(st.integers(-40, 40), st.integers(1, 40)).map(lambda pair: sympy.Rational(*pair)),
    st.sampled_from(["9.81", "0.05", "12.5", "1.234567"]).map(sympy.Rational),
)
_symbols = st.one_of(
    st.sampled_from(_PARAMETERS + _COORDINATES).map(SYMBOLS.name),
    st.tuples(st.sampled_from(_COORDINATES), st.sampled_from((1, 2))).map(lambda pair: SYMBOLS.rate(*pair)),
    st.tuples(st.sampled_from(_COORDINATES), st.sampled_from((0, 1, 2))).map(lambda pair: SYMBOLS.variation(*pair)),
    st.sampled_from((*_COORDINATES, "t")).map(SYMBOLS.differential),
)
_DIFFERENTIALS = {SYMBOLS.differential(name) for name in (*_COORDINATES, "t")}
_EXPONENTS = (2, 3, -1, -2, sympy.Rational(1, 2), sympy.Rational(-1, 2), sympy.Rational(2, 3))


def _compound(parts: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.one_of(
        st.lists(parts, min_size=2, max_size=4).map(lambda p: sympy.Add(*p)),
        st.lists(parts, min_size=2, max_size=4).map(lambda p: sympy.Mul(*p)),
        st.tuples(parts, parts).map(lambda p: p[0] / p[1]),
        st.tuples(parts, st.sampled_from(_EXPONENTS)).map(lambda p: p[0] ** p[1]),
        st.tuples(st.sampled_from(_FUNCTIONS), parts).map(lambda p: p[0](p[1])),
    )


def _is_sound(expr: Any) -> bool:
    """Real and finite, and within the language: rational exponents, values that fit into a double."""
    if expr.has(sympy.zoo, sympy.nan, sympy.oo, -sympy.oo, sympy.I, sympy.re, sympy.im, sympy.AccumBounds):
        return False
    powers = expr.atoms(sympy.Pow)
    return all(p.exp.is_Rational or p.base is sympy.E for p in powers)


expressions = st.recursive(st.one_of(_numbers, _symbols), _compound, max_leaves=14).filter(_is_sound)


# What a computer algebra makes of sound parts may leave the language: complex roots, very long or large numbers.
_OUTSIDE = {"not-real", "too-many-digits", "value-too-large", "value-too-small", "outside-domain", "degree-too-large"}


def read_back(text: str, syntax: Syntax) -> Any:
    try:
        return read(text, syntax)
    except ExpressionError as error:
        assume(error.problems[0].code not in _OUTSIDE)
        raise


def is_same(found: Any, expr: Any) -> bool:
    """The same tree; or the computer algebra has multiplied out a number, and the values are the same."""
    return found == expr or zero_test(found - expr, SYMBOLS).outcome is True


@settings(max_examples=300, deadline=None, derandomize=True)
@given(expressions)
def test_plain_text_is_read_back(expr: Any) -> None:
    assert is_same(read_back(plain(expr), "plain"), expr)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(expressions)
def test_latex_is_read_back(expr: Any) -> None:
    # dx/dt is one thing as a quotient of differentials and as a derivative: not a matter of printing.
    assume(not any(p.exp.is_negative and p.free_symbols & _DIFFERENTIALS for p in expr.atoms(sympy.Pow)))
    assert is_same(read_back(latex(expr, Typography(NAMES)), "latex"), expr)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(expressions)
def test_the_order_of_writing_does_not_depend_on_the_order_of_building(expr: Any) -> None:
    backwards = expr.func(*reversed(expr.args)) if expr.is_Add or expr.is_Mul else expr
    assert plain(backwards, Order(NAMES)) == plain(expr, Order(NAMES))


@pytest.mark.parametrize(
    ("expr", "text"),
    [
        pytest.param(sympy.Float(0.125), "1/8", id="float"),
        pytest.param(sympy.Integer(2) ** sympy.Symbol("x", real=True), "exp(log(2)*x)", id="power with a name above"),
    ],
)
def test_what_the_parser_never_makes_is_written_as_well(expr: Any, text: str) -> None:
    assert plain(expr) == text
    assert is_zero(read_back(text, "plain") - expr, SYMBOLS)
