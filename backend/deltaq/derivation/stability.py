"""Stability of an equilibrium, as far as it can be decided.

Unstable: an eigenvalue of the linearization has a positive real part (Lyapunov). Stable: all have negative real parts;
or the energy is conserved, or fed to Rayleigh's dissipation function, and the stiffness matrix is positive definite
(Lagrange, Dirichlet). Coordinates that no force depends on are left out: their momentum is taken as unchanged (Routh).

Where that leaves it open and one coordinate remains, the first derivative of its force that is not zero decides, say
the k-th: F ≈ F⁽ᵏ⁾ ξᵏ/k!. The energy has a strict minimum if k is odd and F⁽ᵏ⁾ < 0. Else the force leads away from the
equilibrium on one side at least, and a disturbance at rest there never comes back (Chetaev).
Source: Merkin, Introduction to the Theory of Stability, §§2.3, 3.2, 3.4, 4.2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import sympy as sp
from flint import acb_mat, arb

from ..vocabulary import Stability
from .conservation import is_cyclic, power
from .dissipation import is_dissipative
from .equilibria import Equilibrium, free_coordinates
from .matrix_form import forces_at_rest
from .program import number
from .spectrum import ZERO, Spectrum
from .system import System

GROWING = 1e-12  # real part, of the largest eigenvalue
HIGHEST = 8  # derivative of the force that is looked at
NOTHING = arb(2) ** -200  # of the terms of a derivative, where the equilibrium is known to more than 400 bits


@dataclass(frozen=True)
class Verdict:
    """What is known of the stability, and the derivative of the force that tells it: 0 where first order does."""

    stability: Stability
    derivative: int = 0


def verdict(
    system: System,
    equilibrium: Equilibrium,
    point: Mapping[str, arb],
    matrices: list[list[arb]],
    found: Spectrum | None,
) -> Verdict:
    """The stability at the scene's values, where `point` is the equilibrium in numbers."""
    size, free = len(system.free), free_coordinates(system)
    kept = [i for i, q in enumerate(system.free) if q not in free]
    stiffness = [[matrices[2][i * size + k] for k in kept] for i in kept]
    if found is not None and (growth := _growth(found)):
        return Verdict("unstable" if growth > 0 else "stable")
    if not kept or not (system.is_zero(power(system)) or is_dissipative(system, matrices[1])):
        return Verdict("undecided")
    if is_positive_definite(stiffness):
        return Verdict("stable")
    mass = matrices[0][kept[0] * (size + 1)]
    if len(kept) > 1 or not bool(mass > 0) or not all(is_cyclic(system, q) for q in free):
        return Verdict("undecided")
    return _by_derivatives(system, equilibrium, point, kept[0])


def _growth(found: Spectrum) -> int:
    """1 if a small motion grows, −1 if all decay, else 0."""
    largest = max((value.size for value in found.eigenvalues), default=0.0) or 1.0
    growths = [float(value.real) / largest for value in found.eigenvalues]
    return int(max(growths) > GROWING) - int(max(growths) < -GROWING)


def _by_derivatives(system: System, equilibrium: Equilibrium, point: Mapping[str, arb], index: int) -> Verdict:
    """What the force at rest says, of one coordinate that alone matters, conserved or dissipated energy given."""
    q, force = system.q(system.free[index]), forces_at_rest(system)[index]
    for k in range(1, HIGHEST + 1):
        force = force.diff(q)
        if force.has(sp.DiracDelta, sp.sign, sp.Abs, sp.Derivative):
            return Verdict("undecided")
        if equilibrium.exact and system.is_zero(force.xreplace(dict(equilibrium.values))):
            continue
        value = number(force, dict(point))
        size = sum((abs(number(term, dict(point))) for term in sp.Add.make_args(force)), arb(0))
        if not value.is_finite():
            return Verdict("undecided")
        if not bool(abs(value) > NOTHING * size):
            continue
        return Verdict("stable" if k % 2 and bool(value < 0) else "unstable", k)
    return Verdict("undecided")


def is_positive_definite(matrix: list[list[arb]]) -> bool:
    """Whether a matrix is symmetric with positive eigenvalues only."""
    size = len(matrix)
    largest = max((abs(entry) for row in matrix for entry in row), default=arb(0))
    if any(abs(matrix[i][k] - matrix[k][i]) > ZERO * largest for i, k in combinations(range(size), 2)):
        return False
    values = acb_mat(size, size, [entry for row in matrix for entry in row]).eig(algorithm="approx")
    return all(bool(value.real > ZERO * largest) for value in values)
