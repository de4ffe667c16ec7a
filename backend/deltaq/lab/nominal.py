"""The motion about which deviations are linearized: by which steps, and between which times, none of its forces are
passed over; and how far its components go, by which deviations are small.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..simulation.audited import audited_run
from ..simulation.library import get_method
from ..simulation.march import SEEN, Integers
from ..simulation.problem import Floats, Problem
from ..simulation.run import Steps, run
from .orbits import steps_of

ROUNDS = 40  # of following it, each by shorter steps where the one before was blind
SAME = 1e-6  # of what lies between two samples: times that are nearer to each other are one


@dataclass(frozen=True)
class NominalMotion:
    """How a problem's motion is stepped, and its `grid`, shape (intervals + 1,): times between which it is smooth.

    No interval holds an end of its steps, or a sample; the samples that it comes to stand in the grid at `places`,
    shape (samples,). `states` (q, q̇) are those at the grid, shape (intervals + 1, 2n), and `scales`, shape (2n,), how
    far they go. `finest` is the smallest step over the largest.
    """

    problem: Problem
    steps: Steps
    grid: Floats
    places: Integers
    states: Floats
    scales: Floats
    finest: float

    def at(self, times: Floats) -> Floats:
        """(q, q̇) at times that begin with 0, shape (times,), as far as the motion goes: shape (≤ times, 2n)."""
        return _run(self.problem, times, self.steps)

    @classmethod
    def of(cls, problem: Problem, samples: int, sizes: Floats, most: int) -> NominalMotion:
        """The motion of a problem, up to where it ends, no step sees what it meets, or there are `most` intervals.

        `sizes`, shape (2n,), are deviations of (q, q̇), below which its scales do not fall.
        """
        times = np.linspace(0.0, problem.t_end, samples)
        steps = replace(steps_of(problem, is_driven=True), is_recorded=True)
        found, blind = audited_run(
            problem, get_method("taylor"), times, steps, SEEN, np.zeros(1, dtype=np.int64), ROUNDS
        )
        end = min([each.start for each in blind], default=float(found.result.reached))
        ends = found.mesh_times[found.mesh_times < end]
        known = times[: len(found.times)]
        known = known[known <= end]
        beside = np.searchsorted(known, ends).clip(1, max(len(known) - 1, 1))
        apart = np.minimum(np.abs(ends - known[beside - 1]), np.abs(ends - known[beside % len(known)]))
        grid = np.union1d(known, ends[apart > SAME * times[1]])[: most + 1]
        steps = replace(found.steps, is_recorded=False)
        states, lengths = _run(problem, grid, steps), np.diff(grid)
        scales = _scales(states, sizes, float(lengths.max(initial=0.0)) or problem.t_end)
        places = np.searchsorted(grid, known[known <= grid[-1]])
        finest = float(lengths.min() / lengths.max()) if len(lengths) else 1.0
        return cls(problem, steps, grid, places, states, scales, finest)


def _run(problem: Problem, times: Floats, steps: Steps) -> Floats:
    found = run(problem, get_method("taylor"), times, np.zeros(1, dtype=np.int64), steps)
    return found.states[:, : 2 * problem.degrees]


def _scales(states: Floats, sizes: Floats, time: float) -> Floats:
    """How far components go, a place and its rate together; those at rest count as the others, shape (2n,)."""
    n = states.shape[1] // 2
    extents = np.maximum(np.ptp(states, axis=0), sizes)
    ways = np.maximum(extents[:n], time * extents[n:])
    ways = np.where(ways > 0.0, ways, ways.max() or 1.0)
    return np.concatenate([ways, ways / time])
