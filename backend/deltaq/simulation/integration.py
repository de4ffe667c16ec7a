"""From a method's scheme to the kernel that runs it: one case for each family."""

from __future__ import annotations

from functools import cache, singledispatch

import numpy as np
from numpy.typing import NDArray

from .kernels.explicit_runge_kutta import Result, integrate
from .kernels.implicit_room import make_implicit_room
from .kernels.implicit_runge_kutta import integrate_implicit
from .kernels.motion import Motion
from .kernels.newmark import NewmarkWeights, integrate_newmark, make_newmark_room
from .kernels.newton import ImplicitWeights
from .kernels.phase import Phase
from .kernels.splitting import SplitWeights, integrate_split, make_split_room
from .kernels.step import Weights, make_room
from .kernels.step_control import Control
from .method import Newmark, Partitioned, Row, Tableau
from .problem import Floats, Problem

Flag = NDArray[np.int64]  # one number; anything but 0 ends the run


@singledispatch
def integrated(
    scheme: object, _problem: Problem, _motion: Motion, _control: Control, _times: Floats, _out: Floats, _flag: Flag
) -> Result:
    """Runs a scheme; out[i] becomes the state at times[i], as far as the run comes."""
    raise TypeError(f"no kernel is known for {type(scheme).__name__}")


@integrated.register
def _explicit(
    scheme: Tableau, problem: Problem, motion: Motion, control: Control, times: Floats, out: Floats, flag: Flag
) -> Result:
    weights = explicit_weights(scheme)
    return integrate(motion, weights, control, make_room(problem.state, weights), times, out, flag)


@integrated.register
def _partitioned(
    scheme: Partitioned, problem: Problem, motion: Motion, control: Control, times: Floats, out: Floats, flag: Flag
) -> Result:
    phase, n = phase_of(problem), problem.degrees
    if scheme.kicks and problem.model.phase.is_separable:
        split = SplitWeights(floats(scheme.kicks), floats(scheme.drifts))
        return integrate_split(motion, phase, split, control, make_split_room(problem.state, n), times, out, flag)
    room = make_implicit_room(problem.state, n, scheme.stages)
    return integrate_implicit(motion, phase, implicit_weights(scheme), control, room, times, out, flag)


@integrated.register
def _newmark(
    scheme: Newmark, problem: Problem, motion: Motion, control: Control, times: Floats, out: Floats, flag: Flag
) -> Result:
    weights = NewmarkWeights(float(scheme.beta), float(scheme.gamma))
    room = make_newmark_room(problem.state, problem.degrees)
    return integrate_newmark(motion, weights, control, room, times, out, flag)


def motion_of(problem: Problem) -> Motion:
    """The right-hand side of a problem, for kernels."""
    motion = problem.model.motion
    address, data = motion.addresses
    inputs = np.zeros(motion.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    powered = problem.model.layout.is_powered
    return Motion(address, data, problem.degrees, powered, inputs, np.zeros(motion.outputs), np.ones(1))


def phase_of(problem: Problem) -> Phase:
    """Momenta and their rates of a problem, for kernels."""
    function = problem.model.phase.function
    address, data = function.addresses
    inputs = np.zeros(function.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    return Phase(address, data, problem.degrees, inputs, np.zeros(function.outputs))


@cache
def explicit_weights(tableau: Tableau) -> Weights:
    """A tableau as the kernel wants it."""
    stages, extra = tableau.stages, len(tableau.extra_c)
    return Weights(
        _matrix(tableau.a[1:], stages),
        floats(tableau.b),
        floats(tableau.c[1:]),
        _matrix(tableau.error, stages + 1),
        _matrix(tableau.dense, stages + 1 + extra),
        _matrix(tableau.extra_a, stages + 1 + extra),
        floats(tableau.extra_c),
    )


def implicit_weights(scheme: Partitioned) -> ImplicitWeights:
    """A pair of tableaus as the kernel wants it."""
    a, momentum_a = _matrix(scheme.a, scheme.stages), _matrix(scheme.momentum_a, scheme.stages)
    b, c = floats(scheme.b), floats(scheme.c)
    return ImplicitWeights(a, b, c, momentum_a, b, momentum_a @ a, floats(scheme.error))


def floats(row: Row) -> Floats:
    return np.array([float(number) for number in row])


def _matrix(rows: tuple[Row, ...], width: int) -> Floats:
    matrix = np.zeros((len(rows), width))
    for index, row in enumerate(rows):
        matrix[index, : len(row)] = floats(row)
    return matrix
