"""Substitution: equals may be put for equals. With the guide put in, the position depends on time explicitly.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.3.
"""

from __future__ import annotations

from ..formula import Explicit, Substituted
from ..step import Relation, Step
from ..system import System

RULE = "guided-position"


def apply(system: System, place: str) -> Step:
    """r at a place: as the scene states it, with q(t) put in for the guided coordinates, and the result r(q, t)."""
    free = system.given(system.trees(place))
    substituted = Substituted(free, system.guides)
    line = Relation((system.named_position(place), substituted, Explicit(system.position(place))))
    about = {"place": place, "coordinate": ", ".join(guide.coordinate for guide in system.scene.guides)}
    return Step(RULE, place, (line,), (system.source(place),), about)
