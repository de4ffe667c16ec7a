"""Equilibrium: a system at rest stays at rest if and only if no generalized force acts on it there, f(q₀, 0) = 0.

With constraints their reactions count: f(q₀, 0) + A(q₀)ᵀλ₀ = 0 for some multipliers, and the constraints are kept.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1; Lanczos, The Variational Principles of Mechanics,
ch. III.3.
"""

from __future__ import annotations

from ..bound_equilibria import balance
from ..equilibria import Search, free_coordinates
from ..formula import Equation, Explicit, Substituted
from ..friction import holds_everywhere
from ..matrix_form import forces_at_rest, forcing
from ..optional import kink_search_of, left_out_of, search_of
from ..step import Relation, Step
from ..system import System
from ._shape import balanced, plain_value, shaped, zero

RULE = "equilibrium-condition"


def apply(system: System) -> Step:
    """What acts at rest, and whether it can vanish."""
    force = shaped("forcing", "vector", forcing(system))
    at_rest = system.zero_rates
    free = free_coordinates(system)
    about = {"outcome": _outcome(system), "coordinate": ", ".join(free)}
    if not system.conditions:
        line = Relation((Substituted(force, at_rest), Explicit(plain_value(forces_at_rest(system)))))
        return Step(RULE, "", (line,), (), about)
    acting = Substituted(balanced(system, force), at_rest)
    rows = zero(len(system.free))
    lines = (
        Relation((Equation(acting, rows), Equation(Explicit(balance(system)), rows)), "⇔"),
        *(
            Relation((Equation(name, zero(1)), Equation(Explicit(name.value), zero(1))), "⇔")
            for name in map(system.named_condition, system.conditions)
        ),
    )
    return Step(RULE, "", lines, system.constraint_sources, about)


def _outcome(system: System) -> str:
    free = free_coordinates(system)
    known = search_of(system)
    if system.conditions:
        return _outcome_with_constraints(system)
    if not (known and known.found):
        return "held" if holds_everywhere(system) else _outcome_beside(system) or _outcome_of_none(system, known)
    if len(free) == len(system.free):
        return "everywhere" if all(map(system.is_zero, forces_at_rest(system))) else "everywhere-at-values"
    return "free" if free else "text"


def _outcome_beside(system: System) -> str:
    """Where forces vanish nowhere, but friction or a kink balances them; "" where nothing does."""
    kinked = kink_search_of(system)
    if kinked and kinked.found and kinked.found[0].by_friction:
        return "held-in-range"
    return "balanced-at-kink" if kinked and kinked.kinks else ""


def _outcome_of_none(system: System, known: Search | None) -> str:
    """There is none at all, none with open contacts, none where the scene holds; or none was found."""
    forces = [force for force in forces_at_rest(system) if not system.is_zero(force)]
    constant = any(not force.has(*map(system.q, system.free)) for force in forces)
    is_all = known and (_is_everywhere(known) or (left_out_of(system) is None and not known.ranges))
    if not constant and not is_all:
        return "not-found"
    if known and known.beyond:
        return "none-within"
    return "none-open" if any(event.bounces for event in system.scene.events) else "none"


def _is_everywhere(known: Search) -> bool:
    """Whether all positions that touch no contact have been looked at."""
    return known.is_complete_off_contacts and not known.ranges


def _outcome_with_constraints(system: System) -> str:
    known = search_of(system)
    if known and known.found:
        return "constrained"
    return "constrained-none" if known and known.complete and not known.ranges else "constrained-not-found"
