"""Uniform motion that says nothing about a scene: what a moving observer, or another origin, would take away.

A direction a in the space of coordinates is one of boosts if neither M nor f of M q̈ = f depends on the coordinates
along it nor on their rates: then q + a (c + v t) is a motion whenever q is. The motion of the centre of mass of a free
system is of that kind, and so is the spin of a balanced rotor. Along a direction of lengths on which M and f do not
depend at all, though on its rate they may, the mean drift is told apart too: a charge in crossed fields gets further
the longer one waits. The turning of a cyclic angle is neither: no frame takes away what a centrifugal force feels.
Source: Landau, Lifshitz, Mechanics, §3 and §8; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.2 and §8.2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...simulation.problem import Floats, Problem

POINTS, SEED = 24, 7
STEP = 1e-4  # of a difference, in the units of the coordinates
NEGLIGIBLE = 1e-6  # a slope, as a part of what M and f are in those units
LEAST = 1e-5  # of the largest of its kind that an entry of M or f is measured by
SAME = 1e-8
REGULAR = 1e10  # condition of the part of M that belongs to the directions


@dataclass(frozen=True)
class Directions:
    """Directions as orthonormal columns, in units of the coordinates.

    `boosts`, shape (n, boosts), are those of boosts; `lengths`, shape (n, lengths), those on which nothing depends.
    """

    boosts: Floats
    lengths: Floats

    @property
    def both(self) -> Floats:
        """An orthonormal basis of all of them: shape (n, directions)."""
        left, sizes, _ = np.linalg.svd(np.hstack([self.boosts, self.lengths]), full_matrices=False)
        return np.asarray(left[:, sizes > SAME])

    def can_be_boosted(self) -> np.ndarray:
        """Which coordinates alone are directions of boosts: shape (n,)."""
        return np.asarray(np.linalg.norm(self.boosts, axis=1) > 1.0 - SAME)


def drift(times: Floats, states: Floats, masses: Floats, along: Floats) -> Floats:
    """The rates of a motion's uniform part: the mean over time of (Nᵀ M N)⁻¹ Nᵀ M q̇, the columns N being `along`.

    For the direction of a common displacement that is the velocity of the centre of mass. `times` has shape (samples,),
    `states` shape (samples, 2n), `masses` shape (samples, n, n), `along` shape (n, directions); returns shape (n,).
    """
    n = len(along)
    if len(times) < 2 or not np.isfinite(masses).all():
        return np.zeros(n)
    inner = along.T @ masses @ along
    if not along.shape[1] or np.linalg.cond(inner).max() > REGULAR:
        return np.zeros(n)
    momenta = np.einsum("ia,tij,tj->ta", along, masses, states[:, n : 2 * n])
    velocities = np.linalg.solve(inner, momenta[..., None])[..., 0]
    return np.asarray(along @ (np.trapezoid(velocities, times, axis=0) / (times[-1] - times[0])))


def directions(problem: Problem, times: Floats, states: Floats, units: Floats, is_length: np.ndarray) -> Directions:
    """The directions of a problem, seen near a motion of it.

    `times` has shape (samples,), `states` shape (samples, 2n). `units` are sizes of changes of the coordinates,
    `is_length` says which are lengths: shape (n,) each.
    """
    n = problem.degrees
    if not len(times):
        return Directions(np.zeros((n, 0)), np.zeros((n, 0)))
    slopes = _slopes(problem, times, states, units)
    lengths = np.eye(n)[:, is_length]
    held = _held(problem, times, states, units)
    return Directions(
        _null_space(slopes[:, :n], slopes[:, n:], held), lengths @ _null_space(slopes[:, :n] @ lengths, held @ lengths)
    )


def _held(problem: Problem, times: Floats, states: Floats, units: Floats) -> Floats:
    """The rows of A, in units of the coordinates, which directions have to keep: shape (rows, n)."""
    chosen = np.linspace(0, len(times) - 1, POINTS).astype(int)
    system = problem.system(times[chosen], states[chosen])
    rows = system.rows.reshape(-1, problem.degrees) * units
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(np.divide(rows, sizes, out=np.zeros_like(rows), where=sizes > 0.0))


def _null_space(*parts: Floats) -> Floats:
    """The directions along which nothing changes, as orthonormal columns."""
    slopes = np.vstack(parts)
    squares, directions = np.linalg.eigh(slopes.T @ slopes / max(1, len(slopes)))
    return np.asarray(directions[:, squares <= NEGLIGIBLE**2])


def _slopes(problem: Problem, times: Floats, states: Floats, units: Floats) -> Floats:
    """The slopes of M and f over coordinates and rates at points near the motion, all without units, a row for each.

    Points at which they are not defined are left out.
    """
    n, source = problem.degrees, np.random.default_rng(SEED)
    chosen = np.linspace(0, len(times) - 1, POINTS).astype(int)
    scales = np.concatenate([units, units * _frequency(states, units)])
    places = states[chosen, : 2 * n] + scales * source.uniform(-1.0, 1.0, (POINTS, 2 * n))
    table = _without_units(_table(problem, times[chosen], places), n, units)
    sizes = _sizes(table, n)
    columns = []
    for step in STEP * np.diag(scales):
        ahead, behind = (_table(problem, times[chosen], places + sign * step) for sign in (1.0, -1.0))
        columns.append(_without_units(ahead - behind, n, units) / (2.0 * STEP * sizes))
    slopes = np.stack(columns, axis=-1).reshape(-1, 2 * n)
    return np.asarray(slopes[np.isfinite(slopes).all(axis=1)])


def _frequency(states: Floats, units: Floats) -> float:
    """How often a second the fastest coordinate changes by its unit."""
    fastest = float(np.abs(states[:, len(units) : 2 * len(units)] / units).max())
    return fastest if fastest > 0.0 else 1.0


def _table(problem: Problem, times: Floats, states: Floats) -> Floats:
    """The lower triangle of M, then f."""
    n = problem.degrees
    return np.asarray(problem.model.motion.table(problem.inputs(times, states))[:, : n * (n + 1) // 2 + n])


def _without_units(table: Floats, n: int, units: Floats) -> Floats:
    rows, columns = np.tril_indices(n)
    return np.asarray(table * np.concatenate([units[rows] * units[columns], units]))


def _sizes(table: Floats, n: int) -> Floats:
    """How large each column is; what is far smaller than the rest of its kind counts as that much of it."""
    largest = np.nanmax(np.abs(table), axis=0, initial=0.0, where=np.isfinite(table))
    count = n * (n + 1) // 2
    kinds = np.concatenate([np.full(count, largest[:count].max()), np.full(n, largest[count:].max())])
    found = np.maximum(largest, LEAST * kinds)
    return np.asarray(np.where(found > 0.0, found, 1.0))
