"""All real zeros of an equation in one unknown that is algebraic in it, or in its sine and cosine.

A polynomial's zeros are isolated exactly, multiple ones as zeros of its square-free part. An equation in sin nq and
cos nq becomes one by t = tan q/2, which all angles but π have; π is tried by itself.
Source: Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry, §10.2 (isolation); Cox, Little, O'Shea, Ideals,
Varieties, and Algorithms, §1.3 (rational parametrization of the circle).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import sympy as sp

HIGHEST = 40  # degree: beyond it there are more zeros than anybody looks at


@dataclass(frozen=True)
class Zeros:
    """All real zeros, an angle's within (−π, π], and an equation of which they are single zeros where there is one."""

    values: tuple[float, ...]
    equation: sp.Expr


def real_zeros(equation: sp.Expr, unknown: sp.Symbol, *, is_angle: bool) -> Zeros | None:
    """All of them; None if the equation is of another kind, or holds everywhere."""
    if not is_angle:
        polynomial = _polynomial(equation, unknown)
        return None if polynomial is None else Zeros(tuple(_zeros(polynomial)), polynomial.as_expr())
    t = sp.Dummy("t", real=True)
    waves = sp.expand_trig(equation)
    halved = {sp.sin(unknown): 2 * t / (1 + t**2), sp.cos(unknown): (1 - t**2) / (1 + t**2)}
    rational = waves.xreplace(halved)
    if rational.has(unknown):
        return None
    polynomial = _polynomial(rational, t)
    if polynomial is None:
        return None
    opposite = [math.pi] if equation.xreplace({unknown: sp.pi}).equals(0) else []
    return Zeros((*(2 * math.atan(zero) for zero in _zeros(polynomial)), *opposite), equation)


def _polynomial(equation: sp.Expr, unknown: sp.Symbol) -> sp.Poly | None:
    """The square-free numerator with rational coefficients, without the zeros of the denominator."""
    if equation.free_symbols != {unknown} or not equation.is_rational_function(unknown):
        return None
    upper, lower = sp.fraction(sp.cancel(equation))
    if not (upper.is_polynomial(unknown) and lower.is_polynomial(unknown)):
        return None
    found = sp.Poly(upper, unknown)
    if not found.domain.is_QQ and not found.domain.is_ZZ:
        return None
    return found.sqf_part() if 0 < found.degree() <= HIGHEST else None


def _zeros(polynomial: sp.Poly) -> list[float]:
    brackets = polynomial.to_field().intervals(eps=sp.Rational(1, 10**18))
    return [float((low + high) / 2) for (low, high), _ in brackets]
