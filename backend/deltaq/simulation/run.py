"""One run of one method with given steps or local tolerance: the kernels seen from outside."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from .kernels.explicit_runge_kutta import Result, integrate
from .kernels.motion import FINE, Motion
from .kernels.step import Weights, make_room
from .kernels.step_control import Control
from .method import Method, Row
from .problem import Floats, Problem

Flag = NDArray[np.int64]  # one number; anything but 0 ends the run


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
    )
    motion, weights = _motion(problem), weights_of(method)
    room = make_room(problem.state, weights)
    out = np.zeros((times.size, room.old.size))
    start = perf_counter()
    result = integrate(motion, weights, control, room, times, out, cancelled)
    wall_time = perf_counter() - start
    good = int(np.isfinite(out[: result.samples]).all(axis=1).cumprod().sum())
    return Run(times[:good], out[:good], result, float(motion.conditioning[0]), wall_time)


def _motion(problem: Problem) -> Motion:
    motion = problem.model.motion
    address, data = motion.addresses
    inputs = np.zeros(motion.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    powered = problem.model.layout.is_powered
    return Motion(address, data, problem.degrees, powered, inputs, np.zeros(motion.outputs), np.ones(1))


@cache
def weights_of(method: Method) -> Weights:
    """The tableau of a method as the kernel wants it."""
    tableau = method.tableau
    stages, extra = tableau.stages, len(tableau.extra_c)
    return Weights(
        _matrix(tableau.a[1:], stages),
        _matrix((tableau.b,), stages)[0].copy(),
        np.array([float(c) for c in tableau.c[1:]]),
        _matrix(tableau.error, stages + 1),
        _matrix(tableau.dense, stages + 1 + extra),
        _matrix(tableau.extra_a, stages + 1 + extra),
        np.array([float(c) for c in tableau.extra_c]),
    )


def _matrix(rows: tuple[Row, ...], width: int) -> Floats:
    matrix = np.zeros((len(rows), width))
    for index, row in enumerate(rows):
        matrix[index, : len(row)] = [float(number) for number in row]
    return matrix
