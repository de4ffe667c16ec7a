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
from ..vocabulary import Missing
from .matrix_form import forcing, mass_matrix
from .system import System

MOST_COORDINATES, MOST_CONSTRAINTS = 4, 2  # of those that are solved whatever they are like
MANY_COORDINATES, MANY_CONSTRAINTS = 9, 4  # of those that are tried where M is diagonal
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


class NotWritten(Exception):
    """λ is not written out; `why` not."""

    def __init__(self, why: Missing) -> None:
        super().__init__(why)
        self.why = why


@cached_method
def multipliers(system: System) -> Multipliers | None:
    """None where there are no constraints, or λ is not written out: `system.effort.left_out` then tells why."""
    if not system.conditions:
        return None
    try:
        return _written(system)
    except NotWritten as error:
        system.effort.left_out["multipliers"] = error.why
        return None


def _written(system: System) -> Multipliers:
    """Raises NotWritten."""
    if system.scene.is_redundant:  # the determinant is zero where the constraints hold, and nowhere else
        raise NotWritten("dependent")
    mass, rows = mass_matrix(system), system.constraint_matrix()
    if _are_many(system, mass):
        raise NotWritten("many")
    inverse = inverse_of(system, mass)
    if inverse is None or _length(mass, rows, forcing(system)) > MOST_GIVEN * _parted(system, mass):
        raise NotWritten("long")
    loads = forcing(system) + rows.T * sp.Matrix(system.multipliers)
    accelerations = {system.acceleration(q): a for q, a in zip(system.free, inverse * loads, strict=True)}
    matrix = sp.ImmutableMatrix(system.display(rows * inverse * rows.T))
    drift = sp.Matrix([system.drift_term(each) for each in system.conditions])
    rest = system.display(sp.ImmutableMatrix(rows * (inverse * forcing(system)) + drift))
    if _length(matrix, rest) > MOST_LEFT * _parted(system, matrix):
        raise NotWritten("long")
    values = _solved(system, matrix, rest)
    if values is None or sum(map(size, values.values())) > LONGEST:
        raise NotWritten("long")
    return Multipliers(accelerations, matrix, rest, values)


def _parted(system: System, matrix: sp.ImmutableMatrix) -> int:
    """How many times as long may be what falls into parts: a diagonal matrix multiplies nothing when it is inverted."""
    return len(system.conditions) if matrix.is_diagonal() else 1


def _are_many(system: System, mass: sp.ImmutableMatrix) -> bool:
    """Whether there are too many coordinates or constraints for it to be tried."""
    count, degrees = len(system.conditions), len(system.free)
    most = (MANY_CONSTRAINTS, MANY_COORDINATES) if mass.is_diagonal() else (MOST_CONSTRAINTS, MOST_COORDINATES)
    return count > most[0] or degrees > most[1]


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
