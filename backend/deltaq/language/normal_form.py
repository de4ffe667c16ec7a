"""SymPy → Fourier form and back.

tan, cot, sec, csc and the hyperbolic functions are written in sine, cosine and exponentials; what stands below a
fraction line, and sums under a root, become generators of their own (`bases`) that `cleared` takes up to the numerator.
Any other function is an opaque generator: equal arguments give equal generators, but no more is known about it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import sympy
from flint import fmpq

from . import fourier
from .fourier import STILL, Form, Phase
from .generators import Generators
from .order import text_of

_LARGEST_FACTORED = 10**12


def _quotient(upper: Any, lower: Any) -> Any:
    return upper * lower**-1


def _between(a: Any, b: Any, way: int) -> Any:
    """max(a, b) = (a + b + |a − b|)/2, and min with a minus: what is known of absolute values is known of them."""
    return (a + b + way * sympy.Abs(a - b)) / 2


_REWRITTEN: Mapping[Any, Callable[..., Any]] = MappingProxyType(
    {
        sympy.tan: lambda x: _quotient(sympy.sin(x), sympy.cos(x)),
        sympy.cot: lambda x: _quotient(sympy.cos(x), sympy.sin(x)),
        sympy.sec: lambda x: sympy.cos(x) ** -1,
        sympy.csc: lambda x: sympy.sin(x) ** -1,
        sympy.sinh: lambda x: (sympy.exp(x) - sympy.exp(-x)) / 2,
        sympy.cosh: lambda x: (sympy.exp(x) + sympy.exp(-x)) / 2,
        sympy.tanh: lambda x: _quotient(sympy.exp(x) - sympy.exp(-x), sympy.exp(x) + sympy.exp(-x)),
        sympy.Max: lambda a, *rest: _between(a, sympy.Max(*rest), 1),
        sympy.Min: lambda a, *rest: _between(a, sympy.Min(*rest), -1),
        sympy.Heaviside: lambda x, _at_zero: (1 + sympy.sign(x)) / 2,
    }
)


class Reader(Generators):
    """Makes forms, and remembers what its generators stand for."""

    def __init__(self) -> None:
        super().__init__()
        self.is_exact = True
        self._known: dict[Any, Form] = {}

    def form(self, expr: Any) -> Form:
        """The form of a SymPy expression. Raises TooLargeError."""
        known = self._known.get(expr)
        if known is None:
            known = self._known[expr] = self._read(expr)
        return known

    def _read(self, expr: Any) -> Form:  # noqa: PLR0911 - one case for each kind
        if expr.is_Symbol:
            self.meaning[expr.name] = expr
            return fourier.monomial(expr.name)
        if expr.is_Rational:
            return fourier.constant(fmpq(int(expr.p), int(expr.q)))
        if expr.is_Float:
            return self.form(sympy.Rational(str(expr)))
        if expr.is_Add:
            return fourier.add(self.form(a) for a in expr.args)
        if expr.is_Mul:
            return self._product(expr)
        if isinstance(expr, sympy.exp) or expr is sympy.E:
            return self._exponential(sympy.Mul(*expr.args), expr)  # 1 of e itself
        if expr.is_Pow:
            return self._power(*expr.as_base_exp())
        if isinstance(expr, (sympy.sin, sympy.cos)):
            return self._wave(expr)
        if isinstance(expr, (sympy.Abs, sympy.sign)):
            return self._size(self.form(*expr.args), expr, sign=isinstance(expr, sympy.sign))
        rewrite = _REWRITTEN.get(expr.func)
        return self.form(rewrite(*expr.args)) if rewrite else self._opaque(expr)

    def _size(self, form: Form, expr: Any, *, sign: bool) -> Form:
        """|f| as √(f²), and sgn f as f/√(f²)."""
        if not form:
            return {}
        squared = self._base(self.multiply(form, form), fmpq(-1 if sign else 1, 2), expr)
        return self.multiply(form, squared) if sign else squared

    def _named_base(self, form: Form) -> str:
        """The generator that stands for a base; x⁴/√(x²)², in which it may stand itself, is the base x²."""
        written = self.expression(form)
        key = f"~~{text_of(written)}"
        stands_in_itself = any(name == key for mono, _, _ in form for name, _ in mono)
        self.bases[key] = self.form(written) if stands_in_itself else form
        return key

    def _product(self, expr: Any) -> Form:
        product = fourier.constant(1)
        for factor in sorted((self.form(a) for a in expr.args), key=len):
            product = self.multiply(product, factor)
        return product

    def _power(self, base: Any, exponent: Any) -> Form:
        if not exponent.is_Rational:
            return self._opaque(base**exponent)
        if exponent.is_Integer and exponent > 0:
            return self.raised(self.form(base), int(exponent))
        if base.is_Rational:
            return self._root(base, exponent)
        return self._base(self.form(base), fmpq(int(exponent.p), int(exponent.q)), base**exponent)

    def _root(self, base: Any, exponent: Any) -> Form:
        """A root of a rational number: a monomial in roots of primes, with exponents between 0 and 1."""
        if base <= 0 or base.p * base.q > _LARGEST_FACTORED:
            return self._opaque(base**exponent)
        form = fourier.constant(1)
        for prime, times in sympy.factorrat(base).items():
            total = exponent * times
            whole = sympy.floor(total)
            part = total - whole
            root = self.root(int(prime), fmpq(int(part.p), int(part.q)) if part else 0)
            form = self.multiply(form, fourier.scale(root, fmpq(int(prime)) ** int(whole)))
        return form

    def _base(self, form: Form, exponent: Any, expr: Any) -> Form:
        """A negative or fractional power: of a single monomial at once, else of a base with leading coefficient ±1."""
        numerator, denominator = self.cleared(form)
        form = form if denominator else numerator
        if not form and exponent > 0:
            return {}
        if not form:
            raise ZeroDivisionError
        if len(form) == 1 and fourier.is_still(form):
            ((mono, _, _), coefficient), *_ = form.items()
            if exponent.q == 1:
                raised: Form = {(fourier.raised(mono, exponent), STILL, False): coefficient ** int(exponent.p)}
                return self.reduced_roots(raised)
            if coefficient > 0 and all(self._is_positive(name) for name, _ in mono):
                number = sympy.Rational(int(coefficient.p), int(coefficient.q))
                root = self._root(number, sympy.Rational(int(exponent.p), int(exponent.q)))
                return self.multiply(root, {(fourier.raised(mono, exponent), STILL, False): fmpq(1)})
        size = form[fourier.leading(form)]
        if exponent.q > 1:
            self.is_exact = False
            size = abs(size)
            if int(size.p) * int(size.q) > _LARGEST_FACTORED:
                return self._opaque(expr)
        monic = fourier.scale(form, 1 / size)
        key = self._named_base(monic)
        number = self._power(sympy.Rational(int(size.p), int(size.q)), sympy.Rational(int(exponent.p), int(exponent.q)))
        return self.multiply(number, fourier.monomial(key, fourier.whole(exponent)))

    def _is_positive(self, name: str) -> bool:
        return bool(self.meaning[name].is_positive) if name in self.meaning else False

    def _exponential(self, argument: Any, expr: Any) -> Form:
        """exp of a polynomial: a monomial in the exponentials of its monomials."""
        form = self.form(argument)
        if not self._is_polynomial(form):
            return self._opaque(expr)
        factors: list[tuple[str, Any]] = []
        for (mono, _, _), coefficient in form.items():
            key = "exp " + "*".join(f"{name}^{e}" for name, e in mono)
            self.meaning[key] = sympy.exp(self.monomial(mono))
            factors.append((key, fourier.whole(coefficient)))
        return {(tuple(sorted(factors)), STILL, False): fmpq(1)}

    def _is_polynomial(self, form: Form) -> bool:
        return fourier.is_still(form) and not any(name in self.bases for mono, _, _ in form for name, _ in mono)

    def _wave(self, expr: Any) -> Form:
        """cos or sin of a linear form; of its constant multiple of π by the addition theorem."""
        form = self._with_waves_named(self.form(*expr.args))
        sine = isinstance(expr, sympy.sin)
        if not self._is_polynomial(form):
            return self._opaque(expr)
        turn = next((c for (mono, _, _), c in form.items() if mono == (("pi", 1),)), None)
        moving = {mono: fourier.whole(c) for (mono, _, _), c in form.items() if mono != (("pi", 1),)}
        phase: Phase = tuple(sorted(moving.items()))
        if turn is None:
            return fourier.wave(phase, sine=sine)
        return self._turned(phase, sympy.Rational(int(turn.p), int(turn.q)) * sympy.pi, sine=sine)

    def _with_waves_named(self, form: Form) -> Form:
        """An angle such as Ω t sin β, the wave in it taken as a name: sin² + cos² of it is 1 all the same."""
        if fourier.is_still(form):
            return form
        self.is_exact = False
        return fourier.add({(self._named(term), STILL, False): number} for term, number in form.items())

    def _named(self, term: fourier.Term) -> fourier.Monomial:
        mono, phase, sine = term
        if not phase:
            return mono
        value = self.wave(phase, sine=sine)
        key = f"~{text_of(value)}"
        self.meaning[key] = value
        return fourier.times(mono, ((key, 1),))

    def _turned(self, phase: Phase, turn: Any, *, sine: bool) -> Form:
        cosine_turn, sine_turn = self._constant_wave(sympy.cos(turn)), self._constant_wave(sympy.sin(turn))
        same = self.multiply(fourier.wave(phase, sine=sine), cosine_turn)
        other = self.multiply(fourier.wave(phase, sine=not sine), sine_turn)
        return fourier.add((same, other if sine else fourier.scale(other, -1)))

    def _constant_wave(self, value: Any) -> Form:
        return self._opaque(value) if value.has(sympy.sin, sympy.cos) else self.form(value)

    def _opaque(self, expr: Any) -> Form:
        if expr is sympy.pi:
            self.meaning["pi"] = sympy.pi
            return fourier.monomial("pi")
        self.is_exact = False
        known = expr if expr.is_number else expr.func(*(self.expression(self.form(a)) for a in expr.args))
        key = f"~{text_of(known)}"
        self.meaning[key] = known
        return fourier.monomial(key)
