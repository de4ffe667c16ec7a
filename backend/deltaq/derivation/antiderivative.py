"""Antiderivatives of the forces that scenes have.

For xⁿ times cos(ax + b) or sin(ax + b), parts take the power down one by one:
∫ xⁿ cos(ax + b) dx = xⁿ sin(ax + b)/a − n/a ∫ xⁿ⁻¹ sin(ax + b) dx, and likewise for the sine.
Source: Bronshtein, Semendyayev, Handbook of Mathematics, table of indefinite integrals. Everything else is SymPy's.
"""

from __future__ import annotations

import sympy as sp

from ..errors import InputError, Problem
from ..language.canonical import canonical
from ..language.symbols import Symbols
from .formula import Bounds


def antiderivative(integrand: sp.Expr, x: sp.Symbol, symbols: Symbols) -> sp.Expr:
    """F with ∂F/∂x = integrand, term by term of the canonical form."""
    terms = sp.Add.make_args(canonical(integrand, symbols).expand())
    return sp.Add(*(_of_term(term, x) for term in terms))


def definite_integral(integrand: sp.Expr, bounds: Bounds, symbols: Symbols) -> sp.Expr:
    """∫ from the lower to the upper bound. Raises InputError if there is no closed form."""
    whole = antiderivative(integrand, bounds.symbol, symbols)
    if whole.has(sp.Integral):
        raise InputError(Problem("no-closed-integral", parameters={"name": bounds.symbol.name}))
    return whole.xreplace({bounds.symbol: bounds.upper}) - whole.xreplace({bounds.symbol: bounds.lower})


def _of_term(term: sp.Expr, x: sp.Symbol) -> sp.Expr:
    constant, rest = term.as_independent(x, as_Add=False)
    degree, wave = _power_and_wave(rest, x)
    if degree is None:
        return sp.integrate(term, x)
    if wave is None:
        return constant * x ** (degree + 1) / (degree + 1)
    return constant * _by_parts(degree, wave, x)


def _power_and_wave(rest: sp.Expr, x: sp.Symbol) -> tuple[int | None, sp.Function | None]:
    """n and the sine or cosine of a linear form, if the rest is xⁿ times that; else no n."""
    degree, wave = 0, None
    for factor in sp.Mul.make_args(rest):
        base, exponent = factor.as_base_exp()
        if base == x and exponent.is_Integer and exponent >= 0:
            degree += int(exponent)
        elif wave is None and isinstance(factor, sp.sin | sp.cos) and factor.args[0].diff(x, 2) == 0:
            wave = factor
        elif factor != 1:
            return None, None
    return degree, wave


def _by_parts(degree: int, wave: sp.Function, x: sp.Symbol) -> sp.Expr:
    angle = wave.args[0]
    slope = angle.diff(x)
    risen = sp.sin(angle) if isinstance(wave, sp.cos) else -sp.cos(angle)
    if degree == 0:
        return risen / slope
    return x**degree * risen / slope - _by_parts_of(degree, risen, x) / slope


def _by_parts_of(degree: int, risen: sp.Expr, x: sp.Symbol) -> sp.Expr:
    """n ∫ xⁿ⁻¹ of the wave that parts leave behind, which may carry a sign."""
    sign, wave = (-1, -risen) if isinstance(-risen, sp.cos) else (1, risen)
    return sign * degree * _by_parts(degree - 1, wave, x)
