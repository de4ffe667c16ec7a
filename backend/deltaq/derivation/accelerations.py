"""Accelerations along the motion: q̈ = M⁻¹ f, or with constraints q̈ = M⁻¹ (f + Aᵀ λ) with λ in closed form.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4; for constraints see `multipliers`.
"""

from __future__ import annotations

import sympy as sp

from ..language.display import size
from ..language.memory import cached_method
from .matrix_form import forcing, mass_matrix
from .multipliers import multipliers
from .system import System

MOST_COORDINATES = 3
LONGEST = 300  # parts of an expression that is still read


@cached_method
def accelerations(system: System) -> dict[sp.Symbol, sp.Expr] | None:
    """q̈(q, q̇, t), and the multipliers where there are constraints; None where they would be too long."""
    if system.conditions:
        found = multipliers(system)
        if found is None:
            return None
        solved = {a: system.display(value.xreplace(found.values)) for a, value in found.accelerations.items()}
        return {**solved, **found.values}
    if len(system.free) > MOST_COORDINATES:
        return None
    mass, loads = mass_matrix(system), forcing(system)
    determinant = system.display(mass.det(method="berkowitz"))
    if determinant == 0 or sum(map(size, (*mass, *loads))) > LONGEST:
        return None
    solution = mass.adjugate() * loads
    return {
        system.acceleration(q): system.display(value / determinant)
        for q, value in zip(system.free, solution, strict=True)
    }
