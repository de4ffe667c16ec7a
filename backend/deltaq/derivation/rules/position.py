"""Configuration: the position of every body is a function of the coordinates and of time, r = r(P, t, q₁ … q_f).

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.3.
"""

from __future__ import annotations

from ..formula import Named, Quantity
from ..step import Relation, Step
from ..system import System

RULE = "position"
UNGUIDED = "unguided"  # as the scene states it, where a guide moves it


def apply(system: System, place: str) -> Step:
    """r(q, t) at a place as the scene states it; guided coordinates still stand under their letters."""
    given = system.given(system.trees(place))
    arguments = tuple(system.q(name) for name in system.coordinates if given.value.has(system.q(name)))
    part = UNGUIDED if given.value.has(*system.guides) else ""
    name = Named(Quantity("position", place, part), given.value, arguments)
    moved_by_time = "given" if given.value.has(system.t) else "fixed"
    about = {"place": place} if arguments else {"place": place, "outcome": moved_by_time}
    return Step(RULE, place, (Relation((name, given)),), (system.source(place),), about)
