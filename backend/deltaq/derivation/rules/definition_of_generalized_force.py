"""Generalized forces: δW_a = Qᵢ δqᵢ with Qᵢ = ∫ ∂r/∂qᵢ · f_S dS + ∫ ∂r/∂qᵢ · f_V dV, over the surface and the volume.

Source: the lecture's definition of Qᵢ.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, summed, variation
from ..formula import Called, Partial, Quantity
from ..step import Relation, Step
from ._general import for_each, lever, times_variation, work_by_region
from .variation_of_position import displacement

RULE = "definition-of-generalized-force"


def apply(motion: AbstractMotion) -> Step:
    work = Called(Quantity("virtual-work"), work_by_region(motion, displacement(motion)))

    def force(i: str) -> Called:
        return Called(Quantity("generalized-force", i), work_by_region(motion, lever(motion, i)))

    lines = (
        Relation(
            (
                work,
                work.of,
                summed(lambda i: times_variation(work_by_region(motion, lever(motion, i)), i), "i"),
                summed(lambda i: times_variation(force(i), i), "i"),
            )
        ),
        for_each(force, lambda i: Partial(work, variation(i)), lambda i: work_by_region(motion, lever(motion, i))),
    )
    return Step(RULE, "", lines)
