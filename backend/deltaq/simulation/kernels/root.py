"""Where a watched value falls through zero: on the polynomial through the states that the kernel saw of a step.

Sources: Trefethen, Approximation Theory and Approximation Practice, ch. 5 (barycentric formula); T. R. Chandrupatla,
Advances in Engineering Software 28 (1997) 145–149: inverse quadratic interpolation where three values allow it, else
the middle.
"""

from __future__ import annotations

import numpy as np

from .compiler import inline, kernel, runtime_int
from .motion import Floats
from .pointer import call
from .watch import Watch

MOST_ROOT_STEPS = 100
NONE, UNSEEN = -1, -2  # instead of the number of a value


@inline
def state_within(watch: Watch, x: float, state: Floats) -> None:
    """The state at a place x of the step, 0 to 1, by the barycentric formula into `state`, shape (width,)."""
    last, total = watch.nodes.size - 1, 0.0
    for d in range(state.size):
        state[d] = 0.0
    for k in range(last + 1):
        apart = x - watch.nodes[k]
        if apart == 0.0:
            for d in range(state.size):
                state[d] = watch.states[k, d]
            return
        weight = (0.5 if k in (0, last) else 1.0) * (1.0 if k % 2 == 0 else -1.0)
        share = weight / apart
        total += share
        for d in range(state.size):  # what rests stays where it is, to the last digit
            state[d] += share * (watch.states[k, d] - watch.states[0, d])
    for d in range(state.size):
        state[d] = watch.states[0, d] + state[d] / total


@inline
def value_within(watch: Watch, degrees: int, index: int, x: float, state: Floats, values: Floats) -> float:
    """The watched value of this number at a place of the step.

    `state`, shape (width,), and `values`, shape (functions,), receive what all are there.
    """
    state_within(watch, x, state)
    for d in range(2 * degrees):
        watch.inputs[d] = state[d]
    watch.inputs[2 * degrees] = watch.times[0] + (watch.times[watch.times.size - 1] - watch.times[0]) * x
    call(watch.address, watch.data, values, watch.inputs)
    return float(values[index])


@inline
def part_of_way(x1: float, f1: float, x2: float, f2: float, x3: float, f3: float) -> float:
    """The part of the way from the newest place 1 to that across the root, 2; half of it where 3 does not help."""
    xi, phi = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
    if not (phi * phi < xi and (1.0 - phi) ** 2 < 1.0 - xi):
        return 0.5
    return f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)


@inline
def find_root(watch: Watch, degrees: int, index: int, place: int, near: float, state: Floats, values: Floats) -> float:
    """A place of the step with a value ≤ 0, as near to one with a positive one as `near`, and the `state` there.

    The value of this number is positive at the node before `place` and no longer is so there. `state`, shape (width,),
    and `values`, shape (functions,), are written.
    """
    x1, f1 = watch.nodes[place], watch.values[place, index]
    x2, f2 = watch.nodes[place - 1], watch.values[place - 1, index]
    x3, f3 = x2, f2
    part, steps = f1 / (f1 - f2), runtime_int(0)
    while steps < MOST_ROOT_STEPS:
        steps += 1
        least = near / abs(x2 - x1)
        x = x1 + min(max(part, least), 1.0 - least) * (x2 - x1)
        found = value_within(watch, degrees, index, x, state, values)
        if (found > 0.0) == (f1 > 0.0):
            x3, f3 = x1, f1
        else:
            x3, f3, x2, f2 = x2, f2, x1, f1
        x1, f1 = x, found
        if abs(x2 - x1) <= 2.0 * near or f1 == 0.0:
            break
        part = part_of_way(x1, f1, x2, f2, x3, f3)
    root = x1 if f1 <= 0.0 else x2
    state_within(watch, root, state)
    return float(root)


@inline
def first_node_below(watch: Watch, index: int) -> int:
    """The first node at which the value of this number is no longer positive; as many as there are if it is."""
    for k in range(watch.nodes.size):
        if watch.values[k, index] <= 0.0:
            return k
    return int(watch.nodes.size)


@inline
def first_nodes_below(watch: Watch) -> tuple[int, bool]:
    """The same of all values together, and whether one of them falls between nodes, or did so in a step before."""
    first, is_unseen = runtime_int(watch.nodes.size), False
    for j in range(watch.functions):
        node = first_node_below(watch, j)
        is_unseen = is_unseen or (node == watch.nodes.size and watch.least[j] <= 0.0)
        first = min(first, node)
    return first, is_unseen


@inline
def nearest_in_step(watch: Watch, x: float) -> float:
    """How near to a place of the step, 0 to 1, another one can be told from it, and the times at both."""
    start, size = watch.times[0], watch.times[watch.times.size - 1] - watch.times[0]
    near = np.spacing(x)
    return float(max(near, 0.5 * np.spacing(start + size * x) / size) if size > 0.0 else near)


@kernel
def find_fall(watch: Watch, degrees: int, state: Floats, trial: Floats, values: Floats) -> tuple[int, float]:
    """Which watched value falls through zero first in the step, at what place of it, 0 to 1, and the `state` there.

    NONE if none does; UNSEEN if the nodes do not tell. `state` and `trial`, shape (width,), and `values`, shape
    (functions,), are written.
    """
    node, is_unseen = first_nodes_below(watch)
    if is_unseen or node == 0:
        return UNSEEN, 0.0
    if node == watch.nodes.size:
        return NONE, 0.0
    near = nearest_in_step(watch, watch.nodes[node])
    found, place = runtime_int(NONE), np.inf
    for j in range(watch.functions):
        if watch.values[node, j] <= 0.0:
            x = find_root(watch, degrees, j, node, near, trial, values)
            if x < place:
                found, place = j, x
                for d in range(state.size):
                    state[d] = trial[d]
    return found, place
