"""Quadrature in ball arithmetic: exact where theory says so."""

from __future__ import annotations

import pytest
import sympy as sp
from flint import arb, ctx

from deltaq.derivation.evaluation import components, number
from deltaq.derivation.formula import Bounds
from deltaq.derivation.quadrature import NODES, integral
from deltaq.derivation.verification import BITS

S, U, L, T = (sp.Symbol(name, real=True) for name in ("s", "u", "l", "t"))
DEGREE = 2 * NODES - 1


@pytest.mark.parametrize(
    ("integrand", "material", "expected"),
    [
        pytest.param(sp.Integer(1), [Bounds(S, sp.Integer(0), L)], L, id="length"),
        pytest.param(S**DEGREE, [Bounds(S, sp.Integer(0), L)], L ** (DEGREE + 1) / (DEGREE + 1), id="highest degree"),
        pytest.param(sp.sin(S), [Bounds(S, sp.Integer(0), L)], 1 - sp.cos(L), id="sine"),
        pytest.param(S * U, [Bounds(S, sp.Integer(0), L), Bounds(U, sp.Integer(0), S)], L**4 / 8, id="triangle"),
        pytest.param(S, [Bounds(S, L, sp.Integer(0))], -(L**2) / 2, id="backwards"),
    ],
)
def test_known_integrals(integrand: sp.Expr, material: list[Bounds], expected: sp.Expr) -> None:
    point = {"l": arb("1.25")}
    with ctx.workprec(BITS):
        (found,) = integral(lambda inside: components(integrand, inside), tuple(material), point, number)
        assert abs(float(found - number(expected, point))) < 1e-60
