"""Carrying a formula out in normal form: a relation whose members have one normal form holds, whatever the values are.

Every operation is done on Fourier forms (`language.fourier`), which are unique: sums, products, derivatives by the
chain rule, integrals of polynomials. No rule of a derivation works like this; rules differentiate with SymPy. An
integral over the time is a functional of motions that are not known: by parts it is brought to one that holds no rates
of variations, and values at its ends; two of these are equal if their integrands and their ends are. What cannot be
carried out raises `NotCarriedOutError`, and the relation is seen at points only.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from itertools import pairwise

import sympy as sp
from flint import fmpq

from ..language import fourier
from ..language.derivatives import diff
from ..language.form_calculus import derivative, directional
from ..language.fourier import Form, TooLargeError
from ..language.memory import cached_method
from ..language.normal_form import Reader
from ..language.spelling import spell_rate
from . import formula as f
from .step import Relation

Forms = tuple[Form, ...]  # one for a scalar, several for a vector or, row by row, a matrix
HIGHEST = 4  # rates along the motion
MARK = "~integral"  # a generator that stands for an integral over the time
AT = "~at"
ROUNDED = 200  # bits of a denominator that no scene has stated


class NotCarriedOutError(Exception):
    """The formula holds something that has no normal form here."""


@dataclass(frozen=True, eq=False)
class NormalAlgebra:
    """Carries out formulas about functions of time; `held` names variations with the instants where they vanish."""

    functions: tuple[str, ...]
    held: frozenset[tuple[str, sp.Expr]] = frozenset()
    reader: Reader = field(default_factory=Reader)

    def holds(self, relation: Relation) -> bool:
        """Whether all members have one normal form; for the sign ≠, two; for < and ≤, numbers in this order."""
        try:
            first, *others = map(self.carried_out, relation.members)
            if relation.sign in ("<", "≤"):
                return self._rise((first, *others), strictly=relation.sign == "<")
            gaps = [self._gap(first, other) for other in others]
        except (NotCarriedOutError, TooLargeError, ZeroDivisionError):
            return False
        if relation.sign == "≠":
            return self.reader.is_exact and any(gaps)
        return not any(gaps)

    def _rise(self, members: tuple[Forms, ...], *, strictly: bool) -> bool:
        """Whether the members are rational numbers, and each is larger than the one before it."""
        forms = [form for (form,) in members]
        if any(term != fourier.CONSTANT for form in forms for term in form):
            raise NotCarriedOutError
        values = [form.get(fourier.CONSTANT, fmpq(0)) for form in forms]
        return all(a < b or (a == b and not strictly) for a, b in pairwise(values))

    def _gap(self, first: Forms, other: Forms) -> bool:
        """Whether a difference is left when nothing stands below a fraction line."""
        if len(first) != len(other):
            raise NotCarriedOutError
        unlike = ((a, b) for a, b in zip(first, other, strict=True) if a != b)
        differences = (self.add((a, fourier.scale(b, -1))) for a, b in unlike)
        return any(difference and self.reader.cleared(difference)[0] for difference in differences)

    @cached_method
    def products(self, formula: f.Formula) -> dict[tuple[int, object], object] | None:
        """The number before each product of the normal form, by component; None where there is no normal form."""
        try:
            forms = self.carried_out(formula)
        except (NotCarriedOutError, TooLargeError, ZeroDivisionError):
            return None
        return {(place, term): number for place, form in enumerate(forms) for term, number in form.items()}

    def carried_out(self, formula: f.Formula) -> Forms:
        """The components of a formula with every operation done. Raises NotCarriedOutError, TooLargeError."""
        self.reader.begin()
        return self._carried_out(formula)

    @cached_method
    def _carried_out(self, formula: f.Formula) -> Forms:  # noqa: C901, PLR0911, PLR0912 - one case for each kind
        match formula:
            case f.Explicit() | f.Named():
                return tuple(map(self.reader.form, formula.parts))
            case f.Given(_, value):
                return self.value(value)
            case f.Rounded(value) if not _is_rounded(value):
                return self.value(value)
            case f.Partial(of, by):
                return self._each(of, lambda form: derivative(self.reader, form, by.name))
            case f.Rate(of):
                return self._each(of, self.rate)
            case f.Gateaux(of):
                return self._each(of, self._variation)
            case f.Times(factors):
                return self._product([self._carried_out(factor) for factor in factors])
            case f.Dot(left, right):
                pairs = zip(self._carried_out(left), self._carried_out(right), strict=True)
                return (self.add(self.times(a, b) for a, b in pairs),)
            case f.Plus(terms):
                return self._sum([self._scaled(term.formula, term.sign) for term in terms])
            case f.Equation(left, right):
                return self._sum([self._carried_out(left), self._scaled(right, -1)])
            case f.Shifted(value, h):
                return self.value(diff(value, h).xreplace({h: sp.Integer(0)}))
            case f.Integral(of, material):
                return self._integral(of, material)
            case f.Substituted(of, values) | f.AtEquilibrium(of, values) | f.Inserted(of, values) if not any(
                map(_is_rounded, values.values())
            ):
                return self._each(of, lambda form: self._replaced(form, values))
            case f.FunctionFormula():
                return self._of_functions(formula)
            case f.Stack() | f.MatrixTimes() | f.Jacobian() | f.Determinant() | f.Power():
                return self._of_matrix(formula)
        raise NotCarriedOutError  # what is written with very many digits is rounded

    def _of_functions(self, formula: f.FunctionFormula) -> Forms:  # noqa: C901, PLR0911 - one case for each kind
        match formula:
            case f.Called(_, of):
                return self._carried_out(of)
            case f.Directional(f.Called(_, of)) | f.LimitOfQuotient(f.Called(_, of)):
                return self._carried_out(replace(formula, of=of))
            case f.Directional(f.Integral(of, material)) | f.LimitOfQuotient(f.Integral(of, material)):
                return self._carried_out(f.Integral(replace(formula, of=of), material))
            case f.Directional(f.AtTime(of, time)) | f.LimitOfQuotient(f.AtTime(of, time)):
                return self._carried_out(f.AtTime(replace(formula, of=of), time))
            case f.Directional(of, along) | f.LimitOfQuotient(of, along):
                return self._each(of, lambda form: self._along(form, along))
            case f.AtTime(of, time):
                return self._each(of, lambda form: self._at(form, time))
            case f.Boundary(of, lower, upper):
                return self._each(of, lambda form: self._between(form, lower, upper))
            case f.Ratio(numerator, denominator):
                return (self._quotient(self._carried_out(numerator)[0], self._carried_out(denominator)[0]),)
            case f.Summed(_, terms):
                return self._sum([self._carried_out(term) for term in terms])
            case f.Each(_, instances):
                return tuple(form for instance in instances for form in self._carried_out(instance))
        raise NotCarriedOutError

    def _of_matrix(self, formula: f.Stack | f.MatrixTimes | f.Jacobian | f.Determinant | f.Power) -> Forms:
        match formula:
            case f.Stack(rows):
                return tuple(form for row in rows for form in self._carried_out(row))
            case f.MatrixTimes(matrix, vector):
                return self._matrix_times(self._carried_out(matrix), self._carried_out(vector))
            case f.Jacobian(of, by):
                columns = [self._carried_out(f.Partial(of, q)) for q in by]
                return tuple(form for row in zip(*columns, strict=True) for form in row)
            case f.Determinant(of):
                return (self._determinant(self._carried_out(of)),)
            case f.Power(of, exponent):
                return tuple(self.reader.raised(form, exponent) for form in self._carried_out(of))

    def value(self, value: f.Value) -> Forms:
        """The forms of an expression or a vector."""
        parts = value.flat() if isinstance(value, sp.MatrixBase) else [value]
        return tuple(map(self.reader.form, parts))

    def add(self, forms: Iterable[Form]) -> Form:
        """The sum."""
        return fourier.add(forms)

    def times(self, left: Form, right: Form) -> Form:
        """The product."""
        return self.reader.multiply(left, right)

    def _quotient(self, above: Form, below: Form) -> Form:
        if not below:
            raise ZeroDivisionError
        return self.times(above, self.reader.form(1 / self.reader.expression(below)))

    def rate(self, form: Form) -> Form:
        """d/dt along the motion: Σ ∂/∂x · ẋ + ∂/∂t, also of variations."""
        return directional(self.reader, form, self._speed)

    @cached_method
    def _speed(self, name: str) -> Form:
        """d/dt of a generator: that of a symbol is a symbol, that of a sum or a function follows by the chain rule."""
        if name in self._rates:
            return self._known(fourier.monomial(self._rates[name]))
        if name in self.reader.bases:
            return self.rate(self.reader.bases[name])
        meaning = self.reader.meaning[name]
        if meaning.is_Symbol or meaning.is_number:
            return fourier.constant(int(name == "t"))
        inner = ((symbol, self._speed(symbol.name)) for symbol in sorted(meaning.free_symbols, key=str))
        return self.add(self.times(self.reader.form(diff(meaning, symbol)), speed) for symbol, speed in inner if speed)

    @cached_property
    def _rates(self) -> Mapping[str, str]:
        """ẋ by x, up to the highest rates."""
        return {spell_rate(name, n): spell_rate(name, n + 1) for name in self._moving for n in range(HIGHEST)}

    @property
    def _moving(self) -> tuple[str, ...]:
        return (*self.functions, *(f"delta({name})" for name in self.functions))

    def _known(self, monomial: Form) -> Form:
        """A symbol that no expression has named yet."""
        for mono, _, _ in monomial:
            for name, _ in mono:
                self.reader.meaning.setdefault(name, sp.Symbol(name, real=True))
        return monomial

    def _variation(self, form: Form) -> Form:
        """Σ ∂/∂q · δq at fixed time: the neighbouring configuration has other coordinates, not other rates."""
        slopes = ((derivative(self.reader, form, name), f"delta({name})") for name in self.functions)
        return self.add(self.times(slope, self._known(fourier.monomial(name))) for slope, name in slopes if slope)

    def _along(self, form: Form, along: Mapping[sp.Symbol, sp.Expr]) -> Form:
        slopes = ((derivative(self.reader, form, symbol.name), v) for symbol, v in along.items())
        return self.add(self.times(slope, self.reader.form(v)) for slope, v in slopes if slope)

    def _at(self, form: Form, time: sp.Expr) -> Form:
        """Every function of time at the instant, under a name of its own."""
        value = self.reader.expression(form)
        moving = {spell_rate(name, n) for name in self._moving for n in range(HIGHEST + 1)}
        there = {s: self._symbol_at(s, time) for s in value.free_symbols if s.name in moving}
        clock = {s: time for s in value.free_symbols if s.name == "t"}
        return self.reader.form(value.xreplace({**there, **clock}))

    def _symbol_at(self, symbol: sp.Symbol, time: sp.Expr) -> sp.Expr:
        if (symbol.name, time) in self.held:
            return sp.Integer(0)
        return sp.Symbol(f"{symbol.name}{AT} {time}", real=True)

    def _replaced(self, form: Form, values: Mapping[sp.Symbol, sp.Expr]) -> Form:
        """The form with symbols replaced; what is multiplied by a zero is left out first."""
        zeros = {symbol.name for symbol, value in values.items() if value == 0}
        left = {term: number for term, number in form.items() if not any(n in zeros and e > 0 for n, e in term[0])}
        return self.reader.form(self.reader.expression(left).xreplace(dict(values)))

    def _integral(self, of: f.Formula, material: tuple[f.Bounds, ...]) -> Forms:
        forms = self._carried_out(of)
        for bounds in reversed(material):
            forms = tuple(self._integrated(form, bounds) for form in forms)
        return forms

    def _integrated(self, form: Form, bounds: f.Bounds) -> Form:
        """Over the time by parts until variations have no rates; over a body, what is polynomial in its coordinate."""
        if bounds.symbol.name == "t":
            return self._over_time(form, bounds.lower, bounds.upper)
        name = bounds.symbol.name
        lower, upper = (self.reader.form(end) for end in (bounds.lower, bounds.upper))
        return self.add(self._power_between(term, number, name, lower, upper) for term, number in form.items())

    def _over_time(self, form: Form, lower: sp.Expr, upper: sp.Expr) -> Form:
        """∫ a δẋ dt = [a δx] − ∫ ȧ δx dt, until no rate of a variation is left."""
        ends: list[Form] = []
        for name in self.functions:
            for order in range(HIGHEST, 0, -1):
                form, moved = self._split(form, spell_rate(f"delta({name})", order))
                lowered = self._known(fourier.monomial(spell_rate(f"delta({name})", order - 1)))
                if moved:
                    ends.append(self._between(self.times(moved, lowered), lower, upper))
                    form = self.add((form, fourier.scale(self.times(self.rate(moved), lowered), -1)))
        mark = self._known(fourier.monomial(f"{MARK} from {lower} to {upper}"))
        return self.add((self.times(mark, form), *ends))

    def _split(self, form: Form, name: str) -> tuple[Form, Form]:
        """What does not hold the symbol, and the factor of what is linear in it."""
        others, factor = {}, {}
        for (mono, phase, sine), number in form.items():
            power = dict(mono).get(name, 0)
            if power == 1:
                factor[(tuple(pair for pair in mono if pair[0] != name), phase, sine)] = number
            elif not power:
                others[(mono, phase, sine)] = number
            else:
                raise NotCarriedOutError
        return others, factor

    def _between(self, form: Form, lower: sp.Expr, upper: sp.Expr) -> Form:
        """The value at the upper end less that at the lower."""
        return self.add((self._at(form, upper), fourier.scale(self._at(form, lower), -1)))

    def _power_between(self, term: fourier.Term, number: fmpq, name: str, lower: Form, upper: Form) -> Form:
        """c sⁿ from lower to upper: c (upperⁿ⁺¹ − lowerⁿ⁺¹)/(n + 1)"""
        mono, phase, sine = term
        exponent = dict(mono).get(name, 0)
        others = (*(n for n, _ in mono if n != name), *(n for inner, _ in phase for n, _ in inner))
        if not isinstance(exponent, int) or exponent < 0 or any(self._holds(other, name) for other in others):
            raise NotCarriedOutError
        rest: Form = {(tuple(pair for pair in mono if pair[0] != name), phase, sine): number / (exponent + 1)}
        ends = (self.reader.raised(upper, exponent + 1), fourier.scale(self.reader.raised(lower, exponent + 1), -1))
        return self.times(rest, self.add(ends))

    def _holds(self, generator: str, name: str) -> bool:
        """Whether the generator is this symbol, or depends on it."""
        return any(symbol.name == name for symbol in self.reader.generator(generator).free_symbols)

    def _each(self, of: f.Formula, change: Callable[[Form], Form]) -> Forms:
        return tuple(map(change, self._carried_out(of)))

    def _scaled(self, of: f.Formula, sign: int) -> Forms:
        return tuple(fourier.scale(form, fmpq(sign)) for form in self._carried_out(of))

    def _sum(self, summands: list[Forms]) -> Forms:
        return tuple(map(self.add, zip(*summands, strict=True)))

    def _product(self, factors: list[Forms]) -> Forms:
        """Scalars times at most one vector."""
        vector = next((factor for factor in factors if len(factor) > 1), (fourier.constant(1),))
        scalar = reduce(self.times, (factor[0] for factor in factors if len(factor) == 1), fourier.constant(1))
        return tuple(self.times(scalar, form) for form in vector)

    def _matrix_times(self, matrix: Forms, vector: Forms) -> Forms:
        size = len(vector)
        rows = (matrix[start : start + size] for start in range(0, len(matrix), size))
        return tuple(self.add(self.times(a, b) for a, b in zip(row, vector, strict=True)) for row in rows)

    def _determinant(self, matrix: Forms) -> Form:
        """By Laplace's expansion along the first row."""
        size = math.isqrt(len(matrix))
        if size == 1:
            return matrix[0]
        rows = [matrix[start : start + size] for start in range(0, len(matrix), size)]
        minors = (
            self._determinant(tuple(form for row in rows[1:] for form in (*row[:k], *row[k + 1 :])))
            for k in range(size)
        )
        signed = (fourier.scale(entry, fmpq((-1) ** k)) for k, entry in enumerate(rows[0]))
        return self.add(self.times(entry, minor) for entry, minor in zip(signed, minors, strict=True))


def _is_rounded(value: f.Value) -> bool:
    """Whether a root is written as a number with very many digits."""
    return any(number.q.bit_length() > ROUNDED for number in value.atoms(sp.Rational))
