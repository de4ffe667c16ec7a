"""Derivatives of Fourier forms: term by term, by the product rule for monomials and waves.

A long sum is differentiated many times faster here than as a tree, as no tree is built in between.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from . import fourier
from .fourier import Form, Monomial, Phase, TooLargeError
from .normal_form import Reader

LONG = 24  # terms


def is_long(expr: Any) -> bool:
    """Whether the expression, multiplied out, has so many terms that a form pays."""
    return max((len(part.args) for part in (expr, *expr.args) if part.is_Add), default=0) > LONG


def derivative(expr: Any, by: Any) -> Any:
    """∂expr/∂by, of a long sum as a sum of Fourier terms where its form is simple enough."""
    read = _plain_form(expr) if is_long(expr) else None
    if read is None:
        return expr.diff(by)
    reader, form = read
    return reader.expression(form_derivative(form, by.name))


def total_derivative(expr: Any, rates: Mapping[Any, Any]) -> Any | None:
    """Σ ∂expr/∂x · rates[x] of a long sum as a sum of Fourier terms; None if it is short or not that simple."""
    read = _plain_form(expr) if is_long(expr) else None
    if read is None:
        return None
    reader, form = read
    moving = sorted(expr.free_symbols & rates.keys(), key=str)
    changes = (reader.multiply(form_derivative(form, x.name), reader.form(rates[x])) for x in moving)
    return reader.expression(fourier.add(changes))


def _plain_form(expr: Any) -> tuple[Reader, Form] | None:
    """The form with its reader, if each generator is a symbol."""
    reader = Reader()
    forms = plain_forms([expr], reader)
    return (reader, forms[0]) if forms else None


def plain_forms(exprs: Iterable[Any], reader: Reader) -> list[Form] | None:
    """Forms in which each generator is a symbol: no roots, quotients or other functions; else None."""
    try:
        forms = [reader.form(expr) for expr in exprs]
    except (TooLargeError, ZeroDivisionError):
        return None
    is_plain = not reader.bases and all(meaning.is_Symbol for meaning in reader.meaning.values())
    return forms if is_plain else None


def form_derivative(form: Form, name: str) -> Form:
    """∂/∂name of every term."""
    return fourier.add(
        {term: coefficient * number}
        for (mono, phase, sine), coefficient in form.items()
        for term, number in (*_by_monomial(mono, phase, sine, name), *_by_wave(mono, phase, sine, name))
    )


def _by_monomial(mono: Monomial, phase: Phase, sine: bool, name: str) -> Iterable[tuple[fourier.Term, Any]]:  # noqa: FBT001
    """(xⁿ)′ = n xⁿ⁻¹"""
    exponent = dict(mono).get(name)
    if exponent is not None:
        yield (fourier.times(mono, ((name, -1),)), phase, sine), exponent


def _by_wave(mono: Monomial, phase: Phase, sine: bool, name: str) -> Iterable[tuple[fourier.Term, Any]]:  # noqa: FBT001
    """(cos θ)′ = −θ′ sin θ and (sin θ)′ = θ′ cos θ; θ is a linear form in monomials."""
    for inner, factor in phase:
        exponent = dict(inner).get(name)
        if exponent is not None:
            slope = fourier.times(inner, ((name, -1),))
            yield (fourier.times(mono, slope), phase, not sine), (factor if sine else -factor) * exponent
