"""Exchange of derivatives: d/dt (∂r/∂qᵢ) = ∂/∂qᵢ (dr/dt) = ∂v/∂qᵢ, as mixed partial derivatives are equal.

Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4 (Schwarz's theorem).
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, q
from ..formula import Partial, Rate
from ..step import Step
from ._general import for_each, lever, position, velocity

RULE = "general-exchange"


def apply(motion: AbstractMotion) -> Step:
    line = for_each(
        lambda i: Rate(lever(motion, i)),
        lambda i: Partial(Rate(position(motion)), q(i)),
        lambda i: Partial(velocity(motion), q(i)),
    )
    return Step(RULE, "", (line,))
