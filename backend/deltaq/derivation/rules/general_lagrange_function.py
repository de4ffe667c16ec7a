"""Lagrange function: with L = E − V, d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ = Qᵢᵈ, since ∂V/∂q̇ᵢ = 0.

Source: Lagrange, Mécanique analytique (1788); the lecture.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, q, rate
from ..formula import Equation, Partial, Plus, Term
from ..step import Relation, Step
from ._general import (
    ZERO,
    dissipative_force,
    for_each,
    kinetic_energy,
    lagrange_expression,
    lagrangian,
    potential_energy,
)

RULE = "general-lagrange-function"


def apply(motion: AbstractMotion) -> Step:
    energy, potential, function = kinetic_energy(motion), potential_energy(motion), lagrangian(motion)
    lines = (
        Relation((function, function.of)),
        for_each(lambda i: Partial(potential, rate(i)), lambda _: ZERO),
        for_each(lambda i: Partial(function, rate(i)), lambda i: Partial(energy, rate(i))),
        for_each(
            lambda i: Equation(
                Plus((*lagrange_expression(energy, i).terms, Term(Partial(potential, q(i))))),
                dissipative_force(motion, i),
            ),
            lambda i: Equation(lagrange_expression(function, i), dissipative_force(motion, i)),
            sign="⇔",
        ),
    )
    return Step(RULE, "", lines)
