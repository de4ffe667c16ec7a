"""A formula as it will be written: products of numbers, powers and brackets, and sums of these.

A plan is a tree of its own, since the computer algebra would multiply 2 (a + b) out. Its price is the number of its
operations and what speaks against it by habit: a bracket that mixes masses with rates is short, and no book prints it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeAlias

from .polynomial import Exponents, Kind, Poly, Shape

Powers = tuple[tuple[int, int], ...]

# What a bracket costs besides its operations.
OF_PARAMETERS, OF_OTHERS, NESTED = 0.25, 0.75, 1.0
MASSES_WITH_RATES, MASSES_WITH_PLACES, UNEQUAL_DEGREES = 2.0, 1.5, 0.5
RATES_AGAIN, ACCELERATION_AGAIN = 2.0, 3.5
HORNER = 2.0  # (a x + b y) x for a x² + b x y


@dataclass(frozen=True)
class Product:
    """number · Π generatorᵉ · Π (sum)ᵉ"""

    number: Fraction
    powers: Powers
    brackets: tuple[tuple[Sum, int], ...] = ()
    price: float = field(default=0, compare=False)


@dataclass(frozen=True)
class Sum:
    """Two terms or more."""

    terms: tuple[Product, ...]
    price: float = field(default=0, compare=False)


Plan: TypeAlias = Product | Sum


@dataclass(frozen=True, eq=False)
class Prices:
    """Makes plans and says what they cost."""

    shape: Shape

    def product(
        self, number: Fraction, powers: Powers, brackets: tuple[tuple[Sum, int], ...] = (), *, free: bool = False
    ) -> Product:
        """A product; `free` is the common factor of an energy, whose bracket may hold anything."""
        generators = self.shape.generators
        below = sum(generators[i].unit < 0 for i, _ in powers)
        factors = len(powers) + len(brackets) + (abs(number) != 1)
        alone = bool(below) and below == len(powers) and not brackets and abs(number.numerator) == 1
        price = float(max(factors - 1, 0) + alone + sum(generators[i].operations(e) for i, e in powers))
        outside = frozenset(i for i, _ in powers)
        for inner, e in brackets:
            habit = 0.0 if free else self._habit(inner, outside)
            price += inner.price + (e != 1) + habit
        return Product(number, powers, brackets, price)

    def sum(self, terms: Iterable[Product]) -> Sum:
        """A sum, in the order of its terms."""
        parts = tuple(terms)
        price = len(parts) - 1 + sum(part.price for part in parts) + self._repeated(parts)
        return Sum(parts, price)

    def monomial(self, exponents: Exponents, number: Fraction) -> Product:
        """A single term."""
        return self.product(number, tuple((i, e) for i, e in enumerate(exponents) if e))

    def times(self, plan: Product, number: Fraction, powers: Powers, *, free: bool = False) -> Product:
        """A product with further factors."""
        if number == 1 and not powers:
            return plan
        total = Counter(dict(plan.powers))
        for i, e in powers:
            total[i] += e
        return self.product(plan.number * number, tuple(sorted(total.items())), plan.brackets, free=free)

    def _habit(self, inner: Sum, outside: frozenset[int]) -> float:
        """What speaks against a bracket: who is in it together, and how deep it is."""
        kinds = [self._kinds(term) for term in inner.terms]
        held = set().union(*kinds)
        still = held <= {Kind.MASS, Kind.PARAMETER}
        price = OF_PARAMETERS if still else OF_OTHERS
        price += NESTED * any(term.brackets for term in inner.terms)
        moving = bool(held & {Kind.RATE, Kind.OUTER})
        if Kind.MASS in held and moving:
            price += MASSES_WITH_RATES
        elif Kind.MASS in held and not still and not any(self._is_fast(i) for i in outside):
            price += MASSES_WITH_PLACES
        inside = [frozenset(i for i, _ in term.powers) for term in inner.terms]
        if any(self._is_variable(i) and any(i in term for term in inside) for i in outside):
            price += HORNER
        if moving and len({self._degree(term) for term in inner.terms}) > 1:
            price += UNEQUAL_DEGREES
        return price

    def _is_fast(self, index: int) -> bool:
        return self.shape.generators[index].kind in (Kind.RATE, Kind.OUTER)

    def _is_variable(self, index: int) -> bool:
        return self.shape.generators[index].kind in (Kind.COORDINATE, Kind.RATE)

    def _kinds(self, term: Product) -> set[Kind]:
        own = {self.shape.generators[i].kind for i, _ in term.powers}
        return own.union(*(self._kinds(part) for inner, _ in term.brackets for part in inner.terms))

    def _degree(self, term: Product) -> int:
        kinds = (Kind.RATE, Kind.OUTER)
        return sum(e for i, e in term.powers if self.shape.generators[i].kind in kinds)

    def _repeated(self, terms: tuple[Product, ...]) -> float:
        """Against the same product of rates in several terms, and more so against the same acceleration."""
        rates = Counter(self._of_kind(term, Kind.RATE) for term in terms)
        outer = Counter(self._of_kind(term, Kind.OUTER) for term in terms)
        for term in terms:
            rates.update({powers for powers in self._inner_rates(term) if powers} - {self._of_kind(term, Kind.RATE)})
        again = RATES_AGAIN * sum(n - 1 for powers, n in rates.items() if powers)
        return again + ACCELERATION_AGAIN * sum(n - 1 for powers, n in outer.items() if powers)

    def _inner_rates(self, term: Product) -> Iterator[Powers]:
        """The products of rates that a term would have multiplied out, if it has a single plain bracket."""
        if len(term.brackets) != 1 or term.brackets[0][1] != 1 or self._of_kind(term, Kind.RATE):
            return
        yield from (self._of_kind(part, Kind.RATE) for part in term.brackets[0][0].terms if not part.brackets)

    def _of_kind(self, term: Product, kind: Kind) -> Powers:
        return tuple((i, e) for i, e in term.powers if self.shape.generators[i].kind == kind)


def expanded(plan: Plan, shape: Shape) -> dict[Exponents, Fraction]:
    """The plan multiplied out."""
    if isinstance(plan, Sum):
        total: dict[Exponents, Fraction] = {}
        for term in plan.terms:
            for key, number in expanded(term, shape).items():
                total[key] = total.get(key, Fraction(0)) + number
        return {key: number for key, number in total.items() if number}
    start = [0] * len(shape.generators)
    for i, e in plan.powers:
        start[i] = e
    product = {tuple(start): plan.number}
    for inner, e in plan.brackets:
        factor = expanded(inner, shape)
        for _ in range(e):
            product = _times(product, factor)
    return product


def _times(left: dict[Exponents, Fraction], right: dict[Exponents, Fraction]) -> dict[Exponents, Fraction]:
    total: dict[Exponents, Fraction] = {}
    for a, x in left.items():
        for b, y in right.items():
            key = tuple(map(int.__add__, a, b))
            total[key] = total.get(key, Fraction(0)) + x * y
    return {key: number for key, number in total.items() if number}


def in_whole_numbers(poly: Poly, denominator: int) -> dict[Exponents, Fraction]:
    """A polynomial over its denominator, as `expanded` gives it."""
    return {key: Fraction(number, denominator) for key, number in poly.items()}
