"""A formula as a textbook prints it.

Raw expressions are read with their roots and quotients kept, waves are written the shortest way for each product they
stand by, and the planner looks for the shortest grouping that reads well. What is shown is multiplied out again and
compared, exactly, before it is shown.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import sympy

from . import fourier
from .fourier import Form, Monomial, TooLargeError
from .generators import rational
from .kernel_reader import KernelReader
from .memory import cached_method
from .normal_form import Reader
from .order import Order, split_symbol
from .plan import Plan, Product, Sum, expanded
from .planner import MAX_TERMS, Planner, ordered, planned, planned_terms
from .polynomial import RATE, Alphabet, Exponents, Poly
from .trigonometry import written


@dataclass(frozen=True)
class Summand:
    """A term of a sum without its sign, and the products of symbols in it, their waves left out."""

    value: Any
    sign: int
    keys: frozenset[Exponents]
    plan: Product


@dataclass(frozen=True)
class Summands:
    """The terms of a sum."""

    terms: tuple[Summand, ...]
    alphabet: Alphabet

    def key(self, mono: Monomial) -> Exponents | None:
        """What a product of symbols is called in the terms; None if it is in none of them."""
        try:
            return self.alphabet.without_waves(self.alphabet.exponents(mono))
        except KeyError:
            return None


@dataclass(eq=False)
class Textbook:
    """Writes forms of one reader. `given` are sums as the author wrote them: x₂ − x₁ stays x₂ − x₁."""

    reader: Reader
    order: Order
    given: frozenset[Any]

    def whole(self, form: Form) -> Any:
        """An energy, a force or a work: what all terms share may stand in front."""
        parts = self._by_differentials(form)
        written_parts = (self._part(outer, inner, alone=len(parts) == 1) for outer, inner in parts)
        return sympy.Add(*written_parts)

    def _part(self, outer: Monomial, inner: Form, *, alone: bool) -> Any:
        if outer:
            return _times(self.expression(inner), self.reader.monomial(outer))
        return self.expression(inner, free=alone)

    def _by_differentials(self, form: Form) -> list[tuple[Monomial, Form]]:
        """The coefficient of each product of accelerations, dq and δq."""
        parts: dict[Monomial, Form] = {}
        for (mono, phase, sine), c in form.items():
            outer = tuple(pair for pair in mono if self._is_outer(pair[0]))
            rest = tuple(pair for pair in mono if not self._is_outer(pair[0]))
            parts.setdefault(outer, {})[rest, phase, sine] = c
        return list(parts.items())

    def _is_outer(self, name: str) -> bool:
        return name not in self.reader.bases and split_symbol(name)[0] > RATE

    def expression(self, form: Form, *, free: bool = True) -> Any:
        """The form in its cheapest plan."""
        if not form:
            return sympy.S.Zero
        poly, denominator, alphabet = self._polynomial(form)
        if not poly:
            return sympy.S.Zero  # cos a − sin 2a/(2 sin a): what it is shows only where it is multiplied out
        plan = planned(alphabet.shape, tuple(ordered(poly)), denominator, free=free)
        return self.value(plan, alphabet)

    def _polynomial(self, form: Form) -> tuple[Poly, int, Alphabet]:
        if len(form) > MAX_TERMS:
            raise TooLargeError
        form = written(self._multiplied_out(form), self.reader)
        alphabet = Alphabet(self.reader, self.order, self._with_roots(form), self._kernel)
        return *alphabet.polynomial(form), alphabet

    def _multiplied_out(self, form: Form) -> Form:
        """Whole powers of kernels multiplied out, unless the kernel's root stands there too."""
        for key, base in reversed(tuple(self.reader.bases.items())):
            exponents = {dict(mono).get(key, 0) for mono, _, _ in form}
            if any(isinstance(e, int) and e > 0 for e in exponents) and not any(
                fourier.size(e) > 0 and not isinstance(e, int) for e in exponents
            ):
                form = fourier.add(self._expanded(term, c, key, base) for term, c in form.items())
        return form

    def _expanded(self, term: fourier.Term, number: Any, key: str, base: Form) -> Form:
        mono, phase, sine = term
        exponent = dict(mono).get(key, 0)
        if not isinstance(exponent, int) or exponent <= 0:
            return {term: number}
        rest = tuple(pair for pair in mono if pair[0] != key)
        return self.reader.multiply({(rest, phase, sine): number}, self.reader.raised(base, exponent))

    def _with_roots(self, form: Form) -> list[Form]:
        """The form, and the root of each base below a line: fractions may cancel to it."""
        below = {(name, -e) for mono, _, _ in form for name, e in mono if name in self.reader.bases and e < 0}
        roots = [fourier.monomial(name, e) for name, e in sorted(below, key=str) if not isinstance(e, int)]
        return [form, *roots]

    def products(self, form: Form) -> tuple[tuple[Any, int], ...]:
        """The form multiplied out: each product without its sign, and the sign."""
        if any(name in self.reader.bases for mono, _, _ in form for name, _ in mono):
            poly, denominator, alphabet = self._polynomial(form)
            terms = Planner(alphabet.shape).single(poly, denominator)
            parts = (self._summand(term, alphabet) for term in terms)
            return tuple((part.value, part.sign) for part in parts)
        plain = written(form, self.reader)
        return tuple(
            (sympy.Mul(rational(abs(number)), self.reader.monomial(mono)), 1 if number > 0 else -1)
            for (mono, _, _), number in plain.items()
        )

    def summands(self, form: Form, *, apart: bool) -> Summands:
        """The form as a sum, each term with the products of symbols that it stands for.

        `apart`: one term for each acceleration and product of rates, as inertia is written.
        """
        poly, denominator, alphabet = self._polynomial(form)
        terms = planned_terms(alphabet.shape, tuple(ordered(poly)), denominator, apart=apart)
        return Summands(tuple(self._summand(term, alphabet) for term in terms), alphabet)

    def _summand(self, term: Product, alphabet: Alphabet) -> Summand:
        keys = frozenset(alphabet.without_waves(key) for key in expanded(term, alphabet.shape))
        value = self.value(term, alphabet)
        negative = value.as_coeff_Mul()[0] < 0
        return Summand(negated(value) if negative else value, -1 if negative else 1, keys, term)

    def inside(self, summand: Summand, alphabet: Alphabet) -> Iterator[tuple[Any, Any, frozenset[Exponents]]]:
        """Each bracket of a term, its terms, and the products of symbols that each of them stands for there."""
        plan = summand.plan
        for index, (inner, e) in enumerate(plan.brackets):
            others = (*plan.brackets[:index], *([(inner, e - 1)] if e > 1 else []), *plan.brackets[index + 1 :])
            for part in inner.terms:
                whole = replace(plan, brackets=(*others, (Sum((part,)), 1)))
                keys = frozenset(alphabet.without_waves(key) for key in expanded(whole, alphabet.shape))
                yield self.value(inner, alphabet), self.value(part, alphabet), keys

    @cached_method
    def _kernel(self, name: str) -> Any:
        return self.expression(self.reader.bases[name])

    def value(self, plan: Plan, alphabet: Alphabet) -> Any:
        """A plan in SymPy, where 2 (a + b) is kept from being multiplied out."""
        if not isinstance(plan, Product):
            return sympy.Add(*(self.value(term, alphabet) for term in plan.terms))
        number = sympy.Rational(plan.number.numerator, plan.number.denominator)
        factors = [alphabet.generators[i].power(e) for i, e in plan.powers]
        brackets = [(self.value(inner, alphabet), e) for inner, e in plan.brackets]
        for index, (bracket, e) in enumerate(brackets):
            if self._is_turned(bracket):
                brackets[index], number = (-bracket, e), number * (-1) ** e
        if number < 0:
            number *= _turn_one(
                [index for index, (b, e) in enumerate(brackets) if e % 2 and self._may_turn(b)], brackets
            )
        return _product(number, [*factors, *(bracket**e for bracket, e in brackets)])

    def _is_turned(self, bracket: Any) -> bool:
        """Whether it stands the other way round by the author, or is s/a − 1 and not 1 − s/a."""
        constant = next((term for term in bracket.args if term.is_Rational), None)
        if -bracket in self.given and bracket not in self.given:
            return any(term.could_extract_minus_sign() for term in bracket.args)
        return bracket not in self.given and constant is not None and constant < 0

    def _may_turn(self, bracket: Any) -> bool:
        """Whether a minus in front may go into the bracket: −(a − b) is b − a."""
        if bracket in self.given or any(term.is_Rational for term in bracket.args):
            return False
        return any(term.could_extract_minus_sign() for term in bracket.args)


def _turn_one(candidates: list[int], brackets: list[tuple[Any, int]]) -> int:
    """Turn the first of these brackets, if there is one: −1, else 1."""
    if not candidates:
        return 1
    bracket, e = brackets[candidates[0]]
    brackets[candidates[0]] = -bracket, e
    return -1


def _product(number: Any, factors: list[Any]) -> Any:
    if len(factors) == 1 and factors[0].is_Add and number != 1:
        return sympy.Mul(number, factors[0], evaluate=False)
    return sympy.Mul(number, *factors)


def negated(expr: Any) -> Any:
    """−expr, without multiplying 2 (a + b) out."""
    number, rest = expr.as_coeff_Mul()
    return _product(-number, list(sympy.Mul.make_args(rest)))


def _times(coefficient: Any, outer: Any) -> Any:
    return sympy.Mul(*sympy.Mul.make_args(coefficient), outer)


def textbook(expr: Any, order: Order, given: frozenset[Any]) -> Any:
    """A SymPy expression as a textbook prints it. Raises TooLargeError, ZeroDivisionError."""
    reader = KernelReader()
    form = reader.read(expr)
    return Textbook(reader, order, given).whole(form)


def given_sums(exprs: Iterable[Any]) -> frozenset[Any]:
    """The sums in expressions as they were written."""
    return frozenset().union(*(expr.atoms(sympy.Add) for expr in exprs))
