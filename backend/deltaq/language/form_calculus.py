"""Derivatives of Fourier forms: term by term, by the product rule for monomials and waves.

A long sum is differentiated many times faster here than as a tree, as no tree is built in between.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import sympy

from . import fourier
from .derivatives import diff
from .display import display_form
from .fourier import Form, Term, TooLargeError
from .normal_form import Reader
from .symbols import Symbols

ONE = fourier.constant(1)
LONG = 2  # terms: forms are faster than SymPy from there on, whatever is in brackets


@dataclass(frozen=True)
class PlainForm:
    """The form of a long sum in which each generator is a symbol: there are no roots, quotients or other functions."""

    reader: Reader
    form: Form

    @property
    def expression(self) -> Any:
        """The sum of its Fourier terms."""
        return self.reader.expression(self.form)

    def displayed(self, symbols: Symbols, given: frozenset[Any] = frozenset()) -> Any:
        """The shortest of the equivalent expressions."""
        return display_form(self.form, self.reader, symbols, given)

    def minus(self, other: PlainForm) -> PlainForm:
        """The difference of two forms of one reader."""
        return PlainForm(self.reader, fourier.add((self.form, fourier.scale(other.form, -1))))

    def derivative(self, by: Any) -> PlainForm:
        """∂/∂by"""
        return PlainForm(self.reader, form_derivative(self.form, by.name))

    def total_derivative(self, rates: Mapping[Any, Any]) -> PlainForm:
        """Σ ∂/∂x · rates[x] over all x that have a rate."""
        names = {name for mono, phase, _ in self.form for part in (mono, *(m for m, _ in phase)) for name, _ in part}
        moving = sorted((x for x in rates if x.name in names), key=str)
        changes = (self.reader.multiply(form_derivative(self.form, x.name), self.reader.form(rates[x])) for x in moving)
        return PlainForm(self.reader, fourier.add(changes))


def plain_form(expr: Any) -> PlainForm | None:
    """The plain form of an expression with a sum in it that is long enough for it to pay; else None."""
    if max((len(part.args) for part in expr.atoms(sympy.Add)), default=0) <= LONG:
        return None
    reader = Reader()
    forms = plain_forms([expr], reader)
    return PlainForm(reader, forms[0]) if forms else None


def plain_forms(exprs: Iterable[Any], reader: Reader) -> list[Form] | None:
    """Forms in which each generator is a symbol; None if one is not so plain."""
    try:
        forms = [reader.form(expr) for expr in exprs]
    except (TooLargeError, ZeroDivisionError):
        return None
    is_plain = not reader.bases and all(meaning.is_Symbol for meaning in reader.meaning.values())
    return forms if is_plain else None


def derivative(reader: Reader, form: Form, by: str) -> Form:
    """∂/∂by of a form of any generators, by the chain rule through those that are no symbols. Raises TooLargeError."""
    return directional(reader, form, lambda name: _slope(reader, name, by))


def directional(reader: Reader, form: Form, slope: Callable[[str], Form]) -> Form:
    """Σ ∂/∂x · slope(x) over all generators in a form. Raises TooLargeError."""
    inner = ((name, slope(name)) for name in names_in(form))
    parts = (
        form_derivative(form, name) if change == ONE else reader.multiply(form_derivative(form, name), change)
        for name, change in inner
        if change
    )
    return fourier.add(parts)


def names_in(form: Form) -> Iterable[str]:
    """The generators of a form, in the order in which they come."""
    names: dict[str, None] = {}
    for mono, phase, _ in form:
        for name, _ in mono:
            names[name] = None
        for inner, _ in phase:
            for name, _ in inner:
                names[name] = None
    return names


def _slope(reader: Reader, name: str, by: str) -> Form:
    """∂(generator)/∂by: 1 for the symbol itself, 0 for other symbols."""
    if name == by:
        return fourier.constant(1)
    if name in reader.bases:
        return derivative(reader, reader.bases[name], by)
    meaning = reader.meaning[name]
    symbol = next((symbol for symbol in meaning.free_symbols if symbol.name == by), None)
    return reader.form(diff(meaning, symbol)) if symbol is not None else {}


def form_derivative(form: Form, name: str) -> Form:
    """∂/∂name of every term, other generators being constant."""
    return fourier.add(
        {changed: coefficient * number}
        for term, coefficient in form.items()
        for changed, number in (*_by_monomial(term, name), *_by_wave(term, name))
    )


def _by_monomial(term: Term, name: str) -> Iterable[tuple[Term, Any]]:
    """(xⁿ)′ = n xⁿ⁻¹"""
    mono, phase, sine = term
    for other, exponent in mono:
        if other == name:
            yield (fourier.times(mono, ((name, -1),)), phase, sine), exponent


def _by_wave(term: Term, name: str) -> Iterable[tuple[Term, Any]]:
    """(cos θ)′ = −θ′ sin θ and (sin θ)′ = θ′ cos θ; θ is a linear form in monomials."""
    mono, phase, sine = term
    for inner, factor in phase:
        for other, exponent in inner:
            if other == name:
                slope = fourier.times(inner, ((name, -1),))
                yield (fourier.times(mono, slope), phase, not sine), (factor if sine else -factor) * exponent
