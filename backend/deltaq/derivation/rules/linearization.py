"""Linearization: with q = q₀ + x and small x, M₀ ẍ + D₀ ẋ + K₀ x = 0, D₀ = −∂f/∂q̇ and K₀ = −∂f/∂q at the equilibrium.

With constraints K₀ = −∂(f + Aᵀλ₀)/∂q, as reactions turn with the constraint, and A₀ x = 0 to first order: x = N y with
A₀ N = 0. Reactions do no work on such x, so that Nᵀ(M₀Nÿ + D₀Nẏ + K₀Ny) = 0 is free of them.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.2; Meirovitch, Methods of Analytical Dynamics, §6.4;
Nocedal, Wright, Numerical Optimization, 2nd ed., §12.5.
"""

from __future__ import annotations

from collections.abc import Iterator
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
from ..tangent import Tangent
from ._shape import at_rest, balanced, is_scalar, matrices, motions, numbers, shaped, zero

RULE = "linearization"


def apply(system: System, linear: Linearization, number: int) -> Step:
    """The matrices as derivatives of M and f, and the equation that they make."""
    whole = _whole(linear)
    stated = list(zip(whole, _laws(system), strict=True))
    used = [linear.is_damped or named is not whole[1] for named, _ in stated]
    lines = [_line(system, linear, *pair) for pair in compress(stated, used)]
    if linear.tangent is None:
        lines.append(_equation(system, linear, used))
        return Step(RULE, str(number), tuple(lines), (), {"number": str(number)})
    lines += _on_constraints(system, linear, linear.tangent, used)
    about = {"number": str(number), "coordinate": ", ".join(linear.tangent.independent), "outcome": "constrained"}
    return Step(RULE, str(number), tuple(lines), (), about, premises=(f"equilibrium:{number}",))


def _laws(system: System) -> tuple[Term, Term, Term]:
    """What M₀, D₀ and K₀ are the values of."""
    force = shaped("forcing", "vector", forcing(system))
    return (
        Term(shaped("mass", "matrix", mass_matrix(system))),
        minus(_slope(system, force, "rates-vector", [system.rate(q) for q in system.free])),
        minus(_slope(system, balanced(system, force), "coordinates-vector", [system.q(q) for q in system.free])),
    )


def _whole(linear: Linearization) -> tuple[Named, Named, Named]:
    """M₀, D₀ and K₀ in all coordinates."""
    if linear.tangent is None:
        return matrices(linear)
    values = {"mass": linear.tangent.mass, "damping": linear.tangent.damping, "stiffness": linear.tangent.stiffness}
    mass, damping, stiffness = (shaped(f"linear-{name}", "matrix", value) for name, value in values.items())
    return mass, damping, stiffness


def _equation(system: System, linear: Linearization, used: list[bool]) -> Relation:
    """M₀ẍ + D₀ẋ + K₀x = 0, by the letters and written out."""
    pairs = list(compress(zip(matrices(linear), motions(system, linear), strict=True), used))
    symbols = Plus(tuple(Term(MatrixTimes(m, x)) for m, x in pairs))
    written = Plus(tuple(Term(MatrixTimes(_written(linear, m), x)) for m, x in pairs))
    right = zero(linear.mass.rows)
    return Relation((Equation(symbols, right), Equation(written, right)), "⇔")


def _on_constraints(system: System, linear: Linearization, tangent: Tangent, used: list[bool]) -> Iterator[Relation]:
    """A₀ and N with A₀Ny = 0, and the equation of y: projected, by the letters and written out."""
    rows = Named(Quantity("linear-constraint-matrix"), tangent.rows)
    stated = Named(Quantity("constraint-matrix"), system.constraint_matrix())
    yield _line(system, linear, rows, Term(stated))
    basis = Named(Quantity("tangent-basis"), tangent.basis)
    yield Relation((basis, _written(linear, basis)), "=" if linear.equilibrium.exact else "≈")
    y = motions(system, linear)
    kept = MatrixTimes(rows, MatrixTimes(basis, y[2]))
    yield Relation((_at_values(system, linear, kept), zero(tangent.rows.rows)))
    turned = Named(Quantity("tangent-basis-transposed"), sp.ImmutableMatrix(tangent.basis.T))
    pairs = list(compress(zip(_whole(linear), y, strict=True), used))
    inside = Plus(tuple(Term(MatrixTimes(m, MatrixTimes(basis, x))) for m, x in pairs))
    projected = Equation(MatrixTimes(turned, inside), zero(linear.mass.rows))
    short = _equation(system, linear, used)
    yield Relation((projected, *short.members), "⇔")


def _slope(system: System, force: Formula, name: str, by: list[sp.Symbol]) -> Formula:
    """∂f/∂q or ∂f/∂q̇"""
    return Partial(force, by[0]) if is_scalar(system) else Jacobian(force, tuple(by), Quantity(name))


def _line(system: System, linear: Linearization, named: Named, law: Term) -> Relation:
    there = Plus((Term(AtEquilibrium(law.formula, at_rest(system, linear.equilibrium)), (), law.sign),))
    if linear.equilibrium.exact:
        return Relation((named, there, Explicit(named.value)))
    return Relation((named, Inserted(there, numbers(system)), Rounded(named.value)), "≈")


def _at_values(system: System, linear: Linearization, law: Formula) -> Formula:
    return law if linear.equilibrium.exact else Inserted(law, numbers(system))


def _written(linear: Linearization, named: Named) -> Formula:
    return Explicit(named.value) if linear.equilibrium.exact else Rounded(named.value)
