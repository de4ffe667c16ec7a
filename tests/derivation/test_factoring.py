"""Factors by FLINT against SymPy's, and where SymPy's search does not end."""

from __future__ import annotations

import random
import re

import pytest
import sympy as sp

from deltaq.derivation.factoring import factor_list

LETTERS = sp.symbols("a b c x y", positive=True)
x, y = LETTERS[3:]


def drawn(source: random.Random) -> sp.Expr:
    """A product of up to three small factors, multiplied out; some letters stand in a function."""
    things = [*LETTERS, sp.sin(x), sp.exp(y / LETTERS[0]), sp.sqrt(x**2 + 1)]

    def term() -> sp.Expr:
        chosen = source.choices(things, k=source.randint(0, 2))
        return sp.Rational(source.randint(-6, 6), source.randint(1, 3)) * sp.Mul(*chosen)

    factors = [sp.Add(*(term() for _ in range(source.randint(1, 3)))) for _ in range(source.randint(1, 3))]
    return sp.expand(sp.Mul(*factors)) + 12 * LETTERS[0]


@pytest.mark.parametrize("seed", range(40))
def test_the_same_factors_as_sympy(seed: int) -> None:
    expression = drawn(random.Random(seed))
    (number, found), (known, expected) = factor_list(expression), sp.factor_list(expression)
    assert (number, set(found)) == (known, set(expected))


@pytest.mark.parametrize(
    ("expression", "number", "factors"),
    [
        pytest.param(sp.Integer(-5), -5, [], id="a number"),
        pytest.param(sp.sqrt(2) * x**2 - x, 1, [(x, 1), (sp.sqrt(2) * x - 1, 1)], id="roots of numbers"),
        pytest.param(sp.expand((x - y) ** 2 * (x + 1)), 1, [(x + 1, 1), (x - y, 2)], id="a square"),
        pytest.param(3 * sp.sqrt(x) * (x * y - x), 3, [(x, sp.Rational(3, 2)), (y - 1, 1)], id="a product with a root"),
    ],
)
def test_known_ones(expression: sp.Expr, number: int, factors: list[tuple[sp.Expr, int]]) -> None:
    known, found = factor_list(expression)
    assert (known, set(found)) == (number, set(factors))


def test_a_quotient_is_no_polynomial() -> None:
    with pytest.raises(sp.PolynomialError, match=f"^{re.escape('a quotient: x/y + 1')}$"):
        factor_list(1 + x / y)


def test_many_letters() -> None:
    """The force of two Morse potentials and a softened pole: SymPy looks for its factors for minutes."""
    a, b, c, d, k, m, s = sp.symbols("a b c d k m s", positive=True)
    morse = [k * (1 - sp.exp(-x / s)) ** 2, m * (1 - sp.exp(-x / d)) ** 2]
    force = sp.diff(-a / sp.sqrt(x**2 + b**2) + c * sp.Add(*morse), x)
    upper = sp.numer(sp.together(force))
    number, factors = factor_list(upper)
    assert sp.expand(number * sp.Mul(*(factor**power for factor, power in factors)) - upper) == 0
