"""Variation and time derivative commute: δq̇ = d/dt δq, because the time is not varied.

Source: Lanczos, The Variational Principles of Mechanics, ch. II.9.
"""

from __future__ import annotations

from ..action import Action
from ..differential_expression import direction
from ..formula import Explicit, Rate
from ..step import Relation, Step

RULE = "exchange-of-variation"


def apply(action: Action) -> Step:
    """δq̇ = d/dt δq, one line for each function whose rate occurs in L."""
    lines = tuple(Relation((Explicit(direction(x, 1)), Rate(Explicit(direction(x))))) for x in action.moving)
    return Step(RULE, "", lines)
