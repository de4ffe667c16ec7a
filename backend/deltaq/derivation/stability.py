"""Stability of an equilibrium, as far as it can be decided.

Unstable: an eigenvalue of the linearization has a positive real part (Lyapunov). Stable: all have negative real parts;
or the energy is conserved, or fed to Rayleigh's dissipation function, and the stiffness matrix is positive definite
(Lagrange, Dirichlet). Coordinates that no force depends on are left out: their momentum is taken as unchanged (Routh).
Source: Merkin, Introduction to the Theory of Stability, §§2.3, 3.2, 4.2.
"""

from __future__ import annotations

from itertools import combinations

from flint import acb_mat, arb

from ..vocabulary import Stability
from .conservation import power
from .dissipation import is_dissipative
from .equilibria import free_coordinates
from .spectrum import ZERO, Spectrum
from .system import System

GROWING = 1e-12  # real part, of the largest eigenvalue


def stability(system: System, matrices: list[list[arb]], spectrum: Spectrum | None) -> Stability:
    """`stable`, `unstable` or `undecided`."""
    free = {system.free.index(q) for q in free_coordinates(system)}
    kept = [i for i in range(len(system.free)) if i not in free]
    size = len(system.free)
    stiffness = [[matrices[2][i * size + k] for k in kept] for i in kept]
    if spectrum is not None:
        largest = max((value.size for value in spectrum.eigenvalues), default=0.0) or 1.0
        growths = [float(value.real) / largest for value in spectrum.eigenvalues]
        if max(growths) > GROWING:
            return "unstable"
        if max(growths) < -GROWING:
            return "stable"
    has_energy = system.is_zero(power(system)) or is_dissipative(system, matrices[1])
    return "stable" if kept and has_energy and is_positive_definite(stiffness) else "undecided"


def is_positive_definite(matrix: list[list[arb]]) -> bool:
    """Whether a matrix is symmetric with positive eigenvalues only."""
    size = len(matrix)
    largest = max((abs(entry) for row in matrix for entry in row), default=arb(0))
    if any(abs(matrix[i][k] - matrix[k][i]) > ZERO * largest for i, k in combinations(range(size), 2)):
        return False
    values = acb_mat(size, size, [entry for row in matrix for entry in row]).eig(algorithm="approx")
    return all(bool(value.real > ZERO * largest) for value in values)
