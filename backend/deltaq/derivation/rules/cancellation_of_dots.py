"""Cancellation of the dots: ∂v/∂q̇ᵢ = ∂r/∂qᵢ, because v = ∂r/∂qᵢ q̇ᵢ + ∂r/∂t is affine in the rates.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.51; the lecture.
"""

from __future__ import annotations

from ..formula import Explicit, Partial
from ..step import Relation, Step
from ..system import System

RULE = "cancellation-of-dots"


def apply(system: System, place: str) -> Step:
    """∂v/∂q̇ᵢ = (its value) = ∂r/∂qᵢ at a place, one line for each coordinate that its position depends on."""
    position, velocity = system.named_position(place), system.named_velocity(place)
    lines = tuple(
        Relation(
            (
                Partial(velocity, system.rate(q)),
                Explicit(system.derivative(velocity.value, system.rate(q))),
                Partial(position, system.q(q)),
            )
        )
        for q in system.coordinates_of(place)
    )
    return Step(RULE, place, lines, (system.source(place),), {"place": place})
