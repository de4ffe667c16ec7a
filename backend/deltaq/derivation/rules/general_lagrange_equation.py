"""Lagrange's equations of the second kind: d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ = Qᵢ for i = 1 … f.

Source: Lagrange, Mécanique analytique (1788); the lecture.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion
from ..formula import Equation
from ..step import Step
from ._general import for_each, generalized_force, inertia, kinetic_energy, lagrange_expression

RULE = "general-lagrange-equation"


def apply(motion: AbstractMotion) -> Step:
    line = for_each(
        lambda i: Equation(inertia(motion, i), generalized_force(motion, i)),
        lambda i: Equation(lagrange_expression(kinetic_energy(motion), i), generalized_force(motion, i)),
        sign="⇔",
    )
    return Step(RULE, "", (line,))
