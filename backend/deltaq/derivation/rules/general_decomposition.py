"""Decomposition: Qᵢ = Qᵢᵖ + Qᵢᵈ with Qᵢᵖ = −∂V/∂qᵢ, so d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ + ∂V/∂qᵢ = Qᵢᵈ.

Source: the lecture; Szabó, Höhere Technische Mechanik, §I.6.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, q
from ..formula import Equation, Formula, Named, Partial, Plus, Quantity, Term, minus
from ..step import Step
from ._general import (
    dissipative_force,
    for_each,
    generalized_force,
    kinetic_energy,
    lagrange_expression,
    potential_energy,
)

RULE = "general-decomposition"


def apply(motion: AbstractMotion) -> Step:
    energy = kinetic_energy(motion)
    lines = (
        for_each(
            lambda i: generalized_force(motion, i),
            lambda i: Plus((Term(_conservative(motion, i)), Term(dissipative_force(motion, i)))),
        ),
        for_each(lambda i: _conservative(motion, i), lambda i: Plus((minus(_slope(motion, i)),))),
        for_each(
            lambda i: Equation(lagrange_expression(energy, i), generalized_force(motion, i)),
            lambda i: Equation(
                Plus((*lagrange_expression(energy, i).terms, Term(_slope(motion, i)))), dissipative_force(motion, i)
            ),
            sign="⇔",
        ),
    )
    return Step(RULE, "", lines)


def _conservative(motion: AbstractMotion, index: str) -> Named:
    """Qᵢᵖ"""
    return Named(Quantity("conservative-force", index), -motion.potential.diff(q(index)))


def _slope(motion: AbstractMotion, index: str) -> Formula:
    """∂V/∂qᵢ"""
    return Partial(potential_energy(motion), q(index))
