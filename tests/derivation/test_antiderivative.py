"""Antiderivatives: differentiating gives the integrand back."""

from __future__ import annotations

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from deltaq.derivation.antiderivative import antiderivative
from deltaq.derivation.system import System
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
    assert SYSTEM.is_zero(antiderivative(integrand, X, SYSTEM.symbols).diff(X) - integrand)


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(0, 3), st.integers(-3, 3), st.booleans()), max_size=4))
def test_trigonometric_polynomials(terms: list[tuple[int, int, int, bool]]) -> None:
    integrand = sum((c * X**n * (sp.sin if odd else sp.cos)(k * X + Y) for c, n, k, odd in terms), sp.Integer(0))
    assert SYSTEM.is_zero(antiderivative(integrand, X, SYSTEM.symbols).diff(X) - integrand)
