"""How numbers, fractions and sums are written: 9.81 as a decimal, 1/2 as a fraction, m/2 and not 0.5 m, a − b."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any

import sympy

# How tightly a printed text binds.
SUM, PRODUCT, POWER, ATOM = range(4)
_SMALL = 10
_LONG = 100


def is_decimal(value: Fraction) -> bool:
    """Whether a person writes it as a decimal: it ends, and its denominator is no small number."""
    q = value.denominator
    return q >= _SMALL and q % 5 == 0 and 10**12 % q == 0


Decides = Callable[[Fraction], bool]  # whether a number is written as a decimal


def ends(value: Fraction) -> bool:
    """Whether the decimal fraction comes to an end."""
    return 10**12 % value.denominator == 0


def is_long(value: Fraction) -> bool:
    """Whether a fraction has become so long that its decimal is read more easily."""
    return value.denominator >= _LONG and ends(value)


def decimals_of(expr: sympy.Expr, *, wanted: bool | None) -> Decides:
    """How the numbers of one formula are written, so that 0.7 and 7/5 do not stand side by side.

    `wanted`: decimals, as the author of a scene has them (½ alone may stay), or fractions; None: each for itself.
    """
    if wanted is None:
        return is_decimal
    if not wanted:
        return is_long
    values = [exact(n) for n in expr.atoms(sympy.Rational, sympy.Float)]
    as_decimals = any(v.denominator > 2 for v in values) and all(map(ends, values))
    return ends if as_decimals else is_long


def decimal(value: Fraction) -> str:
    """An ending decimal, exactly."""
    digits = next(n for n in range(1, 13) if 10**n % value.denominator == 0)
    whole, part = divmod(abs(value.numerator) * 10**digits // value.denominator, 10**digits)
    return f"{'-' if value < 0 else ''}{whole}.{part:0{digits}d}"


def exact(number: sympy.Expr) -> Fraction:
    """The exact value of a SymPy Rational or Float."""
    if number.is_Float:
        return Fraction(repr(float(number)))
    return Fraction(int(number.p), int(number.q))


def plain_number(number: sympy.Expr) -> tuple[str, int]:
    """Text and how tightly it binds."""
    value = exact(number)
    if value.denominator == 1 or is_decimal(value):
        text = str(value.numerator) if value.denominator == 1 else decimal(value)
        return text, PRODUCT if value < 0 else ATOM
    return f"{value.numerator}/{value.denominator}", PRODUCT


def signed_sum(terms: Iterable[str]) -> str:
    """Printed terms as a sum: a minus in front of a term takes the place of the plus."""
    first, *others = terms
    return first + "".join(f" - {term[1:].lstrip()}" if term.startswith("-") else f" + {term}" for term in others)


def base_exponent(factor: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Base and exponent; an exponential function counts as a base of its own."""
    return (factor, sympy.S.One) if isinstance(factor, sympy.exp) else factor.as_base_exp()


def named_root(expr: sympy.Expr, roots: Mapping[Any, str]) -> tuple[str, int] | None:
    """The letter and its exponent, if the expression is a positive power of a root that has a letter; else None."""
    if not roots:
        return None
    base, exponent = (expr.base, 2 * expr.exp) if expr.is_Pow else (expr, sympy.Integer(2))
    letter = roots.get(base)
    return (letter, int(exponent)) if letter and exponent.is_Integer and exponent > 0 else None


def fraction_parts(
    expr: sympy.Expr, as_decimal: Decides = is_decimal
) -> tuple[str, list[sympy.Expr], list[sympy.Expr]]:
    """Sign, factors above and factors below the line of a product."""
    upper: list[sympy.Expr] = []
    lower: list[sympy.Expr] = []
    sign = ""
    for factor in sympy.Mul.make_args(expr):
        if factor.is_Rational or factor.is_Float:
            value = exact(factor)
            sign = "-" if value < 0 else ""
            value = abs(value)
            above, below = (
                (value, Fraction(1))
                if as_decimal(value) or (factor.is_Float and ends(value))
                else (value.numerator, value.denominator)
            )
            upper += [sympy.Rational(above)] if above != 1 else []
            lower += [sympy.Rational(below)] if below != 1 else []
        else:
            base, exponent = base_exponent(factor)
            if exponent.is_Rational and exponent.is_negative:
                lower.append(base**-exponent)
            else:
                upper.append(factor)
    return sign, upper, lower
