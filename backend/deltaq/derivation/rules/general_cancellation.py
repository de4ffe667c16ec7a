"""Cancellation of the dots: v = dr/dt = ∂r/∂qₖ q̇ₖ + ∂r/∂t is linear in the rates, so ∂v/∂q̇ᵢ = ∂r/∂qᵢ.

Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.51.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, rate, summed
from ..formula import Explicit, Partial, Plus, Rate, Term, Times
from ..step import Relation, Step
from ._general import T, for_each, lever, position, velocity

RULE = "general-cancellation"


def apply(motion: AbstractMotion) -> Step:
    r, v = position(motion), velocity(motion)
    along = summed(lambda k: Times((lever(motion, k), Explicit(rate(k)))))
    lines = (
        Relation((v, Rate(r), Plus((Term(along), Term(Partial(r, T), (), 1, "time-term"))))),
        for_each(lambda i: Partial(v, rate(i)), lambda i: lever(motion, i)),
    )
    return Step(RULE, "", lines)
