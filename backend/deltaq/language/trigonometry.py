"""Fourier sums ↔ polynomials in sines and cosines, and which of them is shorter."""

from __future__ import annotations

import math
from typing import Any

from flint import fmpq

from . import fourier
from .fourier import ONE, STILL, Form, Monomial, Phase
from .normal_form import Reader

_MAX_TERMS = 60
_MAX_MULTIPLE = 8
# A wave of n angles becomes 2^(n-1) products: more than this is never shorter.
_MAX_ANGLES = 4


def shortest(form: Form, reader: Reader, *, both: bool = False) -> Form:
    """The form as it is, or with sin² or with cos² eliminated, whichever is shortest to write.

    With `both` a product of sines and cosines of the same degree in each term is tried as well.
    """
    if len(form) > _MAX_TERMS or fourier.is_still(form) or max(len(phase) for _, phase, _ in form) > _MAX_ANGLES:
        return form
    if len(form) == 1 and all(len(phase) > 1 for _, phase, _ in form):
        return form  # one wave of several angles: two products at least, each of as many factors
    units = _units(form)
    if any(abs(c) > _MAX_MULTIPLE * units[mono] for _, phase, _ in form for mono, c in phase):
        return form
    candidates = [form, *_products(form, units, reader)]
    candidates += _homogeneous(form, units, reader) if both and len(form) > 1 else []
    if any(int(u.p) % 2 == 0 for u in units.values()):
        halves = {mono: u / 2 if int(u.p) % 2 == 0 else u for mono, u in units.items()}
        candidates += _products(form, halves, reader)
    return min(candidates, key=_length)


def written(form: Form, reader: Reader) -> Form:
    """Waves as generators of a polynomial: for each product of everything else the shortest way to write its waves."""
    parts: dict[Monomial, Form] = {}
    for (mono, phase, sine), coefficient in form.items():
        parts.setdefault(mono, {})[ONE, phase, sine] = coefficient
    found = ((mono, part if _is_one_wave(part) else shortest(part, reader, both=True)) for mono, part in parts.items())
    total = (fourier.multiply({(mono, STILL, False): fmpq(1)}, part) if mono else part for mono, part in found)
    return _as_generators(fourier.add(total), reader)


def _is_one_wave(part: Form) -> bool:
    """Whether there is nothing to shorten: a number, or the sine or cosine of a single angle."""
    if len(part) != 1:
        return False
    ((_, phase, _),) = part
    return not phase or (len(phase) == 1 and phase[0][1] == 1)


def _as_generators(form: Form, reader: Reader) -> Form:
    """The form with every wave that is left as a generator of its own."""
    if fourier.is_still(form):
        return form
    return fourier.add(
        {(fourier.times(mono, _wave_generator(phase, reader, sine=sine)), STILL, False): coefficient}
        for (mono, phase, sine), coefficient in form.items()
    )


def _wave_generator(phase: Phase, reader: Reader, *, sine: bool) -> Monomial:
    return ((reader.wave_name(phase, sine=sine), 1),) if phase else ONE


def _homogeneous(form: Form, units: dict[Monomial, Any], reader: Reader) -> list[Form]:
    """The form in products of sin and cos that all have the same degree in each angle: sin² cos² for sin² − sin⁴."""
    product = _Products(units, reader)
    expanded = fourier.add(product.term(term, c) for term, c in form.items())
    return [product.homogeneous(expanded)]


def _products(form: Form, units: dict[Monomial, Any], reader: Reader) -> tuple[Form, Form]:
    """The form in products of sin and cos, once without squares of cosines and once without those of sines."""
    product = _Products(units, reader)
    expanded = fourier.add(product.term(term, c) for term, c in form.items())
    return product.reduced(expanded, "cos", "sin"), product.reduced(expanded, "sin", "cos")


def _units(form: Form) -> dict[Monomial, Any]:
    """For each monomial in the phases the largest angle of which all are whole multiples."""
    units: dict[Monomial, Any] = {}
    for _, phase, _ in form:
        for mono, coefficient in phase:
            units[mono] = _common_unit(units.get(mono, fmpq(coefficient)), fmpq(coefficient))
    return units


def _common_unit(a: Any, b: Any) -> Any:
    denominator = math.lcm(int(a.q), int(b.q))
    return fmpq(math.gcd(int((a * denominator).p), int((b * denominator).p)), denominator)


def _length(form: Form) -> int:
    """Terms, factors and angles to write."""
    return sum(
        2 + sum(2 + 2 * name.count("*") + int(e != 1) for name, e in mono)
        + _angle_length(phase) + int(abs(number) != 1)
        for (mono, phase, _), number in form.items()
    )  # fmt: skip


def _is_even(number: Any) -> bool:
    """Of a rational number; flint takes no remainder of one."""
    return bool(int(number) == number) and int(number) % 2 == 0


def _angle_length(phase: Phase) -> int:
    doubled = len(phase) == 1 and _is_even(phase[0][1])  # sin φ cos φ rather than sin 2φ
    return 2 * len(phase) + sum(len(mono) - 1 + 2 * int(abs(c) != 1) for mono, c in phase) + doubled


class _Products:
    """Writes waves as products of sin and cos of single angles, as monomials in generators for these."""

    def __init__(self, units: dict[Monomial, Any], reader: Reader) -> None:
        self._names: dict[Monomial, str] = {}
        for mono, unit in units.items():
            angle: Phase = ((mono, unit),)
            self._names[mono] = reader.wave_name(angle, sine=False)[3:]
            reader.wave_name(angle, sine=True)
        self._units = units

    def term(self, term: fourier.Term, coefficient: Any) -> Form:
        """One term with its wave expanded by the addition theorems."""
        mono, phase, sine = term
        cosine, sine_part = fourier.constant(1), fourier.constant(0)
        for angle, c in phase:
            multiple = int((c / self._units[angle]).p)
            even, odd = self._multiple(self._names[angle], multiple)
            cosine, sine_part = (
                fourier.add((fourier.multiply(cosine, even), fourier.scale(fourier.multiply(sine_part, odd), -1))),
                fourier.add((fourier.multiply(sine_part, even), fourier.multiply(cosine, odd))),
            )
        return fourier.multiply({(mono, STILL, False): coefficient}, sine_part if sine else cosine)

    def _multiple(self, name: str, multiple: int) -> tuple[Form, Form]:
        """cos nα and sin nα: real and imaginary part of (cos α + i sin α)^n."""
        parts: tuple[Form, Form] = ({}, {})
        for k in range(abs(multiple) + 1):
            mono = fourier.times(_power(f"cos{name}", abs(multiple) - k), _power(f"sin{name}", k))
            sign = -1 if k % 4 > 1 else 1
            parts[k % 2][mono, STILL, False] = fmpq(sign * math.comb(abs(multiple), k))
        return parts[0], parts[1] if multiple > 0 else fourier.scale(parts[1], -1)

    def reduced(self, form: Form, gone: str, kept: str) -> Form:
        """Squares of one function replaced: sin² = 1 − cos²."""
        for name in self._names.values():
            form = fourier.add(self._reduced_term(term, c, gone + name, kept + name) for term, c in form.items())
        return form

    def homogeneous(self, form: Form) -> Form:
        """Lower degrees raised by sin² + cos² = 1."""
        for name in self._names.values():
            pair = ("sin" + name, "cos" + name)
            degrees = {term: sum(dict(term[0]).get(wave, 0) for wave in pair) for term in form}
            highest = max(degrees.values())
            unity = fourier.add(map(_square, pair))
            form = fourier.add(
                fourier.multiply({term: c}, fourier.power(unity, (highest - degrees[term]) // 2))
                for term, c in form.items()
            )
        return form

    def _reduced_term(self, term: fourier.Term, coefficient: Any, gone: str, kept: str) -> Form:
        mono, phase, sine = term
        squares, rest = divmod(dict(mono).get(gone, 0), 2)
        if not squares:
            return {term: coefficient}
        others = fourier.times(tuple(pair for pair in mono if pair[0] != gone), _power(gone, rest))
        replacement = fourier.power(fourier.add((fourier.constant(1), fourier.scale(_square(kept), -1))), squares)
        return fourier.multiply({(others, phase, sine): coefficient}, replacement)


def _power(name: str, exponent: int) -> Monomial:
    return ((name, exponent),) if exponent else ONE


def _square(name: str) -> Form:
    return fourier.monomial(name, 2)
