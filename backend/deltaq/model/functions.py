"""The functions of the expression language, in SymEngine.

Functions with kinks are piecewise, because SymEngine cannot differentiate |x| and sign.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import symengine as se

Expr = Any  # SymEngine has no type information


def absolute(x: Expr) -> Expr:
    """|x| as a piecewise expression."""
    return se.Piecewise((x, x >= 0), (-x, True))


def sign(x: Expr) -> Expr:
    """sign x as a piecewise expression, 0 at 0."""
    return se.Piecewise((1, x > 0), (-1, x < 0), (0, True))


def largest(a: Expr, b: Expr) -> Expr:
    """max(a, b) as a piecewise expression."""
    return se.Piecewise((a, a - b >= 0), (b, True))


def smallest(a: Expr, b: Expr) -> Expr:
    """min(a, b) as a piecewise expression."""
    return se.Piecewise((b, a - b >= 0), (a, True))


def step(x: Expr) -> Expr:
    """The unit step as a piecewise expression, 1/2 at 0."""
    return se.Piecewise((1, x > 0), (0, x < 0), (se.Rational(1, 2), True))


FUNCTIONS: Mapping[str, Callable[..., Expr]] = MappingProxyType(
    {
        "sin": se.sin,
        "cos": se.cos,
        "tan": se.tan,
        "cot": se.cot,
        "sec": se.sec,
        "csc": se.csc,
        "asin": se.asin,
        "acos": se.acos,
        "atan": se.atan,
        "atan2": se.atan2,
        "sinh": se.sinh,
        "cosh": se.cosh,
        "tanh": se.tanh,
        "asinh": se.asinh,
        "acosh": se.acosh,
        "atanh": se.atanh,
        "exp": se.exp,
        "log": se.log,
        "sqrt": se.sqrt,
        "abs": absolute,
        "sign": sign,
        "max": largest,
        "min": smallest,
        "step": step,
    }
)
