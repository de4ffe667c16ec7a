"""Velocity by the chain rule: v = dr/dt = ∂r/∂qᵢ q̇ᵢ + ∂r/∂t.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.46.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Partial, Plus, Quantity, Rate, Term, Times
from ..step import Relation, Step
from ..system import System

RULE = "velocity"


def apply(system: System, place: str) -> Step:
    """v = dr/dt = Σ ∂r/∂qᵢ q̇ᵢ + ∂r/∂t at a place, by the letters, then its value; v = 0 at a place that is fixed."""
    position = system.named_position(place)
    velocity = system.velocity(place)
    names = system.coordinates_of(place)
    terms = [Term(Times((Partial(position, system.q(q)), Explicit(system.rate(q))))) for q in names]
    if position.value.has(system.t):
        terms.append(Term(Partial(position, system.t), (), 1, "time-term"))
    left = Named(Quantity("velocity", place), velocity)
    line = Relation((left, Rate(position), *((Plus(tuple(terms)),) if terms else ()), Explicit(velocity)))
    return Step(RULE, place, (line,), (system.source(place),), {"place": place})
