"""Where a system of one degree of freedom stays at rest though forces act on it: at kinks, and by dry friction.

What it needs to start is f₊(q) = f(q, 0⁺) > 0 to one side, f₋(q) = f(q, 0⁻) < 0 to the other; without dry friction both
are f(q, 0). It stays where f₊(q⁺) ≤ 0 ≤ f₋(q⁻). Between the zeros of f₊ and f₋, the kinks and the walls that is so
everywhere or nowhere: ranges of rest, as |x| ≤ F₀/k for −k x − F₀ sgn ẋ. Elsewhere it may rest at single points where
forces jump over zero: 0 is in the convex hull of what they tend to from both sides. Such a point is stable if they push
towards it from both sides, as 0 in V = |x|, and unstable if they push away.
Source: Filippov, Differential Equations with Discontinuous Righthand Sides, §§4, 13; Clarke, Optimization and Nonsmooth
Analysis, §2.2; Magnus, Popp, Sextro, Schwingungen, 8th ed., §3.1.3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise, product

import sympy as sp
from flint import arb, ctx

from ..language.memory import cached_method
from ..mechanics.event import Event
from ..vocabulary import RangeEnd, Stability
from .closed_form import Sought, closed_form
from .conservation import is_passive
from .dissipation import dissipation_function, dissipative_loads, remaining_loads
from .enclosure import Budget
from .equilibria import BITS, MOST_SWITCHES, NOTHING, OPERATIONS, Equilibrium, domain, point_at, start_point, watched
from .friction import Band, directions
from .impacts import frictions
from .matrix_form import forces_at_rest, is_autonomous
from .program import number
from .refinement import refined
from .solving import Domain, Solver
from .switches import Signs, bends, beside, switches
from .system import System

NEAR = arb(2) ** -60  # beside a point, in units of its coordinate
SAME = 1e-9  # of coordinates above 1: places that are one


@dataclass(frozen=True)
class Place:
    """A value of the coordinate: in closed form in the parameters, or as a number."""

    value: sp.Expr
    exact: bool
    kind: RangeEnd


@dataclass(frozen=True)
class RestRange:
    """The coordinate rests anywhere between two places, these included; None where there is no end to it."""

    coordinate: str
    low: Place | None
    high: Place | None
    by_friction: bool


@dataclass(frozen=True)
class KinkRest:
    """A position where the functions `switches` are zero and forces jump over balance.

    Of one coordinate `sides` are f₋ below it and f₊ above. Of several, each σ in `shares`, from −1 to 1, stands for the
    sign of a switching function such that the forces balance, with the reactions of closed `contacts`.
    """

    equilibrium: Equilibrium
    switches: tuple[sp.Expr, ...]
    stability: Stability
    sides: tuple[sp.Expr, sp.Expr] | None = None
    shares: tuple[sp.Expr, ...] = ()
    contacts: tuple[Event, ...] = ()


@dataclass(frozen=True)
class RestSearch:
    """What was found, and whether that is all where `ranges` says."""

    found: tuple[RestRange, ...] = ()
    kinks: tuple[KinkRest, ...] = ()
    complete: bool = True
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)


@dataclass(frozen=True)
class _Mark:
    """Where something changes: a zero in number, and of what; near it that is `equation`, which switches no more."""

    x: float
    equation: sp.Expr
    kind: RangeEnd
    of: sp.Expr


@cached_method
def rest_search(system: System) -> RestSearch | None:
    """The search; None of several degrees of freedom, with constraints, or where time is in the laws."""
    if len(system.free) != 1 or system.conditions or not is_autonomous(system):
        return None
    return _Line(system).search


@dataclass(frozen=True)
class _Line:
    """All values of the one coordinate."""

    system: System

    @cached_property
    def q(self) -> sp.Symbol:
        return self.system.q(self.system.free[0])

    @cached_property
    def forces(self) -> tuple[sp.Expr, sp.Expr]:
        """f₊ and f₋."""
        at_rest = forces_at_rest(self.system)[0]
        return directions(self.system) or (at_rest, at_rest)

    @cached_property
    def is_round(self) -> bool:
        """Whether a whole turn leads back, for forces and walls."""
        turned = {self.q: self.q + 2 * sp.pi}
        periodic = all(self.system.is_zero(each.xreplace(turned) - each) for each in watched(self.system))
        return periodic and self.q in domain(self.system).angles

    @cached_property
    def domain(self) -> Domain:
        known = domain(self.system)
        return known if self.is_round else replace(known, angles=known.angles - {self.q})

    @property
    def search(self) -> RestSearch:
        system, held = self.system, directions(self.system) is not None
        if not held and not bends(system):
            return RestSearch()
        if len(bends(system)) > MOST_SWITCHES:
            return RestSearch(complete=False)
        budget = Budget(OPERATIONS, system.effort.look)
        marks, complete, is_ranged = self._marks(budget)
        segments = list(self._segments(marks))
        known = [self._rests(middle) for _, middle, _ in segments]
        found = tuple(self._ranges(segments, known))
        touched = {end for (low, _, high), rests in zip(segments, known, strict=True) if rests for end in (low, high)}
        kinks = (self._kink(mark) for mark in marks if mark.kind == "kink" and mark not in touched)
        ranges = {self.q.name: domain(system).ranges[self.q]} if is_ranged else {}
        order = ("stable", "undecided", "unstable")
        told = sorted((each for each in kinks if each is not None), key=lambda each: order.index(each.stability))
        return RestSearch(found, tuple(told), complete, ranges)

    def _marks(self, budget: Budget) -> tuple[list[_Mark], bool, bool]:
        """All marks in order, whether they are all, and whether they were sought in a range only."""
        sought: list[tuple[sp.Expr, RangeEnd]] = [(s, "kink") for s in switches(self.system)]
        sought += [(value, "contact") for value in watched(self.system)]
        sought += [(s, "bend") for s in bends(self.system) if s not in switches(self.system)]
        sought += [(force, "force") for force in dict.fromkeys(self.forces)]
        found: list[_Mark] = []
        complete, is_ranged = True, False
        for expression, kind in sought:
            for signs in self._regions(expression):
                equation = self.system.display(beside(self.system, expression, signs))
                numeric = equation.xreplace(dict(self.system.parameter_values))
                if not numeric.has(self.q) or self.system.is_zero(numeric):
                    continue
                solved = Solver(self.domain, self.system.is_zero, budget).solve([numeric], [self.q])
                complete, is_ranged = complete and solved.complete, is_ranged or bool(solved.ranged)
                marks = (
                    _Mark(each.values[self.q], equation, kind, expression) for each in solved.found if not each.free
                )
                found += [mark for mark in marks if self._has_signs(mark, signs)]
        return _apart(sorted(found, key=lambda mark: mark.x)), complete, is_ranged

    def _regions(self, expression: sp.Expr) -> Iterator[Signs]:
        """The signs that what an expression switches with may have; of its own sign it is not asked."""
        mine = [
            s for s in bends(self.system) if s != expression and beside(self.system, expression, {s: 1}) != expression
        ]
        for chosen in product((sp.Integer(1), sp.Integer(-1)), repeat=len(mine)):
            yield dict(zip(mine, chosen, strict=True))

    def _has_signs(self, mark: _Mark, signs: Signs) -> bool:
        with ctx.workprec(BITS):
            point = self._point(arb(mark.x))
            values = [number(beside(self.system, s, signs) * sign, point) for s, sign in signs.items()]
            return all(bool(value > -SAME * (1 + abs(mark.x))) for value in values)

    def _point(self, x: arb) -> dict[str, arb]:
        return start_point(self.system) | {self.q.name: x}

    def _segments(self, marks: Sequence[_Mark]) -> Iterator[tuple[_Mark | None, arb, _Mark | None]]:
        """What lies between neighbouring marks: both, and a place between them."""
        low, high = domain(self.system).ranges[self.q]
        if not marks:
            yield None, arb(domain(self.system).starts[self.q].p) / int(domain(self.system).starts[self.q].q), None
            return
        if self.is_round:
            for one, other in zip(marks, (*marks[1:], marks[0]), strict=True):
                turn = 2 * math.pi if other.x <= one.x else 0.0
                yield one, arb((one.x + other.x + turn) / 2), other
            return
        yield None, arb(min(marks[0].x, low) - (high - low)), marks[0]
        for one, other in pairwise(marks):
            yield one, arb((one.x + other.x) / 2), other
        yield marks[-1], arb(max(marks[-1].x, high) + (high - low)), None

    def _rests(self, x: arb) -> bool:
        """Whether it stays at rest at a place where nothing jumps."""
        with ctx.workprec(BITS):
            point = self._point(x)
            plus, minus = (number(force, point) for force in self.forces)
            return self._holds(point) and not bool(plus > 0) and not bool(minus < 0) and plus.is_finite()

    def _holds(self, point: Mapping[str, arb]) -> bool:
        return not any(bool(number(value, dict(point)) < -NOTHING) for value in watched(self.system))

    def _ranges(
        self, segments: Sequence[tuple[_Mark | None, arb, _Mark | None]], known: Sequence[bool]
    ) -> Iterator[RestRange]:
        """Neighbouring segments of rest as one."""
        if all(known):
            yield from (
                [self._range(segments[0][0], segments[-1][2])] if not self.is_round else [self._range(None, None)]
            )
            return
        first = known.index(False) if self.is_round else 0
        begun: list[_Mark | None] = []
        order = [*range(first, len(segments)), *range(first)]
        for place in order:
            if known[place] and not begun:
                begun = [segments[place][0]]
            following = order[(order.index(place) + 1) % len(order)]
            last = place == order[-1] or not known[following]
            if known[place] and last:
                yield self._range(begun[0], segments[place][2])
                begun = []

    def _range(self, low: _Mark | None, high: _Mark | None) -> RestRange:
        ends = [None if end is None else self._place(end) for end in (low, high)]
        return RestRange(self.q.name, ends[0], ends[1], directions(self.system) is not None)

    def _place(self, mark: _Mark) -> Place:
        """In closed form where that is recognized, else as a number."""
        angles = frozenset({self.q} & self.domain.angles)
        sought = Sought(self.system, (mark.equation,), {self.q: mark.x}, angles, self.system.parameter_values)
        known = closed_form(sought)
        if known is not None:
            return Place(known[self.q], exact=True, kind=mark.kind)
        numbers = refined([mark.equation.xreplace(dict(self.system.parameter_values))], {self.q: mark.x})
        value = sp.Rational(repr(mark.x)) if numbers is None else numbers[self.q]
        return Place(value, exact=False, kind=mark.kind)

    def _kink(self, mark: _Mark) -> KinkRest | None:
        """The place, if forces may balance there."""
        place, system = self._place(mark), self.system
        with ctx.workprec(BITS):
            x = number(place.value, start_point(system))
            sides = [self._signs(x + way * NEAR) for way in (-1, 1)]
            if not all(self._holds(self._point(x + way * NEAR)) for way in (-1, 1)):
                return None
            told = [[beside(system, force, signs) for force in self.forces] for signs in sides]
            values = [number(force, self._point(x)) for side in told for force in side]
            if not all(v.is_finite() for v in values):  # a pole lies at the kink
                return None
            if all(bool(v > NOTHING) for v in values) or all(bool(v < -NOTHING) for v in values):
                return None
            away = number(told[0][1], self._point(x - NEAR)), number(told[1][0], self._point(x + NEAR))
        there = {self.q: place.value}
        below, above = (system.display(force.xreplace(there)) for force in (told[0][1], told[1][0]))
        rests = Equilibrium(there, place.exact)
        return KinkRest(rests, (mark.of,), self._stability(*away), (below, above))

    def _signs(self, x: arb) -> Signs:
        """The signs of all that switches, at a place where nothing does."""
        point = self._point(x)
        return {s: sp.Integer(1 if bool(number(s, point) > 0) else -1) for s in bends(self.system)}

    def _stability(self, below: arb, above: arb) -> Stability:
        if bool(below < 0) or bool(above > 0):
            return "unstable"
        towards = bool(below > 0) and bool(above < 0)
        return "stable" if towards and feeds_nothing(self.system) else "undecided"


def feeds_nothing(system: System) -> bool:
    """Whether no force feeds energy in: all have a potential, or are dry friction, or dampers that damp."""
    rates = [system.rate(q) for q in system.free]
    known = {part.source for part in frictions(system)}
    if len(system.free) == 1:  # a force of the one coordinate alone has a potential
        known |= {load for load in remaining_loads(system) if not system.load_force(load, system.free[0]).has(*rates)}
    numbers = {**system.parameter_values, **{system.rate(q): sp.Integer(1) for q in system.free}}
    numbers |= domain(system).starts
    losses = [
        (dissipation_function(system, load) or system.zero).xreplace(numbers) for load in dissipative_loads(system)
    ]
    return is_passive(system) or (set(remaining_loads(system)) <= known and all(bool(loss >= 0) for loss in losses))


def range_about(system: System, equilibrium: Equilibrium) -> RestRange | None:
    """The range in which dry friction holds the system about an equilibrium; None without one."""
    known = rest_search(system)
    with ctx.workprec(BITS):
        point = point_at(system, equilibrium)
        found = (each for each in (known.found if known else ()) if each.by_friction and _contains(each, point))
        return next(found, None)


def _contains(known: RestRange, point: Mapping[str, arb]) -> bool:
    x = point[known.coordinate]
    ends = [None if end is None else number(end.value, dict(point)) for end in (known.low, known.high)]
    return not (ends[0] is not None and bool(x < ends[0])) and not (ends[1] is not None and bool(x > ends[1]))


def band_of(known: RestRange | None) -> Band | None:
    """The range as a band between two places where forces overcome friction; None where something else ends it."""
    if known is None or known.low is None or known.high is None or {known.low.kind, known.high.kind} != {"force"}:
        return None
    return Band(known.low.value, known.high.value, exact=known.low.exact and known.high.exact)


def _apart(marks: Sequence[_Mark]) -> list[_Mark]:
    """Marks at one place as one: what jumps there is told before what only vanishes."""
    order = ("kink", "contact", "bend", "force")
    kept: list[_Mark] = []
    for mark in marks:
        if kept and abs(mark.x - kept[-1].x) <= SAME * (1 + abs(mark.x)):
            kept[-1] = min(kept[-1], mark, key=lambda each: order.index(each.kind))
        else:
            kept.append(mark)
    return kept
