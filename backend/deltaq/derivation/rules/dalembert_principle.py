"""d'Alembert's principle: δW_Mb = δW_a + δW_i for all virtual displacements; rigid bodies have δW_i = 0.

Here δW_Mb = ∫ δr · dv/dt dm. The δqᵢ are independent, so the factors of each δqᵢ are equal.
Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.45.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, summed, variation
from ..formula import Called, Dot, Equation, Partial, Plus, Quantity, Summed, Term
from ..step import Relation, Step
from ._general import ZERO, acceleration, by_mass, for_each, generalized_force, inertia, times_variation
from .variation_of_position import displacement

RULE = "dalembert-principle"


def apply(motion: AbstractMotion) -> Step:
    inner = Called(Quantity("inner-virtual-work"), ZERO)
    inert = Called(Quantity("work-of-inertia"), by_mass(motion, Dot(displacement(motion), acceleration(motion))))
    outer = Called(Quantity("virtual-work"), _outer(motion))
    collected = summed(lambda i: times_variation(inertia(motion, i), i), "i")
    lines = (
        Relation((inner, ZERO)),
        Relation((inert, inert.of, collected)),
        Relation((Equation(inert, Plus((Term(outer), Term(inner)))), Equation(collected, _outer(motion))), "⇔"),
        for_each(
            lambda i: Equation(Partial(inert, variation(i)), Partial(outer, variation(i))),
            lambda i: Equation(inertia(motion, i), generalized_force(motion, i)),
            sign="⇔",
        ),
    )
    return Step(RULE, "", lines)


def _outer(motion: AbstractMotion) -> Summed:
    """Qᵢ δqᵢ"""
    return summed(lambda i: times_variation(generalized_force(motion, i), i), "i")
