"""What may end a run before its time: a flag from outside, friction, and events, functions that stay positive.

Of each accepted step the continuous extension is looked at in Chebyshev's extreme points, both ends included. So many
states determine every extension used here, so that `event.py` finds the time without the kernel.
Source of the points: Trefethen, Approximation Theory and Approximation Practice, ch. 5.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline, runtime_int
from .motion import EVENT, FINE, Floats
from .pointer import call
from .switch import Switch, make_switch

NODES = 9  # extensions have degree 7 at most
NODES_OF_SERIES = 25  # and Taylor series more


class Watch(NamedTuple):
    """A flag, and a compiled function with so many outputs (`functions`), all positive as long as nothing has happened.

    `cancelled`, shape (1,), ends the run when it is not 0. `inputs`, shape (inputs,), are those of the motion. `nodes`,
    shape (nodes,), are Chebyshev's extreme points in units of a step; `states`, shape (nodes, width), are the states at
    `times`, shape (nodes,), and `values`, shape (nodes, functions), what the function says of them. Of each output,
    `least`, shape (functions,), is the least value up to the first step that may have fallen through zero, and
    `closest_times`, shape (functions, nodes), with `closest_states`, shape (functions, nodes, width), the step that has
    it. `switch` tells where a force that jumps holds the motion.
    """

    cancelled: NDArray[np.int64]  # one number; anything but 0 ends the run
    address: int
    data: int
    functions: int  # 0: no event is watched for
    inputs: Floats
    nodes: Floats
    times: Floats
    states: Floats
    values: Floats
    least: Floats
    closest_times: Floats
    closest_states: Floats
    switch: Switch


def make_watch(
    cancelled: NDArray[np.int64],
    addresses: tuple[int, int],
    functions: int,
    inputs: Floats,
    width: int,
    switch: Switch,
    count: int = NODES,
) -> Watch:
    """The arrays to watch so many functions of a state with `width` components, beside the switching functions.

    `cancelled` has shape (1,), `inputs` shape (inputs,); each step is looked at in `count` places.
    """
    nodes = places_of_watch(count)
    times, states = np.zeros(count), np.zeros((count, width))
    values, least = np.zeros((count, functions)), np.full(functions, np.inf)
    closest = np.zeros((functions, count)), np.zeros((functions, count, width))
    return Watch(cancelled, *addresses, functions, inputs, nodes, times, states, values, least, *closest, switch)


def places_of_watch(count: int) -> Floats:
    """Chebyshev's extreme points in units of a step, from 0 to 1: shape (count,)."""
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.arange(count) / (count - 1)))


def unwatched(cancelled: NDArray[np.int64], switch: Switch | None = None) -> Watch:
    """A flag of shape (1,) alone, or with switching functions."""
    return make_watch(cancelled, (0, 0), 0, np.zeros(1), 0, switch or make_switch((0, 0), 0, np.zeros(1), 0))


@inline
def set_sample_times(watch: Watch, t: float, h: float) -> None:
    """The times at which states are looked at, for the step of size h from t."""
    for k in range(watch.nodes.size):
        watch.times[k] = t + watch.nodes[k] * h


@inline
def check_events(watch: Watch, degrees: int) -> int:
    """EVENT if a function is no longer positive at one of the states, else FINE."""
    for k in range(watch.times.size):
        for d in range(2 * degrees):
            watch.inputs[d] = watch.states[k, d]
        watch.inputs[2 * degrees] = watch.times[k]
        call(watch.address, watch.data, watch.values[k], watch.inputs)
    outcome = FINE
    for j in range(watch.functions):
        lowest = runtime_int(0)
        for k in range(1, watch.times.size):
            if watch.values[k, j] < watch.values[lowest, j]:
                lowest = k
        if watch.values[lowest, j] <= 0.0:
            outcome = EVENT
        least = interpolated_minimum(watch, lowest, j)
        if least < watch.least[j] and watch.least[j] > 0.0:
            record_closest(watch, j, least)
    return outcome


@inline
def interpolated_minimum(watch: Watch, k: int, j: int) -> float:
    """The least value of function j around node k, by the parabola through its neighbours."""
    middle = watch.values[k, j]
    if k in (0, watch.times.size - 1):
        return float(middle)
    before, after = watch.nodes[k] - watch.nodes[k - 1], watch.nodes[k + 1] - watch.nodes[k]
    fall, rise = (middle - watch.values[k - 1, j]) / before, (watch.values[k + 1, j] - middle) / after
    bend = (rise - fall) / (before + after)
    slope = fall + bend * before
    return float(middle - 0.25 * slope * slope / bend) if bend > 0.0 else float(middle)


@inline
def record_closest(watch: Watch, j: int, least: float) -> None:
    """The step looked at is the one in which function j came closest to zero."""
    watch.least[j] = least
    for k in range(watch.times.size):
        watch.closest_times[j, k] = watch.times[k]
        for d in range(watch.states.shape[1]):
            watch.closest_states[j, k, d] = watch.states[k, d]
