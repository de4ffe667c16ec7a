"""Linearization: with q = q₀ + x and small x, M₀ ẍ + D₀ ẋ + K₀ x = 0, D₀ = −∂f/∂q̇ and K₀ = −∂f/∂q at the equilibrium.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.2; Meirovitch, Methods of Analytical Dynamics, §6.4.
"""

from __future__ import annotations

from itertools import compress

import sympy as sp

from ..formula import (
    AtEquilibrium,
    Equation,
    Explicit,
    Formula,
    Inserted,
    Jacobian,
    MatrixTimes,
    Named,
    Partial,
    Plus,
    Quantity,
    Rounded,
    Term,
    minus,
)
from ..linearization import Linearization
from ..matrix_form import forcing, mass_matrix
from ..step import Relation, Step
from ..system import System
from ._shape import at_rest, is_scalar, matrices, motions, numbers, shaped, zero

RULE = "linearization"


def apply(system: System, linear: Linearization, number: int) -> Step:
    """The matrices as derivatives of M and f, and the equation that they make."""
    force = shaped(system, "forcing", "vector", forcing(system))
    mass, damping, stiffness = matrices(system, linear)
    stated = (
        (mass, Term(shaped(system, "mass", "matrix", mass_matrix(system)))),
        (damping, minus(_slope(system, force, "rates-vector", [system.rate(q) for q in system.free]))),
        (stiffness, minus(_slope(system, force, "coordinates-vector", [system.q(q) for q in system.free]))),
    )
    used = [linear.is_damped or named is not damping for named, _ in stated]
    lines = [_line(system, linear, *pair) for pair in compress(stated, used)]
    pairs = list(compress(zip((mass, damping, stiffness), motions(system), strict=True), used))
    symbols = Plus(tuple(Term(MatrixTimes(m, x)) for m, x in pairs))
    written = Plus(tuple(Term(MatrixTimes(_written(linear, m), x)) for m, x in pairs))
    equation = Relation((Equation(symbols, zero(system)), Equation(written, zero(system))), "⇔")
    return Step(RULE, str(number), (*lines, equation), (), {"number": str(number)})


def _slope(system: System, force: Named, name: str, by: list[sp.Symbol]) -> Formula:
    """∂f/∂q or ∂f/∂q̇"""
    return Partial(force, by[0]) if is_scalar(system) else Jacobian(force, tuple(by), Quantity(name))


def _line(system: System, linear: Linearization, named: Named, law: Term) -> Relation:
    there = Plus((Term(AtEquilibrium(law.formula, at_rest(system, linear)), (), law.sign),))
    if linear.equilibrium.exact:
        return Relation((named, there, Explicit(named.value)))
    return Relation((named, Inserted(there, numbers(system)), Rounded(named.value)), "≈")


def _written(linear: Linearization, named: Named) -> Formula:
    return Explicit(named.value) if linear.equilibrium.exact else Rounded(named.value)
