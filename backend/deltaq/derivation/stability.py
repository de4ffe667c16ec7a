"""Stability of an equilibrium, as far as it can be decided.

Unstable: an eigenvalue of the linearization has a positive real part (Lyapunov). Stable: all have negative real parts;
or the energy is conserved, or fed to Rayleigh's dissipation function, and the stiffness matrix is positive definite
(Lagrange, Dirichlet). Coordinates that no force depends on are left out: their momentum is taken as unchanged (Routh).

Where that leaves it open and one coordinate remains, the first derivative of its force that is not zero decides, say
the k-th: F ≈ F⁽ᵏ⁾ ξᵏ/k!. The energy has a strict minimum if k is odd and F⁽ᵏ⁾ < 0. Else the force leads away from the
equilibrium on one side at least, and a disturbance at rest there never comes back (Chetaev).
Of several coordinates the same is asked along the curve on which the forces across it vanish, where K has a
one-dimensional kernel (Koiter); where K vanishes, the form of lowest degree of the potential decides. Where K has the
kernel of a family of equilibria and is positive across it, the system stays near the family. Where K is not positive
but gyroscopic forces keep all small motions bounded, the linearization decides nothing: with any complete damping the
equilibrium is unstable (Thomson, Tait, Chetaev).
Source: Merkin, Introduction to the Theory of Stability, §§2.3, 3.2, 3.4, 4.2, 6.3–6.4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import sympy as sp
from flint import acb_mat, arb, arb_mat

from ..language.derivatives import diff
from ..vocabulary import Stability
from .conservation import is_cyclic, is_passive
from .degenerate import leading
from .dissipation import is_dissipative
from .equilibria import Equilibrium, free_coordinates
from .leading_form import KINKS, leading_form, sign_of
from .matrix_form import forces_at_rest
from .program import number
from .spectrum import ZERO, Spectrum, kernel
from .system import System

GROWING = 1e-12  # real part, of the largest eigenvalue
HIGHEST = 8  # derivative of the force that is looked at
NOTHING = arb(2) ** -200  # of the terms of a derivative, where the equilibrium is known to more than 400 bits


@dataclass(frozen=True)
class Verdict:
    """What is known of the stability, and the derivative of the force that tells it: 0 where first order does.

    `kind` names what first order leaves open: a "family" of equilibria that the system stays near, a "gyroscopic"
    equilibrium where the potential has no minimum, a "degenerate" one where higher derivatives do not tell either, a
    "band" in which dry friction holds the system. With `by_form` the potential tells it by its form of lowest degree.
    """

    stability: Stability
    derivative: int = 0
    kind: str = ""
    by_form: bool = False


def verdict(
    system: System,
    equilibrium: Equilibrium,
    point: Mapping[str, arb],
    matrices: list[list[arb]],
    found: Spectrum | None,
) -> Verdict:
    """The stability at the scene's values, where `point` is the equilibrium in numbers."""
    if found is not None and (sign := growth(found)):
        return Verdict("unstable" if sign > 0 else "stable")
    free = free_coordinates(system)
    kept = [i for i, q in enumerate(system.free) if q not in free]
    if not kept or not (is_passive(system) or is_dissipative(system, matrices[1])):
        return Verdict("undecided")
    return _by_energy(system, equilibrium, point, matrices, kept)


def _by_energy(
    system: System,
    equilibrium: Equilibrium,
    point: Mapping[str, arb],
    matrices: list[list[arb]],
    kept: list[int],
) -> Verdict:
    """What the potential says, where no energy is fed in."""
    size, free = len(system.free), free_coordinates(system)
    stiffness = [[matrices[2][i * size + k] for k in kept] for i in kept]
    signs = signature(stiffness)
    loose = sum(1 for q in equilibrium.free if q not in free)
    turning = bool(skew(matrices[1], size))
    if signs is None or signs.positive == len(kept):
        return Verdict("undecided" if signs is None else "stable")
    if not signs.negative and signs.zero == loose > 0:
        return Verdict("stable", kind="family")
    if signs.negative and turning:
        return Verdict("undecided", kind="gyroscopic")
    mass = matrices[0][kept[0] * (size + 1)]
    known = Verdict("undecided", kind="family" if loose else "degenerate" if signs.zero else "")
    if bool(mass > 0) and all(is_cyclic(system, q) for q in free):
        if len(kept) == 1 or _are_apart(system, kept):
            known = _each_alone(system, equilibrium, point, kept)
        elif signs.zero == 1 and not (signs.negative or loose or turning):
            known = _along_kernel(system, point, stiffness, kept)
        elif signs.zero == len(kept) and not (loose or turning):
            known = _by_leading_form(system, point, kept)
    return known


def _are_apart(system: System, kept: list[int]) -> bool:
    """Whether each force hangs on its own coordinate alone."""
    forces = forces_at_rest(system)
    return not any(forces[i].has(system.q(system.free[k])) for i in kept for k in kept if i != k)


def _each_alone(system: System, equilibrium: Equilibrium, point: Mapping[str, arb], kept: list[int]) -> Verdict:
    """Unstable if one coordinate is, stable if all are."""
    verdicts = [_by_derivatives(system, equilibrium, point, i) for i in kept]
    order = ("unstable", "undecided", "stable")
    return min(verdicts, key=lambda each: (order.index(each.stability), -each.derivative))


def skew(matrix: list[arb], size: int) -> list[arb]:
    """The gyroscopic part of D, what it is more than rounding."""
    largest = max(map(abs, matrix), default=arb(0))
    parts = [matrix[i * size + k] - matrix[k * size + i] for i, k in combinations(range(size), 2)]
    return [part for part in parts if bool(abs(part) > ZERO * largest)]


def _along_kernel(system: System, point: Mapping[str, arb], stiffness: list[list[arb]], kept: list[int]) -> Verdict:
    """What the force says along the one direction in which the second derivatives vanish."""
    unknowns = [system.q(system.free[i]) for i in kept]
    forces = [forces_at_rest(system)[i].xreplace(dict(system.parameter_values)) for i in kept]
    largest = max(abs(entry) for row in stiffness for entry in row)
    (direction,) = kernel([[entry.mid() for entry in row] for row in stiffness], largest)
    matrix = arb_mat(len(kept), len(kept), [entry.mid() for row in stiffness for entry in row])
    found = leading(forces, unknowns, [point[q.name] for q in unknowns], matrix, direction)
    if found is None:
        return Verdict("undecided", kind="degenerate")
    return Verdict("stable" if found.restores else "unstable", found.order)


def _by_leading_form(system: System, point: Mapping[str, arb], kept: list[int]) -> Verdict:
    """What the potential says where all second derivatives vanish."""
    forces = forces_at_rest(system)
    form = leading_form([forces[i] for i in kept], [system.q(system.free[i]) for i in kept], point)
    sign = sign_of(form) if form else None
    if form is None or sign is None:
        return Verdict("undecided", kind="degenerate")
    degree = sum(next(iter(form)))
    return Verdict("stable" if sign > 0 else "unstable", degree - 1, by_form=True)


def growth(found: Spectrum) -> int:
    """1 if a small motion grows, −1 if all decay, else 0."""
    largest = max((value.size for value in found.eigenvalues), default=0.0) or 1.0
    growths = [float(value.real) / largest for value in found.eigenvalues]
    return int(max(growths) > GROWING) - int(max(growths) < -GROWING)


def _by_derivatives(system: System, equilibrium: Equilibrium, point: Mapping[str, arb], index: int) -> Verdict:
    """What the force at rest says, of one coordinate that alone matters, conserved or dissipated energy given."""
    q, force = system.q(system.free[index]), forces_at_rest(system)[index]
    for k in range(1, HIGHEST + 1):
        force = diff(force, q)
        if force.has(*KINKS):
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
    return Verdict("undecided", kind="degenerate")


@dataclass(frozen=True)
class Signature:
    """How many eigenvalues of a symmetric matrix are positive, zero and negative."""

    positive: int
    zero: int
    negative: int


def signature(matrix: list[list[arb]]) -> Signature | None:
    """The signs of the eigenvalues; None if the matrix is not symmetric, or not finite."""
    size = len(matrix)
    largest = max((abs(entry) for row in matrix for entry in row), default=arb(0))
    if not largest.is_finite():
        return None
    if any(abs(matrix[i][k] - matrix[k][i]) > ZERO * largest for i, k in combinations(range(size), 2)):
        return None
    values = acb_mat(size, size, [entry for row in matrix for entry in row]).eig(algorithm="approx")
    above = sum(1 for value in values if bool(value.real > ZERO * largest))
    below = sum(1 for value in values if bool(value.real < -ZERO * largest))
    return Signature(above, size - above - below, below)
