"""Constraints on rates that bind positions all the same: where Σ aᵢ(q, t) q̇ᵢ + b(q, t) is dG/dt, G keeps its value.

It is if ∂aᵢ/∂qₖ = ∂aₖ/∂qᵢ and ∂aᵢ/∂t = ∂b/∂qᵢ (an exact form): then G is the sum of antiderivatives, each of what is
left of the slope when those before have been taken. A wheel that rolls along a line, ẋ = R φ̇, is tied to x − R φ; one
that may turn is not.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.3; Neimark, Fufaev, Dynamics of Nonholonomic Systems,
ch. I §1.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import prod

import symengine as se

from .functions import Expr
from .kinetic import ZERO
from .phase import vanishes
from .symbols import Symbols

SAME = 1e-12  # of an initial value or of 1: rounding, where the scene states a decimal


def integrated(value: Expr, symbols: Symbols, start: Mapping[Expr, Expr]) -> Expr | None:
    """G − G₀ with the value as its rate along every motion; None where the form is not exact, or G is not found.

    `start` are the free coordinates and the time where the motion begins.
    """
    slopes = {symbols.values[name]: value.diff(symbols.rates[name]) for name in symbols.free}
    slopes[symbols.time] = value.subs({symbols.rates[name]: ZERO for name in symbols.free})
    total = ZERO
    for symbol, slope in slopes.items():
        part = antiderivative(se.expand(slope - total.diff(symbol)), symbol)
        if part is None:
            return None
        total += part
    exact = all(vanishes(total.diff(symbol) - slope) for symbol, slope in slopes.items())
    return se.expand(total - total.subs(start)) if exact else None


def antiderivative(value: Expr, symbol: Expr) -> Expr | None:
    """∫ of a sum of powers, and of sines and cosines of what is linear in the symbol; None of anything else."""
    terms = value.args if isinstance(value, se.Add) else (value,)
    found = [_of_term(term, symbol) for term in terms]
    return None if any(part is None for part in found) else se.Add(ZERO, *found)


def _of_term(term: Expr, symbol: Expr) -> Expr | None:
    factors = term.args if isinstance(term, se.Mul) else (term,)
    own = [factor for factor in factors if symbol in factor.free_symbols]
    rest = prod((factor for factor in factors if factor not in own), start=se.Integer(1))
    if not own:
        return rest * symbol
    part = _of_factor(own[0], symbol) if len(own) == 1 else None
    return None if part is None else rest * part


def _of_factor(factor: Expr, symbol: Expr) -> Expr | None:
    if factor == symbol:
        return symbol**2 / 2
    if isinstance(factor, se.Pow):
        base, exponent = factor.args
        is_power = base == symbol and exponent.is_Integer and exponent != -1
        return symbol ** (exponent + 1) / (exponent + 1) if is_power else None
    if isinstance(factor, se.sin | se.cos):
        slope = factor.args[0].diff(symbol)
        if symbol in slope.free_symbols:
            return None
        return -se.cos(factor.args[0]) / slope if isinstance(factor, se.sin) else se.sin(factor.args[0]) / slope
    return None


def exactly(number: float, stated: float) -> Expr:
    """A number as a fraction: the decimal that the scene states, where it is that but for rounding."""
    near = abs(number - stated) <= SAME * max(1.0, abs(stated))
    fraction = Fraction(repr(float(stated if near else number)))
    return se.Rational(fraction.numerator, fraction.denominator)
