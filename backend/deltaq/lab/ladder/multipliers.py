"""What multipliers cost and how right they are, by the same motion in minimal coordinates.

There q̈ follows from no multiplier, and M q̈ − f = Aᵀλ tells λ by itself. It is the truth that both are held to: the
motion in minimal coordinates is computed as accurately as can be.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...mechanics.scene import Scene
from ...simulation.derivatives import accelerations
from ...simulation.integration import Flag
from ...simulation.problem import Floats, Problem
from .distance import Accuracy, Yardstick
from .ending import known
from .measurement import LEAST_TOLERANCE, SHOWN, RungRun, full_run, run_rung, seen
from .minimal import Minimal, minimal
from .simplification import Motion

DEPENDENT = 1e-9  # of the largest singular value of A: what constraints that follow from others have but for rounding


@dataclass(frozen=True)
class Beside:
    """A scene with constraints, its motion as it is measured by, and the same in minimal coordinates."""

    run: RungRun
    full: Yardstick
    below: Minimal
    problem: Problem

    def values(self, times: Floats, states: Floats) -> Mapping[str, Floats]:
        """The full scene's coordinates at states of the minimal ones, shape (samples, ≥ 2n)."""
        free, n = self.problem.model.layout.free, self.problem.degrees
        values, rates = (dict(zip(free, part.T, strict=True)) for part in (states[:, :n], states[:, n : 2 * n]))
        return self.below.back(Motion(times, values, rates)).values


@dataclass(frozen=True)
class Comparison:
    """At `times`: the largest difference `apart` of a coordinate and its `estimate`, the largest |g| (`gaps`).

    `errors` and `estimates` are those of each multiplier that is unique, by name, as parts of the largest value that it
    has: shape (samples,) each.
    """

    times: Floats
    apart: Floats
    estimate: Floats
    gaps: Floats
    errors: Mapping[str, Floats]
    estimates: Mapping[str, Floats]


def beside(scene: Scene, span: float, tolerance: float, cancelled: Flag) -> Beside | None:
    """None where the scene has no constraints, no minimal coordinates in closed form, or no motion."""
    if not scene.constraints:
        return None
    run = full_run(scene, span, cancelled, tolerance)
    full, _ = known(run, tolerance)
    try:
        below = minimal(scene, seen(run).until(len(full.times)))
        found = run_rung(below.scene, span, cancelled, Accuracy(LEAST_TOLERANCE, run.accuracy.samples))
    except InputError:
        return None
    return Beside(run, full, below, found.problem) if len(full.times) else None


def compared(pair: Beside, cancelled: Flag) -> Comparison | None:
    """The run with multipliers against the most accurate one without; None where one of them tells no error."""
    exact = run_rung(
        pair.below.scene, pair.run.problem.t_end, cancelled, Accuracy(LEAST_TOLERANCE, pair.run.accuracy.samples)
    )
    trajectory, (times, states) = pair.run.trajectory, exact.sampled
    count = min(len(pair.full.times), len(times))
    if not count or trajectory.reactions is None or trajectory.estimate is None or exact.trajectory.estimate is None:
        return None
    motion = seen(exact)
    columns = zip(exact.problem.model.layout.free, accelerations(exact.problem, times, states).T, strict=True)
    whole = pair.below.whole(motion, dict(columns))
    order = pair.run.problem.model.layout.free
    q, v, a = (np.column_stack([part[name] for name in order])[:count] for part in whole)
    truth = _multipliers(pair.run.problem, times[:count], np.hstack([q, v]), a)
    sizes = np.maximum(np.abs(truth).max(axis=0), 1e-300)
    found = trajectory.reactions.multipliers[:count]
    doubts = trajectory.estimate.multipliers
    doubts = np.zeros_like(found) if doubts is None else doubts[:count]
    shown = slice(0, count, max(1, count // SHOWN))
    estimate = trajectory.estimate.errors[:count] + exact.trajectory.estimate.errors[:count]
    names = _unique(pair.run.problem)
    return Comparison(
        times[:count][shown],
        _apart(pair.full, q)[shown],
        estimate[shown],
        trajectory.reactions.gaps[:count][shown],
        {name: (np.abs(found - truth) / sizes)[shown, k] for k, name in names.items()},
        {name: (doubts / sizes)[shown, k] for k, name in names.items()},
    )


def _apart(full: Yardstick, values: Floats) -> Floats:
    """The largest difference of a coordinate at each sample; of an angle whole turns do not count."""
    apart = values - full.values[: len(values)]
    radians = np.array(full.radians)
    turn = np.divide(2.0 * np.pi, radians, out=np.full_like(radians, np.inf), where=radians > 0.0)
    turns = np.where(np.isfinite(turn), np.round(apart / turn) * np.where(np.isfinite(turn), turn, 0.0), 0.0)
    return np.asarray(np.abs(apart - turns).max(axis=1))


def _unique(problem: Problem) -> Mapping[int, str]:
    """The multipliers that constraints leave no choice of, by number."""
    unknown = problem.moved.undetermined if problem.moved else ()
    return {k: name for k, name in enumerate(problem.model.layout.multipliers) if name not in unknown}


def _multipliers(problem: Problem, times: Floats, states: Floats, q_dd: Floats) -> Floats:
    """λ of M q̈ − f = Aᵀλ, the least by least squares: shape (samples, m). `q_dd` is q̈, shape (samples, n)."""
    system = problem.system(times, states)
    held = np.einsum("tij,tj->ti", system.mass, q_dd) - system.forces
    nothing = None if problem.rank == system.rows.shape[1] else DEPENDENT
    pairs = zip(system.rows, held, strict=True)
    return np.stack([np.linalg.lstsq(rows.T, each, rcond=nothing)[0] for rows, each in pairs])
