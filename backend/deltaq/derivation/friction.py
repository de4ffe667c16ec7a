"""Dry friction: what can set a system of one degree of freedom at rest.

Out of rest the force is f₊(q) = f(q, 0⁺) in one direction and f₋(q) = f(q, 0⁻) in the other. Friction holds the system
where neither starts it: f₊ ≤ 0 ≤ f₋. That is a band between zeros of f₊ and f₋, as |x| ≤ R/k for −k x − R sgn ẋ.
Source: Magnus, Popp, Sextro, Schwingungen, 8th ed., §3.1.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..language.memory import cached_method
from ..mechanics.contributions import Friction
from .impacts import frictions
from .matrix_form import forcing
from .system import System


@dataclass(frozen=True)
class Band:
    """Between which values friction holds a coordinate, in the parameters where both are exact."""

    low: sp.Expr
    high: sp.Expr
    exact: bool


@cached_method
def directions(system: System) -> tuple[sp.Expr, sp.Expr] | None:
    """f₊ and f₋ of the one coordinate; None of several, or where no force jumps as the rate passes zero."""
    if len(system.free) != 1:
        return None
    rate, force = system.rate(system.free[0]), forcing(system)[0]
    still = {rate: system.zero, **system.parameter_values}
    jumps = [each for each in force.atoms(sp.sign) if each.args[0].has(rate) and each.args[0].xreplace(still) == 0]
    if not jumps:
        return None
    more = sum((_more_at_rest(system, part) for part in frictions(system)), system.zero)
    ways = [(force.xreplace({j: way * sp.sign(j.args[0].diff(rate)) for j in jumps}), way * more) for way in (1, -1)]
    plus, minus = (system.display(moving.xreplace({rate: system.zero}) - extra) for moving, extra in ways)
    return plus, minus


def _more_at_rest(system: System, part: Friction) -> sp.Expr:
    """F₀ − F: what friction holds with beyond what it resists a beginning motion with; nothing on a moving surface."""
    rate = system.rate(system.free[0])
    surface = system.guided(system.expression(part.surface_rate)).xreplace(dict(system.parameter_values))
    if system.slipping(part) != system.q(system.free[0]) or not system.is_zero(surface):
        return system.zero
    static, moving = (system.guided(system.expression(each)) for each in (part.static, part.force))
    return (static - moving).xreplace({rate: system.zero})


def holds_everywhere(system: System) -> bool:
    """Whether friction balances a force that is the same everywhere."""
    found = directions(system)
    if found is None or any(force.has(system.q(system.free[0])) for force in found):
        return False
    plus, minus = (force.xreplace(dict(system.parameter_values)) for force in found)
    return bool(plus <= 0) and bool(minus >= 0)
