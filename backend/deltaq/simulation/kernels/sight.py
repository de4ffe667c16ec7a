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
from .audit import AuditWorkspace, Blind, Path, Rules, inspect
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

HALVES = 2.0  # a step whose halves are seen through is not blind
Integers = NDArray[np.int64]


class Meshes(NamedTuple):
    """Where the steps of motions ended: (q, q̇, t) in `rows`, shape (motions, capacity, 2n + 1).

    Of each motion so many are filled as `counts`, shape (motions,), say.
    """

    rows: Floats
    counts: Integers

    def chosen(self, which: Integers) -> Meshes:
        """Those of some motions."""
        return Meshes(self.rows[which], self.counts[which])

    def go_on(self, which: Integers) -> None:
        """The last entry of some motions, none of them empty, becomes their first and only one."""
        self.rows[which, 0] = self.rows[which, self.counts[which] - 1]
        self.counts[which] = 1


class Boxes(NamedTuple):
    """Between which bounds q, q̇ and t stay in each step: `low` and `high`, shape (2n + 1, capacity).

    `sizes` of steps and `jumps` of q̈ at their ends have shape (capacity,), as do second derivatives at their `begins`
    and `ends`. `moves`, shape (2, inputs), is how far inputs move in a step, at most, and in one of them: zero behind
    (q, q̇, t).
    """

    low: Floats
    high: Floats
    sizes: Floats
    jumps: Floats
    begins: Floats
    ends: Floats
    moves: Floats


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
    """What motions are looked at in: `path`, `columns` and `boxes` have the capacity of the meshes.

    `columns`, shape (2n + 1, capacity), are the rows of one, and `spare` has shape (2, 2n + 1).
    """

    columns: Floats
    slopes: Slopes
    boxes: Boxes
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
def find_jumps(times: Floats, q: Floats, v: Floats, count: int, boxes: Boxes) -> None:
    """How far q̈ of the cubics through q and q̇ jumps at the ends of steps, into `boxes.jumps`; `sizes` are known.

    Of `times`, `q` and `v` of one coordinate, shape (capacity,), so many entries count. Where steps are as short as
    rounding q̈ means nothing; at the two ends nothing is told, and it is taken to jump as beside them.
    """
    sizes, begins, ends, jumps = boxes.sizes, boxes.begins, boxes.ends, boxes.jumps
    brief = 1e-13 * times[count - 1]
    for k in range(count - 1):
        per_step = 1.0 / sizes[k]
        slope = (q[k + 1] - q[k]) * per_step
        begins[k] = (6.0 * slope - 4.0 * v[k] - 2.0 * v[k + 1]) * per_step
        ends[k] = (2.0 * v[k] + 4.0 * v[k + 1] - 6.0 * slope) * per_step
    for k in range(1, count - 1):
        jump = abs(begins[k] - ends[k - 1])
        jumps[k] = jump if jump < np.inf and min(sizes[k - 1], sizes[k]) > brief else 0.0
    jumps[0] = jumps[1] if count > 2 else 0.0
    jumps[count - 1] = jumps[count - 2]


@inline
def turn_to_columns(rows: Floats, count: int, columns: Floats) -> None:
    """The first rows, shape (capacity, 2n + 1), as `columns`."""
    for d in range(columns.shape[0]):
        column = columns[d]
        for k in range(count):
            column[k] = rows[k, d]


@inline
def bound_steps(columns: Floats, count: int, boxes: Boxes) -> None:
    """The boxes of all steps of a mesh, as those of `box_of_part`.

    Of `columns`, shape (2n + 1, capacity), so many entries count. Loops go along the mesh, so that processors take
    several steps at once.
    """
    n, sizes, jumps = columns.shape[0] // 2, boxes.sizes, boxes.jumps
    times, since, until = columns[2 * n], boxes.low[2 * n], boxes.high[2 * n]
    for k in range(count - 1):
        since[k], until[k], sizes[k] = times[k], times[k + 1], times[k + 1] - times[k]
    for d in range(n):
        q, v = columns[d], columns[n + d]
        find_jumps(times, q, v, count, boxes)
        low, high, slowest, fastest = boxes.low[d], boxes.high[d], boxes.low[n + d], boxes.high[n + d]
        for k in range(count - 1):
            h, first, last, begin, end = sizes[k], q[k], q[k + 1], v[k], v[k + 1]
            one, two = first + h * begin * (1.0 / 3.0), last - h * end * (1.0 / 3.0)
            middle = 3.0 * (two - one) / h
            jump = max(jumps[k], jumps[k + 1])
            wide, fast = jump * h * h * (1.0 / 16.0), jump * h * 0.25
            low[k], high[k] = min(first, last, one, two) - wide, max(first, last, one, two) + wide
            slowest[k], fastest[k] = min(begin, middle, end) - fast, max(begin, middle, end) + fast


@inline
def join_boxes(boxes: Boxes, steps: int, ranges: Ranges) -> None:
    """The box of the first steps together, into `ranges`, and how far inputs move in one of them at most."""
    for d in range(boxes.low.shape[0]):
        low, high = boxes.low[d], boxes.high[d]
        least, most, furthest = low[0], high[0], 0.0
        for k in range(steps):
            least, most, furthest = min(least, low[k]), max(most, high[k]), max(furthest, high[k] - low[k])
        ranges.inputs_low[d], ranges.inputs_high[d], boxes.moves[0, d] = least, most, furthest


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
def sees_all(tape: TapeArrays, ranges: Ranges, steps: int, slopes: Slopes, limit: float, boxes: Boxes) -> bool:
    """Whether so many steps, whose boxes are known, are seen through by the slopes over all of them.

    All at once, as if each moved every input as far as any does, or one by one.
    """
    join_boxes(boxes, steps, ranges)
    bound_slopes(tape, ranges, slopes)
    if sees_step(tape, boxes.moves[0], slopes, limit):
        return True
    for k in range(steps):
        for d in range(boxes.low.shape[0]):
            boxes.moves[1, d] = boxes.high[d, k] - boxes.low[d, k]
        if not sees_step(tape, boxes.moves[1], slopes, limit):
            return False
    return True


@inline
def bound_parameters(parameters: Floats, ranges: Ranges, first: int) -> None:
    """The parameters of a motion, shape (parameters,), as bounds of themselves behind so many inputs."""
    for p in range(parameters.size):
        ranges.inputs_low[first + p] = ranges.inputs_high[first + p] = parameters[p]


@inline
def path_of(meshes: Meshes, motion: int, room: Room) -> Path:
    """The mesh of a motion as a path, in the first part of the room's."""
    count, columns, whole = meshes.counts[motion], room.columns, room.path
    n, times = columns.shape[0] // 2, columns[columns.shape[0] - 1]
    path = Path(whole.times[:count], whole.q[:count], whole.v[:count], whole.jumps[:count])
    turn_to_columns(meshes.rows[motion], count, columns)
    for k in range(count):
        path.times[k] = times[k]
    for k in range(count - 1):
        room.boxes.sizes[k] = times[k + 1] - times[k]
    for d in range(n):
        find_jumps(times, columns[d], columns[n + d], count, room.boxes)
        for k in range(count):
            path.q[k, d], path.v[k, d], path.jumps[k, d] = columns[d, k], columns[n + d, k], room.boxes.jumps[k]
    return path


@kernel
def find_unsure(
    tape: TapeArrays,
    ranges: Ranges,
    meshes: Meshes,
    parameters: Floats,
    which: Integers,
    limit: float,
    room: Room,
    found: Integers,
) -> None:
    """Tells of some motions, `which`, whether slopes leave it open that a step was blind: 1 in `found`, else 0.

    `parameters` has shape (motions, parameters), `which` and `found` shape (some of them,); arguments may swing up to
    the `limit` in a part of a step that is seen through.
    """
    choose(tape, room.slopes)
    for k in range(which.size):
        motion, found[k] = which[k], 0
        count = meshes.counts[motion]
        if count > 1:
            bound_parameters(parameters[motion], ranges, meshes.rows.shape[2])
            turn_to_columns(meshes.rows[motion], count, room.columns)
            bound_steps(room.columns, count, room.boxes)
            is_seen = sees_all(tape, ranges, count - 1, room.slopes, HALVES * limit, room.boxes)
            found[k] = 0 if is_seen else 1


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
        found[motion] = 0
        if meshes.counts[motion] > 1:
            path = path_of(meshes, motion, room)
            bound_parameters(parameters[motion], ranges, meshes.rows.shape[2])
            room.workspace.looked[0], room.blind.found[0] = 0, 0
            inspect(tape, ranges, path, seeds[motion : motion + 1], rules, room.workspace, room.spare, room.blind)
            found[motion] = 1 if room.blind.found[0] > 0 else 0
