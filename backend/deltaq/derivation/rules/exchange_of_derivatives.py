"""Exchange of derivatives: d/dt ∂r/∂qᵢ = ∂v/∂qᵢ, because second derivatives commute.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4; the lecture.
"""

from __future__ import annotations

from ..formula import Explicit, Partial, Rate
from ..step import Relation, Step
from ..system import System

RULE = "exchange-of-derivatives"


def apply(system: System, place: str) -> Step:
    """d/dt ∂r/∂qᵢ = (its value) = ∂v/∂qᵢ at a place, one line for each coordinate that its position depends on."""
    position, velocity = system.named_position(place), system.named_velocity(place)
    lines = tuple(
        Relation(
            (
                Rate(Partial(position, system.q(q))),
                Explicit(system.derivative(velocity.value, system.q(q))),
                Partial(velocity, system.q(q)),
            )
        )
        for q in system.coordinates_of(place)
    )
    return Step(RULE, place, lines, (system.source(place),), {"place": place})
