"""Exchange of integration and differentiation: the body does not depend on t and qᵢ, so ∫ ∂/∂q (v · v/2) dm = ∂E/∂q.

Source: the lecture; Forster, Analysis 3, §11 (differentiation under the integral).
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, q, rate
from ..formula import Partial, Plus, Rate, Term, minus
from ..step import Relation, Step
from ._general import by_mass, for_each, half_square, inertia, kinetic_energy, lagrange_expression

RULE = "general-integral"


def apply(motion: AbstractMotion) -> Step:
    energy, half = kinetic_energy(motion), half_square(motion)
    lines = (
        for_each(
            lambda i: inertia(motion, i),
            lambda i: Plus(
                (
                    Term(Rate(by_mass(motion, Partial(half, rate(i))))),
                    minus(by_mass(motion, Partial(half, q(i)))),
                )
            ),
            lambda i: lagrange_expression(by_mass(motion, half), i),
            lambda i: lagrange_expression(energy, i),
        ),
        Relation((energy, energy.of)),
    )
    return Step(RULE, "", lines)
