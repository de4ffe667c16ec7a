"""Virtual displacement in general: δr = ∂r/∂qᵢ δqᵢ, the time held fixed.

Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.47.
"""

from __future__ import annotations

from ..abstract_motion import FREEDOM, AbstractMotion, q, summed, variation
from ..formula import Called, Directional, Quantity, Summed
from ..step import Relation, Step
from ._general import H, lever, position, times_variation

RULE = "variation-of-position"


def apply(motion: AbstractMotion) -> Step:
    along = {q(i): variation(i) for i in (*map(str, range(1, FREEDOM + 1)), "i")}
    return Step(RULE, "", (Relation((displacement(motion), Directional(position(motion), along, H), chain(motion))),))


def chain(motion: AbstractMotion) -> Summed:
    """∂r/∂qᵢ δqᵢ"""
    return summed(lambda i: times_variation(lever(motion, i), i), "i")


def displacement(motion: AbstractMotion) -> Called:
    return Called(Quantity("virtual-displacement"), chain(motion))
