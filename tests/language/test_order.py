"""Factors and terms stand in the order of a textbook, and numbers are written as their author has them."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from tests.language.scene_names import NAMES, read

from deltaq.language.latex_printer import Typography, latex
from deltaq.language.numerals import decimal, ends, is_decimal, is_long
from deltaq.language.order import Order, natural, split_symbol
from deltaq.language.plain_printer import plain

PRODUCTS = [
    pytest.param("2*pi*sqrt(2)*m*k*g*l", id="numbers, masses, stiffnesses, g, lengths"),
    pytest.param("m*m1*F0*k*l*y0", id="forces among stiffnesses, numbers of an index"),
    pytest.param("m*l*omega*x", id="angular velocities after lengths"),
    pytest.param("m*a*y*phi*x*t", id="parameters, coordinates in their own order, time"),
    pytest.param("l*y*sin(phi)*dot(phi)", id="coordinates, functions, rates"),
    pytest.param("x*sin(y)*cos(y)*sin(phi)*cos(phi)*tan(phi)", id="functions by their angles, sine first"),
    pytest.param("log(m)*sin(phi)*exp(x)", id="functions of parameters first"),
    pytest.param("m*(m + k)*l*x", id="a bracket where its first symbol would stand"),
    pytest.param("x*(1 - a/s)", id="a coordinate before a bracket of parameters and numbers"),
    pytest.param("dot(phi)*(dot(y) + dot(x))*ddot(y)", id="a bracket of rates among rates"),
    pytest.param("x*dot(x)*ddot(x)*d(x)*delta(x)*dot(delta(x))*ddot(delta(x))", id="what moves, by its derivatives"),
]
SUMS = [
    pytest.param("ddot(y) + ddot(phi) + dot(y)^2 + dot(y)*dot(phi) + dot(phi)^2 + x^2 + y + x", id="by derivatives"),
    pytest.param("delta(y) + x*delta(phi) + dot(delta(y))", id="virtual displacements"),
    pytest.param("y^3 + y^2*x + y*x^2 + x^3", id="by powers"),
    pytest.param("l^2*x + l*x", id="by powers of parameters"),
    pytest.param("m*ddot(y) + sin(phi)*ddot(y)", id="plain factors before functions"),
    pytest.param("m*g - k*y", id="no minus in front where there is a plus"),
    pytest.param("-m - l", id="a minus in front where there is no plus"),
    pytest.param("-ddot(y) + m*x", id="accelerations keep their place"),
    pytest.param("-delta(y) + delta(x)", id="so do virtual displacements"),
    pytest.param("-d(y) + d(x)", id="and differentials"),
    pytest.param("sin(x) + sin(x)*cos(x)", id="fewer functions first"),
]  # fmt: skip


@pytest.mark.parametrize("text", [*PRODUCTS, *SUMS])
def test_written_in_order(text: str) -> None:
    expr = read(text)
    backwards = expr.func(*reversed(expr.args), evaluate=False)
    assert plain(expr, Order(NAMES)) == text
    assert plain(backwards, Order(NAMES)) == text


def test_without_names_coordinates_stand_by_their_letters() -> None:
    assert plain(read("y*phi*x*s*t")) == "s*x*y*phi*t"
    assert plain(read("sin(x)*sin(phi) + y + x")) == "x + y + sin(x)*sin(phi)"


@pytest.mark.parametrize(
    ("name", "kind", "base"),
    [
        ("phi", 0, "phi"),
        ("dot(phi)", 1, "phi"),
        ("ddot(phi)", 2, "phi"),
        ("dddot(phi)", 3, "phi"),
        ("ddddot(phi)", 8, "phi"),
        ("d(phi)", 4, "phi"),
        ("delta(phi)", 5, "phi"),
        ("dot(delta(phi))", 6, "phi"),
        ("ddot(delta(phi))", 7, "phi"),
        ("x y", 0, "x y"),
    ],
)
def test_what_a_symbol_is(name: str, kind: int, base: str) -> None:
    assert split_symbol(name) == (kind, base)


def test_names_with_numbers_stand_by_the_numbers() -> None:
    names = ["phi", "phi2", "m10", "x", "m2", "m", "m2a", "alpha", "10"]
    assert sorted(names, key=natural) == ["10", "m", "m2", "m2a", "m10", "x", "alpha", "phi", "phi2"]


@pytest.mark.parametrize("name", ["x", "t", "s", "dot(x)", "delta(x)", "d(t)", "unknown"])
def test_what_moves(name: str) -> None:
    assert Order(NAMES).is_moving(sympy.Symbol(name, real=True))


@pytest.mark.parametrize("name", ["m", "a"])
def test_what_stands_still(name: str) -> None:
    assert not Order(NAMES).is_moving(sympy.Symbol(name, real=True))


def test_without_names_what_is_positive_stands_still() -> None:
    assert Order().is_moving(sympy.Symbol("x", real=True))
    assert not Order().is_moving(sympy.Symbol("m", positive=True))


def test_what_is_named_as_masses_are() -> None:
    masses, others = ("m", "m12", "M", "J_s", "I1", "Theta", "mu", "rho"), ("k", "l", "mass", "g", "omega")
    assert [name for name in (*masses, *others) if Order(NAMES).is_mass(name)] == list(masses)


# Each number: whether a person writes it as a decimal, whether it ends, whether it is long, the decimal.
NUMBERS = [
    ("1/2", False, True, False, "0.5"),
    ("1/8", False, True, False, "0.125"),
    ("1/5", False, True, False, "0.2"),
    ("1/10", True, True, False, "0.1"),
    ("-3/20", True, True, False, "-0.15"),
    ("1/16", False, True, False, "0.0625"),
    ("981/100", True, True, True, "9.81"),
    ("1/128", False, True, True, "0.0078125"),
    ("1/1000000000000", True, True, True, "0.000000000001"),
    ("5/2", False, True, False, "2.5"),
    ("1/3", False, False, False, None),
    ("1/30", False, False, False, None),
    ("1/300", False, False, False, None),
    ("1/10000000000000", False, False, False, None),
]


@pytest.mark.parametrize(("number", "as_decimal", "does_end", "long", "digits"), NUMBERS, ids=[n for n, *_ in NUMBERS])
def test_decimals(number: str, *, as_decimal: bool, does_end: bool, long: bool, digits: str | None) -> None:
    value = Fraction(number)
    assert (is_decimal(value), ends(value), is_long(value)) == (as_decimal, does_end, long)
    if digits is not None:
        assert decimal(value) == digits


# How one formula is written: each number for itself, in decimals, in fractions.
WANTED = [
    ("0.7*m + 7/5*l", r"0.7 m + \frac{7}{5} l", "0.7 m + 1.4 l", r"\frac{7}{10} m + \frac{7}{5} l"),
    ("m/2 + l", r"\frac{m}{2} + l", r"\frac{m}{2} + l", r"\frac{m}{2} + l"),
    ("0.5*m + 0.25*l", r"\frac{m}{2} + \frac{l}{4}", "0.5 m + 0.25 l", r"\frac{m}{2} + \frac{l}{4}"),
    ("m/3 + 0.25*l", r"\frac{m}{3} + \frac{l}{4}", r"\frac{m}{3} + \frac{l}{4}", r"\frac{m}{3} + \frac{l}{4}"),
    ("-0.49*m", "-0.49 m", "-0.49 m", "-0.49 m"),
    ("-0.7*m", "-0.7 m", "-0.7 m", r"-\frac{7}{10} m"),
]


@pytest.mark.parametrize(("text", "each", "decimals", "fractions"), WANTED, ids=[row[0] for row in WANTED])
def test_one_formula_has_one_kind_of_numbers(text: str, each: str, decimals: str, fractions: str) -> None:
    written = [latex(read(text), Typography(NAMES, decimals=wanted)) for wanted in (None, True, False)]
    assert written == [each, decimals, fractions]


def test_terms_stand_by_the_highest_rate_in_them() -> None:
    """Fourth rates, third ones, accelerations, then rates, though the sum was written otherwise."""
    total = read("x + l*dot(x)^3 + m*ddot(x) + k*dddot(x) + m*ddddot(x)")
    assert [str(term) for term in Order(NAMES).terms(total)] == [
        "ddddot(x)*m", "dddot(x)*k", "ddot(x)*m", "dot(x)**3*l", "x",
    ]  # fmt: skip
