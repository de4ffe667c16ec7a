"""Equilibria on closed contacts: f(q₀, 0) + Aᵀλ₀ + Σ λ_N ∂g_N/∂q = 0 with gaps g_N(q₀) = 0 and reactions λ_N > 0.

Closed contacts are constraints whose reactions act in one direction only, towards opening: a floor pushes, a string
pulls. So every choice of contacts is closed in turn, as many as there are degrees of freedom at most: a reaction of
more of them is one of some that are independent (Carathéodory). What is found counts if all reactions are positive and
every other event's value is not negative. With λ_N > 0 the potential grows as a contact opens, to first order, so that
only motions along closed contacts decide the stability; as many contacts as degrees of freedom leave none.
Dry friction makes families of such positions, which are not sought.
Source: Fourier's principle of virtual work with inequalities, Lanczos, The Variational Principles of Mechanics, ch.
III.6; Nocedal, Wright, Numerical Optimization, 2nd ed., §12.3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import combinations, islice

import sympy as sp
from flint import arb, ctx

from ..language.memory import cached_method
from ..language.rewriting import ZERO, Exchange, exchanged
from ..mechanics.closure import closed
from ..mechanics.event import Event
from ..vocabulary import OptionalPart, Stability
from .bound_equilibria import (
    BRANCHES,
    SHARE,
    are_balanced,
    balancing,
    is_sought,
    matrix_at,
    numbers_at,
    smooth_conditions,
    smooth_matrix,
    within,
    without_root,
)
from .closed_form import Sought, closed_form
from .conservation import is_passive
from .dissipation import is_dissipative
from .enclosure import Budget
from .equilibria import BITS, NOTHING, OPERATIONS, Equilibrium, domain, is_jumping, is_within, point_at
from .impacts import bouncing, frictions, gap, moving_term
from .linearization import damping_at_rest, on_constraints
from .matrix_form import is_autonomous
from .program import number
from .refinement import refined
from .solving import Domain, Solution, Solver
from .system import System

PART: OptionalPart = "contact-equilibria"
MOST = 16  # choices of closed contacts that are looked at


@dataclass(frozen=True)
class ContactEquilibrium:
    """A position at rest on `contacts`, and the `reactions` λ_N of these, in their order.

    `free` are coordinates that may have any value near it, as in `equilibrium`, whose `reactions` are those of the
    scene's own constraints. `is_only_here` says that contacts move at other values of the parameters.
    """

    contacts: tuple[Event, ...]
    equilibrium: Equilibrium
    reactions: tuple[sp.Expr, ...]
    stability: Stability
    is_only_here: bool = False


@dataclass(frozen=True)
class ContactSearch:
    """What was found, the stable ones first, and whether that is all.

    `ranges` tells between which values coordinates were searched that are not searched everywhere.
    """

    found: tuple[ContactEquilibrium, ...]
    complete: bool
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)


ORDER: tuple[Stability, ...] = ("stable", "undecided", "unstable")
NOT_SOUGHT = ContactSearch((), complete=False)


@cached_method
def contact_search(system: System) -> ContactSearch | None:
    """The search for all of them; None where there is no contact, or time is in the laws."""
    if not bouncing(system) or not is_autonomous(system):
        return None
    if not is_sought(system) or (frictions(system) and len(system.free) > 1):
        return NOT_SOUGHT
    still = tuple(event for event in bouncing(system) if not moves(system, event))
    if any(gap(system, event).has(system.t) for event in still):
        return _at_these_values(system, still)
    degrees = system.scene.degrees_of_freedom
    every = (each for size in range(1, degrees + 1) for each in combinations(still, size))
    choices = tuple(islice(every, MOST + 1))
    budget = Budget(SHARE * OPERATIONS, system.effort.look)
    searches = [_with_closed(system, contacts, degrees, budget) for contacts in choices[:MOST]]
    found = list[ContactEquilibrium]()
    for each in (one for search in searches for one in search.found):
        found += [each] if _is_new(system, each, found) else []
    complete = len(choices) <= MOST and all(search.complete for search in searches) and not _jumps_there(system)
    ranges = {q: ends for search in searches for q, ends in search.ranges.items()}
    return ContactSearch(tuple(sorted(found, key=lambda each: ORDER.index(each.stability))), complete, ranges)


def _at_these_values(system: System, still: tuple[Event, ...]) -> ContactSearch | None:
    """The search where contacts rest because an amplitude is zero: with the zeros put into their gaps."""
    zeros = Exchange(trees={each.name: ZERO for each in system.scene.parameters if each.value == 0})
    known = {event.name: event for event in system.scene.events}
    held = {event.name: replace(event, value=exchanged(event.value, zeros)) for event in still}
    resting = System(replace(system.scene, events=tuple(held.get(name, event) for name, event in known.items())))
    if any(gap(resting, event).has(resting.t) for event in bouncing(resting) if event.name in held):
        return NOT_SOUGHT
    found = contact_search(resting)
    if found is None:
        return None
    told = (replace(one, contacts=tuple(known[each.name] for each in one.contacts)) for one in found.found)
    return replace(found, found=tuple(replace(one, is_only_here=True) for one in told))


def _jumps_there(system: System) -> bool:
    """Whether a force may jump on a contact; of one coordinate kinks are apart from contacts, or met by themselves."""
    return is_jumping(system) and len(system.free) > 1


def _with_closed(system: System, contacts: tuple[Event, ...], degrees: int, budget: Budget) -> ContactSearch:
    """With these contacts closed."""
    return (_with_nothing_left if len(contacts) == degrees else _along)(system, contacts, budget)


def moves(system: System, event: Event) -> bool:
    """Whether a contact moves by itself at the scene's values: then nothing is at rest on it."""
    return not system.is_zero(moving_term(system, event).xreplace(dict(system.parameter_values)))


def _along(system: System, contacts: tuple[Event, ...], budget: Budget) -> ContactSearch:
    """With a motion left: the equilibria of the scene with constraints, and the small motions along these."""
    bound = System(closed(system.scene, contacts))

    def search() -> ContactSearch:
        found = within(bound, budget)
        judged = (_judged(system, bound, contacts, each) for each in found.found)
        is_all = found.complete and found.count == len(found.found)
        return ContactSearch(tuple(each for each in judged if each is not None), is_all, found.ranges)

    spent = system.effort.spent
    bound.effort.spent[PART] = spent.get(PART, 0)  # one share for all choices of contacts
    try:
        return bound.effort.afford(PART, search, NOT_SOUGHT)
    finally:
        spent[PART] = bound.effort.spent[PART]


def _judged(
    system: System, bound: System, contacts: tuple[Event, ...], equilibrium: Equilibrium
) -> ContactEquilibrium | None:
    """None where a reaction would have the wrong sign, or is zero: then the position is one of open contacts."""
    values = tuple(equilibrium.reactions[each] for each in bound.multipliers)
    own = dict(zip(system.multipliers, values, strict=False))
    reactions = values[len(own) :]
    with ctx.workprec(BITS):
        point = numbers_at(bound, equilibrium)
        if not all(_is_positive(value, point) for value in reactions):
            return None
        stability = on_constraints(bound, equilibrium).stability
        touched = any(_touches(system, event, point) for event in bouncing(system) if event not in contacts)
    # Another contact that touches takes away motions: a minimum stays one, but what grows may be stopped.
    if (touched and stability == "unstable") or (stability == "stable" and not _feeds_nothing(system, point)):
        stability = "undecided"
    return ContactEquilibrium(contacts, replace(equilibrium, reactions=own), reactions, stability)


def _is_positive(value: sp.Expr, point: Mapping[str, arb]) -> bool:
    return bool(number(value, dict(point)) > NOTHING)


def _touches(system: System, event: Event, point: Mapping[str, arb]) -> bool:
    return not bool(number(gap(system, event), dict(point)) > NOTHING)


def _feeds_nothing(system: System, point: Mapping[str, arb]) -> bool:
    """Whether energy does not grow, so that a minimum of the potential is stable."""
    return is_passive(system) or is_dissipative(system, list(matrix_at(damping_at_rest(system), point).entries()))


def _with_nothing_left(system: System, contacts: tuple[Event, ...], budget: Budget) -> ContactSearch:
    """As many contacts as degrees of freedom: all gaps are zero, and the reactions follow from one linear system."""
    gaps = tuple(system.display(without_root(system, gap(system, event))) for event in contacts)
    equations = (*smooth_conditions(system), *gaps)
    unknowns = [system.q(q) for q in system.free]
    numeric = [equation.xreplace(dict(system.parameter_values)) for equation in equations]
    searched = _where(system, gaps)
    solved = Solver(searched, system.is_zero, budget, BRANCHES).solve(numeric, unknowns)
    placed = [_placed(system, equations, searched.angles, each) for each in solved.found]
    tried = [_held(system, contacts, gaps, each) for each in placed if each is not None]
    complete = solved.complete and len(tried) == len(solved.found)
    ranges = {q: searched.ranges[system.q(q)] for q in system.free if system.q(q) in solved.ranged}
    return ContactSearch(tuple(each for each in tried if each is not None), complete, ranges)


def _where(system: System, gaps: tuple[sp.Expr, ...]) -> Domain:
    """The domain of the open system; a coordinate whose gap is another one after a turn is no angle here."""
    known = domain(system)

    def is_periodic(q: sp.Symbol) -> bool:
        return all(system.is_zero(each.xreplace({q: q + 2 * sp.pi}) - each) for each in gaps if each.has(q))

    return replace(known, angles=frozenset(filter(is_periodic, known.angles)))


def _placed(
    system: System, equations: tuple[sp.Expr, ...], angles: frozenset[sp.Symbol], solution: Solution
) -> Equilibrium | None:
    """The position in closed form, else as numbers; None where it is not isolated."""
    if solution.free:
        return None
    known = closed_form(Sought(system, equations, solution.values, angles, system.parameter_values))
    if known is not None:
        return Equilibrium({system.q(q): known[system.q(q)] for q in system.free}, exact=True)
    numeric = [equation.xreplace(dict(system.parameter_values)) for equation in equations]
    rounded = refined(numeric, dict(solution.values))
    return None if rounded is None else Equilibrium(rounded, exact=False)


def _held(
    system: System, contacts: tuple[Event, ...], gaps: tuple[sp.Expr, ...], place: Equilibrium
) -> ContactEquilibrium | None:
    """The position with what holds it; None where another is closed too far, or a reaction has the wrong sign."""
    slopes = sp.Matrix([[system.derivative(each, system.q(q)) for q in system.free] for each in gaps])
    rows = smooth_matrix(system).col_join(slopes)
    values = balancing(system, rows, place)
    if values is None or not are_balanced(system, rows, place, values):
        return None
    own, reactions = values[: len(system.conditions)], tuple(values[len(system.conditions) :])
    with ctx.workprec(BITS):
        point = point_at(system, place)
        if not is_within(system, point) or not all(_is_positive(each, point) for each in reactions):
            return None
        stability: Stability = "stable" if _feeds_nothing(system, point) else "undecided"
    held = replace(place, reactions=dict(zip(system.multipliers, own, strict=True)))
    return ContactEquilibrium(contacts, held, reactions, stability)


def _is_new(system: System, one: ContactEquilibrium, found: list[ContactEquilibrium]) -> bool:
    """Whether it is at another position than those before: one on three walls is on two of them as well."""
    return not any(_is_same(system, one, other) for other in found)


def _is_same(system: System, one: ContactEquilibrium, other: ContactEquilibrium) -> bool:
    with ctx.workprec(BITS):
        here, there = (point_at(system, each.equilibrium) for each in (one, other))
        return all(bool(abs(here[q] - there[q]) < NOTHING) for q in system.free)
