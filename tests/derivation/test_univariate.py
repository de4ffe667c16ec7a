"""All zeros of one equation in one unknown, against equations that were made of their zeros."""

from __future__ import annotations

import math
import random

import pytest
import sympy as sp

from deltaq.derivation.univariate import real_zeros

X = sp.Symbol("x", real=True)


@pytest.mark.parametrize("seed", range(12))
def test_every_zero_of_a_polynomial_is_found_once(seed: int) -> None:
    draw = random.Random(seed)
    zeros = {sp.Rational(draw.randint(-400, 400), draw.choice((1, 7, 100))) for _ in range(draw.randint(1, 5))}
    others = sp.prod((X - draw.randint(-3, 3)) ** 2 + sp.Rational(1, draw.randint(1, 9)) for _ in range(seed % 3))
    equation = sp.expand(others * sp.prod((X - zero) ** draw.randint(1, 3) for zero in zeros))
    found = real_zeros(equation, X, is_angle=False)
    assert found is not None
    assert sorted(found.values) == pytest.approx(sorted(map(float, zeros)), abs=1e-12)
    assert all(found.equation.diff(X).subs(X, zero) != 0 for zero in zeros)


@pytest.mark.parametrize("seed", range(12))
def test_every_zero_of_a_wave_is_found_once(seed: int) -> None:
    draw = random.Random(seed)
    heights = {sp.Rational(draw.randint(-130, 130), 100) for _ in range(draw.randint(1, 4))} | (
        {-1} if seed % 2 else set()
    )
    equation = sp.expand(sp.prod(sp.cos(X) - height for height in heights))
    expected = {round(sign * math.acos(h), 9) for h in heights if abs(h) <= 1 for sign in (1, -1)} - {
        round(-math.pi, 9)
    }
    found = real_zeros(equation, X, is_angle=True)
    assert found is not None
    assert sorted(found.values) == pytest.approx(sorted(expected), abs=1e-6)


@pytest.mark.parametrize(
    ("equation", "count"),
    [
        pytest.param(sp.sin(3 * X), 6, id="multiple angle"),
        pytest.param(X / (X**2 - 1), 1, id="poles are none"),
        pytest.param(X**4 + 1, 0, id="none at all"),
    ],
)
def test_numbers_of_zeros(equation: sp.Expr, count: int) -> None:
    found = real_zeros(equation, X, is_angle=equation.has(sp.sin))
    assert found is not None
    assert len(found.values) == count


@pytest.mark.parametrize("equation", [sp.exp(X) - X, sp.sqrt(X) - 1, sp.Integer(0), X - sp.Symbol("a")])
def test_other_equations_are_left_to_others(equation: sp.Expr) -> None:
    assert real_zeros(equation, X, is_angle=False) is None
