"""Arranges the terms of a form to be read.

Terms are gathered by what they multiply (rates, accelerations, dq, δq). The trigonometric factor of each is written as
Fourier sum, such as cos(φ1 − φ2), or as polynomial in sines and cosines, whichever is shorter. Equal coefficients are
gathered: (m1 + m2) l1². A common factor goes in front where all terms are of one kind: ½ m (ẏ² − …).
"""

from __future__ import annotations

import math
from typing import Any

import sympy
from flint import fmpq

from . import fourier
from .fourier import ONE, STILL, Form, Monomial
from .generators import rational
from .normal_form import Reader
from .order import Order, split_symbol
from .trigonometry import shortest

_RATE = 1
_LARGEST_DENOMINATOR = 12
_MAX_SHORTENED = 200  # terms: more are not read by anyone, so they stay in Fourier form
# Degrees in the rates at which a common factor goes in front: a potential or force, a kinetic energy, one with a guide.
_FACTORED = ({0.0}, {2.0}, {1.0, 2.0}, {0.0, 1.0, 2.0})


class Arrangement:
    """Arranges the terms of a form."""

    def __init__(self, reader: Reader, order: Order) -> None:
        self._reader = reader
        self._order = order

    def expression(self, form: Form) -> Any:
        """The expression, its terms gathered and its waves written the shortest way."""
        form = self._shortened(form)
        content = self._content(form)
        if content != ONE:
            inverse: Form = {(fourier.raised(content, -1), STILL, False): self._number(form)}
            inner = self._gathered(fourier.multiply(form, inverse))
            if inner.is_Add:
                return sympy.Mul(1 / rational(self._number(form)), self._reader.monomial(content), inner)
        return self._gathered(form)

    def _shortened(self, form: Form) -> Form:
        if len(form) > _MAX_SHORTENED:
            return form
        return fourier.add(
            fourier.multiply({(outer, STILL, False): fmpq(1)}, shortest(inner, self._reader))
            for outer, inner in self._groups(form).items()
        )

    def _groups(self, form: Form) -> dict[Monomial, Form]:
        """The coefficient of each product of rates, accelerations, dq and δq."""
        groups: dict[Monomial, Form] = {}
        for (mono, phase, sine), coefficient in form.items():
            outer = tuple(pair for pair in mono if self._kind(pair[0]))
            inner = tuple(pair for pair in mono if not self._kind(pair[0]))
            groups.setdefault(outer, {})[inner, phase, sine] = coefficient
        return groups

    def _gathered(self, form: Form) -> Any:
        return sympy.Add(*(self._group(outer, inner) for outer, inner in self._groups(form).items()))

    def _group(self, outer: Monomial, form: Form) -> Any:
        """The coefficient of one product of rates or of one δq."""
        coefficients: dict[Any, list[Any]] = {}
        for (mono, phase, sine), coefficient in form.items():
            fixed = tuple(pair for pair in mono if self._is_parameter(pair[0]))
            moving = tuple(pair for pair in mono if not self._is_parameter(pair[0]))
            wave = sympy.Mul(self._reader.monomial(moving), self._reader.wave(phase, sine=sine))
            coefficients.setdefault(wave, []).append((fixed, coefficient))
        monomial = self._reader.monomial(outer)
        if len(coefficients) == 1:
            # In one product, else the computer algebra would multiply a number into a sum.
            ((wave, terms),) = coefficients.items()
            return sympy.Mul(*self._polynomial(terms), wave, monomial)
        inner = sympy.Add(*(sympy.Mul(*self._polynomial(terms), wave) for wave, terms in coefficients.items()))
        return sympy.Mul(inner, monomial)

    def _polynomial(self, terms: list[Any]) -> tuple[Any, Any, Any]:
        """A polynomial in the parameters: its number, its common monomial and the rest."""
        common = _common([mono for mono, _ in terms])
        rest = fourier.raised(common, -1)
        numbers = [number for _, number in terms]
        shared = numbers[0] if all(abs(n) == abs(numbers[0]) for n in numbers) else 1
        summed = sympy.Add(
            *(rational(number / shared) * self._reader.monomial(fourier.times(mono, rest)) for mono, number in terms)
        )
        return rational(shared), self._reader.monomial(common), summed

    def _kind(self, name: str) -> int:
        return 0 if name in self._reader.bases else split_symbol(name)[0]

    def _is_parameter(self, name: str) -> bool:
        meaning = self._reader.meaning.get(name)
        return meaning is not None and not any(map(self._order.is_moving, meaning.free_symbols))

    def _content(self, form: Form) -> Monomial:
        """The parameters that all terms share, if this is an energy or a force; momenta and equations stay sums."""
        degrees: set[Any] = set()
        for mono, _, _ in form:
            kinds = [(self._kind(name), exponent) for name, exponent in mono]
            if any(kind > _RATE for kind, _ in kinds):
                return ONE
            degrees.add(sum(fourier.size(e) for kind, e in kinds if kind))
        if len(form) == 1 or degrees not in _FACTORED:
            return ONE
        return tuple(pair for pair in _common([mono for mono, _, _ in form]) if self._is_parameter(pair[0]))

    def _number(self, form: Form) -> Any:
        """The inverse of the number that goes in front: the common denominator if it is small, and a common sign."""
        shared = math.lcm(*(int(c.q) for c in form.values()))
        negative = all(c < 0 for c in form.values())
        return fmpq((shared if shared <= _LARGEST_DENOMINATOR else 1) * (-1 if negative else 1))


def _common(monomials: list[Monomial]) -> Monomial:
    """The greatest monomial that divides all of them."""
    first, *rest = map(dict, monomials)
    lowest = {name: min([e, *(m.get(name, 0) for m in rest)], key=fourier.size) for name, e in first.items()}
    return tuple(sorted((name, e) for name, e in lowest.items() if isinstance(e, int) and e > 0))
