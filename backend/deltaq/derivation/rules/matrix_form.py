"""Matrix form: Lagrange's equations are linear in the accelerations, M(q, t) q̈ = f(q, q̇, t), with Mᵢₖ = ∂²E/∂q̇ᵢ∂q̇ₖ.

Source: Meirovitch, Methods of Analytical Dynamics, §2.11 and §6.4; Arnold, Mathematical Methods of Classical
Mechanics, 2nd ed., §19.
"""

from __future__ import annotations

from ..calculus import column
from ..formula import Equation, Explicit, Formula, MatrixTimes, Named, Quantity, Stack
from ..matrix_form import forcing, mass_matrix
from ..step import Relation, Step
from ..system import System
from ._lagrange import left_side, other_force
from ._shape import is_scalar, plain_value, shaped

RULE = "matrix-form"


def apply(system: System) -> Step:
    """All equations in one line, and M and f written out."""
    accelerations = column(system.acceleration(q) for q in system.free)
    mass = shaped("mass", "matrix", mass_matrix(system))
    force = shaped("forcing", "vector", forcing(system))
    second = Named(Quantity("accelerations-vector"), plain_value(accelerations))
    laws = [left_side(system, q) for q in system.free]
    right: list[Formula] = [other_force(system, q) for q in system.free]
    law = Equation(*laws, *right) if is_scalar(system) else Equation(Stack(tuple(laws)), Stack(tuple(right)))
    moved = Explicit(second.value) if is_scalar(system) else second
    lines = (
        Relation((law, Equation(MatrixTimes(mass, moved), force)), "⇔"),
        Relation((mass, Explicit(mass.value))),
        Relation((force, Explicit(force.value))),
    )
    sources = tuple(f"load:{load}" for load in system.load_names)
    return Step(RULE, "", lines, system.body_sources + sources)
