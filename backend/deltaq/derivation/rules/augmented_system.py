"""Equations of motion and differentiated constraints as one linear system for q̈ and λ:

    ⎡ M  Aᵀ ⎤ ⎡  q̈ ⎤   ⎡  f ⎤
    ⎣ A  0  ⎦ ⎣ −λ ⎦ = ⎣ −γ ⎦

It is symmetric; it has one solution where the rows of A are independent and M is positive on what they leave free.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., §VII.1.
"""

from __future__ import annotations

import sympy as sp

from ..calculus import column
from ..formula import Equation, Explicit, Formula, MatrixTimes, Named, Quantity, Stack
from ..matrix_form import forcing, mass_matrix
from ..step import Relation, Step
from ..system import System
from ._lagrange import left_side, right_side
from .constraint_rates import RULE as RATES
from .constraint_rates import highest

RULE = "augmented-system"


def apply(system: System) -> Step:
    """All laws in one line, and M, A, f and γ written out; rows of A that depend on others leave λ open."""
    laws = [left_side(system, q) for q in system.free] + [
        _rate_of(system, index) for index in range(len(system.conditions))
    ]
    right = [right_side(system, q) for q in system.free] + [Explicit(system.zero)] * len(system.conditions)
    unknown = column((*map(system.acceleration, system.free), *(-each for each in system.multipliers)))
    written = Equation(
        MatrixTimes(Explicit(augmented_matrix(system)), Explicit(unknown)), Explicit(augmented_right_side(system))
    )
    parts = {
        "mass-matrix": mass_matrix(system),
        "constraint-matrix": system.constraint_matrix(),
        "forcing-vector": forcing(system),
    }
    lines = (
        Relation((Equation(Stack(tuple(laws)), Stack(tuple(right))), written), "⇔"),
        *(Relation((Named(Quantity(kind), value), Explicit(value))) for kind, value in parts.items()),
    )
    sources = (*system.body_sources, *(f"load:{load}" for load in system.load_names), *system.constraint_sources)
    premises = tuple(f"{RATES}:{condition.source}" for condition in system.conditions)
    about = {"outcome": "dependent" if system.scene.is_redundant else "text"}
    return Step(RULE, "", lines, sources, about, premises=(*(f"equation:{q}" for q in system.free), *premises))


def augmented_matrix(system: System) -> sp.ImmutableMatrix:
    """[M Aᵀ; A 0]"""
    mass, rows = mass_matrix(system), system.constraint_matrix()
    return sp.ImmutableMatrix(sp.Matrix([[mass, rows.T], [rows, sp.zeros(rows.rows, rows.rows)]]))


def augmented_right_side(system: System) -> sp.ImmutableMatrix:
    """[f; −γ]"""
    return column((*forcing(system), *(-system.drift_term(each) for each in system.conditions)))


def _rate_of(system: System, index: int) -> Formula:
    condition = system.conditions[index]
    return highest(system.named_condition(condition), condition)
