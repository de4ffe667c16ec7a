"""Derivatives that are finite wherever the function has one.

SymEngine differentiates atan2(y, x) by way of y/x, which has no value where x = 0, and pieces that a variable does not
change into pieces of zeros, which with an infinite factor are no number. So such parts are differentiated here:

    d atan2(y, x) = (x dy − y dx)/(x² + y²),

and what is left is differentiated by SymEngine, by the chain rule. Likewise u |u|^p with p < 0, which is what the
product rule makes of the powers of |u|, is sgn(u) |u|^(p + 1).
"""

from __future__ import annotations

from collections.abc import Sequence

import symengine as se

from .functions import Expr, absolute
from .parts import outermost, parts

ZERO = se.Integer(0)


def slope(expression: Expr, variable: Expr) -> Expr:
    """∂f/∂x"""
    return gradient(expression, (variable,))[0]


def gradient(expression: Expr, variables: Sequence[Expr]) -> tuple[Expr, ...]:
    """∂f/∂xᵢ for each of some variables."""
    expression = se.sympify(expression)
    own = sorted(outermost(expression, (se.Piecewise, se.atan2)), key=str)
    if not own:
        return tuple(map(expression.diff, variables))
    names = [se.Symbol(f"part{number}") for number in range(len(own))]
    rest = expression.subs(dict(zip(own, names, strict=True)))
    inner = [_slopes(part, variables) for part in own]
    outer = [rest.diff(name) for name in names]
    known = dict(zip(names, own, strict=True))
    found = (
        sum((a * b[i] for a, b in zip(outer, inner, strict=True)), rest.diff(variable))
        for i, variable in enumerate(variables)
    )
    return tuple(joined(se.sympify(each).subs(known)) for each in found)


def _slopes(part: Expr, variables: Sequence[Expr]) -> list[Expr]:
    if isinstance(part, se.Piecewise):
        branches = [gradient(branch, variables) for branch in part.args[::2]]
        return [_piecewise(each, part.args[1::2]) for each in zip(*branches, strict=True)]
    y, x = part.args
    square = x**2 + y**2
    return [(x * a - y * b) / square for a, b in zip(gradient(y, variables), gradient(x, variables), strict=True)]


def _piecewise(values: Sequence[Expr], conditions: Sequence[Expr]) -> Expr:
    if all(value == values[0] for value in values):
        return values[0]
    return se.Piecewise(*zip(values, conditions, strict=True))


def joined(expression: Expr) -> Expr:
    """The expression with its products of negative powers of |u| and powers of u in one power each."""
    found = {product: _product(product.args) for product in parts([expression], se.Mul)}
    changed = {product: other for product, other in found.items() if other is not None}
    return expression.subs(changed) if changed else expression


def _product(factors: Sequence[Expr]) -> Expr | None:
    """The product, where something in it could be put together."""
    powers = dict(map(_power, factors))
    moduli = {base: base.args[0] for base, exponent in powers.items() if _is_negative(exponent) and _is_modulus(base)}
    joined = {modulus: inside for modulus, inside in moduli.items() if _is_count(powers.get(inside, ZERO))}
    if not joined:
        return None
    for modulus, inside in joined.items():
        count = powers.pop(inside)
        powers[modulus] += count
        if int(count) % 2:
            way = se.Piecewise((1, inside >= 0), (-1, True))
            powers[way] = powers.get(way, ZERO) + 1
    return se.Mul(*(base**exponent for base, exponent in powers.items()))


def _power(factor: Expr) -> tuple[Expr, Expr]:
    return factor.args if isinstance(factor, se.Pow) else (factor, se.Integer(1))


def _is_modulus(base: Expr) -> bool:
    return isinstance(base, se.Piecewise) and base == absolute(base.args[0])


def _is_negative(exponent: Expr) -> bool:
    return bool(exponent.is_Number and exponent < 0)


def _is_count(exponent: Expr) -> bool:
    return bool(exponent.is_Integer and exponent > 0)
