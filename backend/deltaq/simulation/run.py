"""One run of one method with given steps or local tolerance: the kernels seen from outside."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from .integration import Flag, integrated, motion_of
from .kernels.explicit_runge_kutta import Result
from .kernels.motion import FINE
from .kernels.step_control import Control
from .method import Method
from .problem import Floats, Problem
from .stability import real_stability


@dataclass(frozen=True)
class Run:
    """States (q, q̇ and, where power is fed in, ∫P dt) at `times`, as far as the run came."""

    times: Floats
    states: Floats
    result: Result
    conditioning: float  # smallest pivot of M met, relative to its largest diagonal entry
    wall_time: float

    @property
    def is_complete(self) -> bool:
        return bool(self.result.outcome == FINE)


@dataclass(frozen=True)
class Steps:
    """How to step: with a local tolerance and steps up to `size`, or (tolerance 0) with steps of that size."""

    size: float
    tolerance: float = 0.0


def run(problem: Problem, method: Method, times: Floats, cancelled: Flag, steps: Steps) -> Run:
    """Integrates a problem once; samples at `times`."""
    control = Control(
        float(steps.tolerance),
        float(steps.size),
        float(steps.size),
        float(method.error_order or method.order),
        float(method.memory),
        int(problem.step_limit),
        int(method.tableau.stages),
        real_stability(method.tableau),
    )
    motion, out = motion_of(problem), np.zeros((times.size, problem.state.size))
    start = perf_counter()
    result = integrated(method.tableau, problem, motion, control, times, out, cancelled)
    wall_time = perf_counter() - start
    good = int(np.isfinite(out[: result.samples]).all(axis=1).cumprod().sum())
    return Run(times[:good], out[:good], result, float(motion.conditioning[0]), wall_time)
