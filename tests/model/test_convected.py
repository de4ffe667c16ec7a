"""Christoffel's symbols: the part of Lagrange's equations without accelerations."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import symengine as se
from tests.derivation.scenes import chain

from deltaq.model.convected import convected
from deltaq.model.equations import equations
from deltaq.model.operations import operations

x, y, t, u, v, w, m = se.symbols("x y t u v w m")
sin, cos = se.sin, se.cos
VALUES, RATES = (x, y, t), (u, v, w)

ENERGIES = [
    pytest.param(m * (u**2 + v**2) / 2, id="a mass matrix without coordinates"),
    pytest.param(m * (u**2 + x**2 * v**2) / 2, id="polar coordinates"),
    pytest.param(m * (u**2 + v**2 / 3 + u * v * cos(x - y)) / 2, id="a double pendulum"),
    pytest.param(m * (v**2 + sin(y + t) ** 2 * w**2) / 2 + x * y * u * w, id="with the clock"),
    pytest.param(sin(x * y) * (u + 2 * v + t * w) ** 2, id="everything depends on everything"),
]


@pytest.mark.parametrize("energy", ENERGIES)
def test_it_is_what_lagrange_says(energy: se.Expr) -> None:
    momenta = [energy.diff(rate) for rate in RATES]
    mass = tuple(tuple(momentum.diff(rate) for rate in RATES) for momentum in momenta)
    convection = [
        sum((p.diff(q) * rate for q, rate in zip(VALUES, RATES, strict=True)), se.Integer(0)) for p in momenta
    ]
    expected = [b - energy.diff(q) for b, q in zip(convection, VALUES, strict=True)]
    for found, wanted in zip(convected(mass, VALUES, RATES), expected, strict=True):
        assert se.expand(found - wanted) == 0


def products(expr: se.Expr) -> Iterator[set[se.Expr]]:
    """The symbols that stand in each product as factors or powers."""
    if expr.is_Mul:
        yield {part.args[0] if part.is_Pow else part for part in expr.args}
    for part in expr.args:
        yield from products(part)


def test_what_cancels_is_gone() -> None:
    """In absolute angles, no row of a pendulum of links has a product of two different rates."""
    eqs = equations(chain(4))
    rates = {eqs.symbols.rates[name] for name in eqs.symbols.free}
    assert [max(len(factors & rates) for factors in products(row)) for row in eqs.forcing] == [1, 1, 1, 1]


@pytest.mark.parametrize(("links", "most"), [pytest.param(n, 8 * n * n, id=f"{n} links") for n in (2, 4, 10)])
def test_a_pendulum_of_links_takes_few_operations(links: int, most: int) -> None:
    found = operations(chain(links))
    assert found.total - found.solving <= most
