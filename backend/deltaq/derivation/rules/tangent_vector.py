"""Partial derivative: ∂r/∂qᵢ is the derivative with every other coordinate and the time held fixed.

It is the vector along which the body moves when qᵢ alone changes.
Source: Lanczos, The Variational Principles of Mechanics, ch. I.
"""

from __future__ import annotations

from ..formula import Explicit, Partial
from ..step import Relation, Step
from ..system import System

RULE = "tangent-vector"


def apply(system: System, place: str, coordinate: str) -> Step:
    """∂r/∂qᵢ at a place with respect to one coordinate, and its value."""
    derivative = Partial(system.named_position(place), system.q(coordinate))
    line = Relation((derivative, Explicit(system.tangent(place, coordinate))))
    about = {"place": place, "coordinate": coordinate}
    return Step(RULE, f"{place}:{coordinate}", (line,), (system.source(place),), about)
