"""What was not carried out because it would take too long: a part of the last chapter, by its name."""

from __future__ import annotations

from ...vocabulary import OptionalPart
from ..step import Step

RULE = "left-out"


def apply(part: OptionalPart) -> Step:
    """A step of words only."""
    return Step(RULE, part, (), (), {"outcome": part})
