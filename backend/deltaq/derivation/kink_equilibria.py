"""Equilibria of several coordinates where forces jump: switching functions s(q₀) = 0, with contacts and constraints.

Beside s = 0 a force is f₊ or f₋; on it any f between them may act (Filippov), which is that with a σ from −1 to 1 in
the place of sgn s: f(q₀, σ₀) + Aᵀλ₀ + Σ λ_N ∂g_N/∂q = 0 with g_N = 0, λ_N > 0. Of a potential these are the places
where 0 is in Clarke's generalized gradient. Every choice of as many kinks and contacts as there are degrees of freedom
is looked at, as long as the gradients are independent. Where V rises from the kink to both sides to first order,
|σ₀| < 1, and has a minimum along it, the equilibrium is stable; where it falls to both sides, it is unstable.
Source: Clarke, Optimization and Nonsmooth Analysis, §2.2; Rockafellar, Wets, Variational Analysis, §10.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations, islice, product

import sympy as sp
from flint import arb, ctx

from ..language.derivatives import diff
from ..language.memory import cached_method
from ..mechanics.event import Event
from ..vocabulary import Stability
from .bound_equilibria import (
    BRANCHES,
    SHARE,
    domain_with,
    is_sought,
    matrix_at,
    reactions_at_rest,
    smooth_conditions,
    smooth_matrix,
    without_root,
)
from .closed_form import Sought, closed_form
from .contact_equilibria import moves
from .enclosure import Budget
from .equilibria import (
    BITS,
    MOST_SWITCHES,
    NOTHING,
    OPERATIONS,
    Equilibrium,
    domain,
    has_signs,
    is_within,
    point_at,
)
from .impacts import bouncing, frictions, gap
from .matrix_form import forces_at_rest, is_autonomous
from .program import number
from .refinement import refined
from .rest_sets import KinkRest, RestSearch, feeds_nothing, rest_search
from .solving import Solution, Solver
from .stability import Signature, signature
from .switches import Signs, beside, switches
from .system import System

MOST = 40  # choices of kinks, contacts and signs that are looked at
ORDER: tuple[Stability, ...] = ("stable", "undecided", "unstable")


@dataclass(frozen=True)
class _Choice:
    """Kinks that are met with a σ each, closed contacts with a λ each, and the signs of the other kinks."""

    kinks: Mapping[sp.Expr, sp.Symbol]
    contacts: Mapping[Event, sp.Symbol]
    others: Signs


@cached_method
def kink_search(system: System) -> RestSearch | None:
    """The search at kinks, and in one degree of freedom for ranges of rest; None where time is in the laws."""
    if not is_sought(system) or not is_autonomous(system):
        return None
    single = rest_search(system)
    if single is not None:
        return single
    if frictions(system) or len(switches(system)) > MOST_SWITCHES:
        return RestSearch(complete=False)
    return _search(system) if switches(system) else RestSearch()


def _search(system: System) -> RestSearch:
    choices = tuple(islice(_choices(system), MOST + 1))
    budget = Budget(SHARE * OPERATIONS, system.effort.look)
    searches = [_with(system, choice, budget) for choice in choices[:MOST]]
    found = sorted((one for each in searches for one in each.kinks), key=lambda each: ORDER.index(each.stability))
    ranges = {q: ends for each in searches for q, ends in each.ranges.items()}
    complete = len(choices) <= MOST and not system.conditions and all(each.complete for each in searches)
    return RestSearch((), tuple(found), complete, ranges)


def _choices(system: System) -> Iterator[_Choice]:
    still = [event for event in bouncing(system) if not moves(system, event)]
    degrees = system.scene.degrees_of_freedom
    for size in range(1, degrees + 1):
        for count in range(1, size + 1):
            for kinks, contacts in product(combinations(switches(system), count), combinations(still, size - count)):
                others = [s for s in switches(system) if s not in kinks]
                for signs in product((sp.Integer(1), sp.Integer(-1)), repeat=len(others)):
                    yield _Choice(
                        {s: sp.Dummy(f"sigma{n}", real=True) for n, s in enumerate(kinks)},
                        {event: sp.Dummy(f"lambda{n}", real=True) for n, event in enumerate(contacts)},
                        dict(zip(others, signs, strict=True)),
                    )


@dataclass(frozen=True)
class _Laws:
    """The balance of forces with σ and λ in it, what is zero besides, and the rows of what is kept at zero."""

    balance: sp.ImmutableMatrix
    zeros: tuple[sp.Expr, ...]
    rows: sp.ImmutableMatrix

    def loose(self, system: System) -> tuple[str, ...]:
        """The coordinates that nothing here depends on."""
        return tuple(q for q in system.free if not sp.Tuple(*self.balance, *self.zeros).has(system.q(q)))


def _laws(system: System, choice: _Choice) -> _Laws:
    forces = beside(system, forces_at_rest(system), {**choice.kinks, **choice.others})
    surfaces = [sp.sympify(beside(system, s, choice.others)) for s in choice.kinks]
    gaps = [system.display(without_root(system, gap(system, event))) for event in choice.contacts]
    slopes = [[system.derivative(each, system.q(q)) for q in system.free] for each in (*surfaces, *gaps)]
    pushed = sp.Matrix(slopes[len(surfaces) :]).T * sp.Matrix(list(choice.contacts.values())) if gaps else None
    balance = sp.Matrix(forces) + (reactions_at_rest(system) if system.conditions else sp.zeros(len(system.free), 1))
    shown = system.display(sp.ImmutableMatrix(balance + pushed if pushed is not None else balance))
    rows = sp.Matrix(slopes).col_join(sp.Matrix(smooth_matrix(system))) if system.conditions else sp.Matrix(slopes)
    return _Laws(shown, (*surfaces, *gaps, *smooth_conditions(system)), sp.ImmutableMatrix(rows))


def _with(system: System, choice: _Choice, budget: Budget) -> RestSearch:
    laws, sigmas = _laws(system, choice), tuple(choice.kinks.values())
    if any(diff(diff(each, one), other) != 0 for each in laws.balance for one in sigmas for other in sigmas):
        return RestSearch(complete=False)  # between the corners forces are not those with a σ for each kink
    coordinates = tuple(system.q(q) for q in system.free if q not in laws.loose(system))
    unknowns = (*coordinates, *sigmas, *choice.contacts.values(), *system.multipliers)
    equations = [each for each in (*laws.balance, *laws.zeros) if each != 0]
    numeric = [each.xreplace(dict(system.parameter_values)) for each in equations]
    where = domain_with(system, unknowns)
    where = replace(where, ranges={**where.ranges, **dict.fromkeys(sigmas, (-1.5, 1.5))})
    solved = Solver(where, system.is_zero, budget, BRANCHES).solve(numeric, unknowns)
    told = [_told(system, choice, laws, equations, each) for each in solved.found]
    ranges = {q: where.ranges[system.q(q)] for q in system.free if system.q(q) in solved.ranged}
    complete = solved.complete and not any(each is None for each in told)
    return RestSearch((), tuple(each for each in told if isinstance(each, KinkRest)), complete, ranges)


def _told(
    system: System, choice: _Choice, laws: _Laws, equations: list[sp.Expr], solution: Solution
) -> KinkRest | str | None:
    """The rest; None where it is not known well enough to tell, and why not where it is none."""
    sigmas, reactions = tuple(choice.kinks.values()), tuple(choice.contacts.values())
    if solution.free:
        return None
    angles = frozenset(q for q in solution.values if q in domain(system).angles)
    values = closed_form(Sought(system, tuple(equations), solution.values, angles, system.parameter_values))
    exact = values is not None
    if values is None:
        numeric = [each.xreplace(dict(system.parameter_values)) for each in equations]
        values = refined(numeric, dict(solution.values))
    if values is None:
        return None
    places = {system.q(q): values[system.q(q)] for q in system.free if system.q(q) in values}
    held = {each: values[each] for each in system.multipliers}
    equilibrium = Equilibrium(places, exact, laws.loose(system), held)
    with ctx.workprec(BITS):
        point = point_at(system, equilibrium) | {
            each.name: number(values[each], point_at(system, equilibrium)) for each in (*sigmas, *reactions, *held)
        }
        if not _is_there(system, choice, equilibrium, point):
            return "elsewhere"
        rows = matrix_at(laws.rows, point)
        if not bool((rows * rows.transpose()).det() > NOTHING):
            return None
        stability = _stability(system, choice, laws, point)
    shares = tuple(values[each] for each in sigmas)
    return KinkRest(equilibrium, tuple(choice.kinks), stability, None, shares, tuple(choice.contacts))


def _is_there(system: System, choice: _Choice, equilibrium: Equilibrium, point: Mapping[str, arb]) -> bool:
    """Whether the signs are those chosen, every σ is from −1 to 1, contacts push, and the scene holds."""
    shares = all(bool(abs(point[each.name]) <= 1 + NOTHING) for each in choice.kinks.values())
    pushed = all(bool(point[each.name] > NOTHING) for each in choice.contacts.values())
    return shares and pushed and is_within(system, point) and has_signs(system, equilibrium, choice.others)


def _stability(system: System, choice: _Choice, laws: _Laws, point: Mapping[str, arb]) -> Stability:
    """By how V changes across the kinks, to first order, and by its curvature along them where that rises."""
    inside = all(bool(abs(point[each.name]) < 1 - NOTHING) for each in choice.kinks.values())
    if not inside or not feeds_nothing(system):
        return "undecided"
    rises = [_rise(laws, k, sigma, point) for k, sigma in enumerate(choice.kinks.values())]
    if any(rise < 0 for rise in rises):
        return "unstable"
    along = _curvature(system, laws, point)
    if along is None or (along.zero and not along.negative) or not all(rises):
        return "undecided"
    return "unstable" if along.negative else "stable"


def _curvature(system: System, laws: _Laws, point: Mapping[str, arb]) -> Signature | None:
    """How many directions along all that is kept are stiff, slack or falling.

    The bordered matrix [K Bᵀ; B 0] has as many more positive and as many more negative eigenvalues as B has rows.
    """
    kept = [i for i, q in enumerate(system.free) if q not in laws.loose(system)]
    names = [system.q(system.free[i]) for i in kept]
    stiffness = matrix_at(sp.ImmutableMatrix([[-diff(laws.balance[i], q) for q in names] for i in kept]), point)
    rows = matrix_at(laws.rows, point)
    count, size = rows.nrows(), len(kept)
    table = [[arb(0)] * (size + count) for _ in range(size + count)]
    for i in range(size):
        for k in range(size):
            table[i][k] = (stiffness[i, k] + stiffness[k, i]) / 2
        for k in range(count):
            table[i][size + k] = table[size + k][i] = rows[k, kept[i]]
    found = signature(table)
    return found and Signature(found.positive - count, found.zero, found.negative - count)


def _rise(laws: _Laws, place: int, sigma: sp.Symbol, point: Mapping[str, arb]) -> int:
    """1 where V rises from a kink to both sides, −1 where it falls: by the part of the jump along ∂s/∂q."""
    jump = [number(diff(each, sigma), dict(point)) for each in laws.balance]
    row = [number(each, dict(point)) for each in laws.rows[place, :]]
    along = sum((a * b for a, b in zip(jump, row, strict=True)), arb(0))
    return int(bool(along < -NOTHING)) - int(bool(along > NOTHING))
