"""Equilibria: configurations q₀ in which nothing moves and nothing starts to, f(q₀, 0) = 0.

Equations that share no unknown are solved apart, at the scene's parameter values: at their factors, by elimination and
by exact isolation completely, else by subdivision with interval Newton steps over a stated range. What is found is then
recognized as a closed form where that is quick. A search says whether it is complete.

Only where every event's value is not negative does the scene hold: positions behind a contact, or where a string is
slack, are no equilibria of it. With a closed contact its reaction acts as well; such positions are not sought here.
Nor are those at a kink of the potential, where a force jumps from one sign to the other and vanishes on neither side.

Where the mass matrix is singular the coordinates describe a position badly, and f = 0 is not enough: it is an
equilibrium only if fᵀM⁻¹f, the square of the acceleration out of rest, vanishes towards it (at the cusp of a cycloid it
does not).
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1; Gauss, J. reine angew. Math. 4 (1829), 232.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice, product

import sympy as sp
from flint import arb, arb_mat, ctx

from ..language.memory import cached_method
from ..mechanics.coordinate import Coordinate
from ..vocabulary import SearchEnd
from .closed_form import Known, Sought, closed_form
from .enclosure import Budget
from .matrix_form import forces_at_rest, forcing, is_autonomous, mass_matrix
from .program import number
from .refinement import in_numbers, refined
from .solving import Domain, Solution, Solutions, Solver
from .switches import Signs, beside, switches
from .system import System

MOST_SWITCHES = 4  # of forces that jump: each doubles the regions
MOST = 32  # equilibria that are looked at; more are counted
RANGE = 10  # times the largest length that the scene names: how far coordinates are searched
OPERATIONS = 600_000  # in ball arithmetic, of all searches of a scene: about half a second
BITS = 512
NOTHING = arb(2) ** -100  # of an event's value, where the equilibrium is known to more than 400 bits


@dataclass(frozen=True)
class Equilibrium:
    """A configuration at rest.

    `values` are closed forms in the parameters (exact), or the numbers at the scene's values of them. Coordinates in
    `free` may have any value: those that are not in `values`, whose values may depend on them; and where numbers stand
    for a whole family of equilibria, those that may be chosen near them. `reactions` are multipliers.
    """

    values: Mapping[sp.Symbol, sp.Expr]
    exact: bool
    free: tuple[str, ...] = ()
    reactions: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)

    @property
    def is_family(self) -> bool:
        """Whether neighbouring positions are equilibria as well."""
        return bool(self.free)


@dataclass(frozen=True)
class Search:
    """What was found, how many there are, and whether that is all.

    `ranges` tells between which values coordinates were searched that are not searched everywhere. `left_out` says why
    a search is not complete: "budget", "continuum" where equilibria are not isolated and others may lie apart,
    "singular" where constraints depend on one another, so that their multipliers are not unique, "kinks" where only
    those were sought that lie beside jumps of the forces, or "contacts" where only those that touch none. `beyond`
    counts positions where no force acts, but the scene does not hold.
    """

    found: tuple[Equilibrium, ...]
    count: int
    complete: bool
    ranges: Mapping[str, tuple[float, float]]
    left_out: SearchEnd | None = None
    beyond: int = 0

    @property
    def is_complete_off_contacts(self) -> bool:
        """Whether these are all equilibria that touch no contact."""
        return self.complete or self.left_out == "contacts"


@dataclass(frozen=True)
class _Part:
    """Equations that hang together, the unknowns in them, and the forces that they are on one side of their jumps."""

    equations: tuple[sp.Expr, ...]
    unknowns: tuple[Coordinate, ...]
    stated: tuple[sp.Expr, ...]


@cached_method
def search(system: System) -> Search | None:
    """The search for all equilibria; None where time is in the laws.

    Where forces jump, in each region between the jumps by itself; those at a jump are another search's.
    """
    if not is_autonomous(system):
        return None
    is_divided = 0 < len(switches(system)) <= MOST_SWITCHES
    found = _in_regions(system, Budget(OPERATIONS, system.effort.look)) if is_divided else None
    if found is not None:
        return found
    whole = _with(system, forces_at_rest(system), {}, Budget(OPERATIONS, system.effort.look))
    if not is_jumping(system):
        return beside_jumps(system, whole)
    return _off_switches(system, whole)


def _off_switches(system: System, found: Search) -> Search:
    """What was found of forces that jump, without what only seems to vanish as the sign of zero is zero."""
    kept = tuple(each for each in found.found if not _is_on_switch(system, each))
    count = found.count - len(found.found) + len(kept)
    return replace(found, found=kept, count=count, complete=False, left_out=found.left_out or "continuum")


def _is_on_switch(system: System, equilibrium: Equilibrium) -> bool:
    with ctx.workprec(BITS):
        point = point_at(system, equilibrium)
        return any(not bool(abs(number(s, dict(point))) > NOTHING) for s in switches(system))


def _in_regions(system: System, budget: Budget) -> Search | None:
    """The search of every region; None where one is flat, so that its equilibria are no isolated ones."""
    parts: list[Search] = []
    for chosen in product((sp.Integer(1), sp.Integer(-1)), repeat=len(switches(system))):
        signs = dict(zip(switches(system), chosen, strict=True))
        forces = sp.ImmutableMatrix(beside(system, forces_at_rest(system), signs))
        parts.append(_with(system, system.display(forces), signs, budget))
        if not all(_is_isolated(system, each) for each in parts[-1].found):
            return None
    found = sorted((each for part in parts for each in part.found), key=lambda each: _place_of(system, each))
    ranges = {q: ends for part in parts for q, ends in part.ranges.items()}
    reason: SearchEnd = next((part.left_out for part in parts if part.left_out), "kinks")
    beyond = sum(part.beyond for part in parts)
    count = sum(part.count for part in parts)
    return Search(tuple(found[:MOST]), count, complete=False, ranges=ranges, left_out=reason, beyond=beyond)


def _is_isolated(system: System, equilibrium: Equilibrium) -> bool:
    """Whether it has no neighbours but by coordinates that never matter."""
    free = free_coordinates(system)
    return equilibrium.free == free and len(equilibrium.values) + len(free) == len(system.free)


def _place_of(system: System, equilibrium: Equilibrium) -> tuple[float, list[float]]:
    with ctx.workprec(BITS):
        point = point_at(system, equilibrium)
    return _place([float(point[q.name].mid()) for q in equilibrium.values])


def _with(system: System, forces: sp.ImmutableMatrix, signs: Signs, budget: Budget) -> Search:
    """The search where forces at rest are these and the switching functions have these signs."""
    parts = list(_parts(system, forces))
    if any(not part.unknowns for part in parts):
        return Search((), 0, complete=True, ranges={})
    solved = [_solved(system, part, budget) for part in parts]
    known = [[_recognized(system, part, each) for each in s.found] for part, s in zip(parts, solved, strict=True)]
    complete = all(s.complete for s in solved) and all(one is not None for each in known for one in each)
    found, count, beyond = _combined(system, [[one for one in each if one is not None] for each in known], signs)
    ranged = frozenset[sp.Symbol]().union(*(s.ranged for s in solved))
    ranges = {q: domain(system).ranges[system.q(q)] for q in system.free if system.q(q) in ranged}
    reason: SearchEnd | None = None if complete else "budget" if budget.left <= 0 else "continuum"
    return Search(found, count, complete, ranges, reason, beyond)


def beside_jumps(system: System, found: Search) -> Search:
    """The search as what it is: one for equilibria beside jumps of the forces, with all contacts open."""
    if is_jumping(system) and found.left_out in {None, "continuum"}:
        return replace(found, complete=False, left_out="kinks")
    if not found.complete or not any(event.bounces for event in system.scene.events):
        return found
    return replace(found, complete=False, left_out="contacts")


def is_jumping(system: System) -> bool:
    """Whether a force jumps anywhere as coordinates change."""
    return bool(switches(system))


def _combined(system: System, parts: list[list[Equilibrium]], signs: Signs) -> tuple[tuple[Equilibrium, ...], int, int]:
    """All choices of one for each part that are at rest, the first of them merged; how many, and how many beyond."""
    merged = (_merged(system, each) for each in product(*parts))
    resting = (each for each in merged if has_signs(system, each, signs) and rests(system, each))
    if not system.scene.events and not signs:
        found = tuple(islice(resting, MOST))
        return found, len(found) if len(found) < MOST else math.prod(map(len, parts)), 0
    everywhere = tuple(resting)
    held = tuple(each for each in everywhere if is_within(system, point_at(system, each)))
    return held[:MOST], len(held), len(everywhere) - len(held)


def has_signs(system: System, equilibrium: Equilibrium, signs: Signs) -> bool:
    """Whether the switching functions have these signs there; one that is zero has none."""
    with ctx.workprec(BITS):
        point = point_at(system, equilibrium)
        return all(bool(number(beside(system, s, signs) * sign, dict(point)) > NOTHING) for s, sign in signs.items())


def is_within(system: System, point: Mapping[str, arb]) -> bool:
    """Whether the scene holds at rest there: no event's value is negative. One that changes with time is not asked."""
    with ctx.workprec(BITS):
        return not any(bool(number(value, dict(point)) < -NOTHING) for value in watched(system))


@cached_method
def watched(system: System) -> tuple[sp.Expr, ...]:
    """The values of the events at rest."""
    at_rest = system.zero_rates
    values = (system.guided(system.expression(event.value.tree)).xreplace(at_rest) for event in system.scene.events)
    return tuple(value for value in values if not value.has(system.t))


def point_at(system: System, equilibrium: Equilibrium) -> dict[str, arb]:
    """The equilibrium in numbers; what is free there stands where the scene starts."""
    with ctx.workprec(BITS):
        start = start_point(system)
        return start | {q.name: number(value, start) for q, value in equilibrium.values.items()}


def _merged(system: System, parts: tuple[Equilibrium, ...]) -> Equilibrium:
    """All values in the order of the coordinates: closed forms if all are, else numbers."""
    values = {q: value for part in parts for q, value in part.values.items()}
    ordered = {q: values[q] for q in map(system.q, system.free) if q in values}
    exact = all(part.exact for part in parts)
    loose = {q for part in parts for q in part.free} | set(free_coordinates(system))
    free = tuple(q for q in system.free if q in loose)
    if exact:
        return Equilibrium(ordered, exact, free)
    starts = {q: domain(system).starts[q] for q in map(system.q, free) if q not in ordered}
    return Equilibrium(in_numbers(ordered, {**system.parameter_values, **starts}), exact, free)


def free_coordinates(system: System) -> tuple[str, ...]:
    """Coordinates that no force at rest and no constraint depends on: they may have any value in an equilibrium."""
    forces = sp.Tuple(*forces_at_rest(system), *map(system.condition, system.conditions))
    return tuple(q for q in system.free if not forces.has(system.q(q)))


def _parts(system: System, forces: sp.ImmutableMatrix) -> Iterator[_Part]:
    """The equations grouped so that groups share no unknown; one without unknowns stands alone, if it does not hold."""
    groups: list[tuple[list[tuple[sp.Expr, sp.Expr]], set[str]]] = []
    for force, stated in zip(forces, forces_at_rest(system), strict=True):
        if system.is_zero(force):
            continue
        names = {q for q in system.free if force.has(system.q(q))}
        if not names and system.is_zero(force.xreplace(dict(system.parameter_values))):
            continue
        touching = [group for group in groups if group[1] & names]
        merged = [e for group in touching for e in group[0]], set().union(*(group[1] for group in touching))
        groups = [group for group in groups if group not in touching]
        groups.append(([*merged[0], (force, stated)], merged[1] | names))
    for pairs, names in groups:
        equations, stated = zip(*pairs, strict=True)
        yield _Part(equations, tuple(c for c in system.scene.free if c.name in names), stated)


def _solved(system: System, part: _Part, budget: Budget) -> Solutions:
    """The solutions of one part at the scene's values, those next to the origin first."""
    equations = [equation.xreplace(dict(system.parameter_values)) for equation in part.equations]
    unknowns = [system.q(c.name) for c in part.unknowns]
    found = Solver(domain(system), system.is_zero, budget).solve(equations, unknowns)
    return replace(found, found=tuple(sorted(found.found, key=lambda each: _place(list(each.values.values())))))


def _place(numbers: Sequence[float]) -> tuple[float, list[float]]:
    return round(math.hypot(*numbers), 6), [-round(x, 6) for x in numbers]


def _recognized(system: System, part: _Part, solution: Solution) -> Equilibrium | None:
    """The solution as closed form or as refined numbers; None if it is neither."""
    free = tuple(q.name for q in solution.values if q in solution.free)
    ordered = {q: solution.values[q] for q in (system.q(c.name) for c in part.unknowns)}
    sought = {q: x for q, x in ordered.items() if q not in solution.free}
    held = {q: sp.Rational(repr(x)) for q, x in ordered.items() if q in solution.free}
    known = {**system.parameter_values, **held}
    angles = frozenset(q for q in sought if is_angle(system, q))
    if sought:
        values: Known | None = closed_form(Sought(system, part.equations, sought, angles, known))
        if values is not None and _holds_beside(values, held) and _holds_as_stated(system, part, values):
            return Equilibrium(values, exact=True, free=free)
    rounded = refined([e.xreplace(held) for e in solution.equations], sought) if sought else {}
    return None if rounded is None else Equilibrium({**held, **rounded}, exact=False, free=free)


def _holds_as_stated(system: System, part: _Part, values: Known) -> bool:
    """Whether the forces vanish for all parameters: on the one side of a jump they are others than beyond it."""
    return part.equations == part.stated or all(system.is_zero(force.xreplace(values)) for force in part.stated)


def _holds_beside(known: Known, held: Mapping[sp.Symbol, sp.Expr]) -> bool:
    """Whether the free coordinates of a family may have any value: a root or an arcsine of them would not be real."""
    if not held:
        return True
    limited = [each for value in known.values() for each in value.atoms(sp.Pow, sp.Function)]
    return not any(each.has(*held) for each in limited if not (each.is_Pow and each.exp.is_Integer))


@cached_method
def domain(system: System) -> Domain:
    """Where coordinates are searched: angles over a turn, others to ten times the lengths that the scene names."""
    symbols = {system.q(c.name): c for c in system.scene.free}
    reaches = {q: RANGE * _scale(system, c) for q, c in symbols.items()}
    ranges = {q: (-reach, reach) for q, reach in reaches.items()}
    starts = {q: sp.Rational(repr(float(c.value))) for q, c in symbols.items()}
    return Domain(ranges, frozenset(q for q in symbols if is_angle(system, q)), starts)


def _scale(system: System, coordinate: Coordinate) -> float:
    """The largest number of the coordinate's unit: of parameters, its slider and where it starts."""
    alike = [p.value for p in system.scene.parameters if p.unit == coordinate.unit]
    own = [coordinate.value, coordinate.min or 0.0, coordinate.max or 0.0]
    return max(map(abs, (*alike, *own))) or 1.0


def rests(system: System, equilibrium: Equilibrium) -> bool:
    """Whether the system starts from there with no acceleration, also where M is singular."""
    with ctx.workprec(BITS):
        point = point_at(system, equilibrium)
        if _inverted(system, point) is not None:
            return True
        beside = [[_acceleration(system, point, k, arb(2) ** -bits) for bits in (60, 100)] for k in range(3)]
    return all(near is None or far is None or bool(near <= far * arb(2) ** -10) for far, near in beside)


def start_point(system: System) -> dict[str, arb]:
    """The parameters' values, and the coordinates where the scene starts."""
    known = {**system.parameter_values, **domain(system).starts}
    return {symbol.name: number(value, {}) for symbol, value in known.items()}


def _inverted(system: System, point: Mapping[str, arb]) -> arb_mat | None:
    size = len(system.free)
    try:
        found = arb_mat(size, size, [number(entry, point) for entry in mass_matrix(system)]).inv()
    except ZeroDivisionError:
        return None
    return found if all(entry.is_finite() for entry in found.entries()) else None


def _acceleration(system: System, point: Mapping[str, arb], way: int, distance: arb) -> arb | None:
    """fᵀM⁻¹f at a distance; None where M is singular there, too."""
    beside = {q: point[q] + distance * (1 + (way + 2) * (i + 1) % 5) * (-1) ** way for i, q in enumerate(system.free)}
    there = {**point, **beside}
    inverse = _inverted(system, there)
    if inverse is None:
        return None
    force = arb_mat(len(system.free), 1, [number(f, there) for f in forces_at_rest(system)])
    return (force.transpose() * inverse * force)[0, 0]


def is_angle(system: System, q: sp.Symbol) -> bool:
    """Whether the equations of motion are the same after a whole turn: q stands only in sines and cosines of n q."""
    waves, outside = _waves(system)
    around = [wave.args[0].diff(q) for wave in waves if wave.has(q)]
    return bool(around) and q not in outside and all(slope.is_Integer for slope in around)


@cached_method
def _waves(system: System) -> tuple[frozenset[sp.Expr], frozenset[sp.Symbol]]:
    """The sines and cosines in the equations of motion, and the symbols that stand outside them."""
    laws = sp.Tuple(*mass_matrix(system), *forcing(system), *map(system.condition, system.conditions))
    waves = laws.atoms(sp.sin, sp.cos)
    hidden = laws.xreplace({wave: sp.Dummy() for wave in waves})
    return frozenset(waves), frozenset(hidden.free_symbols)
