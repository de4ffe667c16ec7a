"""Antiderivatives of the forces that scenes have.

For xⁿ times cos(ax + b) or sin(ax + b), parts take the power down one by one:
∫ xⁿ cos(ax + b) dx = xⁿ sin(ax + b)/a − n/a ∫ xⁿ⁻¹ sin(ax + b) dx, and likewise for the sine.
Source: Bronshtein, Semendyayev, Handbook of Mathematics, table of indefinite integrals. Everything else is SymPy's, as
long as it is made of functions that the language has: an erf or Si would be no closed form to a reader.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from itertools import chain
from types import FrameType

import sympy as sp

from ..errors import InputError, Problem
from ..language.canonical import canonical
from ..language.functions import FUNCTIONS
from ..language.symbols import Symbols
from .formula import Bounds

Values = Mapping[sp.Symbol, sp.Expr]

MOST_CALLS = 1_000_000  # of a search, some two seconds; integrals of textbooks take up to 0.4 million
NEAR = 1e-6  # double zeros are found no better


def antiderivative(integrand: sp.Expr, x: sp.Symbol, symbols: Symbols) -> sp.Expr | None:
    """F with ∂F/∂x = integrand; None if it has no closed form.

    Terms over roots of quadratics are taken as they stand, where one denominator for all would be long; others in the
    canonical form.
    """
    over_powers, others = _over_powers(sp.Add.make_args(sp.expand_mul(integrand, deep=False)), x)
    rest = sp.Add(*others)
    terms = sp.Add.make_args(canonical(rest, symbols).expand()) if rest != 0 else ()
    quotients = (_of_quotient(sp.Add(*upper), power, x) for power, upper in over_powers.items())
    parts = list[sp.Expr]()
    for part in chain(quotients, (_of_term(term, x) for term in terms)):
        if part.has(sp.Integral):  # no other part makes up for it, and each that fails takes seconds
            return None
        parts.append(part)
    whole = sp.Add(*parts)
    return whole if _is_closed(whole) else None


def _over_powers(terms: Iterable[sp.Expr], x: sp.Symbol) -> tuple[dict[sp.Pow, list[sp.Expr]], list[sp.Expr]]:
    """The terms (ax + b) Pˢ with P of second degree and s = n/2, by their Pˢ without that factor; and all others."""
    found: dict[sp.Pow, list[sp.Expr]] = {}
    others = []
    for term in terms:
        powers = [each for each in sp.Mul.make_args(term) if each.has(x) and each.is_Pow and not each.exp.is_Integer]
        upper = term / powers[0] if len(powers) == 1 else term
        if len(powers) == 1 and _is_root_of_quadratic(powers[0], x) and upper.is_polynomial(x) and not upper.diff(x, 2):
            found.setdefault(powers[0], []).append(upper)
        else:
            others.append(term)
    return found, others


def _is_root_of_quadratic(power: sp.Pow, x: sp.Symbol) -> bool:
    base = power.base
    return bool(power.exp.is_Rational and base.is_polynomial(x) and sp.degree(base, x) == 2)


def _of_quotient(upper: sp.Expr, power: sp.Pow, x: sp.Symbol) -> sp.Expr:
    """∫ (c P′ + r) Pˢ dx: the first part is c Pˢ⁺¹/(s + 1), the second one 2r P′/(Δ √P) for s = −3/2, Δ = 4ac − b²."""
    P, s = power.base, power.exp
    c, b, a = (P.expand().coeff(x, n) for n in range(3))
    upper = upper.expand()
    share = upper.coeff(x, 1) / (2 * a)
    rest = (upper.coeff(x, 0) - share * b).expand()
    whole = share * P ** (s + 1) / (s + 1)
    if rest == 0:
        return whole
    delta = (4 * a * c - b**2).expand()
    if s == sp.Rational(-3, 2) and delta != 0:
        return whole + 2 * rest * P.diff(x) / (delta * sp.sqrt(P))
    return whole + _searched(rest * power, x)


def definite_integral(integrand: sp.Expr, bounds: Bounds, symbols: Symbols, values: Values) -> sp.Expr:
    """∫ from the lower to the upper bound. `values` are numbers for parameters, to look for poles with.

    Raises InputError if there is no closed form, or if the integral diverges.
    """
    x = bounds.symbol
    whole = antiderivative(integrand, x, symbols)
    if whole is None:
        raise InputError(Problem("no-closed-integral", parameters={"name": x.name}))
    value = whole.xreplace({x: bounds.upper}) - whole.xreplace({x: bounds.lower})
    if not is_finite(value) or _has_pole(integrand, bounds, values):
        raise InputError(Problem("divergent-integral", parameters={"name": x.name}))
    return value


def is_finite(value: sp.Expr) -> bool:
    """Whether the expression holds no infinity, nothing undefined and nothing imaginary."""
    return not value.has(sp.zoo, sp.oo, -sp.oo, sp.nan, sp.I)


def _is_closed(value: sp.Expr) -> bool:
    calls = value.atoms(sp.Function)
    known = all(type(call).__name__.lower() in FUNCTIONS for call in calls)
    return known and not value.has(sp.Integral, sp.Piecewise, sp.I)


def _has_pole(integrand: sp.Expr, bounds: Bounds, values: Values) -> bool:
    """Whether a denominator vanishes inside the interval, where the antiderivative would jump unseen."""
    numbers, x = dict(values), bounds.symbol
    lower, upper = bounds.lower.xreplace(numbers), bounds.upper.xreplace(numbers)
    powers = (power for power in integrand.atoms(sp.Pow) if power.exp.is_negative)
    denominators = (power.base.xreplace(numbers) for power in powers)
    polynomials = [base for base in denominators if base.free_symbols == {x} and base.is_polynomial(x)]
    if not (lower.is_number and upper.is_number):
        return False
    zeros = (root for base in polynomials for root in sp.Poly(base, x).nroots() if abs(sp.im(root)) < NEAR)
    return any(lower < sp.re(root) < upper for root in zeros)


def _of_term(term: sp.Expr, x: sp.Symbol) -> sp.Expr:
    constant, rest = term.as_independent(x, as_Add=False)
    degree, wave = _power_and_wave(rest, x)
    if degree is None:
        return _searched(term, x)
    if wave is None:
        return constant * x ** (degree + 1) / (degree + 1)
    return constant * _by_parts(degree, wave, x)


class TooManyCalls(BaseException):
    """SymPy has called more functions than a search may. No Exception: SymPy would take it for one of its own."""


def _searched(term: sp.Expr, x: sp.Symbol) -> sp.Expr:
    """SymPy's antiderivative; the integral as it stands if there is none, or none within bounds.

    What is counted are calls and not seconds, as the same integral must have the same answer.
    """
    calls, before = 0, sys.getprofile()

    def count(_frame: FrameType, event: str, _argument: object) -> None:
        nonlocal calls
        calls += event == "call"
        if calls > MOST_CALLS:
            raise TooManyCalls

    sys.setprofile(count)
    try:
        return sp.integrate(term, x)
    except TooManyCalls:
        return sp.Integral(term, x)
    finally:
        sys.setprofile(before)


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
