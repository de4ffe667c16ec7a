"""Ball arithmetic: what excludes zero is not zero, what has no value decides nothing."""

from __future__ import annotations

from typing import Any

import pytest
import sympy

from deltaq.language.intervals import sample_zero

X = sympy.Symbol("x", real=True)
L = sympy.Symbol("l", positive=True)


@pytest.mark.parametrize(
    ("expr", "outcome"),
    [
        pytest.param(sympy.E - sympy.Rational("2.718281828459045"), (False, 1), id="a number like e"),
        pytest.param(sympy.cosh(1) - (sympy.E + 1 / sympy.E) / 2, (True, 12), id="e itself"),
        pytest.param(sympy.log(L**2) - 2 * sympy.log(L), (True, 12), id="logarithms"),
        pytest.param(sympy.cbrt(L**2 + 1) ** 3 - L**2, (False, 1), id="cube root"),
        pytest.param(sympy.Heaviside(X**2 + L) - 1, (True, 12), id="a step that has come"),
        pytest.param(sympy.Heaviside(X) + sympy.Heaviside(-X) - 1, (True, 12), id="steps forth and back"),
        pytest.param(sympy.S.Zero, (True, 12), id="zero itself"),
        pytest.param(sympy.sqrt(-1 - X**2), (None, 0), id="root of what is negative"),
        pytest.param(sympy.gamma(X), (None, 0), id="function without an interval"),
        pytest.param(1 / (X - X * sympy.sign(L)), (None, 0), id="division by zero everywhere"),
    ],
)
def test_sampling(expr: Any, outcome: tuple[bool | None, int]) -> None:
    assert sample_zero(expr) == outcome
