"""How long a formula is on paper: the number of its operations.

Counted are additions and subtractions, multiplications and divisions, powers, roots and calls of functions. Signs in
front, dots and deltas are parts of a symbol, and a fraction of two numbers is one number: ½ m v² has three.
"""

from __future__ import annotations

from typing import Any

import sympy


def operations(expr: Any) -> int:
    """The operations of a SymPy expression as it is printed."""
    if expr.is_Atom:
        return 0
    if expr.is_Add:
        return len(expr.args) - 1 + sum(map(operations, expr.args))
    if expr.is_Mul:
        return _product(expr.args)
    if expr.is_Pow:
        return _product((expr,)) if _is_below(expr) else _power(expr.base, expr.exp)
    return 1 + sum(map(operations, expr.args))


def _product(factors: tuple[Any, ...]) -> int:
    number = sympy.Mul(*(f for f in factors if f.is_Rational or f.is_Float))
    others = [f for f in factors if not (f.is_Rational or f.is_Float)]
    below = [f for f in others if _is_below(f)]
    above = len(others) - len(below)
    inner = sum(_power(f.base, -f.exp) if _is_below(f) else operations(f) for f in others)
    counted = len(others) + (abs(number) != 1)
    one_above = bool(below) and not above and (abs(number) == 1 or getattr(number, "p", 2) in (1, -1))
    return int(max(counted - 1, 0) + inner + one_above)


def _power(base: Any, exponent: Any) -> int:
    return operations(base) + (0 if exponent.is_number else operations(exponent)) + int(exponent != 1)


def _is_below(factor: Any) -> bool:
    return bool(factor.is_Pow and factor.exp.is_Rational and factor.exp.is_negative)
