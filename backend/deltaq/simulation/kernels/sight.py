"""Which motions in lanes may have passed over something that their steps could not see: an audit of their meshes.

Most are seen through at little cost. Over the box of a whole motion the slopes of all operations are bounded once; they
bound how far arguments move in each step by how far coordinates and rates do. Only where that may be too far the motion
is looked at step by step (`audit`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.tape import ADD, ARCTANGENT_2, CONSTANT, INPUT, MULTIPLY, POWER
from .audit import AuditWorkspace, Blind, Path, Rules, box_of_part, inspect
from .compiler import inline, kernel
from .intervals import (
    Ranges,
    TapeArrays,
    derivative_bound,
    magnitude,
    mignitude,
    product,
    propagate_bounds,
    swing_per_width,
)
from .motion import Floats
from .plan import COUNT, STRIDE

HALVES = 2.0  # a step whose halves are seen through is not blind
Integers = NDArray[np.int64]


class Meshes(NamedTuple):
    """Where the steps of motions ended: (q, q̇) in `states`, shape (motions, capacity, 2n), at `times` (see `Plan`).

    `times` has shape (motions, capacity), `progress` (motions, 3).
    """

    times: Floats
    states: Floats
    progress: Integers

    def chosen(self, which: Integers) -> Meshes:
        """Those of some motions."""
        return Meshes(self.times[which], self.states[which], self.progress[which])


class Slopes(NamedTuple):
    """Of each operation, over a box: bounds of what it changes by, for a change of its operands, and of swings.

    `by_first`, `by_second`, `swings` and `moves`, how far it moves in a step, have shape (operations,); `chosen`, of
    the same shape, are the operations that it takes to know all swings, in their order, and −1 behind them.
    """

    by_first: Floats
    by_second: Floats
    swings: Floats
    moves: Floats
    chosen: Integers


class Room(NamedTuple):
    """What motions are looked at in: `path` has the capacity of the meshes.

    `spare`, shape (2 + capacity, inputs), is zero behind (q, q̇, t).
    """

    slopes: Slopes
    workspace: AuditWorkspace
    path: Path
    spare: Floats
    blind: Blind


@inline
def choose(tape: TapeArrays, slopes: Slopes) -> None:
    """The operations that have a swing of their own, and all that lead to them."""
    count, moves = tape.codes.size, slopes.moves
    moves[:] = 0.0
    slopes.chosen[:] = -1
    for i in range(count - 1, -1, -1):
        code, a, b = tape.codes[i], tape.a[i], tape.b[i]
        if code in (INPUT, CONSTANT):
            continue
        is_polynomial = code == POWER and tape.constants[i] >= 0.0 and tape.constants[i] == np.floor(tape.constants[i])
        if moves[i] > 0.0 or not (code in (ADD, MULTIPLY) or is_polynomial):
            moves[i] = moves[a] = 1.0
            if code in (ADD, MULTIPLY, ARCTANGENT_2):
                moves[b] = 1.0
    place = 0
    for i in range(count):
        if moves[i] > 0.0:
            slopes.chosen[place] = i
            place += 1


@inline
def fill_path(meshes: Meshes, motion: int, path: Path) -> None:
    """The mesh of a motion as a path; q̈ of its cubics jumps at the ends of steps.

    Of `path`, whose arrays have the length of the mesh, all is written.
    """
    count, n = path.times.size, path.q.shape[1]
    brief = 1e-13 * meshes.times[motion, count - 1]
    for k in range(count):
        path.times[k] = meshes.times[motion, k]
        for d in range(n):
            path.q[k, d], path.v[k, d] = meshes.states[motion, k, d], meshes.states[motion, k, n + d]
    for d in range(n):
        before = np.nan
        for k in range(count - 1):
            h = path.times[k + 1] - path.times[k]
            first, last = path.v[k, d], path.v[k + 1, d]
            slope = (path.q[k + 1, d] - path.q[k, d]) / h
            begin, end = (6.0 * slope - 4.0 * first - 2.0 * last) / h, (2.0 * first + 4.0 * last - 6.0 * slope) / h
            jump = abs(begin - before)
            path.jumps[k, d] = jump if jump < np.inf and h > brief else 0.0
            before = end
        if count > 2:
            path.jumps[0, d], path.jumps[count - 1, d] = path.jumps[1, d], path.jumps[count - 2, d]
        else:
            path.jumps[count - 1, d] = 0.0


@inline
def bound_slopes(tape: TapeArrays, ranges: Ranges, slopes: Slopes) -> None:
    """Slopes over the box in `ranges`, whose bounds are found first."""
    propagate_bounds(tape, ranges)
    low, high = ranges.low, ranges.high
    for i in slopes.chosen:
        if i < 0:
            break
        code, a, b = tape.codes[i], tape.a[i], tape.b[i]
        slopes.swings[i], slopes.by_second[i] = swing_per_width(tape, ranges, i), 0.0
        if code in (INPUT, CONSTANT):
            slopes.by_first[i] = 0.0
        elif code == ADD:
            slopes.by_first[i] = slopes.by_second[i] = 1.0
        elif code == MULTIPLY:
            slopes.by_first[i], slopes.by_second[i] = magnitude(low[b], high[b]), magnitude(low[a], high[a])
        elif code == ARCTANGENT_2:
            nearest = mignitude(low[a], high[a]) ** 2 + mignitude(low[b], high[b]) ** 2
            slopes.by_first[i] = slopes.by_second[i] = 1.0 / np.sqrt(nearest) if nearest > 0.0 else np.inf
        else:
            slopes.by_first[i] = derivative_bound(code, tape.constants[i], low[a], high[a], low[i], high[i])


@inline
def sees_step(tape: TapeArrays, inputs: Floats, slopes: Slopes, limit: float) -> bool:
    """Whether no argument can swing further than the limit where inputs move so far: `inputs`, shape (inputs,)."""
    moves = slopes.moves
    for i in slopes.chosen:
        if i < 0:
            break
        code, a = tape.codes[i], tape.a[i]
        if code in (INPUT, CONSTANT):
            moves[i] = inputs[a] if code == INPUT else 0.0
            continue
        swing, moves[i] = product(moves[a], slopes.swings[i]), product(moves[a], slopes.by_first[i])
        if code in (ADD, MULTIPLY, ARCTANGENT_2):
            b = tape.b[i]
            moves[i] += product(moves[b], slopes.by_second[i])
            swing = max(swing, product(moves[b], slopes.swings[i]))
        if not swing <= limit:
            return False
    return True


@inline
def sees_all(tape: TapeArrays, ranges: Ranges, path: Path, slopes: Slopes, limit: float, spare: Floats) -> bool:
    """Whether all steps of a path are seen through by the slopes over its box.

    `spare`, as in `Room`, has shape (2 + capacity, inputs).
    """
    width, steps = 2 * path.q.shape[1] + 1, path.times.size - 1
    low, high, moves = spare[0], spare[1], spare[2:]
    for k in range(steps):
        box_of_part(path, k, 0.0, 1.0, ranges)
        for d in range(width):
            least, most = ranges.inputs_low[d], ranges.inputs_high[d]
            low[d] = least if k == 0 else min(low[d], least)
            high[d] = most if k == 0 else max(high[d], most)
            moves[k, d] = most - least
    for d in range(width):
        ranges.inputs_low[d], ranges.inputs_high[d] = low[d], high[d]
    bound_slopes(tape, ranges, slopes)
    seen = 0
    while seen < steps and sees_step(tape, moves[seen], slopes, limit):
        seen += 1
    return seen == steps


@inline
def begin_motion(meshes: Meshes, motion: int, parameters: Floats, ranges: Ranges, whole: Path) -> Path:
    """The path of a motion, which fills the first part of `whole`, and its parameters as bounds of themselves.

    `parameters` has shape (motions, parameters).
    """
    count, first = meshes.progress[motion, COUNT], 2 * whole.q.shape[1] + 1
    path = Path(whole.times[:count], whole.q[:count], whole.v[:count], whole.jumps[:count])
    fill_path(meshes, motion, path)
    for p in range(parameters.shape[1]):
        ranges.inputs_low[first + p] = ranges.inputs_high[first + p] = parameters[motion, p]
    return path


@kernel
def find_unsure(
    tape: TapeArrays, ranges: Ranges, meshes: Meshes, parameters: Floats, limit: float, room: Room, found: Integers
) -> None:
    """Tells of each motion whether slopes leave it open that a step was blind: 1 in `found`, shape (motions,), else 0.

    `parameters` has shape (motions, parameters); arguments may swing up to the `limit` in a part of a step that is seen
    through.
    """
    choose(tape, room.slopes)
    for motion in range(found.size):
        found[motion] = 0
        if meshes.progress[motion, COUNT] > 1:
            path = begin_motion(meshes, motion, parameters, ranges, room.path)
            longest = HALVES * limit * meshes.progress[motion, STRIDE]
            found[motion] = 0 if sees_all(tape, ranges, path, room.slopes, longest, room.spare) else 1


@kernel
def find_blind(
    tape: TapeArrays,
    ranges: Ranges,
    meshes: Meshes,
    parameters: Floats,
    seeds: Floats,
    rules: Rules,
    room: Room,
    found: Integers,
) -> None:
    """Tells of each motion whether any of its steps was blind: 1 in `found`, shape (motions,), else 0.

    `parameters` has shape (motions, parameters); `seeds`, shape (motions, outputs of the tape), bounds |∂q̈/∂output|.
    """
    for motion in range(found.size):
        path = begin_motion(meshes, motion, parameters, ranges, room.path)
        room.workspace.looked[0], room.blind.found[0] = 0, 0
        own = Rules(rules.limit, rules.threshold, float(meshes.progress[motion, STRIDE]))
        inspect(tape, ranges, path, seeds[motion : motion + 1], own, room.workspace, room.spare, room.blind)
        found[motion] = 1 if room.blind.found[0] > 0 else 0
