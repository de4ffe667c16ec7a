"""The shortest way to write a polynomial that reads well: factored, or split by what its terms share.

A polynomial is its factorization (completed squares among them), or a sum after one split: its terms are gathered by
their rates, parameters, kernels or single generators, or by what hangs together, and each part is planned by itself.
Parts with the same cofactor are one: m₁ l² φ̇² + m₂ l² φ̇² is (m₁ + m₂) l² φ̇². The cheapest wins.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from operator import mul
from typing import TypeVar

from .plan import Plan, Powers, Prices, Product, Sum, expanded, in_whole_numbers
from .polynomial import Exponents, Kind, Poly, Shape, as_poly

MAX_TERMS = 160
TRIED = 2  # splits that are followed, of those that look shortest
SLACK = 2  # how much longer than the plain sum a split of many terms may look
FEW = 6  # terms of which every split may look longer
HIGHEST = 200  # degree up to which factors are looked for: of xⁿ − 1 with n a million it takes gigabytes
MAX_SINGLE = 8  # terms up to which each single generator is tried

KEPT = 1 << 12  # plans: sums that differ in their symbols alone share one, and large scenes have many of them
UNLIKE = "a plan is not the polynomial it was made for"

P = TypeVar("P", bound=Plan)
Terms = tuple[tuple[Exponents, int], ...]  # of a polynomial, in a fixed order
Key = frozenset[tuple[Exponents, int]]
Parts = dict[Key, tuple[Poly, Poly]]  # for each cofactor, what it is multiplied by, and the cofactor


class Planner:
    """Plans for the polynomials in generators of one shape; what was planned is kept."""

    def __init__(self, shape: Shape, budget: int = 150) -> None:
        self.prices = Prices(shape)
        self._shape = shape
        self._known: dict[Key, Plan] = {}
        self._left = budget
        self._moving = frozenset(i for i, g in enumerate(shape.generators) if g.moves)

    def plan(self, poly: Poly, denominator: int = 1, *, free: bool = False) -> Plan:
        """The plan of a polynomial that is not zero; `free`: a mass may go in front of anything."""
        if len(poly) == 1:
            ((exponents, number),) = poly.items()
            return self.prices.monomial(exponents, Fraction(number, denominator))
        number, common, primitive = split_off(poly)
        factor, powers = Fraction(number, denominator), _powers(common)
        free = free and any(self._shape.generators[i].kind == Kind.MASS for i, _ in powers)
        return self._scaled(self._primitive(primitive), factor, powers, free=free)

    def terms(self, poly: Poly, denominator: int = 1, *, apart: bool = False) -> tuple[Product, ...]:
        """The plan as terms of a sum; `apart`: one for each acceleration and product of rates, as inertia is."""
        if not apart:
            found = self.plan(poly, denominator)
            return found.terms if isinstance(found, Sum) else (found,)
        moving = self._shape.of_kinds(Kind.RATE, Kind.OUTER)
        return tuple(
            term
            for outer, inner in _grouped(poly, moving)
            for term in self._with_outer(self.plan(inner, denominator), _powers(outer))
        )

    def _with_outer(self, plan: Plan, outer: Powers) -> tuple[Product, ...]:
        found = self._scaled(plan, Fraction(1), outer, free=False)
        return found.terms if isinstance(found, Sum) else (found,)

    def single(self, poly: Poly, denominator: int = 1) -> tuple[Product, ...]:
        """Every term by itself."""
        return tuple(self.prices.monomial(exponents, Fraction(n, denominator)) for exponents, n in ordered(poly))

    def _scaled(self, plan: Plan, number: Fraction, powers: Powers, *, free: bool) -> Plan:
        if number == 1 and not powers:
            return plan
        if isinstance(plan, Product):
            return self.prices.times(plan, number, powers, free=free)
        bracketed = self.prices.product(number, powers, ((plan, 1),), free=free)
        spread = self.prices.sum(self.prices.times(term, number, powers) for term in plan.terms)
        return bracketed if bracketed.price <= spread.price else spread

    def _primitive(self, poly: Poly) -> Plan:
        key = frozenset(poly.items())
        found = self._known.get(key)
        if found is None:
            self._left -= 1
            found = self._known[key] = min(self._options(poly), key=lambda plan: plan.price)
        return found

    def _options(self, poly: Poly) -> Iterator[Plan]:
        yield self.prices.sum(self.prices.monomial(e, Fraction(n)) for e, n in ordered(poly))
        if self._left < 0:
            return
        factored = self._factored(poly)
        if factored is not None:
            yield factored
        for parts in self._worth_following(poly) if len(poly) > 2 else ():
            yield self._gathered(parts)

    def _worth_following(self, poly: Poly) -> list[Parts]:
        """What hangs together, in which squares may be hidden, and the splits that look shortest."""
        seen: set[frozenset[Key]] = set()
        apart = self._splits(poly, self._components(poly), seen)
        limit = self._plain(poly) + SLACK if len(poly) > FEW else math.inf
        estimated = ((self._estimate(parts), parts) for parts in self._splits(poly, self._groupings(poly), seen))
        others = sorted((each for each in estimated if each[0] < limit), key=lambda each: (each[0], len(each[1])))
        return [*apart, *(parts for _, parts in others[:TRIED])]

    def _factored(self, poly: Poly) -> Product | None:
        """The factors of a primitive polynomial, each a sum; None if it has none, or its degree is above HIGHEST."""
        if max(map(max, poly)) > HIGHEST:
            return None
        number, factors = self._shape.context.from_dict(poly).factor()
        if len(factors) == 1 and factors[0][1] == 1:
            return None
        total, brackets = Fraction(int(number)), []
        for factor, times in sorted(((as_poly(f), int(e)) for f, e in factors), key=lambda f: sorted(f[0].items())):
            content, _, primitive = split_off(factor)
            total *= Fraction(content) ** times
            inner = self._primitive(primitive)
            brackets.append((inner if isinstance(inner, Sum) else self.prices.sum((inner,)), times))
        return self.prices.product(total, (), tuple(brackets))

    def _splits(
        self, poly: Poly, groupings: Iterator[list[tuple[Exponents, Poly]]], seen: set[frozenset[Key]]
    ) -> Iterator[Parts]:
        """The groups of each grouping that have a cofactor in common, joined."""
        for groups in groupings:
            if not 1 < len(groups) < len(poly):
                continue
            parts = _by_cofactor(groups)
            shape = frozenset(parts)
            if shape not in seen:
                seen.add(shape)
                yield parts

    def _groupings(self, poly: Poly) -> Iterator[list[tuple[Exponents, Poly]]]:
        shape = self._shape
        used = frozenset(i for i, highest in enumerate(map(max, zip(*poly, strict=True))) if highest)
        rates = shape.of_kinds(Kind.RATE, Kind.OUTER)
        fixed = shape.of_kinds(Kind.MASS, Kind.PARAMETER)
        kinds = (
            rates,
            fixed,
            rates | fixed,
            shape.of_kinds(Kind.MASS),
            shape.of_kinds(Kind.KERNEL),
            shape.of_kinds(Kind.COORDINATE, Kind.WAVE, Kind.KERNEL),
        )
        single = (frozenset((i,)) for i in sorted(used)) if len(poly) <= MAX_SINGLE else ()
        for chosen in dict.fromkeys(part & used for part in (*kinds, *single)):
            if chosen and chosen != used:
                yield _grouped(poly, chosen)

    def _components(self, poly: Poly) -> Iterator[list[tuple[Exponents, Poly]]]:
        """The terms that hang together by what moves."""
        parts: list[tuple[set[int], Poly]] = []
        for exponents, number in sorted(poly.items()):
            moving = {i for i in self._moving if exponents[i]}
            touching = [part for part in parts if part[0] & moving]
            merged = {exponents: number}
            for names, terms in touching:
                moving |= names
                merged |= terms
            parts = [part for part in parts if part not in touching]
            parts.append((moving, merged))
        one = (0,) * len(self._shape.generators)
        if len(parts) > 1:
            yield [(one, terms) for _, terms in parts]

    def _estimate(self, parts: Parts) -> float:
        total = 0.0
        for multiplier, inner in parts.values():
            number = math.gcd(*multiplier.values())
            total += self._plain(multiplier) + (number != 1)
            total += self._plain(inner) + 1 if len(inner) > 1 else 0
        return total

    def _plain(self, poly: Poly) -> float:
        generators = self._shape.generators
        return sum(
            sum(1 + generators[i].operations(e) for i, e in enumerate(exponents) if e) for exponents in poly
        ) + len(poly)

    def _gathered(self, parts: Parts) -> Plan:
        terms: list[Product] = []
        for multiplier, inner in parts.values():
            if inner.keys() == {(0,) * len(self._shape.generators)}:
                terms += [self.prices.monomial(e, Fraction(n)) for e, n in ordered(multiplier)]
                continue
            terms += self._joined(self.plan(multiplier), self._primitive(inner))
        return self.prices.sum(terms) if len(terms) > 1 else terms[0]

    def _joined(self, outer: Plan, inner: Plan) -> list[Product]:
        """outer · inner as terms of a sum."""
        left = outer if isinstance(outer, Product) else self.prices.product(Fraction(1), (), ((outer, 1),))
        right = inner if isinstance(inner, Product) else self.prices.product(Fraction(1), (), ((inner, 1),))
        total = dict(left.powers)
        for i, e in right.powers:
            total[i] = total.get(i, 0) + e
        powers = tuple(sorted(total.items()))
        whole = self.prices.product(left.number * right.number, powers, left.brackets + right.brackets)
        if isinstance(outer, Product) and isinstance(inner, Sum):
            spread = [self.prices.times(term, outer.number, outer.powers) for term in inner.terms]
            bare = outer.number == 1 and not outer.powers
            if not outer.brackets and (bare or self.prices.sum(spread).price < whole.price):
                return spread
        return [whole]


@lru_cache(maxsize=KEPT)
def planned(shape: Shape, terms: Terms, denominator: int, *, free: bool = False) -> Plan:
    """The cheapest plan of a polynomial; of one in other symbols of the same kinds it is the same."""
    return _sound(Planner(shape).plan(dict(terms), denominator, free=free), shape, terms, denominator)


@lru_cache(maxsize=KEPT)
def planned_terms(shape: Shape, terms: Terms, denominator: int, *, apart: bool) -> tuple[Product, ...]:
    """The same as terms of a sum; `apart`: one for each acceleration and product of rates, as inertia is."""
    found = Planner(shape).terms(dict(terms), denominator, apart=apart)
    return _sound(Sum(found), shape, terms, denominator).terms


def _sound(plan: P, shape: Shape, terms: Terms, denominator: int) -> P:
    """What is shown is what was to be shown."""
    if expanded(plan, shape) != in_whole_numbers(dict(terms), denominator):
        raise ArithmeticError(UNLIKE)
    return plan


def _by_cofactor(groups: list[tuple[Exponents, Poly]]) -> Parts:
    parts: Parts = {}
    for outer, inner in groups:
        number, common, primitive = split_off(inner)
        multiplier, _ = parts.setdefault(frozenset(primitive.items()), ({}, primitive))
        key = tuple(map(int.__add__, outer, common))
        multiplier[key] = multiplier.get(key, 0) + number
    return parts


def split_off(poly: Poly) -> tuple[int, Exponents, Poly]:
    """Number, common monomial, and the rest: primitive, with a positive first coefficient where signs are even."""
    number = math.gcd(*poly.values())
    common = tuple(map(min, zip(*poly, strict=True)))
    negative = sum(c < 0 for c in poly.values())
    if 2 * negative > len(poly) or (2 * negative == len(poly) and poly[max(poly)] < 0):
        number = -number
    rest = {tuple(map(int.__sub__, exponents, common)): c // number for exponents, c in poly.items()}
    return number, common, rest


def ordered(poly: Poly) -> list[tuple[Exponents, int]]:
    """The terms in a fixed order."""
    return sorted(poly.items(), reverse=True)


def _grouped(poly: Poly, chosen: frozenset[int]) -> list[tuple[Exponents, Poly]]:
    """The coefficient of each product of the chosen generators."""
    groups: dict[Exponents, Poly] = {}
    taken = [int(i in chosen) for i in range(len(next(iter(poly))))]
    left = [1 - each for each in taken]
    for exponents, number in poly.items():
        outer = tuple(map(mul, exponents, taken))
        groups.setdefault(outer, {})[tuple(map(mul, exponents, left))] = number
    return sorted(groups.items(), reverse=True)


def _powers(exponents: Exponents) -> Powers:
    return tuple((i, e) for i, e in enumerate(exponents) if e)
