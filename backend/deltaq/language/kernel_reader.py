"""SymPy → Fourier form for display: what stands below a root or a fraction line stays what the author made of it.

The canonical reader brings everything over one denominator, which decides equality and reads badly. Here each base of
a root or a reciprocal is a kernel with a free exponent: s · s⁻¹ cancels, s² is not multiplied out. From a root only
squares and factors known to be positive are taken, √(f²) = |f|; and |f| sgn f = f, f sgn f = |f|.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import sympy
from flint import Ordering, fmpq, fmpq_mpoly_ctx

from . import fourier
from .fourier import ONE, STILL, Form, Monomial
from .normal_form import Reader
from .order import arguments_of, text_of

MAX_ROOT = 10**12
# Functions that stay as the author wrote them: hyperbolic ones unless they cancel, tangents where no sine stands by.
_HYPERBOLIC = (sympy.sinh, sympy.cosh, sympy.tanh)
_TANGENTS = (sympy.tan, sympy.cot)


class KernelReader(Reader):
    """Makes forms whose kernels are primitive: integers without a common factor, no common monomial."""

    def __init__(self) -> None:
        super().__init__()
        self.sizes: dict[str, Form] = {}  # |f| and sgn f by the names of their generators
        self.signs: dict[str, tuple[str, Form]] = {}

        self._own: tuple[Any, ...] = _HYPERBOLIC

    def read(self, expr: Any) -> Form:
        """The form of a SymPy expression, its absolute values and signs merged. Raises TooLargeError."""
        self._own = _TANGENTS if not expr.has(sympy.sin, sympy.cos) else ()
        if expr.has(*_HYPERBOLIC) and _has_exponentials(Reader().form(expr)):
            self._own += _HYPERBOLIC
        return self._divided(self._merged(self.form(expr)))

    def _read(self, expr: Any) -> Form:
        if isinstance(expr, self._own):
            return self._opaque(expr)
        if isinstance(expr, sympy.Abs):
            return self._size_of(self.form(*expr.args))
        if isinstance(expr, sympy.sign):
            return self._sign_of(self.form(*expr.args))
        if isinstance(expr, (sympy.Max, sympy.Min)):
            return self._opaque(expr)
        if isinstance(expr, sympy.Heaviside):
            return self._step_of(self.form(*arguments_of(expr)))
        return super()._read(expr)

    def _base(self, form: Form, exponent: Any, expr: Any) -> Form:
        if len(form) <= 1 or (exponent.q > 1 and exponent.q != 2):
            return super()._base(form, exponent, expr)
        number, common, primitive = _primitive(form)
        outside, inside = (number, fmpq(1)) if exponent.q == 1 else _squares(number)
        taken = common if exponent.q == 1 else tuple(pair for pair in common if self._may_leave_root(pair))
        left = tuple(pair for pair in common if pair not in taken)
        kernel = fourier.multiply({(left, STILL, False): inside}, primitive)
        scale = _root(outside, exponent)
        front: Form = {(fourier.raised(taken, exponent), STILL, False): scale}
        return self.multiply(front, self._kernel(kernel, exponent))

    def _may_leave_root(self, pair: tuple[str, Any]) -> bool:
        return self._is_positive(pair[0])

    def _kernel(self, form: Form, exponent: Any) -> Form:
        return fourier.monomial(self._named_base(form), fourier.whole(exponent))

    def cleared(self, form: Form) -> tuple[Form, Monomial]:
        """As it is: kernels are not cleared here."""
        return form, ONE

    def _size_of(self, form: Form) -> Form:
        if not form:
            return {}
        inner, number, front = self._oriented(form)
        if not inner:
            return fourier.scale(front, abs(number))
        key = f"~|{text_of(self.expression(inner))}|"
        self.meaning[key] = sympy.Abs(self.expression(inner))
        self.sizes[key] = inner
        return self.multiply(fourier.scale(front, abs(number)), fourier.monomial(key))

    def _sign_of(self, form: Form) -> Form:
        if not form:
            return {}
        inner, number, _ = self._oriented(form)
        sign = fmpq(1 if number > 0 else -1)
        if not inner:
            return fourier.constant(sign)
        text = text_of(self.expression(inner))
        key = f"~sgn {text}"
        self.meaning[key] = sympy.sign(self.expression(inner))
        self.signs[key] = (f"~|{text}|", inner)
        self.sizes.setdefault(f"~|{text}|", inner)
        self.meaning.setdefault(f"~|{text}|", sympy.Abs(self.expression(inner)))
        return fourier.scale(fourier.monomial(key), sign)

    def _step_of(self, form: Form) -> Form:
        """step(c f) is step(f) for c > 0, and 1 − step(f) for c < 0."""
        if not form:
            return fourier.constant(fmpq(1, 2))
        inner, number, _ = self._oriented(form)
        if not inner:
            return fourier.constant(fmpq(1 if number > 0 else 0))
        value = sympy.Heaviside(self.expression(inner))
        key = f"~step {text_of(value.args[0])}"
        self.meaning[key] = value
        step = fourier.monomial(key)
        return step if number > 0 else fourier.add((fourier.constant(fmpq(1)), fourier.scale(step, fmpq(-1))))

    def _oriented(self, form: Form) -> tuple[Form, Any, Form]:
        """What stays between the bars, the number that leaves them, and the positive monomial that does."""
        number, common, primitive = _primitive(form)
        if primitive[fourier.leading(primitive)] < 0:
            number, primitive = -number, fourier.scale(primitive, -1)
        leaving = tuple(pair for pair in common if self._is_positive(pair[0]))
        staying = tuple(pair for pair in common if pair not in leaving)
        inner = fourier.multiply({(staying, STILL, False): fmpq(1)}, primitive)
        front: Form = {(leaving, STILL, False): fmpq(1)}
        return ({} if inner == fourier.constant(1) else inner), number, front

    def _merged(self, form: Form) -> Form:
        """|f|² = f², |f| sgn f = f, and x sgn x = |x| for a symbol x."""
        if not self.sizes:
            return form
        for _ in range(8):
            merged = fourier.add(self._merged_term(term, number) for term, number in form.items())
            if merged == form:
                break
            form = merged
        return form

    def _divided(self, form: Form) -> Form:
        """f sgn f = |f| for a sum f: what stands before sgn f is divided by f where that leaves nothing over."""
        for key, (size, inner) in self.signs.items():
            factor = {term: c for term, c in form.items() if (key, 1) in term[0]}
            quotient = divided(self._without(factor, key), inner) if len(factor) >= len(inner) else None
            if quotient is not None:
                rest = {term: c for term, c in form.items() if term not in factor}
                form = fourier.add((rest, self.multiply(quotient, fourier.monomial(size))))
        return form

    def _without(self, form: Form, key: str) -> Form:
        return fourier.multiply({(((key, -1),), STILL, False): fmpq(1)}, form)

    def _merged_term(self, term: fourier.Term, number: Any) -> Form:
        mono, phase, sine = term
        exponents = Counter(dict(mono))
        for key, inner in self.sizes.items():
            if exponents[key] >= 2:
                return self._replaced(term, number, {key: 2}, fourier.multiply(inner, inner))
        for key, (size, inner) in self.signs.items():
            if exponents[key] < 1:
                continue
            if exponents[size] >= 1:
                return self._replaced(term, number, {key: 1, size: 1}, inner)
            name = _symbol(inner)
            if name is not None and exponents[name] >= 1:
                return self._replaced(term, number, {key: 1, name: 1}, fourier.monomial(size))
        return {(mono, phase, sine): number}

    def _replaced(self, term: fourier.Term, number: Any, gone: dict[str, int], by: Form) -> Form:
        mono, phase, sine = term
        rest = fourier.times(mono, tuple((name, -times) for name, times in gone.items()))
        return self.multiply({(rest, phase, sine): number}, by)


def divided(form: Form, by: Form) -> Form | None:
    """The quotient of two polynomials in natural powers of generators; None if it is none, or waves are in them."""
    monos = [mono for part in (form, by) for mono, _, _ in part]
    natural = all(isinstance(e, int) and e > 0 for mono in monos for _, e in mono)
    if not form or not (natural and fourier.is_still(form) and fourier.is_still(by)):
        return None
    names = sorted({name for mono in monos for name, _ in mono})
    ring = fmpq_mpoly_ctx.get([f"x{i}" for i in range(len(names))], Ordering.lex)
    upper, lower = (
        ring.from_dict({tuple(dict(mono).get(n, 0) for n in names): c for (mono, _, _), c in part.items()})
        for part in (form, by)
    )
    quotient, rest = divmod(upper, lower)
    if len(rest):
        return None
    return {
        (tuple((n, int(e)) for n, e in zip(names, exponents, strict=True) if e), STILL, False): fmpq(c)
        for exponents, c in quotient.to_dict().items()
    }


def _has_exponentials(form: Form) -> bool:
    return any(name.startswith("exp ") for mono, _, _ in form for name, _ in mono)


def _symbol(form: Form) -> str | None:
    """The name of the form if it is a bare symbol."""
    if len(form) != 1:
        return None
    (((mono, phase, _), number),) = form.items()
    return mono[0][0] if number == 1 and not phase and len(mono) == 1 and mono[0][1] == 1 else None


def _primitive(form: Form) -> tuple[Any, Monomial, Form]:
    """Number, common monomial, and the rest with whole numbers that have no common factor."""
    upper = math.gcd(*(int(c.p) for c in form.values()))
    lower = math.lcm(*(int(c.q) for c in form.values()))
    number = fmpq(upper, lower)
    first, *rest = (dict(mono) for mono, _, _ in form)
    names = sorted(set(first).union(*rest))
    lowest = {name: min((m.get(name, 0) for m in (first, *rest)), key=fourier.size) for name in names}
    common = tuple((name, e) for name, e in lowest.items() if isinstance(e, int) and e)
    inverse: Form = {(fourier.raised(common, -1), STILL, False): 1 / number}
    return number, common, fourier.multiply(inverse, form)


def _squares(number: Any) -> tuple[Any, Any]:
    """A positive number as a² b with a whole b that has no square in it: the first, then the second factor."""
    whole = int(number.p) * int(number.q)
    if whole > MAX_ROOT:
        return fmpq(1), number
    square = math.prod(int(prime) ** (times // 2) for prime, times in sympy.factorint(whole).items())
    return fmpq(square, int(number.q)) ** 2, fmpq(whole // square**2)


def _root(number: Any, exponent: Any) -> Any:
    """A power of a number whose root is rational."""
    if exponent.q == 1:
        return number ** int(exponent.p)
    root = fmpq(math.isqrt(int(number.p)), math.isqrt(int(number.q)))
    return root ** int(exponent.p)
