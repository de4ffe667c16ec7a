"""Derivatives of long sums, held to SymPy's."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from tests.language.scene_names import NAMES, SYMBOLS, read

from deltaq.language.canonical import is_zero
from deltaq.language.display import size
from deltaq.language.form_calculus import derivative, plain_form
from deltaq.language.kernel_reader import KernelReader
from deltaq.language.normal_form import Reader
from deltaq.language.sympy_algebra import rates_of, time_derivative

LONG = [
    pytest.param(
        "m*x^2 + m*y^2 + k*x*y + c*x*sin(phi) + g*cos(2*phi - x) + l*dot(x)^2 + dot(phi)*x + a*t*x",
        id="sines, rates and time",
    ),
    pytest.param(
        "m*(x + y + l*sin(phi))^2 + k*sqrt(m)*x + cos(omega*t - phi)*x^3 + 1/l + 1/m + g + c + a*x*y*cos(x)^2",
        id="powers and a product of waves",
    ),
    pytest.param("m*l*(x^2 + y^2 + x*y + x*sin(phi) + y*cos(phi) + x + y) + g", id="the long sum stands in a product"),
]
NOT_PLAIN = [
    pytest.param("m*x + k*y", id="short"),
    pytest.param("x + y + m + l + g + k + c + 1/(x + 1)", id="a quotient"),
    pytest.param("x + y + m + l + g + k + c + log(l)", id="a logarithm"),
    pytest.param("(x + y + m + l + g + k + c + a + 1)^9", id="too large"),
]


@pytest.mark.parametrize("text", LONG)
@pytest.mark.parametrize("name", ["x", "phi", "m", "t", "y0"])
def test_derivative(text: str, name: str) -> None:
    expr = read(text)
    form = plain_form(expr)
    assert form is not None
    by = SYMBOLS.name(name)
    assert is_zero(form.derivative(by).expression - expr.diff(by), SYMBOLS)
    assert is_zero(form.derivative(by).displayed(SYMBOLS) - expr.diff(by), SYMBOLS)


@pytest.mark.parametrize("text", LONG)
def test_derivative_along_the_motion(text: str) -> None:
    expr, rates = read(text), rates_of(SYMBOLS)
    chain_rule = sympy.Add(*(expr.diff(x) * rates[x] for x in expr.free_symbols & rates.keys()))
    assert is_zero(time_derivative(expr, SYMBOLS) - chain_rule, SYMBOLS)


def test_difference_of_two_forms() -> None:
    expr = read("m*x^2 + m*y^2 + k*x*y + c*x*sin(phi) + g*cos(2*phi - x) + l*x")
    form = plain_form(expr + read("dot(x)^2"))
    assert form is not None
    by = {name: form.derivative(SYMBOLS.name(name)) for name in ("x", "y")}
    assert is_zero(
        by["x"].minus(by["y"]).expression - (expr.diff(SYMBOLS.name("x")) - expr.diff(SYMBOLS.name("y"))), SYMBOLS
    )


@pytest.mark.parametrize("text", NOT_PLAIN)
def test_what_is_left_to_the_tree(text: str) -> None:
    expr: Any = read(text, names=NAMES)
    assert plain_form(expr) is None
    by_tree = sum(expr.diff(x) * rate for x, rate in rates_of(SYMBOLS).items())
    assert sympy.expand(time_derivative(expr, SYMBOLS) - by_tree) == 0


def test_a_product_is_not_multiplied_out_for_its_derivative() -> None:
    factor = "(l + m + g + k + x*m + m1*sin(phi))"
    expr = read("*".join([factor] * 3) + " + m + x*y*sin(6*phi) + y*x*sin(4*x) + x*y + y*sin(8*phi)")
    acceleration = time_derivative(time_derivative(expr, SYMBOLS), SYMBOLS)
    assert size(acceleration) < 5000


@pytest.mark.parametrize(
    "text", ["ddot(" + "*".join(["(x + y + phi + m*sin(x) + l*cos(phi) + k*sin(y))"] * n) + ")" for n in (2, 4, 6)]
)
def test_second_derivative_of_a_product_is_found_however_long_it_is(text: str) -> None:
    assert read(text).has(SYMBOLS.rate("phi", 2))


def test_what_nobody_reads_is_not_arranged() -> None:
    form = plain_form(read("(x + y + m + l + g + k + c)^6"))
    assert form is not None
    assert len(form.displayed(SYMBOLS).args) == 924


@pytest.mark.parametrize("factor", [pytest.param("1", id="at rest"), pytest.param("dot(x)^2", id="moving")])
def test_what_is_too_long_to_be_planned_is_arranged(factor: str) -> None:
    total = sympy.expand(read(f"{factor}*(x + y + m + l + g + k)^6"))
    form = plain_form(total)
    assert form is not None
    shown = form.displayed(SYMBOLS)
    assert sympy.expand(shown) == total
    assert size(shown) < size(total)


OF_ANY_GENERATORS = [
    "x^3*sin(2*phi - x) + m", "sqrt(x^2 + y^2)", "x/(x + y)^2", "1/sqrt(m*x^2 + l)", "log(x^2 + 1)*y", "exp(-x*phi)",
    "sin(sqrt(x^2 + 1))", "atan2(y, x)", "tan(phi)*x", "sinh(x*y)^2", "sqrt(1 + 1/(x^2 + 1))", "pi*log(m)*x",
]  # fmt: skip


@pytest.mark.parametrize("text", OF_ANY_GENERATORS)
@pytest.mark.parametrize("reader", [Reader, KernelReader])
def test_derivative_through_roots_quotients_and_functions(text: str, reader: type[Reader]) -> None:
    expr, forms = read(text), reader()
    form = forms.form(expr)
    for name in ("x", "phi", "m"):
        slope = forms.expression(derivative(forms, form, name))
        assert is_zero(slope - expr.diff(SYMBOLS.name(name)), SYMBOLS)
