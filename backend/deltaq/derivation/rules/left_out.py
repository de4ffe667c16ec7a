"""A part that would take too long or be too long to read, or that has no law here for scenes with constraints.

How long expressions become cannot be told beforehand, so each part has a share of operations, after which it ends
without a result (`derivation/effort.py`).
Source: Davenport, Siret, Tournier, Computer Algebra (1988), ch. 2, on the swell of intermediate expressions.
"""

from __future__ import annotations

from ...vocabulary import OWN_REASONS, Missing, OptionalPart
from ..step import Step

RULE = "left-out"


def apply(part: OptionalPart, why: Missing, chapter: str = "") -> Step:
    """A step of words only; of one chapter, where it stands for its steps."""
    subject = f"{part}:{chapter}" if chapter else part
    return Step(RULE, subject, (), (), {"outcome": f"{part}{OWN_REASONS.get(why, '')}"})
