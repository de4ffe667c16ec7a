"""First variation (Gâteaux differential): δf = ∂/∂h f(q + h δq) at h = 0, the time held fixed.

Source: Gelfand, Fomin, Calculus of Variations, §3; the lecture's definition.
"""

from __future__ import annotations

from ...language.derivatives import diff
from ..formula import Explicit, Gateaux, Named, Quantity, Shifted
from ..step import Relation, Step
from ..system import System

RULE = "gateaux-differential"


def apply(system: System, place: str) -> Step:
    """δr at a place by its definition: r(q + h δq), its slope in h at h = 0, and what that gives."""
    position = system.named_position(place)
    left = Named(Quantity("virtual-displacement", place), system.virtual_displacement(place), position.arguments)
    shifted = position.value.xreplace({q: q + system.h * dq for q, dq in system.variations.items()})
    varied = system.display(diff(shifted, system.h).xreplace({system.h: 0}))
    members = (left, Gateaux(position), Shifted(shifted, system.h), Explicit(varied))
    return Step(RULE, place, (Relation(members),), (system.source(place),), {"place": place})
