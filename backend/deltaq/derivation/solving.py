"""All real solutions of equations in several unknowns, as far as they can be had, and a word on what was searched.

Equations are split at their factors, unknowns that one of them holds linearly are eliminated, both without loss; an
equation in one unknown that is algebraic in it, or in its sine and cosine, is solved completely. What is left is
searched by subdivision with interval Newton steps, angles over one turn and others over a given range, within a budget.
Solutions that are not isolated are told by one of them, with the unknowns that may have any value near it.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice

import sympy as sp
from flint import arb

from ..errors import ExpressionError
from ..language.derivatives import diff
from .compiled import compiled_together
from .enclosure import Box, Budget, Enclosed, enclosed
from .factoring import factor_list
from .newton import ITERATIONS, Row, root, step_of
from .program import number
from .univariate import real_zeros

LONGEST = 120  # operations in an equation that is worth a factorization
BRANCHES = 24  # of one system: more factors than that are not followed
MOST_UNKNOWNS = 6  # of a search by subdivision
MOST_STARTS = 24
MOST_CROSSINGS = 8  # of branches of a family that are looked at before a root that stands for it is given up
SMALL = 1e-8  # of the size of its terms: what is below it solves an equation
SHIFT = 0.0173  # a turn is searched from −π − SHIFT on, so that π is not at its end
DEGENERATE = 1e-7  # pivots, relative to the largest
BESIDE = 1e-2  # of a range: how far around a multiple root nothing can be decided
NEXT = 1e-4  # of a range: undecided boxes that are as near to one another make one cluster
FAR = 1e3  # times the size of the starts: there a force only fades away

Values = dict[sp.Symbol, float]


@dataclass(frozen=True)
class Domain:
    """Where unknowns are searched: `ranges` are those of lengths and the like; angles go once around."""

    ranges: Mapping[sp.Symbol, tuple[float, float]]
    angles: frozenset[sp.Symbol]
    starts: Mapping[sp.Symbol, sp.Rational]

    def box(self, unknowns: Sequence[sp.Symbol]) -> Box:
        """The box of these unknowns."""
        turn = (-math.pi - SHIFT, math.pi - SHIFT)
        return tuple(turn if q in self.angles else self.ranges[q] for q in unknowns)


@dataclass(frozen=True)
class Solution:
    """Numbers of all unknowns; near them those in `free` may have any value. `equations` are those it is a root of."""

    values: Mapping[sp.Symbol, float]
    free: tuple[sp.Symbol, ...] = ()
    equations: tuple[sp.Expr, ...] = ()


@dataclass(frozen=True)
class Solutions:
    """What was found, whether that is all of it, and which unknowns were searched in their range only."""

    found: tuple[Solution, ...] = ()
    complete: bool = True
    ranged: frozenset[sp.Symbol] = frozenset()

    def __add__(self, other: Solutions) -> Solutions:
        return Solutions((*self.found, *other.found), self.complete and other.complete, self.ranged | other.ranged)


@dataclass
class Solver:
    """Solves systems of equations whose parameters are numbers already."""

    domain: Domain
    is_zero: Callable[[sp.Expr], bool]
    budget: Budget
    branches: int = field(default=BRANCHES)

    def solve(self, equations: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol]) -> Solutions:
        """All solutions, each once, isolated ones of a family within it."""
        found = self._solve(tuple(equations), tuple(unknowns))
        real = [each for each in found.found if _solves(equations, each.values)]
        return replace(found, found=tuple(_distinct(real, self.domain.angles)))

    def _solve(self, equations: tuple[sp.Expr, ...], unknowns: tuple[sp.Symbol, ...]) -> Solutions:
        left = self._remaining(equations)
        if left is None or any(not e.has(*unknowns) for e in left) or (left and not unknowns):
            return Solutions()
        absent = tuple(q for q in unknowns if not any(e.has(q) for e in left))
        if absent:
            there = {q: float(self.domain.starts[q]) for q in absent}
            rest = (
                self._solve(left, tuple(q for q in unknowns if q not in absent)) if left else Solutions((Solution({}),))
            )
            return replace(
                rest,
                found=tuple(
                    Solution({**there, **each.values}, (*absent, *each.free), each.equations) for each in rest.found
                ),
            )
        return self._split(left, unknowns) or self._eliminated(left, unknowns) or self._searched(left, unknowns)

    def _remaining(self, equations: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...] | None:
        """The equations that do not hold anyway; None if one has no value anywhere, so that nothing solves it.

        A spring's force where what was put in makes its ends meet is divided by a length that is zero for good.
        """
        try:
            return tuple(e for e in equations if not (e == 0 or self.is_zero(e)))
        except ExpressionError:
            return None

    def _split(self, equations: tuple[sp.Expr, ...], unknowns: tuple[sp.Symbol, ...]) -> Solutions | None:
        """The solutions for each factor of an equation; None if there is but one."""
        parts = [_factors(e, unknowns) for e in equations]
        if any(not each for each in parts):
            return Solutions()
        several = next((each for each in parts if len(each) > 1), None)
        if several is None:
            simple = tuple(each[0] for each in parts)
            return (
                None if simple == equations else self._eliminated(simple, unknowns) or self._searched(simple, unknowns)
            )
        total = Solutions()
        for factor in several:
            self.branches -= 1
            if self.branches < 0:
                return replace(total, complete=False)
            others = [sp.Mul(*each) for each in parts if factor not in each]
            total += self._solve((factor, *others), unknowns)
        return total

    def _eliminated(self, equations: tuple[sp.Expr, ...], unknowns: tuple[sp.Symbol, ...]) -> Solutions | None:
        """The solutions of the other equations, and what follows of an unknown that one holds linearly."""
        for q in reversed(unknowns):
            for index, equation in enumerate(equations):
                slope = diff(equation, q).expand() if equation.has(q) else sp.Integer(0)
                if slope == 0 or slope.has(*unknowns) or not slope.is_number:
                    continue
                value = (-equation.xreplace({q: sp.Integer(0)}) / slope).expand()
                others = tuple(e.xreplace({q: value}) for i, e in enumerate(equations) if i != index)
                rest = tuple(each for each in unknowns if each != q)
                known = self._solve(others, rest) if rest else self._constants(others)
                made = ((each, _value(value, each.values)) for each in known.found)
                return replace(
                    known,
                    found=tuple(
                        Solution({**each.values, q: there}, each.free, (*each.equations, equation))
                        for each, there in made
                        if math.isfinite(there)
                    ),
                )
        return None

    def _constants(self, equations: tuple[sp.Expr, ...]) -> Solutions:
        return Solutions((Solution({}),)) if self._remaining(equations) == () else Solutions()

    def _searched(self, equations: tuple[sp.Expr, ...], unknowns: tuple[sp.Symbol, ...]) -> Solutions:
        if len(equations) < len(unknowns):
            return self._family(equations, unknowns)
        if len(unknowns) == 1:
            known = next(filter(None, (self._exactly(e, unknowns[0]) for e in equations)), None)
            if known is not None:
                return known
        chosen = equations[: len(unknowns)]
        if len(unknowns) > MOST_UNKNOWNS:
            return self._by_newton(chosen, unknowns, complete=False)
        found = enclosed(chosen, unknowns, self.domain.box(unknowns), self.budget)
        ranged = frozenset(unknowns) - self.domain.angles
        solutions = [Solution(self._turned(unknowns, root), (), chosen) for root in found.roots]
        solutions += [_flat(box, unknowns, chosen) for box in _joined(found)]
        more = self._by_newton(chosen, unknowns, complete=found.complete, near=self._apart(found.undecided, unknowns))
        return Solutions((*solutions, *more.found), more.complete, ranged)

    def _turned(self, unknowns: tuple[sp.Symbol, ...], root: Sequence[float]) -> Values:
        """A root of the box, its angles in (−π, π]."""
        pairs = zip(unknowns, root, strict=True)
        return {q: turned(x) if q in self.domain.angles else x for q, x in pairs}

    def _apart(self, points: Sequence[Sequence[float]], unknowns: tuple[sp.Symbol, ...]) -> list[Sequence[float]]:
        """One for each cluster of points."""
        widths = [NEXT * (high - low) for low, high in self.domain.box(unknowns)]
        kept: list[Sequence[float]] = []
        for point in points:
            if not any(all(map(_is_within, point, other, widths)) for other in kept):
                kept.append(point)
        return kept

    def _exactly(self, equation: sp.Expr, q: sp.Symbol) -> Solutions | None:
        zeros = real_zeros(equation, q, is_angle=q in self.domain.angles)
        if zeros is None:
            return None
        return Solutions(tuple(Solution({q: value}, (), (zeros.equation,)) for value in zeros.values))

    def _by_newton(
        self,
        equations: tuple[sp.Expr, ...],
        unknowns: tuple[sp.Symbol, ...],
        *,
        complete: bool,
        near: Sequence[Sequence[float]] = (),
    ) -> Solutions:
        """Roots from what subdivision left undecided; from starts all over the box where it was not complete."""
        newton = Newton(equations, unknowns, self.domain)
        starts = [] if complete else list(newton.starts())
        found: list[Solution] = []
        lost: list[Sequence[float]] = []
        for start in (*near, *starts):
            if len(unknowns) > MOST_UNKNOWNS and not self.budget.pays(newton.cost):
                break
            there = newton.root(start)
            if there is not None:
                free = newton.free(there)
                snapped = None if free or start not in near else self._snapped(equations, there)
                found.append(Solution(snapped or there, free, equations))
            elif start in near and not newton.is_singular(start):
                lost.append(start)
        distinct = _distinct(found, self.domain.angles)
        decided = all(any(self._is_beside(unknowns, start, each) for each in distinct) for start in lost)
        isolated = not any(each.free for each in distinct)
        return Solutions(tuple(distinct), complete and decided and isolated, frozenset(unknowns) - self.domain.angles)

    def _is_beside(self, unknowns: tuple[sp.Symbol, ...], point: Sequence[float], solution: Solution) -> bool:
        """Whether an undecided point belongs to a solution that was found next to it."""
        box = self.domain.box(unknowns)
        return all(
            abs(x - solution.values[q]) <= BESIDE * (high - low)
            or (
                q in self.domain.angles
                and abs(math.remainder(x - solution.values[q], 2 * math.pi)) <= BESIDE * 2 * math.pi
            )
            for q, x, (low, high) in zip(unknowns, point, box, strict=True)
        )

    def _snapped(self, equations: tuple[sp.Expr, ...], root: Values) -> Values | None:
        """A multiple root, which floats find to half their digits, at round numbers if these solve the equations."""
        guess = {q: _round(x, angle=q in self.domain.angles) for q, x in root.items()}
        left = self._remaining(tuple(e.xreplace(guess) for e in equations))
        return {q: float(x) for q, x in guess.items()} if left == () else None

    def _family(self, equations: tuple[sp.Expr, ...], unknowns: tuple[sp.Symbol, ...]) -> Solutions:
        """One solution that stands for all of fewer equations than unknowns.

        Where J loses its rank, branches of the family cross, and no unknown may be chosen: such a root stands for none
        but itself.
        """
        newton = Newton(equations, unknowns, self.domain)
        roots = (each for each in map(newton.root, newton.starts()) if each is not None)
        crossings: list[Solution] = []
        for there in islice(roots, MOST_CROSSINGS):
            found = Solution(there, newton.free(there), equations)
            if len(found.free) >= len(unknowns) - len(equations):
                return Solutions((found,))
            crossings.append(found)
        return Solutions(tuple(crossings[:1]), complete=False)


class Newton:
    """Newton's method, damped, for equations in unknowns; it also finds roots that are not isolated."""

    def __init__(self, equations: tuple[sp.Expr, ...], unknowns: tuple[sp.Symbol, ...], domain: Domain) -> None:
        slots = {q: slot for slot, q in enumerate(unknowns)}
        self.unknowns, self.domain, self.size = unknowns, domain, len(unknowns)
        self.field = compiled_together(equations, slots)
        held = [(row, q) for row, e in enumerate(equations) for q in unknowns if q in e.free_symbols]
        slopes = [(row, slots[q], diff(equations[row], q)) for row, q in held]
        self.places = [(row, column) for row, column, slope in slopes if slope != 0]
        self.entries = compiled_together([slope for _, _, slope in slopes if slope != 0], slots)
        self.count = len(equations)
        self.cost = ITERATIONS * self.size**2  # of a start, where most of J is zero
        values = [self.field(start) for start in self.starts()]
        self.scale = max((math.hypot(*v) for v in values if all(map(math.isfinite, v))), default=1.0)

    def slopes(self, x: Sequence[float]) -> list[Row]:
        """J by rows, what is not zero."""
        rows: list[Row] = [{} for _ in range(self.count)]
        for (row, column), entry in zip(self.places, self.entries(x), strict=True):
            rows[row][column] = entry
        return rows

    def starts(self) -> Iterator[list[float]]:
        """Points of the box, the first ones near where the scene starts; the same for every call."""
        source = random.Random(1)
        yield [float(self.domain.starts[q]) + 0.1 for q in self.unknowns]
        for index in range(MOST_STARTS):
            spread = 1.0 if index % 2 else 0.1
            yield [self._drawn(q, source, spread) for q in self.unknowns]

    def _drawn(self, q: sp.Symbol, source: random.Random, spread: float) -> float:
        if q in self.domain.angles:
            return source.uniform(-math.pi, math.pi)
        low, high = self.domain.ranges[q]
        return (low + high) / 2 + spread * source.uniform(-0.5, 0.5) * (high - low)

    def root(self, start: Sequence[float]) -> Values | None:
        """The root that a start leads to, within the ranges or not far from them."""
        found = root(self.field, self.slopes, list(start), self.scale)
        if found is None or not all(map(self._is_near, self.unknowns, found)):
            return None
        return {q: turned(x) if q in self.domain.angles else x for q, x in zip(self.unknowns, found, strict=True)}

    def _is_near(self, q: sp.Symbol, x: float) -> bool:
        if q in self.domain.angles:
            return True
        low, high = self.domain.ranges[q]
        return abs(x - (low + high) / 2) <= FAR * (high - low)

    def is_singular(self, point: Sequence[float]) -> bool:
        """Whether the equations have no value at a point, or next to it."""
        there = [[x + d for x in point] for d in (0.0, 1e-12, -1e-12)]
        beside = [abs(v) for p in there for v in self.field(p)]
        return any(not math.isfinite(v) or v > 1e6 * self.scale for v in beside)

    def free(self, values: Values) -> tuple[sp.Symbol, ...]:
        """The unknowns that may have other values near a root: steps along the kernel of J lead to roots again."""
        point = [values[q] for q in self.unknowns]
        pivots = _pivots([[row.get(i, 0.0) for i in range(self.size)] for row in self.slopes(point)])
        chosen: list[int] = []
        for i in (k for k in range(self.size) if k not in pivots):
            if all(self._moves(point, i, chosen, part) for part in (1e-3, -1e-3)):
                chosen.append(i)
        return tuple(self.unknowns[i] for i in chosen)

    def _moves(self, point: list[float], index: int, held: list[int], part: float) -> bool:
        """Whether there is a root with another value of this unknown, all but those that are held adjusted."""
        q = self.unknowns[index]
        low, high = (-math.pi, math.pi) if q in self.domain.angles else self.domain.ranges[q]
        wanted = point[index] + part * (high - low)
        others = [i for i in range(self.size) if i != index and i not in held]
        places = {i: place for place, i in enumerate(others)}
        x = [*point]
        x[index] = wanted
        for _ in range(12):
            value = self.field(x)
            rows = [{places[i]: slope for i, slope in row.items() if i in places} for row in self.slopes(x)]
            if not all(map(math.isfinite, (*value, *(s for row in rows for s in row.values())))):
                return False
            step = step_of(rows, value, 1e-12, len(others)) if others else []
            if step is None:
                return False
            for i, d in zip(others, step, strict=True):
                x[i] += d
        return math.hypot(*self.field(x)) <= 1e-11 * self.scale and math.dist(x, point) < 0.2 * (high - low)


def _pivots(rows: list[list[float]]) -> list[int]:
    """The columns that elimination with full pivots needs, the last ones preferred: the first unknowns stay free."""
    rows = [list(row) for row in rows]
    largest = max((abs(x) for row in rows for x in row), default=0.0)
    found: list[int] = []
    for _ in range(len(rows)):
        sizes = [(abs(x) * (1 + 1e-6 * k), r, k) for r, row in enumerate(rows) for k, x in enumerate(row)]
        size, r, k = max(sizes, default=(0.0, 0, 0))
        if not size > DEGENERATE * largest:
            break
        chosen = rows.pop(r)
        rows = [[a - row[k] / chosen[k] * b for a, b in zip(row, chosen, strict=True)] for row in rows]
        found.append(k)
    return found


def _factors(equation: sp.Expr, unknowns: tuple[sp.Symbol, ...]) -> tuple[sp.Expr, ...]:
    """What an equation is a product of, each once, without denominators and what never vanishes."""
    found: dict[sp.Expr, None] = {}
    for part in sp.Mul.make_args(equation):
        for base in _without_root(part):
            found |= dict.fromkeys(_irreducible(base, unknowns))
    return tuple(found)


def _irreducible(part: sp.Expr, unknowns: tuple[sp.Symbol, ...]) -> tuple[sp.Expr, ...]:
    """The factors of its numerator that hold an unknown; the part as it stands if there is but one."""
    if not part.has(*unknowns):
        return ()
    if not part.is_Add or part.count_ops() > LONGEST:
        return (part,)
    try:
        upper, _ = sp.fraction(sp.together(sp.expand_trig(part)))
        _, powers = factor_list(upper)
    except (sp.PolynomialError, NotImplementedError, RecursionError):
        return (part,)
    held = [base for base, _ in powers if base.has(*unknowns)]
    if len(held) == 1 and dict(powers)[held[0]] == 1:
        return (part,)
    return tuple(dict.fromkeys(each for base in held for each in _without_root(base)))


def _without_root(base: sp.Expr) -> Iterator[sp.Expr]:
    """A factor (…)^r with r > 0 vanishes where its base does."""
    power = base.as_base_exp()
    if base.is_positive:
        return
    if power[1].is_Rational and power[1] > 0 and power[0].is_Add:
        yield power[0]
    elif not (power[1].is_Rational and power[1] < 0):
        yield base


def _value(expression: sp.Expr, values: Mapping[sp.Symbol, float]) -> float:
    return float(number(expression, {q.name: arb(value) for q, value in values.items()}))


def _solves(equations: Sequence[sp.Expr], values: Mapping[sp.Symbol, float]) -> bool:
    """Whether all equations hold, but for rounding; they do not where they have no value."""
    point = {q.name: arb(value) for q, value in values.items()}
    return all(_holds(equation, values, point) for equation in equations)


def _holds(equation: sp.Expr, unknowns: Iterable[sp.Symbol], point: Mapping[str, arb]) -> bool:
    terms = [number(term, point) for term in sp.Add.make_args(equation)]
    size, rest = sum(map(abs, terms), arb(0)), float(abs(sum(terms, arb(0))).mid())
    if not size.is_finite() or rest <= SMALL * float(size.mid()):
        return bool(size.is_finite())
    slopes = (abs(number(diff(equation, q), point)) * (1 + abs(point[q.name])) for q in unknowns)
    return rest <= SMALL * float(sum((slope for slope in slopes if slope.is_finite()), size).mid())


def _round(x: float, *, angle: bool) -> sp.Expr:
    """The multiple of π/12, or of 1/60, next to a number."""
    return sp.Rational(round(12 * x / math.pi), 12) * sp.pi if angle else sp.Rational(round(60 * x), 60)


def _is_within(one: float, other: float, width: float) -> bool:
    return abs(one - other) <= width


def _joined(found: Enclosed) -> list[Box]:
    """Boxes on an axis on which everything vanishes, those that touch as one; of several unknowns the first."""
    if not found.flat or len(found.flat[0]) > 1:
        return list(found.flat[:1])
    joined: list[tuple[float, float]] = []
    for ((low, high),) in sorted(found.flat):
        if joined and low <= joined[-1][1] + 1e-6 * (1 + abs(low)):
            joined[-1] = (joined[-1][0], max(high, joined[-1][1]))
        else:
            joined.append((low, high))
    return [(each,) for each in joined]


def _flat(box: Box, unknowns: tuple[sp.Symbol, ...], equations: tuple[sp.Expr, ...]) -> Solution:
    return Solution({q: (low + high) / 2 for q, (low, high) in zip(unknowns, box, strict=True)}, unknowns, equations)


def _distinct(found: Sequence[Solution], angles: frozenset[sp.Symbol]) -> list[Solution]:
    """Each once; what lies on a family is told by it."""
    kept: list[Solution] = []
    for each in sorted(found, key=lambda one: -len(one.free)):
        if not any(_same(each, other, angles) for other in kept):
            kept.append(each)
    return kept


def _same(one: Solution, other: Solution, angles: frozenset[sp.Symbol]) -> bool:
    same = all(
        abs(math.remainder(one.values[q] - x, 2 * math.pi) if q in angles else one.values[q] - x) < 1e-6 * (1 + abs(x))
        for q, x in other.values.items()
    )
    return same or (len(one.free) <= len(other.free) > 0 and _solves(other.equations, one.values))


def turned(angle: float) -> float:
    """The angle in (−π, π]."""
    around = math.remainder(angle, 2 * math.pi)
    return around + 2 * math.pi if around < -math.pi + 1e-6 else around
