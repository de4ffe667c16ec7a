"""Slopes are those of SymPy's own `diff`, in the same form."""

from __future__ import annotations

import random

import pytest
import sympy as sp

from deltaq.language.derivatives import diff

x, y, t = sp.symbols("x y t", real=True)
k = sp.Symbol("k", positive=True)
LEAVES = (x, y, t, k, sp.pi, sp.Integer(2), sp.Rational(-1, 3))
FUNCTIONS = (sp.sin, sp.cos, sp.tan, sp.exp, sp.atan, sp.sinh, sp.Abs, sp.sign, sp.asin, sp.log)


def expression(source: random.Random, depth: int) -> sp.Expr:
    if depth == 0 or source.random() < 0.15:
        return source.choice(LEAVES)
    parts = [expression(source, depth - 1) for _ in range(source.randint(2, 3))]
    match source.randint(0, 4):
        case 0 | 1:
            return sp.Add(*parts)
        case 2:
            return sp.Mul(*parts)
        case 3:
            return (1 + parts[0] ** 2) ** source.choice((2, -1, sp.Rational(1, 2), sp.Rational(-3, 2), y))
    return source.choice(FUNCTIONS)(2 + parts[0] ** 2 if source.random() < 0.5 else parts[0])


@pytest.mark.parametrize("seed", range(120))
def test_it_is_what_diff_gives(seed: int) -> None:
    expr = expression(random.Random(seed), 3)
    for by in (x, y, k):
        found, expected = diff(expr, by), expr.diff(by)
        assert found == expected or sp.simplify(found - expected) == 0, expr


def test_of_matrices_entry_by_entry() -> None:
    matrix = sp.ImmutableMatrix([[x * sp.sin(y)], [k]])
    assert diff(matrix, x) == sp.ImmutableMatrix([[sp.sin(y)], [0]])


def test_what_has_rules_of_its_own_is_left_to_sympy() -> None:
    assert diff(x * sp.Abs(x), x) == sp.Abs(x) + x * sp.sign(x)
    assert diff(sp.sign(x), x) == sp.sign(x).diff(x)
    assert diff(sp.Piecewise((x**2, x > 0), (x, True)), x) == sp.Piecewise((2 * x, x > 0), (1, True))


@pytest.mark.parametrize("value", [x / y - k, sp.sqrt(x * y), x**3, sp.atan2(x, y)], ids=str)
def test_a_sign_has_no_slope_but_where_it_jumps(value: sp.Expr) -> None:
    """SymPy leaves the derivative of a sign as it stands if it cannot tell that what is in it is real."""
    slope = diff(y * sp.sign(value), x)
    assert slope == 2 * y * sp.DiracDelta(value) * diff(value, x)
    assert diff(y * sp.sign(value), k).has(sp.DiracDelta) is value.has(k)


@pytest.mark.parametrize(
    ("factor", "inner", "vanishes"),
    [
        (x, x, True),
        (x**2 * y, x, True),
        (sp.exp(x) - 1, x, True),
        (x * sp.sign(x), x, True),
        (x - y, 2 * y - 2 * x, True),
        (sp.sin(2 * x), sp.sin(x), True),
        (x**2 + y**2 - 1, x**2 + y**2 - 1, True),
        (x * y, x * y, True),
        (sp.S.One, x, False),
        (x + 1, x, False),
        (sp.sign(x), x, False),
        (1 + sp.sign(x), x, False),
        (y, x, False),
        (x, x * y, False),  # y = 0 is left
        (sp.cos(x), sp.sin(x), False),
        (sp.sin(x), x**2 + y**2 - 1, False),
    ],
)
def test_an_impulse_stays_unless_what_it_is_multiplied_by_vanishes_with_it(
    factor: sp.Expr, inner: sp.Expr, vanishes: bool
) -> None:
    for step in (sp.Heaviside, sp.sign):
        slopes = [diff(factor * step(inner), by) for by in (x, y)]
        assert any(slope.has(sp.DiracDelta) for slope in slopes) is not vanishes
