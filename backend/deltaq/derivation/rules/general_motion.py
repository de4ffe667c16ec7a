"""Configuration: every particle's position is a function of particle, time and coordinates, r = r(P, t, qᵢ).

Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.38.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, q
from ..formula import Explicit, Named, Quantity
from ..step import Relation, Step
from ._general import T, for_each, position

RULE = "general-motion"


def apply(motion: AbstractMotion) -> Step:
    named = position(motion)
    lines = (
        Relation((Named(named.quantity, named.value), named)),
        for_each(lambda i: Explicit(q(i)), lambda i: Named(Quantity("coordinate", i), q(i), (T,))),
    )
    return Step(RULE, "", lines)
