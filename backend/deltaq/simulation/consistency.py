"""Initial values that keep the constraints: positions on g = 0 and rates on w = 0, as near as can be.

Near is meant in the metric of the mass matrix, ½ Δqᵀ M Δq; of the rates this takes the least kinetic energy, as if the
constraints had been imposed by a blow. Positions are found by Newton's method on the conditions of the nearest point.
Sources: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.1; Lurie, Analytical Mechanics, ch. 8.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import Problem as Mistake
from ..errors import SceneError
from ..model.model import Model
from .kernels.motion import SMALLEST_SCHUR_PIVOT
from .problem import Floats, Moved, Problem
from .rounding import short

PASSES = 60
SETTLED, CLOSE = 1e-13, 1e-9  # corrections relative to coordinates above 1: then done, and what must be reached
FARTHEST = 4.0  # of a correction, in units of the coordinates or of 1: consistent positions are not near
AROUND, POINTS = 1e-3, 3  # how far around a configuration, and at how many points, independence is looked at
FLAT = 1e-3  # of a gradient beside the positions that keep a constraint: there it has none
SHARES = 1e-6  # of a multiplier in a combination that has no effect


@dataclass(frozen=True)
class Start:
    """Consistent initial values: `values` and `rates`, shape (n,), of how many independent constraints (`rank`).

    `undetermined` are the constraints whose multipliers are not unique, by their number among the model's.
    """

    values: Floats
    rates: Floats
    rank: int
    undetermined: tuple[int, ...]


def consistent(problem: Problem) -> Problem:
    """The problem with initial values that keep the constraints, and by how much they were moved.

    Raises SceneError where no such values are near.
    """
    layout = problem.model.layout
    values, rates = np.array(problem.values), np.array(problem.rates)
    start = consistent_start(problem.model, np.array(problem.parameters), values, rates)
    moved = Moved(
        tuple((start.values - values).tolist()),
        tuple((start.rates - rates).tolist()),
        tuple(layout.multipliers[k] for k in start.undetermined),
    )
    found = tuple(start.values.tolist()), tuple(start.rates.tolist())
    return replace(problem, values=found[0], rates=found[1], rank=start.rank, moved=moved)


def consistent_start(model: Model, parameters: Floats, values: Floats, rates: Floats) -> Start:
    """The consistent values next to those wanted: `values` and `rates` have shape (n,), `parameters` (parameters,).

    Raises SceneError where there are none near, or where constraints lose their independence.
    """
    places = model.layout.constraints
    constraints = _Constraints(model, parameters)
    found = constraints.nearest(values)
    moved = np.abs(found - values) / np.maximum(1.0, np.abs(values))
    worst = constraints.worst(values if not np.isfinite(found).all() else found)
    endless = constraints.endless(found if np.isfinite(found).all() else values, rates)
    if endless is not None:
        raise _refused("constraint-not-finite", places[endless], 0.0)
    if not np.isfinite(found).all() or constraints.is_off(found) or moved.max() > FARTHEST:
        raise _refused("constraint-not-met", places[worst], constraints.gaps(values, rates)[worst])
    eigenvalues, vectors = constraints.spectrum(found)
    rank = int(np.count_nonzero(eigenvalues > SMALLEST_SCHUR_PIVOT))
    if constraints.rank_around(found) > rank:
        weak = int(np.argmax(np.abs(vectors[:, 0])))
        raise _refused(
            "constraint-without-gradient" if constraints.is_flat(weak, found) else "constraints-locked",
            places[weak],
            0.0,
        )
    speeds = constraints.nearest_rates(found, rates)
    slips = np.abs(constraints.slips(found, speeds))
    if (slips > CLOSE * constraints.rate_sizes(found, speeds)).any():
        worst = int(np.argmax(slips))
        raise _refused("constraint-rate-not-met", places[worst], slips[worst])
    free = np.abs(vectors[:, eigenvalues <= SMALLEST_SCHUR_PIVOT]).max(axis=1, initial=0.0)
    return Start(found, speeds, rank, tuple(int(k) for k in np.flatnonzero(free > SHARES)))


def idle_multipliers(problem: Problem) -> Floats:
    """λ that exert no force where a problem begins, Aᵀλ = 0, one for each constraint too many: shape (idle, m)."""
    constraints, values = _Constraints(problem.model, np.array(problem.parameters)), np.array(problem.values)
    eigenvalues, vectors = constraints.spectrum(values)
    return np.asarray((vectors[:, eigenvalues <= SMALLEST_SCHUR_PIVOT] * constraints.scales(values)[:, None]).T)


def unmet(problem: Problem) -> SceneError:
    """That constraints cannot be kept where a problem begins: with numbers whose digits end before it matters."""
    constraints, values = _Constraints(problem.model, np.array(problem.parameters)), np.array(problem.values)
    worst = constraints.worst(values)
    gap = float(np.nan_to_num(constraints.gaps(values, np.array(problem.rates))[worst]))
    return _refused("constraint-not-met", problem.model.layout.constraints[worst], gap)


def _refused(code: str, place: int, gap: float) -> SceneError:
    return SceneError(Mistake(code, f"/constraints/{place}", parameters={"gap": short(float(abs(gap)))}))


@dataclass(frozen=True)
class _Constraints:
    """A model's constraints g(q) = 0 and w(q, q̇) = 0 at t = 0, with M and A, whose rows are ∂w/∂q̇."""

    model: Model
    parameters: Floats

    def _inputs(self, q: Floats, v: Floats) -> Floats:
        return np.concatenate([q, v, [0.0], self.parameters])[None, :]

    def _mass_and_rows(self, q: Floats) -> tuple[Floats, Floats]:
        """M, shape (n, n), and A, shape (m, n)."""
        system = self.model.system(self._inputs(q, np.zeros(q.size)))
        return system.mass[0], system.rows[0]

    def gaps(self, q: Floats, v: Floats) -> Floats:
        """What each constraint is off by: g of the holonomic ones, w of the others: shape (m,)."""
        table, holonomic = self._missed(q, v), self.model.layout.holonomic
        return np.concatenate([table[:holonomic], table[2 * holonomic :]])

    def _missed(self, q: Floats, v: Floats) -> Floats:
        """g of the holonomic ones, then w of all: shape (holonomic + m,)."""
        function = self.model.gaps
        return np.zeros(0) if function is None else function.table(self._inputs(q, v))[0]

    def endless(self, q: Floats, v: Floats) -> int | None:
        """The first constraint that has no finite g or w there; None if all have."""
        gaps = np.hstack([self._off(q), np.zeros(len(self.slips(q, v)) - self.model.layout.holonomic)])
        bad = ~np.isfinite(gaps + self.slips(q, v))
        return int(np.argmax(bad)) if bad.any() else None

    def is_flat(self, index: int, q: Floats) -> bool:
        """Whether a holonomic constraint has no gradient wherever it is kept around a position, only beside it."""
        if index >= self.model.layout.holonomic:
            return False
        for near in self._around(q):
            kept = self.nearest(near)
            sizes = [np.linalg.norm(self._mass_and_rows(each)[1][index]) for each in (kept, near)]
            if not sizes[0] <= FLAT * sizes[1]:
                return False
        return True

    def _around(self, q: Floats) -> Iterator[Floats]:
        """Positions close to one."""
        source = np.random.default_rng(1)
        for _ in range(POINTS):
            yield q + AROUND * np.maximum(1.0, np.abs(q)) * source.uniform(-1.0, 1.0, q.size)

    def slips(self, q: Floats, v: Floats) -> Floats:
        """w of all: shape (m,)."""
        return self._missed(q, v)[self.model.layout.holonomic :]

    def _off(self, q: Floats) -> Floats:
        return self.gaps(q, np.zeros(q.size))[: self.model.layout.holonomic]

    def _sizes(self, rows: Floats, q: Floats) -> Floats:
        return np.asarray(np.abs(rows) @ np.maximum(1.0, np.abs(q)))

    def rate_sizes(self, q: Floats, v: Floats) -> Floats:
        """What w is a difference of, about: shape (m,)."""
        return self._sizes(self._mass_and_rows(q)[1], v) + 1e-300

    def is_off(self, q: Floats) -> bool:
        """Whether a holonomic constraint is not kept."""
        gaps = np.abs(self._off(q))
        return bool((gaps > CLOSE * (self._sizes(self._mass_and_rows(q)[1][: gaps.size], q) + 1e-300)).any())

    def worst(self, q: Floats) -> int:
        """The holonomic constraint that is furthest from being kept."""
        gaps = np.abs(self._off(q))
        return int(np.argmax(np.nan_to_num(gaps, nan=np.inf))) if gaps.size else 0

    def nearest(self, start: Floats) -> Floats:
        """The position on all g = 0 nearest to `start`, shape (n,); not finite where there is none to be found."""
        if not self.model.layout.holonomic:
            return start
        mass = self._mass_and_rows(start)[0]
        found = self._iterated(start, start, mass)
        return found if found is not None else np.full(start.size, np.nan)

    def _iterated(self, start: Floats, q: Floats, mass: Floats) -> Floats | None:
        for each in range(PASSES):
            rows, off = self._mass_and_rows(q)[1][: self.model.layout.holonomic], self._off(q)
            if not (np.isfinite(rows).all() and np.isfinite(off).all()):
                return None
            aim = start if each < PASSES // 2 else q  # nearest to where it was wanted, or where that is too far, here
            moved = aim + _shortest(mass, rows, rows @ (q - aim) - off)
            change = np.max(np.abs(moved - q) / np.maximum(1.0, np.abs(q)))
            q = moved
            if not np.isfinite(change):
                return None
            if change <= SETTLED:
                return q
        return q

    def nearest_rates(self, q: Floats, rates: Floats) -> Floats:
        """The rates on w = 0 nearest to those given; both have shape (n,)."""
        (mass, rows), v = self._mass_and_rows(q), rates
        for _ in range(3):
            v = v - _shortest(mass, rows, self.slips(q, v))
        return v

    def scales(self, q: Floats) -> Floats:
        """What brings the diagonal of AM⁻¹Aᵀ to 1 from both sides: shape (m,)."""
        return unit_diagonal(self._schur_complement(q))

    def spectrum(self, q: Floats) -> tuple[Floats, Floats]:
        """The eigenvalues of AM⁻¹Aᵀ scaled to a unit diagonal, rising, shape (m,), and its eigenvectors, (m, m)."""
        schur = self._schur_complement(q)
        inverse = unit_diagonal(schur)
        values, vectors = np.linalg.eigh(schur * inverse * inverse[:, None])
        return values, vectors

    def _schur_complement(self, q: Floats) -> Floats:
        """AM⁻¹Aᵀ, shape (m, m)."""
        mass, rows = self._mass_and_rows(q)
        return np.asarray(rows @ _solved(mass, rows.T))

    def rank_around(self, q: Floats) -> int:
        """The largest number of independent constraints in consistent positions around one."""
        ranks = []
        for near in self._around(q):
            found = self.nearest(near)
            if np.isfinite(found).all():
                ranks.append(int(np.count_nonzero(self.spectrum(found)[0] > SMALLEST_SCHUR_PIVOT)))
        return max(ranks, default=0)


def unit_diagonal(schur: Floats) -> Floats:
    """What brings the diagonals of matrices to 1 from both sides, 0 where it is 0: shape (…, m) of (…, m, m)."""
    own = np.sqrt(np.maximum(np.diagonal(schur, axis1=-2, axis2=-1), 0.0))
    return np.divide(1.0, own, out=np.zeros_like(own), where=own > 0.0)


def _solved(mass: Floats, right: NDArray[np.float64]) -> Floats:
    """M⁻¹ times some columns; by the least squares where M has no inverse."""
    try:
        return np.asarray(np.linalg.solve(mass, right))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.lstsq(mass, right, rcond=None)[0])


def _shortest(mass: Floats, rows: Floats, right: Floats) -> Floats:
    """The shortest x in the metric of M with A x = `right`: M⁻¹Aᵀ(AM⁻¹Aᵀ)⁺ right."""
    responses = _solved(mass, rows.T)
    schur = rows @ responses
    inverse = unit_diagonal(schur)
    values, vectors = np.linalg.eigh(schur * inverse * inverse[:, None])
    kept = values > SMALLEST_SCHUR_PIVOT  # those that count as independent
    inside = (vectors[:, kept].T @ (inverse * right)) / values[kept]
    return np.asarray(responses @ (inverse * (vectors[:, kept] @ inside)))
