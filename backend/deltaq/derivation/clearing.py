"""Equations f = 0 as a textbook writes them: f without denominators and without factors that cannot be zero.

f is brought over one denominator, with a generator r for each root (rᵏ = b, so that higher powers of r are lowered),
and the numerator is factored over the rationals. A factor g is left out where the equation says the same without it:

* it stands in a denominator, or under a root there: where it is zero, f has no value;
* it holds parameters and numbers alone: these are taken as not zero;
* it is positive for all real values, as 1 + ẋ²;
* it holds the time alone, and is zero at single times, where the rest of f vanishes too, as it is continuous;
* it holds one function x and no rate, and a denominator is zero where g = 0 and ẋ = 0: then x = const with g = 0 is
  excluded, and what is left are single times again.

Source: von zur Gathen, Gerhard, Modern Computer Algebra, 3rd ed., ch. 15 (factorization) for the means.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import sympy as sp

from ..language import canonical
from ..language.order import split_symbol
from ..language.symbols import Symbols
from .factoring import factor_list

Reason = Literal["denominators", "constants", "points"]
POWERS = (1, -1, 2, -2)
# Operations times symbols, and powers of sums: what is more is not factored while someone waits.
LARGEST, STEEPEST = 1000, 8
ORDERS = {0: 0, 1: 1, 2: 2, 3: 3, 8: 4}  # kind of a symbol → order of its rate


@dataclass(frozen=True)
class Cleared:
    """`value` = `factor` · what it was made of; `reasons` say why the factor may be left out of an equation."""

    value: sp.Expr
    factor: sp.Expr = sp.Integer(1)
    reasons: tuple[Reason, ...] = ()


def cleared(expression: sp.Expr, symbols: Symbols, function: str = "") -> Cleared:
    """The expression without what does not matter to the equation expression = 0; as it is if it cannot be factored.

    The highest rate of `function`, if it is named, gets a positive factor.
    """
    if expression.is_number or _is_large(expression):
        return Cleared(expression)
    try:
        return _Fraction(expression, symbols, function).cleared
    except (sp.PolynomialError, NotImplementedError):
        return Cleared(expression)


def constant_of_motion(expression: sp.Expr, symbols: Symbols) -> tuple[sp.Expr, int, sp.Expr]:
    """(g, n, c) with g = c · expressionⁿ: what is constant with the expression and is the shortest to write.

    c holds numbers and parameters alone; n is one of 1, −1, 2 and −2.
    """
    moving = _moving(expression, symbols)
    found = []
    for power in POWERS if not expression.is_Add else (1,):
        constant, shown = (expression**power).as_independent(*moving, as_Add=False)
        if shown.could_extract_minus_sign():
            constant, shown = -constant, -shown
        found.append((shown, power, 1 / constant))
    return min(found, key=lambda one: _length(*one[:2]))


def _length(expression: sp.Expr, power: int) -> int:
    """How long a constant of motion is to write; it is left as it is unless much is gained."""
    return _size(expression) + 3 * int(sp.denom(expression) != 1) + 4 * int(power != 1)


def upright_roots(expression: sp.Expr) -> sp.Expr:
    """√(1/(g x)), which SymPy makes of √((1 + ẋ²)/(g x)), as 1/√(g x)."""
    powers = (p for p in expression.atoms(sp.Pow) if p.exp.is_Rational and not p.exp.is_Integer)
    return expression.xreplace({p: (1 / p.base) ** -p.exp for p in powers if sp.fraction(p.base)[0] == 1})


def factored(expression: sp.Expr, symbols: Symbols) -> sp.Expr:
    """The expression as one product, or with one term for each power of a root, if that is short; else displayed."""
    otherwise = canonical.display(expression, symbols)
    if _is_large(expression) or not any(_divides(power) for power in expression.atoms(sp.Pow)):
        return otherwise
    try:
        fraction = _Fraction(expression, symbols)
        return min((otherwise, fraction.by_roots if fraction.has_roots_in_sums else fraction.product), key=_size)
    except (sp.PolynomialError, NotImplementedError):
        return otherwise


def _size(expression: sp.Expr) -> int:
    """How long it is to write; a root costs more than a power."""
    roots = sum(1 for power in expression.atoms(sp.Pow) if not power.exp.is_Integer)
    return int(expression.count_ops()) + 2 * roots


def _moving(expression: sp.Expr, symbols: Symbols) -> tuple[sp.Symbol, ...]:
    """What is no parameter: functions, their rates and the time."""
    held = {symbol.name for symbol in symbols.names.symbols if symbol.kind == "parameter"}
    return tuple(sorted((s for s in expression.free_symbols if s.name not in held), key=str))


@dataclass(frozen=True, eq=False)
class _Fraction:
    """An expression over one denominator, its roots as generators."""

    expression: sp.Expr
    symbols: Symbols
    function: str = ""
    roots: dict[sp.Symbol, tuple[sp.Expr, int]] = field(default_factory=dict)  # r ↦ (b, k) with rᵏ = b
    written: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)  # r ↦ b as it was

    @cached_property
    def _parts(self) -> tuple[sp.Expr, sp.Expr]:
        """Numerator and denominator, in which powers of r in the numerator are below k."""
        single = self.expression.replace(_is_multiple_angle, sp.expand_trig)
        numerator, denominator = sp.fraction(sp.together(self._without_roots(single)))
        for root in reversed(tuple(self.roots)):
            lowered = sp.together(self._lowered(sp.expand(numerator), root))
            numerator, more = sp.fraction(lowered)
            denominator *= more
        numerator, denominator = sp.fraction(sp.cancel(numerator / denominator))
        for root in self.roots:
            numerator, more = sp.fraction(sp.together(self._raised(numerator, root)))
            denominator *= more
        return numerator, denominator

    def _without_roots(self, expression: sp.Expr) -> sp.Expr:
        """Roots and powers with symbols in the exponent as generators, from the inside out."""
        if not expression.args:
            return expression
        inside = expression.func(*map(self._without_roots, expression.args))
        if not inside.is_Pow or inside.exp.is_Integer:
            return inside
        base, exponent = inside.as_base_exp()
        if not exponent.is_Rational:
            return inside if base is sp.E else self._generator(inside, 0)
        above, _ = sp.fraction(sp.together(base))
        if self.moves(above):
            return self._generator(base, exponent.q) ** exponent.p
        return self._generator(1 / base, exponent.q) ** -exponent.p  # √(1/x) is zero nowhere

    def _generator(self, base: sp.Expr, degree: int) -> sp.Symbol:
        relation = sp.cancel(base) if degree else base, degree
        known = (r for r, other in self.roots.items() if other == relation)
        found = next(known, None) or sp.Dummy(f"r{len(self.roots)}", real=True)
        self.roots[found] = relation
        self.written.setdefault(found, base)
        return found

    def _lowered(self, numerator: sp.Expr, root: sp.Symbol) -> sp.Expr:
        base, degree = self.roots[root]
        if not degree or not numerator.has(root):
            return numerator
        powers = sp.Poly(numerator, root).terms()
        return sp.Add(*(c * base ** (n // degree) * root ** (n % degree) for (n,), c in powers))

    def _raised(self, numerator: sp.Expr, root: sp.Symbol) -> sp.Expr:
        """Where terms differ in their powers of r, (1 + ẋ²) r is written as r³."""
        base, degree = self.roots[root]
        above, below = sp.fraction(sp.together(base))
        if not degree or not above.is_Add or len(terms := sp.Poly(numerator, root).terms()) < 2:
            return numerator
        total = sp.Integer(0)
        for (power,), coefficient in terms:
            quotient, rest = sp.div(coefficient, above, *sorted(above.free_symbols, key=str))
            total += quotient * below * root ** (power + degree) if rest == 0 else coefficient * root**power
        return total

    def _back(self, value: sp.Expr) -> sp.Expr:
        for root in reversed(tuple(self.roots)):
            base, (_, degree) = self.written[root], self.roots[root]
            value = value.xreplace({root: base ** sp.Rational(1, degree) if degree else base})
        return value

    @cached_property
    def _factors(self) -> tuple[sp.Expr, tuple[tuple[sp.Expr, int], ...]]:
        """The numerator as a number times powers of what cannot be factored further."""
        number, factors = factor_list(self._parts[0])
        return number, tuple(factors)

    @cached_property
    def product(self) -> sp.Expr:
        """Numerator and denominator as products."""
        number, factors = self._factors
        return self._back(sp.Mul(number, 1 / sp.factor(self._parts[1]), *(g**n for g, n in factors)))

    @property
    def by_roots(self) -> sp.Expr:
        """One term for each power of the roots: m c²/√(1 − ẋ²/c²) − F x."""
        numerator, denominator = self._parts
        roots = [root for root in self.roots if numerator.has(root)]
        terms = sp.Poly(numerator, *roots).terms()
        powers = (sp.Mul(*(r**n for r, n in zip(roots, exponents, strict=True))) for exponents, _ in terms)
        return self._back(sp.Add(*(sp.factor(c * p / denominator) for p, (_, c) in zip(powers, terms, strict=True))))

    @property
    def has_roots_in_sums(self) -> bool:
        return any(g.is_Add and g.has(*self.roots) for g, _ in self._factors[1])

    @cached_property
    def cleared(self) -> Cleared:
        number, factors = self._factors
        if number == 0:
            return Cleared(sp.Integer(0))
        reasons = {g: self._reason(g) for g, _ in factors}
        kept = sp.Mul(*(g**n for g, n in factors if reasons[g] is None))
        if not self.moves(kept):  # nothing is left that moves: it is as it was
            return Cleared(self.expression)
        dropped = sp.Mul(number, *(g**n for g, n in factors if reasons[g] is not None))
        sign = self._sign(kept)
        value = canonical.display(self._back(sp.expand(sign * kept) if kept.is_Add else sign * kept), self.symbols)
        factor = self._back(sp.factor(self._parts[1]) * sign / dropped)
        named = {*reasons.values(), "denominators" if self.moves(self._parts[1]) else None}
        if self._parts[1].free_symbols and not self.moves(self._parts[1]):
            named.add("constants")
        return Cleared(value, factor, tuple(r for r in ("denominators", "constants", "points") if r in named))

    def _reason(self, factor: sp.Expr) -> Reason | None:
        """Why the factor is not zero, or only where it does not matter; None if it may be."""
        if not self.moves(factor):
            return "constants"
        if factor in self._excluded or self._back(factor).is_positive or self._back(factor).is_negative:
            return "denominators"
        return "points" if self._is_zero_at_points_only(factor) else None

    @cached_property
    def _excluded(self) -> frozenset[sp.Expr]:
        """What is not zero where the expression has a value: the factors of denominators and of roots in them."""
        below = self._parts[1]
        below = sp.Mul(below, *(self._base(root) for root in self.roots if below.has(root)))
        return frozenset(g for g, _ in factor_list(sp.numer(sp.together(below)))[1])

    def _base(self, root: sp.Symbol) -> sp.Expr:
        base, _ = self.roots[root]
        numerator, denominator = sp.fraction(sp.together(base))
        return numerator * denominator

    def _is_zero_at_points_only(self, factor: sp.Expr) -> bool:
        """Whether g(t), or whether g(x) = 0 for longer, so that ẋ = 0, would make a denominator zero."""
        moving = _moving(self._back(factor), self.symbols)
        kinds = [split_symbol(symbol.name) for symbol in moving]
        if moving == (self.symbols.time,):
            return True
        if len(moving) != 1 or kinds[0][0]:
            return False
        rest = self._at_rest(kinds[0][1])
        below = (factor_list(sp.expand(g.xreplace(rest)))[1] for g in self._excluded if g.has(*rest))
        return any(part in (factor, -factor) for parts in below for part, _ in parts)

    def _at_rest(self, function: str) -> Mapping[sp.Symbol, sp.Expr]:
        return {self.symbols.rate(function, order): sp.Integer(0) for order in range(1, 5)}

    def moves(self, value: sp.Expr) -> bool:
        """Whether it holds more than parameters."""
        return bool(_moving(self._back(value), self.symbols))

    def _sign(self, value: sp.Expr) -> int:
        """The sign that makes the factor of the highest rate positive for positive values of all symbols."""
        back = self._back(value)
        highest = max(back.free_symbols, key=lambda s: (_order(s), split_symbol(s.name)[1] == self.function, str(s)))
        leading = sp.expand(back).coeff(highest) if _order(highest) else sp.expand(back)
        places = {s: sp.Rational(7 + 2 * n, 10 + n) for n, s in enumerate(sorted(back.free_symbols, key=str))}
        value = sp.N(leading.subs(places))
        negative = value < 0 if value.is_extended_real else leading.could_extract_minus_sign()
        return -1 if negative else 1


def _is_large(expression: sp.Expr) -> bool:
    """Whether multiplying it out and factoring it may take seconds."""
    powers = (p.exp for p in expression.atoms(sp.Pow) if p.base.is_Add and p.exp.is_Rational)
    size = expression.count_ops() * len(expression.free_symbols)
    return bool(size > LARGEST or any(abs(exponent) > STEEPEST for exponent in powers))


def _divides(power: sp.Pow) -> bool:
    """Whether it is a root or stands in a denominator, and holds more than numbers."""
    return not (power.exp.is_Integer and power.exp > 0) and bool(power.base.free_symbols)


def _is_multiple_angle(part: sp.Basic) -> bool:
    """sin 2x hides the factors sin x and cos x."""
    return isinstance(part, sp.sin | sp.cos) and part.args[0].as_coeff_Mul()[0] in range(2, 5)


def _order(symbol: sp.Symbol) -> int:
    kind, _ = split_symbol(symbol.name)
    return ORDERS.get(kind, 0)
