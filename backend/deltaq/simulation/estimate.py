"""How wrong a computed motion is: two runs of unlike fineness, compared.

The difference of two runs, taken as it is, says too little where a motion turns back: there even a wrong phase gives
the right value. So coordinates and rates are compared together, |Δq|² + τ²|Δq̇|², with the coordinate's own time scale
τ (rate over acceleration, root mean squares). Neighbouring samples share their largest difference.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .problem import Floats, Problem
from .run import Run
from .stiffness import accelerations

NEIGHBOURS = 2
ROUNDING = 4e-16
LOST = 0.5  # an error this large, relative to the size of the coordinate, leaves no digit


@dataclass(frozen=True)
class Estimate:
    """`errors[i]` estimates the largest error of any coordinate at times[i]; after `horizon` no digit is left.

    `worst` is the largest error in the measure of a tolerance: absolute below 1 and relative above.
    """

    errors: Floats
    worst: float
    horizon: float | None


def estimate(problem: Problem, coarse: Run, fine: Run, factor: float) -> Estimate:
    """The error of one of two runs: `factor` times their difference, over the samples that both have."""
    n, count = problem.degrees, min(len(coarse.times), len(fine.times))
    times, states = fine.times[:count], fine.states[:count]
    difference = np.abs(coarse.states[:count] - states)
    scales = _time_scales(problem, times, states)
    errors = factor * _spread(np.hypot(difference[:, :n], scales * difference[:, n : 2 * n]))
    sizes = np.abs(states[:, :n])
    errors = np.maximum(errors, _grain(problem, times, fine)[:, None] * np.maximum(1.0, sizes))
    horizon = _horizon(problem, times, errors, sizes)
    if horizon is not None:
        # Beyond the horizon both runs are wrong, and their difference may shrink by chance.
        late = times >= horizon
        errors[late] = 2.0 * np.maximum.accumulate(errors[late], axis=0)
    worst = float(np.max(errors / np.maximum(1.0, sizes)))
    return Estimate(errors.max(axis=1), worst, horizon)


def _grain(problem: Problem, times: Floats, fine: Run) -> Floats:
    """Rounding: one in the last digit for each step, some up and some down."""
    return np.asarray(ROUNDING * np.sqrt(1.0 + fine.result.steps * times / problem.t_end))


def _time_scales(problem: Problem, times: Floats, states: Floats) -> Floats:
    """τ of each coordinate: root mean square of the rate (without its mean) over that of the acceleration."""
    n = problem.degrees
    rates = states[:, n : 2 * n] - states[:, n : 2 * n].mean(axis=0)
    fast = np.sqrt(np.nanmean(accelerations(problem, times, states) ** 2, axis=0))
    slow = np.sqrt(np.mean(rates**2, axis=0))
    return np.asarray(np.divide(slow, fast, out=np.zeros(n), where=fast > 0))


def _spread(errors: Floats) -> Floats:
    """Each sample takes the largest value of its neighbourhood; the first keeps its own, which is exact."""
    padded = np.pad(errors, ((NEIGHBOURS, NEIGHBOURS), (0, 0)))
    spread = np.max([padded[k : k + len(errors)] for k in range(2 * NEIGHBOURS + 1)], axis=0)
    spread[0] = errors[0]
    return np.asarray(spread)


def _horizon(problem: Problem, times: Floats, errors: Floats, sizes: Floats) -> float | None:
    """The first time at which the error of a coordinate is as large as the coordinate, or a sizeable angle."""
    largest = np.max(sizes, axis=0)
    angular = np.array(problem.angular or (False,) * problem.degrees)
    scale = np.where(angular, np.minimum(largest, 1.0), largest)
    lost = np.any((errors >= LOST * scale) & (scale > 0), axis=1)
    return float(times[np.argmax(lost)]) if lost.any() else None
