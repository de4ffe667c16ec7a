"""Product rule: ∂r/∂qᵢ · dv/dt = d/dt (∂r/∂qᵢ · v) − d/dt (∂r/∂qᵢ) · v.

Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion
from ..formula import Dot, Plus, Rate, Term, minus
from ..step import Step
from ._general import acceleration, for_each, lever, velocity

RULE = "general-product-rule"


def apply(motion: AbstractMotion) -> Step:
    v = velocity(motion)
    line = for_each(
        lambda i: Dot(lever(motion, i), acceleration(motion)),
        lambda i: Plus((Term(Rate(Dot(lever(motion, i), v))), minus(Dot(Rate(lever(motion, i)), v)))),
    )
    return Step(RULE, "", (line,))
