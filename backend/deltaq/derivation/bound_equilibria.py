"""Equilibria with constraints: multipliers balance the forces, f(q₀, 0) + A(q₀)ᵀλ₀ = 0, and g(q₀) = 0.

With one degree of freedom λ is eliminated: the forces are balanced where the rows of A and f are dependent, so their
determinant vanishes. With more of them the multipliers are unknowns like the others, which stand in the equations
linearly. Where constraints are dependent λ₀ is not unique: such positions are left out, and the search says so.
Constraints on rates hold the system in any position that their reactions can balance: equilibria are then families of
at least as many dimensions as there are such constraints, and are not sought.
Source: Lanczos, The Variational Principles of Mechanics, ch. III.3; Neimark, Fufaev, Dynamics of Nonholonomic Systems,
ch. VI §1 (manifolds of equilibria).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import sympy as sp
from flint import arb, arb_mat, ctx

from ..language.memory import cached_method
from ..vocabulary import SearchEnd
from .calculus import column
from .closed_form import Sought, closed_form
from .enclosure import Budget
from .equilibria import (
    BITS,
    MOST,
    OPERATIONS,
    RANGE,
    Equilibrium,
    Search,
    beside_jumps,
    domain,
    free_coordinates,
    is_angle,
    is_within,
    search,
    start_point,
)
from .matrix_form import forces_at_rest, is_autonomous, mass_matrix
from .program import number
from .refinement import rational, refined
from .solving import Domain, Solution, Solver
from .system import System

BRANCHES = 96  # of the search: each rod may point two ways
BALANCED = arb(2) ** -40  # of the largest force, and of 1: what is left of it
SHARE = 4  # times the operations of a search without constraints: they have more unknowns


def is_sought(system: System) -> bool:
    """Whether equilibria may be isolated, which constraints on rates make families of, and have unique multipliers."""
    return all(condition.is_holonomic for condition in system.conditions) and not system.scene.is_redundant


def searched(system: System) -> Search | None:
    """The search for all equilibria, with constraints or without; None where time is in the laws, or none is sought."""
    if not is_sought(system):
        return None
    return bound_search(system) if system.conditions else search(system)


@cached_method
def bound_search(system: System) -> Search | None:
    """The search with holonomic constraints; None where time is in the laws or the constraints."""
    if not is_autonomous(system):
        return None
    return beside_jumps(system, within(system, Budget(SHARE * OPERATIONS, system.effort.look)))


def within(system: System, budget: Budget) -> Search:
    """The search with all contacts open, with what is left of a budget."""
    laws = _laws(system)
    equations = [equation.xreplace(dict(system.parameter_values)) for equation in laws.equations]
    solver = Solver(domain_with(system, laws.unknowns), system.is_zero, budget, BRANCHES)
    solved = solver.solve(equations, laws.unknowns)
    placed = sorted(solved.found, key=lambda each: _place(system, each))
    known = [_recognized(system, laws, each) for each in placed]
    regular = tuple(each for each in known if each is not None and is_regular(system, each))
    balanced = tuple(each for each in regular if each.reactions)
    found = tuple(each for each in balanced if is_within(system, numbers_at(system, each)))
    complete = solved.complete and len(balanced) == len(known)
    ranges = {q: domain(system).ranges[system.q(q)] for q in system.free if system.q(q) in solved.ranged}
    reason: SearchEnd = "budget" if budget.left <= 0 else "continuum" if len(regular) == len(known) else "singular"
    beyond = len(balanced) - len(found)
    return Search(found[:MOST], len(found), complete, ranges, None if complete else reason, beyond)


@dataclass(frozen=True)
class _Laws:
    """What vanishes in an equilibrium, and the unknowns: the coordinates, and where they are not eliminated, λ."""

    equations: tuple[sp.Expr, ...]
    unknowns: tuple[sp.Symbol, ...]


def _laws(system: System) -> _Laws:
    coordinates = tuple(map(system.q, system.free))
    gaps, rows = smooth_conditions(system), smooth_matrix(system)
    if len(system.free) - len(gaps) <= 1:
        joined = rows.col_join(forces_at_rest(system).T)
        balance = [joined.det(method="berkowitz")] if joined.rows == joined.cols else []
        return _Laws((*map(system.display, balance), *gaps), coordinates)
    balance = forces_at_rest(system) + rows.T * sp.Matrix(system.multipliers)
    return _Laws((*map(system.display, balance), *gaps), (*coordinates, *system.multipliers))


@cached_method
def smooth_conditions(system: System) -> tuple[sp.Expr, ...]:
    """g of every constraint; ±(s − √D) of a positive s as ±(s² − D)/2s, with the same zeros and the same λ there."""
    return tuple(system.display(without_root(system, system.condition(each))) for each in system.conditions)


def without_root(system: System, value: sp.Expr) -> sp.Expr:
    """±(s − √D) of a positive s as ±(s² − D)/2s, with the same zeros and the same slopes there; others as they are."""
    moving = set(map(system.q, system.free))
    still = [term for term in sp.Add.make_args(value) if not term.free_symbols & moving]
    rest, length = value - sp.Add(*still), sp.Add(*still)
    sign = 1 if length.is_positive else -1
    root = -sign * rest
    if not (root.is_Pow and root.exp == sp.Rational(1, 2) and (sign * length).is_positive):
        return value
    return sign * (length**2 - root.base) / (2 * sign * length)


@cached_method
def smooth_matrix(system: System) -> sp.ImmutableMatrix:
    """The slopes of the smooth conditions, which are A wherever the constraints are kept."""
    return sp.ImmutableMatrix(
        [[system.derivative(gap, system.q(q)) for q in system.free] for gap in smooth_conditions(system)]
    )


def domain_with(system: System, unknowns: tuple[sp.Symbol, ...]) -> Domain:
    """The domain of the coordinates; multipliers up to ten times the forces where the scene starts."""
    own = domain(system)
    with ctx.workprec(BITS):
        forces = [float(abs(number(f, start_point(system))).mid()) for f in forces_at_rest(system)]
    reach = RANGE * (max((size for size in forces if math.isfinite(size)), default=0.0) or 1.0)
    extra = [each for each in unknowns if each not in own.ranges]
    ranges = {**own.ranges, **dict.fromkeys(extra, (-reach, reach))}
    return Domain(ranges, own.angles, {**own.starts, **dict.fromkeys(extra, sp.Integer(0))})


def _place(system: System, solution: Solution) -> tuple[float, list[float]]:
    numbers = [solution.values[system.q(q)] for q in system.free]
    return round(math.hypot(*numbers), 6), [-round(x, 6) for x in numbers]


def _recognized(system: System, laws: _Laws, solution: Solution) -> Equilibrium | None:
    """The solution with its multipliers in closed form, else as numbers; None where they are not unique.

    Without any where none balance the forces.
    """
    free = tuple(q for q in system.free if system.q(q) in solution.free)
    if any(each in solution.free for each in system.multipliers):
        return None
    loose = set(map(system.q, free_coordinates(system)))  # which nothing depends on
    held = {q: sp.Rational(repr(x)) for q, x in solution.values.items() if q in solution.free and q not in loose}
    sought = {q: x for q, x in solution.values.items() if q not in solution.free}
    angles = frozenset(q for q in sought if q.name in system.free and is_angle(system, q))
    known = {**system.parameter_values, **held}
    values = None if held else closed_form(Sought(system, laws.equations, sought, angles, known))
    if values is None:
        numbers = refined([each.xreplace(held) for each in _numeric(system, laws)], sought)
        return None if numbers is None else _with_reactions(system, {**held, **numbers}, free, exact=False)
    return _with_reactions(system, values, free, exact=True)


def _numeric(system: System, laws: _Laws) -> list[sp.Expr]:
    return [equation.xreplace(dict(system.parameter_values)) for equation in laws.equations]


def _with_reactions(
    system: System, known: Mapping[sp.Symbol, sp.Expr], free: tuple[str, ...], *, exact: bool
) -> Equilibrium | None:
    values = {system.q(q): known[system.q(q)] for q in system.free if system.q(q) in known}
    equilibrium = Equilibrium(values, exact, free)
    reactions = {each: known[each] for each in system.multipliers if each in known}
    if not reactions:
        found = balancing(system, smooth_matrix(system), equilibrium)
        if found is None:
            return None
        if not are_balanced(system, smooth_matrix(system), equilibrium, found):
            return equilibrium
        reactions = dict(zip(system.multipliers, found, strict=True))
    return replace(equilibrium, reactions=reactions)


def balancing(system: System, rows: sp.ImmutableMatrix, place: Equilibrium) -> list[sp.Expr] | None:
    """λ₀ = −(A Aᵀ)⁻¹ A f, which solves Aᵀλ = −f where that has a solution; None where the rows A are dependent.

    In the parameters where the place is exact, else at the scene's values.
    """
    return (_in_parameters if place.exact else _in_numbers)(system, rows, place)


def are_balanced(system: System, rows: sp.ImmutableMatrix, place: Equilibrium, reactions: list[sp.Expr]) -> bool:
    """Whether f + Aᵀλ is zero at the scene's values: where a force jumps over balance, nothing makes it so."""
    with ctx.workprec(BITS):
        point = numbers_at(system, place)
        force, turned = matrix_at(forces_at_rest(system), point), matrix_at(rows, point).transpose()
        left = force + turned * arb_mat(len(reactions), 1, [number(each, point) for each in reactions])
        largest = max((abs(each) for each in force.entries()), default=arb(0))
        return all(bool(abs(each) <= BALANCED * (1 + largest)) for each in left.entries())


def _in_parameters(system: System, rows: sp.ImmutableMatrix, place: Equilibrium) -> list[sp.Expr] | None:
    there = dict(place.values)
    known = system.display(rows.xreplace(there))
    force = system.display(forces_at_rest(system).xreplace(there))
    square = system.display(known * known.T)
    determinant = system.display(square.det(method="berkowitz"))
    if determinant == 0 or system.is_zero(determinant):
        return None
    return [system.display(-each / determinant) for each in square.adjugate() * (known * force)]


def _in_numbers(system: System, rows: sp.ImmutableMatrix, place: Equilibrium) -> list[sp.Expr] | None:
    with ctx.workprec(BITS):
        point = numbers_at(system, place)
        known, force = matrix_at(rows, point), matrix_at(forces_at_rest(system), point)
        try:
            found = (known * known.transpose()).solve(-(known * force))
        except ZeroDivisionError:
            return None
        return [rational(each) for each in found.entries()]


def numbers_at(system: System, equilibrium: Equilibrium) -> dict[str, arb]:
    """The equilibrium in numbers, its multipliers included; what is free there stands where the scene starts."""
    point = start_point(system) | dict.fromkeys((each.name for each in system.multipliers), arb(0))
    known = {**equilibrium.values, **equilibrium.reactions}
    return point | {q.name: number(value, point) for q, value in known.items()}


def matrix_at(matrix: sp.ImmutableMatrix, point: Mapping[str, arb]) -> arb_mat:
    """A matrix in numbers."""
    return arb_mat(matrix.rows, matrix.cols, [number(entry, dict(point)) for entry in matrix])


def is_regular(system: System, equilibrium: Equilibrium) -> bool:
    """Whether [M Aᵀ; A 0] has an inverse there, so that accelerations and multipliers are unique."""
    with ctx.workprec(BITS):
        point = numbers_at(system, equilibrium)
        determinant = matrix_at(_augmented(system), point).det()
        sizes = [abs(number(entry, dict(point))) for entry in _augmented(system)]
        scale = max((size for size in sizes if size.is_finite()), default=arb(1))
        return bool(abs(determinant) > arb(2) ** -140 * scale ** _augmented(system).rows)


@cached_method
def _augmented(system: System) -> sp.ImmutableMatrix:
    rows = smooth_matrix(system)
    return sp.ImmutableMatrix(sp.Matrix([[mass_matrix(system), rows.T], [rows, sp.zeros(rows.rows, rows.rows)]]))


def balance(system: System) -> sp.ImmutableMatrix:
    """f(q, 0) + A(q)ᵀλ"""
    return forces_at_rest(system) + reactions_at_rest(system)


@cached_method
def reactions_at_rest(system: System) -> sp.ImmutableMatrix:
    """Aᵀλ"""
    return column(system.reaction(q) for q in system.free)
