"""Which symmetries were looked for: Noether's condition is linear in the generator, so that all of a family are found.

The families are generators that are affine in the coordinates and in time, and motions of space and of rigid bodies.
Source: Olver, Applications of Lie Groups to Differential Equations, 2nd ed., §5.3; Noether, Nachr. Ges. Wiss. Göttingen
(1918) 235.
"""

from __future__ import annotations

from ..space import motions
from ..step import Step
from ..system import System

RULE = "symmetry-search"


def apply(system: System) -> Step:
    """A step of words only."""
    return Step(RULE, "", (), (), {"outcome": "and-space" if motions(system) else "affine"}, premises=("lagrangian",))
