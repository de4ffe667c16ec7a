"""Where each term of a line comes from: terms of the line before it, and terms of the steps it rests on.

A line is a sum, and what is done to it is linear in each of its terms: they are derived, multiplied, integrated one by
one. So a term of the next line comes from those terms of the last one that have a product of its normal form in common
with it. Nothing but carrying each term out by itself is needed for that, whatever the law was (`normal_algebra`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import combinations, pairwise, repeat
from typing import Any, Protocol, TypeAlias

import sympy as sp

from . import formula as f
from .formula import Owners
from .premises import Names, Signature, concluded, signature
from .step import Change, Line, Origin, Relation, Step, Summand

Products: TypeAlias = Mapping[tuple[int, object], Any]  # coefficients by component and product
Rebuild: TypeAlias = Callable[[f.Formula], f.Formula]
DERIVATIVES = (f.Partial, f.Rate, f.Gateaux, f.Directional, f.LimitOfQuotient)
INTEGRALS = (f.Integral, f.MassIntegral)
ZERO = f.Explicit(sp.Integer(0))
MOST = 160  # terms of a line; longer ones are told as a whole


class Algebra(Protocol):
    """What is able to carry a formula out."""

    def products(self, formula: f.Formula) -> Products | None:
        """The normal form product by product; None if there is none."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """A term that may have become another.

    `carried_out` is what it is in the line that it stands in, `written` what it was where it was written, with `side`
    the sign that it had there on the left of an equation.
    """

    id: str
    carried_out: f.Formula
    written: f.Formula
    side: int = 1
    change: Change | None = None  # by the operation that is done to it
    sources: tuple[str, ...] = ()


Share: TypeAlias = tuple[Candidate, Products]


@dataclass(frozen=True)
class History:
    """Tells the lines of steps, one after the other; `known` are the terms of what earlier steps gave a value to."""

    algebra: Algebra
    names: Names = field(default_factory=Names)
    known: dict[Signature, tuple[Summand, ...]] = field(default_factory=dict)
    inside: dict[str, Owners] = field(default_factory=dict)  # by the ids of terms

    def lines(self, step: Step) -> tuple[tuple[Line, ...], ...]:
        """All members of all relations of the step, which have given a value to something from here on."""
        found = tuple(self._lines(step, number, relation) for number, relation in enumerate(step.relations))
        for relation, members in zip(step.relations, found, strict=True):
            self.known.update(self._learned(relation, members))
        return found

    def learned(self, step: Step) -> Iterator[Signature]:
        """What a step whose lines are told has given a value to."""
        for relation, members in zip(step.relations, step.lines, strict=True):
            yield from (name for name, _ in self._learned(relation, members))

    def _learned(
        self, relation: Relation, members: tuple[Line, ...]
    ) -> Iterator[tuple[Signature, tuple[Summand, ...]]]:
        """What the relation says that something is: its left side, and term by term what stands in a sum by name."""
        whole = self.names.join(concluded(relation))
        if whole is not None:
            yield whole, members[-1].terms
        for (named, first), (written, second) in pairwise(zip(relation.members, members, strict=True)):
            match named, written:
                case f.Plus(names), f.Plus(values) if (
                    len(names) == len(values) == len(second.terms) == len(first.terms)
                ):
                    for name, value, term in zip(names, values, second.terms, strict=True):
                        is_name = isinstance(name.formula, f.Named) and name.sign == value.sign == 1
                        if is_name and (signed := signature(name.formula)):
                            yield self.names.one(signed), (term,)

    def _lines(self, step: Step, number: int, relation: Relation) -> tuple[Line, ...]:
        found: list[Line] = []
        for place, member in enumerate(relation.members):
            terms = tuple(
                one.called(f"{step.id}/{number}.{place}.{index}") for index, one in enumerate(summands(member))
            )
            if place == 0 or relation.sign in ("≠", "<", "≤"):
                found.append(Line(self._started(terms, step.sources)))
                continue
            before = [*_as_candidates(found[-1].terms), *self._inside(found[-1].terms)]
            here = list(self._inside(terms))
            told = self._told(terms, before, here, {term.id for term in found[-1].terms})
            of_all = {one.id: one.sources for one in (*before, *here)}
            sourced = (_with_sources(term, of_all, step.sources) for term in told.terms)
            found.append(replace(told, terms=tuple(self._with_inside(term, (*before, *here)) for term in sourced)))
        return tuple(found)

    def _started(self, terms: tuple[Summand, ...], whole: tuple[str, ...]) -> tuple[Summand, ...]:
        """The terms of the first member: what they name comes from the steps that said what it is."""
        of_all = {one.id: one.sources for one in self._inside(terms)}
        return tuple(_with_sources(term.coming_from(self._named_in(term)), of_all, whole) for term in terms)

    def _named_in(self, term: Summand) -> tuple[Origin, ...]:
        """Every known term in it that is not zero there."""
        found = (one for one in self._inside((term,)) if self.algebra.products(one.carried_out) != {})
        return tuple(Origin(*pair) for pair in dict.fromkeys((one.id, one.change or "kept") for one in found))

    def _told(self, terms: tuple[Summand, ...], before: list[Candidate], here: list[Candidate], own: set[str]) -> Line:
        """The terms of a member with their origins."""
        if len(before) > MOST or len(terms) > MOST:
            return Line(terms)
        if len(before) == 1 and not here:
            (only,) = before
            return Line(tuple(term.coming_from((Origin(only.id, only.change or "expanded"),)) for term in terms))
        carried = {one: self.algebra.products(one.carried_out) for one in (*before, *here)}
        told, used = [], set[str]()
        for term in terms:
            origins = tuple(self._matching(term, carried, own))
            used |= {origin.term for origin in origins}
            told.append(term.coming_from(origins))
        lost = dict.fromkeys(one.id for one in before if carried[one] and one.id not in used)
        return Line(tuple(told), tuple(lost) if all(term.origins for term in told) else ())

    def came_from(self, terms: Iterable[Summand], before: tuple[Candidate, ...]) -> tuple[tuple[Origin, ...], ...]:
        """Of each term of a sum, which of the candidates it comes from."""
        carried, own = {one: self.algebra.products(one.carried_out) for one in before}, {one.id for one in before}
        return tuple(tuple(self._matching(term, carried, own)) for term in terms)

    def _matching(self, term: Summand, carried: Mapping[Candidate, Products | None], own: set[str]) -> Iterator[Origin]:
        """The candidates that have a product in common with the term, each with what became of it.

        Where no normal form shows them, as when fractions are brought together, all terms of the line before are.
        """
        products = self.algebra.products(term.alone)
        shares = [
            (one, found) for one, found in carried.items() if products and found and found.keys() & products.keys()
        ]
        sharing = _left_over(products or {}, _of_like_sources(term, shares))
        if not sharing:
            whole = [one for one in carried if one.id in own and carried[one] != {} and products != {}]
            several = len({one.id for one in whole}) > 1
            yield from (Origin(one.id, one.change or ("merged" if several else "expanded")) for one in whole)
            return
        told: dict[str, Change] = {}
        for one in sharing:
            alike = {other.id for other in sharing if (other.id in own) == (one.id in own)}
            told.setdefault(one.id, one.change or self._change(one, term, several=len(alike) > 1))
        yield from (Origin(name, change) for name, change in told.items())

    def _with_inside(self, term: Summand, candidates: tuple[Candidate, ...]) -> Summand:
        """With the bodies and loads of what stands in its brackets, where it has several."""
        if (
            len(term.sources) < 2
            or not isinstance(term.shown, f.Explicit)
            or isinstance(term.shown.value, sp.MatrixBase)
        ):
            return term
        own = {origin.term for origin in term.origins}
        shares = [(one, self.algebra.products(one.carried_out) or {}) for one in candidates if one.id in own]
        brackets = tuple(_brackets(term.shown.value))
        found = (self._bracket(term, *pair, shares) for pair in brackets)
        told = tuple(pair for pair in found if len({sources for _, sources in pair[1]}) > 1)
        before = (pair for name in own for pair in self.inside.get(name, ()))
        inside = told or tuple(pair for pair in before if pair[0] in {bracket for bracket, _ in brackets})
        self.inside[term.id] = inside
        return replace(term, inside=inside)

    def _bracket(
        self, term: Summand, bracket: sp.Expr, rest: sp.Expr, shares: list[tuple[Candidate, Products]]
    ) -> tuple[sp.Expr, tuple[tuple[sp.Expr, tuple[str, ...]], ...]]:
        """Each summand of a bracket with the sources of the candidates that have its products; else those of all."""
        found = []
        for part in bracket.args:
            products = self.algebra.products(f.Explicit(part * rest)) or {}
            holding = [one.sources for one, share in shares if share.keys() & products.keys()]
            several = [sources for sources in holding if set(sources) < set(term.sources)]
            names = {source for sources in several for source in sources}
            found.append((part, tuple(source for source in term.sources if source in names) or term.sources))
        return bracket, tuple(found)

    def _change(self, one: Candidate, term: Summand, *, several: bool) -> Change:
        """What became of a term that was not derived or integrated: whether it is written as it was before."""
        before, after = self.algebra.products(one.written) or {}, self.algebra.products(term.alone) or {}
        ways: tuple[tuple[int, Change], ...] = ((one.side * term.side, "kept"), (-one.side * term.side, "sign-turned"))
        for sign, change in ways:
            if before.keys() == after.keys() and all(number == sign * after[key] for key, number in before.items()):
                return change
        return "merged" if several else "expanded"

    def _inside(self, terms: tuple[Summand, ...]) -> Iterator[Candidate]:
        """The known terms of what the terms name, each put in the place of the whole."""
        for term in terms:
            for name, rebuild, change in self._occurrences(term.alone):
                for one in self.known[name]:
                    yield Candidate(one.id, rebuild(one.alone), one.alone, one.side, change, one.sources)

    def _occurrences(self, formula: f.Formula) -> Iterator[tuple[Signature, Rebuild, Change | None]]:
        """All that is known by a name, how to put something in its place, and what is done to it there."""
        name = signature(formula)
        if name is not None and self.names.one(name) in self.known:
            yield self.names.one(name), _itself, None
            return
        change = _done_by(formula)
        for part, rebuild in _linear_parts(formula):
            for inner, build, below in self._occurrences(part):
                yield inner, _nested(rebuild, build), change or below


def _as_candidates(terms: tuple[Summand, ...]) -> Iterator[Candidate]:
    for term in terms:
        yield Candidate(term.id, term.alone, term.alone, term.side, _operation(term.shown), term.sources)


def _brackets(value: sp.Expr) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """The sums among the factors of a product, each with what it is multiplied by."""
    factors = sp.Mul.make_args(value)
    for place, factor in enumerate(factors):
        base, exponent = factor.as_base_exp()
        if base.is_Add and exponent.is_Integer and exponent > 0:
            others = (*factors[:place], *factors[place + 1 :])
            yield base, sp.Mul(*others, base ** (exponent - 1))


def _of_like_sources(term: Summand, shares: list[Share]) -> list[Share]:
    """Those that bodies and loads of the term are in; all, if there are none of that kind."""
    kinds = ("body", "load")
    alike = [share for share in shares if all(_overlap(kind, share[0].sources, term.sources) for kind in kinds)]
    return alike or shares


def _overlap(kind: str, *sources: tuple[str, ...]) -> bool:
    """Whether two have bodies, or loads, in common; also where one of them has none."""
    one, other = ({source for source in names if source.startswith(kind)} for names in sources)
    return not one or not other or bool(one & other)


def _left_over(term: Products, shares: list[Share]) -> list[Candidate]:
    """Those of which something is left in the term: what two of them have with opposite signs is in neither."""
    parts = [{key: found[key] for key in term if key in found} for _, found in shares]
    gone = set[int]()
    for one, other in combinations(range(len(parts)), 2):
        if gone.isdisjoint((one, other)) and _is_opposite(parts[one], parts[other]):
            gone |= {one, other}
    left = [one for place, (one, _) in enumerate(shares) if place not in gone]
    return left or [one for one, _ in shares]


def _is_opposite(one: Products, other: Products) -> bool:
    return one.keys() == other.keys() and all(number == -other[key] for key, number in one.items())


def _with_sources(term: Summand, of_all: Mapping[str, tuple[str, ...]], whole: tuple[str, ...]) -> Summand:
    """With the bodies and loads of the terms that it comes from, unless it has its own.

    What a step says of one load is the load's. Where the line before is a single term, as a name is, earlier steps tell
    more of it.
    """
    if term.sources or (len(whole) == 1 and whole[0].startswith("load:")):
        return replace(term, sources=term.sources or whole)
    step = term.id.rpartition("/")[0]
    before = [of_all.get(o.term, ()) for o in term.origins if o.term.rpartition("/")[0] == step]
    earlier = {source for o in term.origins if o.term.rpartition("/")[0] != step for source in of_all.get(o.term, ())}
    found = {source for sources in before for source in sources}
    if len(before) <= 1:
        found = found & earlier or earlier or found
    ranked = dict.fromkeys((*whole, *sorted(found)))
    found = found or set(whole if len(whole) == 1 and before else ())
    return replace(term, sources=tuple(source for source in ranked if source in found))


def _done_by(formula: f.Formula) -> Change | None:
    """What an operation does to the terms in it."""
    if isinstance(formula, DERIVATIVES):
        return "differentiated"
    return "integrated" if isinstance(formula, INTEGRALS) else None


def _operation(formula: f.Formula) -> Change | None:
    """What is still to be done to a term as it is written."""
    below = (_operation(part) for part, _ in _linear_parts(formula))
    return _done_by(formula) or next(filter(None, below), None)


def summands(formula: f.Formula) -> Iterator[Summand]:  # noqa: C901 - one case for each kind
    """The terms of a line as they are written, with the line in which they stand alone."""
    match formula:
        case f.Plus(terms):
            for term in terms:
                if not _is_zero(term.formula):
                    yield Summand("", term.formula, f.Plus((term,)), term.sign, 1, term.sources)
        case f.Equation(left, right):
            yield from (one for one in summands(left) if not _is_zero(one.shown))
            for one in summands(right):
                if not _is_zero(one.shown):
                    yield replace(one, alone=_negative(one.alone), side=-1)
        case f.Explicit(value) if isinstance(value, sp.MatrixBase):
            yield from _entries(formula)
        case f.Explicit(value) if isinstance(value, sp.Add):
            yield from (Summand("", *_signed(part)) for part in value.args)
        case f.Integral(of, material):
            yield from (replace(one, alone=f.Integral(one.alone, material)) for one in summands(of))
        case f.AtTime(of, time):
            yield from (replace(one, alone=f.AtTime(one.alone, time)) for one in summands(of))
        case _:
            yield Summand("", formula, formula)


def with_inside(formula: f.Formula, terms: tuple[Summand, ...]) -> f.Formula:
    """The line, in whose brackets each summand is told apart where `inside` of its terms does."""
    inside = tuple(pair for term in terms for pair in term.inside)
    if not inside:
        return formula
    match formula:
        case f.Explicit(value, owners):
            return f.Explicit(value, (*owners, *inside))
        case f.Plus(parts):
            return f.Plus(tuple(replace(part, formula=with_inside(part.formula, terms)) for part in parts))
        case f.Equation(left, right):
            return f.Equation(with_inside(left, terms), with_inside(right, terms))
    return formula


def with_names(formula: f.Formula, names: Iterator[str]) -> f.Formula:  # noqa: PLR0911 - one case for each kind
    """The line with a class for each of its `summands`, in their order, where it is a sum as it is written."""
    match formula:
        case f.Plus(terms):
            return f.Plus(tuple(_with_role(term, names) for term in terms))
        case f.Equation(left, right):
            return f.Equation(
                with_names(left, _unless_zero(left, names)), with_names(right, _unless_zero(right, names))
            )
        case f.Explicit(value, owners) if isinstance(value, sp.MatrixBase):
            entries = [(entry, tuple(part for part in sp.Add.make_args(entry) if part != 0)) for entry in formula.parts]
            named = [(entry, tuple((part, (next(names),)) for part in parts)) for entry, parts in entries]
            return f.Explicit(value, (*owners, *(pair for pair in named if len(pair[1]) > 1)))
        case f.Explicit(value, owners) if isinstance(value, sp.Add):
            return f.Explicit(value, (*owners, (value, tuple((part, (next(names),)) for part in value.args))))
        case f.Integral(of, material):
            return f.Integral(with_names(of, names), material)
        case f.AtTime(of, time):
            return f.AtTime(with_names(of, names), time)
        case _:
            next(names)
            return formula


def _with_role(term: f.Term, names: Iterator[str]) -> f.Term:
    if _is_zero(term.formula):
        return term
    return replace(term, role=f"{term.role} {next(names)}".strip())


def _unless_zero(side: f.Formula, names: Iterator[str]) -> Iterator[str]:
    """A side that is 0 has no term, and takes no name."""
    return repeat("") if _is_zero(side) else names


def _entries(matrix: f.Explicit) -> Iterator[Summand]:
    """Row by row; alone a term stands among zeros."""
    zeros = (ZERO,) * len(matrix.parts)
    for place, entry in enumerate(matrix.parts):
        for part in sp.Add.make_args(entry):
            if part != 0:
                shown, alone, sign = _signed(part)
                yield Summand("", shown, f.Stack((*zeros[:place], alone, *zeros[place + 1 :])), sign)


def _signed(part: sp.Expr) -> tuple[f.Formula, f.Formula, int]:
    """A term without its sign, as it stands, and the sign."""
    negative = part.could_extract_minus_sign()
    return f.Explicit(-part if negative else part), f.Explicit(part), -1 if negative else 1


def _is_zero(formula: f.Formula) -> bool:
    return isinstance(formula, f.Explicit) and formula.value == 0


def _negative(formula: f.Formula) -> f.Formula:
    return f.Plus((f.minus(formula),))


def _itself(formula: f.Formula) -> f.Formula:
    return formula


def _nested(outer: Rebuild, inner: Rebuild) -> Rebuild:
    return lambda other: outer(inner(other))


def _linear_parts(formula: f.Formula) -> Iterator[tuple[f.Formula, Rebuild]]:  # noqa: C901 - one case for each kind
    """The formulas inside in which this one is linear, and this one with another in the place of each.

    In a sum the other terms are left out: they say nothing of this one.
    """
    match formula:
        case f.Plus(terms):
            yield from ((term.formula, partial(_sum_of, term)) for term in terms)
        case f.Times(factors):
            yield from ((factor, partial(_among, f.Times, factors, place)) for place, factor in enumerate(factors))
        case f.Stack(rows):
            zeros = (ZERO,) * len(rows)
            yield from ((row, partial(_among, f.Stack, zeros, place)) for place, row in enumerate(rows))
        case f.Dot(left, right):
            yield left, lambda other: f.Dot(other, right)
            yield right, lambda other: f.Dot(left, other)
        case f.Equation(left, right):
            yield left, _itself
            yield right, _negative
        case f.MatrixTimes(matrix, vector):
            yield matrix, lambda other: f.MatrixTimes(other, vector)
            yield vector, lambda other: f.MatrixTimes(matrix, other)
        case f.Summed(_, terms):
            yield from ((term, _itself) for term in terms)
        case f.Partial(of) | f.Rate(of) | f.Gateaux(of) | f.Integral(of) | f.AtTime(of) | f.Boundary(of):
            yield of, lambda other: replace(formula, of=other)
        case f.Directional(of) | f.LimitOfQuotient(of) | f.MassIntegral(of) | f.Jacobian(of):
            yield of, lambda other: replace(formula, of=other)
        case f.Substituted(of) | f.Called(_, of):
            yield of, lambda other: replace(formula, of=other)


def _sum_of(term: f.Term, other: f.Formula) -> f.Formula:
    return f.Plus((replace(term, formula=other),))


def _among(
    kind: Callable[[tuple[f.Formula, ...]], f.Formula], others: tuple[f.Formula, ...], place: int, one: f.Formula
) -> f.Formula:
    """A product or a column with another formula in one place."""
    return kind((*others[:place], one, *others[place + 1 :]))
