"""Dry friction: where it can hold a system of one degree of freedom at rest.

Out of rest the force is f₊(q) = f(q, 0⁺) in one direction and f₋(q) = f(q, 0⁻) in the other. Friction holds the system
where neither starts it: f₊ ≤ 0 ≤ f₋. That is a band between zeros of f₊ and f₋, as |x| ≤ R/k for −k x − R sgn ẋ.
Source: Magnus, Popp, Sextro, Schwingungen, 8th ed., §3.1.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp

from ..language.memory import cached_method
from .closed_form import Sought, closed_form
from .enclosure import Budget
from .equilibria import OPERATIONS, Equilibrium, domain, is_angle
from .matrix_form import forcing
from .refinement import refined
from .solving import Solver
from .system import System


@dataclass(frozen=True)
class Band:
    """Between which values friction holds a coordinate, in the parameters where both are exact."""

    low: sp.Expr
    high: sp.Expr
    exact: bool


@cached_method
def directions(system: System) -> tuple[sp.Expr, sp.Expr] | None:
    """f₊ and f₋ of the one coordinate; None of several, or where no force jumps with the rate."""
    if len(system.free) != 1:
        return None
    rate, force = system.rate(system.free[0]), forcing(system)[0]
    jumps = [each for each in force.atoms(sp.sign) if each.args[0].has(rate)]
    if not jumps:
        return None
    ways = [force.xreplace({each: way * sp.sign(each.args[0].diff(rate)) for each in jumps}) for way in (1, -1)]
    plus, minus = (system.display(way.xreplace({rate: system.zero})) for way in ways)
    return plus, minus


def holds_everywhere(system: System) -> bool:
    """Whether friction balances a force that is the same everywhere."""
    found = directions(system)
    if found is None or any(force.has(system.q(system.free[0])) for force in found):
        return False
    plus, minus = (force.xreplace(dict(system.parameter_values)) for force in found)
    return bool(plus <= 0) and bool(minus >= 0)


def band(system: System, equilibrium: Equilibrium) -> Band | None:
    """The band around an equilibrium; None without dry friction that holds it on both sides."""
    found = directions(system)
    if found is None or not equilibrium.values:
        return None
    q = system.q(system.free[0])
    here = float(equilibrium.values[q].xreplace(dict(system.parameter_values)))
    zeros = [zero for force in found for zero in _zeros(system, force, q)]
    below = max((zero for zero in zeros if zero[0] < here), default=None)
    above = min((zero for zero in zeros if zero[0] > here), default=None)
    if below is None or above is None or not _is_held(system, found, (below[0] + here) / 2, (above[0] + here) / 2):
        return None
    low, high = (_value(system, zero, q) for zero in (below, above))
    if low is None or high is None:
        return None
    return Band(low[0], high[0], low[1] and high[1])


def _zeros(system: System, force: sp.Expr, q: sp.Symbol) -> Iterator[tuple[float, sp.Expr]]:
    equation = force.xreplace(dict(system.parameter_values))
    if not equation.has(q):
        return
    found = Solver(domain(system), system.is_zero, Budget(OPERATIONS // 4)).solve([equation], [q])
    yield from ((each.values[q], force) for each in found.found if not each.free)


def _is_held(system: System, forces: tuple[sp.Expr, sp.Expr], *places: float) -> bool:
    q = system.q(system.free[0])
    plus, minus = (force.xreplace(dict(system.parameter_values)) for force in forces)
    return all(float(plus.xreplace({q: sp.Float(x)})) <= 0 <= float(minus.xreplace({q: sp.Float(x)})) for x in places)


def _value(system: System, zero: tuple[float, sp.Expr], q: sp.Symbol) -> tuple[sp.Expr, bool] | None:
    """Where the force of one direction vanishes, as closed form or as a number."""
    number, force = zero
    angles = frozenset({q} if is_angle(system, q) else ())
    known = closed_form(Sought(system, (force,), {q: number}, angles, system.parameter_values))
    if known is not None:
        return known[q], True
    rounded = refined([force.xreplace(dict(system.parameter_values))], {q: number})
    return None if rounded is None else (rounded[q], False)
