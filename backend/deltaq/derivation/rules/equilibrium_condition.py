"""Equilibrium: a system at rest stays at rest if and only if no generalized force acts on it there, f(q₀, 0) = 0.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1.
"""

from __future__ import annotations

from ..equilibria import free_coordinates
from ..formula import Explicit, Substituted
from ..friction import holds_everywhere
from ..matrix_form import forces_at_rest, forcing
from ..optional import search_of
from ..step import Relation, Step
from ..system import System
from ._shape import plain_value, shaped

RULE = "equilibrium-condition"


def apply(system: System) -> Step:
    """What acts at rest, and whether it can vanish."""
    force = shaped(system, "forcing", "vector", forcing(system))
    at_rest = {system.rate(q): system.zero for q in system.free}
    line = Relation((Substituted(force, at_rest), Explicit(plain_value(forces_at_rest(system)))))
    free = free_coordinates(system)
    return Step(RULE, "", (line,), (), {"outcome": _outcome(system), "coordinate": ", ".join(free)})


def _outcome(system: System) -> str:
    free = free_coordinates(system)
    known = search_of(system)
    if not (known and known.found):
        if holds_everywhere(system):
            return "held"
        forces = [force for force in forces_at_rest(system) if not system.is_zero(force)]
        constant = any(not force.has(*map(system.q, system.free)) for force in forces)
        return "none" if constant or (known and known.complete and not known.ranges) else "not-found"
    if len(free) == len(system.free):
        return "everywhere"
    return "free" if free else "text"
