"""Antiderivatives: differentiating gives the integrand back."""

from __future__ import annotations

import sys
import time

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from deltaq.derivation.antiderivative import antiderivative, definite_integral
from deltaq.derivation.formula import Bounds
from deltaq.derivation.system import System
from deltaq.errors import InputError, Problem
from deltaq.mechanics.library import load_scene

SYSTEM = System(load_scene("elastic-pendulum"))
X, Y = SYSTEM.q("phi"), SYSTEM.q("y")

CASES = [
    pytest.param(sp.Integer(0), id="0"),
    pytest.param(Y, id="constant"),
    pytest.param(X**3, id="power"),
    pytest.param(sp.sin(X), id="sine"),
    pytest.param(Y * sp.cos(2 * X - Y), id="cosine of a linear form"),
    pytest.param(X * sp.sin(X), id="power times sine"),
    pytest.param(X**2 * sp.cos(3 * X + Y), id="power times cosine"),
    pytest.param(sp.sin(X) * sp.cos(X) ** 2, id="product of waves"),
    pytest.param(sp.exp(X) * Y, id="exponential"),
]


@pytest.mark.parametrize("integrand", CASES)
def test_derivative_gives_the_integrand_back(integrand: sp.Expr) -> None:
    found = antiderivative(integrand, X, SYSTEM.symbols)
    assert found is not None
    assert SYSTEM.is_zero(found.diff(X) - integrand)


@settings(deadline=None, derandomize=True)
@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(0, 3), st.integers(-3, 3), st.booleans()), max_size=4))
def test_trigonometric_polynomials(terms: list[tuple[int, int, int, bool]]) -> None:
    integrand = sum((c * X**n * (sp.sin if odd else sp.cos)(k * X + Y) for c, n, k, odd in terms), sp.Integer(0))
    found = antiderivative(integrand, X, SYSTEM.symbols)
    assert found is not None
    assert SYSTEM.is_zero(found.diff(X) - integrand)


@pytest.mark.parametrize(
    "integrand",
    [
        pytest.param(sp.exp(X**2), id="imaginary error function"),
        pytest.param(sp.sin(X) / X, id="integral sine"),
        pytest.param(sp.exp(sp.sin(X)), id="nothing at all"),
    ],
)
def test_what_has_no_closed_form(integrand: sp.Expr) -> None:
    assert antiderivative(integrand, X, SYSTEM.symbols) is None


def interval(lower: sp.Expr, upper: sp.Expr) -> Bounds:
    return Bounds(X, sp.sympify(lower), sp.sympify(upper))


LENGTH = SYSTEM.q("l")


@pytest.mark.parametrize(
    ("integrand", "code"),
    [
        pytest.param(1 / X, "divergent-integral", id="pole at the end"),
        pytest.param(1 / (X - LENGTH / 3) ** 2, "divergent-integral", id="double pole inside"),
        pytest.param(1 / (X**2 - LENGTH**2 / 2), "divergent-integral", id="simple pole inside"),
        pytest.param(sp.exp(X**2), "no-closed-integral", id="no closed form"),
    ],
)
def test_integrals_that_are_refused(integrand: sp.Expr, code: str) -> None:
    with pytest.raises(InputError) as caught:
        definite_integral(integrand, interval(sp.S.Zero, LENGTH), SYSTEM.symbols, SYSTEM.parameter_values)
    assert caught.value.problems == (Problem(code, parameters={"name": "phi"}),)


@pytest.mark.parametrize(
    ("integrand", "value"),
    [
        pytest.param(1 / sp.sqrt(X), 2 * sp.sqrt(LENGTH), id="integrable at the end"),
        pytest.param(1 / (X + LENGTH) ** 2, 1 / (2 * LENGTH), id="pole outside"),
    ],
)
def test_poles_that_do_no_harm(integrand: sp.Expr, value: sp.Expr) -> None:
    found = definite_integral(integrand, interval(sp.S.Zero, LENGTH), SYSTEM.symbols, SYSTEM.parameter_values)
    assert sp.simplify(found - value) == 0


def test_a_search_without_end_is_bounded() -> None:
    """∫ x² tan²(a x) dx needs a polylogarithm, for which SymPy searches minutes; what can be found is found before."""
    x, a = sp.symbols("x a", real=True)
    symbols = System(load_scene("pendulum")).symbols
    begin = time.process_time()
    assert antiderivative(x**2 * sp.tan(a * x) ** 2, x, symbols) is None
    assert time.process_time() - begin < 30  # on any machine; without the bound it takes minutes
    assert sys.getprofile() is None
    found = antiderivative(x * sp.atan(x), x, symbols)
    assert found is not None
    assert sp.simplify(found.diff(x) - x * sp.atan(x)) == 0


def test_of_several_terms_without_antiderivative_one_is_searched(monkeypatch: pytest.MonkeyPatch) -> None:
    """No other part of a sum makes up for a part that has none, and each search that fails takes seconds."""
    searched = list[sp.Expr]()

    def search(term: sp.Expr, x: sp.Symbol) -> sp.Expr:
        searched.append(term)
        return sp.Integral(term, x)

    monkeypatch.setattr(sp, "integrate", search)
    assert antiderivative(sp.exp(-(X**2)) / X + sp.sin(X**3) + sp.cos(Y * X) / (X + 1), X, SYSTEM.symbols) is None
    assert len(searched) == 1
