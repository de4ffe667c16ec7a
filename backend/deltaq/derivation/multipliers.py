"""The multipliers in closed form, where they are short: from A q̈ + γ = 0 and q̈ = M⁻¹ (f + Aᵀ λ),

    (A M⁻¹ Aᵀ) λ = −γ − A M⁻¹ f.

Source: Udwadia, Kalaba, Analytical Dynamics: A New Approach, §3.3; Hairer, Wanner, Solving ODEs II, §VII.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..language.display import size
from ..language.memory import cached_method
from ..language.operations import operations
from .matrix_form import forcing, mass_matrix
from .system import System

MOST_COORDINATES, MOST_CONSTRAINTS = 4, 2
LONGEST = 400  # parts of an expression that is still read
LEAST_CANCELLED, MOST_CANCELLED = 12, 200  # parts of an expression whose common factors are cancelled
MOST_GIVEN, MOST_LEFT = 150, 120  # parts of the laws, and of the system for λ: solving it multiplies them


@dataclass(frozen=True)
class Multipliers:
    """λ(q, q̇, t), and what it comes from: `matrix` λ + `rest` is Φ̈ along the motion with the multipliers λ."""

    accelerations: dict[sp.Symbol, sp.Expr]  # in terms of λ
    matrix: sp.ImmutableMatrix
    rest: sp.ImmutableMatrix
    values: dict[sp.Symbol, sp.Expr]


@cached_method
def multipliers(system: System) -> Multipliers | None:
    """None where there are no constraints, or λ would be too long to be read."""
    count = len(system.conditions)
    if not 0 < count <= MOST_CONSTRAINTS or len(system.free) > MOST_COORDINATES:
        return None
    mass, rows = mass_matrix(system), system.constraint_matrix()
    if _length(mass, rows, forcing(system)) > MOST_GIVEN:
        return None
    inverse = inverse_of(system, mass)
    if inverse is None:
        return None
    loads = forcing(system) + rows.T * sp.Matrix(system.multipliers)
    accelerations = {system.acceleration(q): a for q, a in zip(system.free, inverse * loads, strict=True)}
    matrix = system.display(rows * inverse * rows.T)
    drift = sp.Matrix([system.drift_term(each) for each in system.conditions])
    rest = system.display(sp.ImmutableMatrix(rows * (inverse * forcing(system)) + drift))
    if _length(matrix, rest) > MOST_LEFT:
        return None
    values = _solved(system, sp.ImmutableMatrix(matrix), rest)
    if values is None or sum(map(size, values.values())) > LONGEST:
        return None
    return Multipliers(accelerations, sp.ImmutableMatrix(matrix), rest, values)


def _length(*matrices: sp.ImmutableMatrix) -> int:
    return sum(size(entry) for matrix in matrices for entry in matrix)


def inverse_of(system: System, mass: sp.ImmutableMatrix) -> sp.ImmutableMatrix | None:
    """M⁻¹ by the adjugate, written to be read; None if M has none."""
    determinant = system.display(mass.det(method="berkowitz"))
    if determinant == 0:
        return None
    return sp.ImmutableMatrix(mass.adjugate()).applyfunc(lambda entry: system.display(entry / determinant))


def _solved(system: System, matrix: sp.ImmutableMatrix, rest: sp.ImmutableMatrix) -> dict[sp.Symbol, sp.Expr] | None:
    """λ = −(matrix)⁻¹ rest"""
    determinant = system.display(matrix.det(method="berkowitz"))
    if determinant == 0:
        return None
    found = -(matrix.adjugate() * rest)
    return {
        each: simplified(system, value / determinant) for each, value in zip(system.multipliers, found, strict=True)
    }


def simplified(system: System, value: sp.Expr) -> sp.Expr:
    """The display form, or the shorter one that cancelling common factors of numerator and denominator leads to.

    Roots of the constraints are cancelled as well: x²/√(x² + y²)² + y²/(x² + y²) is 1.
    """
    shown = system.display(value)
    if not MOST_CANCELLED >= size(shown) > LEAST_CANCELLED:
        return shown
    try:
        cancelled = sp.cancel(sp.together(shown))
        apart = _by_rates(system, cancelled)
    except sp.PolynomialError:
        return shown
    found = (shown, system.display(cancelled), system.display(sp.factor_terms(cancelled)), apart)
    return min(found, key=operations)


def _by_rates(system: System, value: sp.Expr) -> sp.Expr:
    """What is of one degree in the rates together, each in factors: m (x ẏ − y ẋ)²/s³ + m g y/s of a rod's force."""
    rates = [system.rate(q) for q in system.free]
    upper, lower = sp.fraction(value)
    if lower.has(*rates) or not upper.is_polynomial(*rates):
        return value
    groups: dict[int, sp.Expr] = {}
    for powers, factor in sp.Poly(upper, *rates).terms():
        term = sp.Mul(factor, *(rate**power for rate, power in zip(rates, powers, strict=True)))
        groups[sum(powers)] = groups.get(sum(powers), system.zero) + term
    return sp.Add(*(sp.factor(group / lower) for group in groups.values()))
