"""Arithmetic of trigonometric polynomials in their Fourier form.

A form is the sum of terms coefficient · monomial · cos(phase) or · sin(phase). As
cos a cos b = ½[cos(a−b) + cos(a+b)] and so on, the product of two forms is a form. Monomials, and cosines and sines of
phases that differ by more than a sign, are linearly independent over the rationals. So the form of an expression is
unique, and an expression is zero exactly if its form has no terms.

The coefficients are exact rationals; a monomial may have negative and fractional exponents; a phase is a linear form
with rational coefficients in monomials such as phi or omega·t.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from flint import fmpq

# Exponents, and the numbers in phases, are int where whole, else fmpq; both compare and hash alike, an int much faster.
Monomial = tuple[tuple[str, Any], ...]
Phase = tuple[tuple[Monomial, Any], ...]
Term = tuple[Monomial, Phase, bool]  # True: sine
Form = dict[Term, Any]

ONE: Monomial = ()
STILL: Phase = ()
CONSTANT: Term = (ONE, STILL, False)
HALF = fmpq(1, 2)

MAX_TERMS = 1500
MAX_PRODUCTS = 60_000


class TooLargeError(Exception):
    """The form would have too many terms to be worth making; the caller takes another way."""


def constant(value: Any) -> Form:
    """The form of a number."""
    value = fmpq(value)
    return {(ONE, STILL, False): value} if value else {}


def monomial(name: str, exponent: Any = 1) -> Form:
    """The form of name^exponent."""
    return {(((name, exponent),), STILL, False): fmpq(1)} if exponent else constant(1)


def wave(phase: Phase, *, sine: bool) -> Form:
    """The form of cos(phase) or sin(phase)."""
    form: Form = {}
    _accumulate(form, (ONE, phase, sine), fmpq(1))
    return form


def add(forms: Iterable[Form]) -> Form:
    """The sum."""
    total: Form = {}
    for form in forms:
        for term, coefficient in form.items():
            value = total.get(term, 0) + coefficient
            if value:
                total[term] = value
            else:
                del total[term]
    if len(total) > MAX_TERMS:
        raise TooLargeError
    return total


def scale(form: Form, factor: Any) -> Form:
    """A multiple by a number."""
    return {term: coefficient * factor for term, coefficient in form.items()} if factor else {}


def multiply(left: Form, right: Form) -> Form:
    """The product."""
    if len(left) * len(right) > MAX_PRODUCTS:
        raise TooLargeError
    product: Form = {}
    for (mono_a, phase_a, sine_a), a in left.items():
        for (mono_b, phase_b, sine_b), b in right.items():
            mono = times(mono_a, mono_b)
            if not phase_a or not phase_b:
                _accumulate(product, (mono, phase_a or phase_b, sine_a or sine_b), a * b)
                continue
            half = a * b * HALF
            plus, minus = _combine(phase_a, phase_b, 1), _combine(phase_a, phase_b, -1)
            sine = sine_a != sine_b
            _accumulate(product, (mono, plus, sine), -half if sine_a and sine_b else half)
            _accumulate(product, (mono, minus, sine), -half if sine_b and not sine_a else half)
    if len(product) > MAX_TERMS:
        raise TooLargeError
    return product


def power(form: Form, exponent: int) -> Form:
    """A power with a whole exponent ≥ 0, by squaring."""
    result, square = constant(1), form
    while exponent:
        if exponent & 1:
            result = multiply(result, square)
        exponent >>= 1
        if exponent:
            square = multiply(square, square)
    return result


def times(left: Monomial, right: Monomial) -> Monomial:
    """The product of two monomials."""
    if not left or not right:
        return left or right
    exponents = dict(left)
    for name, exponent in right:
        exponents[name] = exponents.get(name, 0) + exponent
    return tuple(sorted((name, whole(e)) for name, e in exponents.items() if e))


def raised(mono: Monomial, exponent: Any) -> Monomial:
    """A power of a monomial."""
    return tuple((name, whole(e * exponent)) for name, e in mono) if exponent else ONE


def whole(exponent: Any) -> Any:
    """An int where it is one."""
    return exponent if isinstance(exponent, int) else int(exponent.p) if exponent.q == 1 else exponent


def _combine(left: Phase, right: Phase, sign: int) -> Phase:
    coefficients = dict(left)
    for mono, coefficient in right:
        coefficients[mono] = coefficients.get(mono, 0) + sign * coefficient
    return tuple(sorted((mono, whole(c)) for mono, c in coefficients.items() if c))


def _accumulate(form: Form, term: Term, coefficient: Any) -> None:
    """Add one term, its phase turned so that its first coefficient is positive."""
    mono, phase, sine = term
    if not phase and sine:
        return
    if phase and phase[0][1] < 0:
        term = (mono, tuple((m, -c) for m, c in phase), sine)
        coefficient = -coefficient if sine else coefficient
    value = form.get(term, 0) + coefficient
    if value:
        form[term] = value
    else:
        form.pop(term, None)


def is_still(form: Form) -> bool:
    """Whether no term has a phase."""
    return not any(phase for _, phase, _ in form)


def leading(form: Form) -> Term:
    """The first term in a fixed order, the same for every way to build the form."""
    return min(form, key=_rank)


def _rank(term: Term) -> tuple[Any, ...]:
    mono, phase, sine = term
    return (
        tuple((name, -size(e)) for name, e in mono),
        tuple((m, -size(c)) for m, c in phase),
        sine,
    )


def size(value: Any) -> float:
    """An exponent or a number in a phase as a float."""
    return float(value) if isinstance(value, int) else int(value.p) / int(value.q)
