"""What the generators of Fourier forms stand for, and forms → SymPy."""

from __future__ import annotations

from typing import Any

import sympy
from flint import fmpq

from . import fourier
from .fourier import ONE, Form, Monomial, Phase, TooLargeError
from .memory import cached_method

_MAX_WORK = 60_000


class Generators:
    """Symbols and opaque functions (`meaning`), sums below a fraction line or under a root (`bases`)."""

    def __init__(self) -> None:
        self.meaning: dict[str, Any] = {}
        self.bases: dict[str, Form] = {}
        self._work = 0
        self._has_roots = False

    def begin(self) -> None:
        """What was read so far stays known; the bound of work counts from here."""
        self._work = 0

    def multiply(self, left: Form, right: Form) -> Form:
        """The product, as long as all products together stay within bounds."""
        # Whole powers of roots have to be looked for in every product.
        self._work += len(left) * len(right) * (4 if self._has_roots else 1)
        if self._work > _MAX_WORK:
            raise TooLargeError
        product = fourier.multiply(left, right)
        return self.reduced_roots(product) if self._has_roots else product

    def root(self, prime: int, exponent: Any) -> Form:
        """A root of a prime, as a generator of its own."""
        self._has_roots = True
        self.meaning[str(prime)] = sympy.Integer(prime)
        return fourier.monomial(str(prime), exponent)

    def reduced_roots(self, form: Form) -> Form:
        """Whole powers of primes taken into the coefficients: √2·√2 = 2."""
        if not any(name.isdigit() and not 0 < fourier.size(e) < 1 for mono, _, _ in form for name, e in mono):
            return form
        return fourier.add(self._reduced_root(term, coefficient) for term, coefficient in form.items())

    def _reduced_root(self, term: fourier.Term, coefficient: Any) -> Form:
        mono, phase, sine = term
        whole = {name: _floor(e) for name, e in mono if name.isdigit()}
        for name, exponent in whole.items():
            coefficient *= fmpq(int(name)) ** exponent
        rest = tuple((name, e - whole.get(name, 0)) for name, e in mono)
        return {(tuple(pair for pair in rest if pair[1]), phase, sine): coefficient}

    def raised(self, form: Form, exponent: int) -> Form:
        """A power with a whole exponent ≥ 0, by squaring."""
        result = fourier.constant(1)
        for digit in f"{exponent:b}":
            result = self.multiply(result, result)
            result = self.multiply(result, form) if digit == "1" else result
        return result

    def cleared(self, form: Form) -> tuple[Form, Monomial]:
        """Numerator and denominator: no base stands in the numerator with a whole or a negative power."""
        denominator: Monomial = ONE
        for key in reversed(tuple(self.bases)):
            whole = [_floor(dict(mono).get(key, 0)) for mono, _, _ in form]
            if not any(whole):
                continue
            lowest = min(*whole, 0)
            form = fourier.add(self._expanded(term, c, key, lowest) for term, c in form.items())
            denominator = fourier.times(denominator, ((key, -lowest),)) if lowest else denominator
        return form, denominator

    def _expanded(self, term: fourier.Term, coefficient: Any, key: str, lowest: int) -> Form:
        mono, phase, sine = term
        exponent = dict(mono).get(key, 0) - lowest
        whole = _floor(exponent)
        part = exponent - whole
        rest = fourier.times(tuple(pair for pair in mono if pair[0] != key), ((key, part),) if part else ONE)
        return self.multiply({(rest, phase, sine): coefficient}, self.raised(self.bases[key], whole))

    def expression(self, form: Form) -> Any:
        """The SymPy expression of a form, term by term."""
        return sympy.Add(*(self._term(term, coefficient) for term, coefficient in form.items()))

    def _term(self, term: fourier.Term, coefficient: Any) -> Any:
        mono, phase, sine = term
        number = sympy.Rational(int(coefficient.p), int(coefficient.q))
        return sympy.Mul(number, self.monomial(mono), self.wave(phase, sine=sine))

    @cached_method
    def wave(self, phase: Phase, *, sine: bool) -> Any:
        """cos(phase) or sin(phase) in SymPy."""
        if not phase:
            return sympy.S.One
        return sympy.sin(self.angle(phase)) if sine else sympy.cos(self.angle(phase))

    @cached_method
    def wave_name(self, phase: Phase, *, sine: bool) -> str:
        """The name of a wave as a generator: cos(phi). Also where SymPy knows its value, as of cos(acos(x))."""
        value = self.wave(phase, sine=sine)
        function = sympy.sin if sine else sympy.cos
        name: str = sympy.sstr(value if value.has(function) else function(self.angle(phase), evaluate=False))
        self.meaning[name] = value
        return name

    def angle(self, phase: Phase) -> Any:
        """A phase in SymPy."""
        return sympy.Add(*(rational(c) * self.monomial(mono) for mono, c in phase))

    @cached_method
    def monomial(self, mono: Monomial) -> Any:
        """A monomial in SymPy."""
        return sympy.Mul(*(self.generator(name) ** rational(e) for name, e in mono))

    def generator(self, name: str) -> Any:
        """What a generator stands for."""
        return self.expression(self.bases[name]) if name in self.bases else self.meaning[name]


def _floor(exponent: Any) -> int:
    return exponent if isinstance(exponent, int) else int(exponent.p) // int(exponent.q)


def rational(exponent: Any) -> Any:
    """A number of a form in SymPy."""
    return sympy.Integer(exponent) if isinstance(exponent, int) else sympy.Rational(int(exponent.p), int(exponent.q))
