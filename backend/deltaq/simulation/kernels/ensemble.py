"""Many motions of one model by Taylor series, some side by side in the lanes of vectors.

Each lane has its own time, step and parameters; one that has come to its end takes up the next motion. The step is that
of `taylor`, and so is the look at what it really did; where that is bad, the lane goes back and takes a shorter one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .aligned import aligned
from .compiler import inline, kernel
from .loop import to_a_number
from .motion import CANCELLED, FINE, NOT_FINITE, ROUNDING, SINGULAR, STEP_LIMIT, STEP_UNDERFLOW, TOO_LARGE, Floats
from .pointer import call_jet
from .step import LARGEST_VALUE
from .taylor import ALWAYS_UNNOTICED, LEAST_OF_SURPRISING, MOST_ORDERS, ROOM, SHORTER, UNNOTICED, sign_change

OLD, NEW, OLD_REST, NEW_REST, SLOPES = 0, 1, 2, 3, 4  # rows of states
# And of neighbours: how far each is from its motion at the beginning of a step, at its end, and there with what the
# step did wrong; the largest error up to the beginning, and up to the end.
APART, APART_AHEAD, APART_FOUND, ERRORS, ERRORS_FOUND = 5, 6, 7, 8, 9
INSIDE_STATES = 10  # h ẋ within the step
STATES = 11
# Rows of what is told of steps: θ of the step to go, and of that gone in the new unit of time; that unit, tolerance.
THETA, GONE, UNIT, TOLERANCE = 0, 1, 2, 3
# And found: sizes of numbers, pivots (the least margin, and their sum), the defect, the step that is wanted.
SIZES, MARGINS, PIVOTS, DEFECTS, WANTED = 4, 5, 6, 7, 8
# And of neighbours: the part of a defect that is an error, whether the step before is kept, and the enlargement; and
# the defect within the step.
SHARE, KEPT, SCALE, INSIDE = 9, 10, 11, 12
ROWS = 13
LEAST_JET = 2  # orders
FIRST_SCALE = 2.0**20
GOES_ON, RESTS, ENDED = 1, 2, 3
NEXT, BUSY, ROW = 0, 1, 2  # of the turn
SMALLER, MOST_UNITS = 2.0**-12, 8  # of the unit of time, where the first coefficients are out of range
Integers = NDArray[np.int64]


class Members(NamedTuple):
    """All motions: where they begin, their constants, and what becomes of them.

    `states` has shape (motions, width), `constants` (motions, constants). `samples`, shape (motions, samples, width),
    receives the states at `times`, shape (samples,); `outcomes`, `steps`, `filled` (how many samples) and the times
    `reached` have shape (motions,). Where errors are wanted, `nudges` are changes of (q, q̇, constants) by rounding,
    shape (motions, 2n + constants), and `errors`, shape (motions, samples, 2n), receives the largest error up to each
    sample; else both are empty in their last axis. `mesh_rows`, shape (motions, capacity, 2n + 1), and `mesh_counts`,
    shape (motions,), receive the ends of steps as `sight.Meshes`, with capacity 0 if they are not wanted; `blind`,
    shape (motions,), is for what is made of that: 1 where a step was blind.
    """

    states: Floats
    constants: Floats
    nudges: Floats
    times: Floats
    samples: Floats
    errors: Floats
    outcomes: Integers
    steps: Integers
    filled: Integers
    reached: Floats
    mesh_rows: Floats
    mesh_counts: Integers
    blind: Integers


class Addresses(NamedTuple):
    """Code for coefficients (`jet`), for the step of all lanes (`advance`) and for what it did (`measure`).

    And, for their neighbours before a step, in it, and behind it, `begin`, `carry`, and `settle`; for what is within a
    step, `look` and `compare` (`series.neighbour`).
    """

    jet: int
    advance: int
    measure: int
    begin: int
    carry: int
    settle: int
    look: int
    compare: int


class Lanes(NamedTuple):
    """The code, and what each lane is at; the last axis of all arrays is that of the lanes.

    `given` has shape (numbers, lanes), `coefficients` (2, MOST_ORDERS, components, lanes); `work` has shape (numbers,),
    `program` (1,). `states`, shape (STATES, width, lanes), are `old` and `new`, their rests `old_rest` and `new_rest`,
    slopes, and what is known of neighbours; `told`, shape (ROWS, lanes), is what the code is told of steps, and tells.
    Behind these two in `rows`, shape (numbers, lanes), come `nudges` of constants, and what neighbours' jets are given,
    `near_given`; these find `near`, shape (orders, components, lanes), by `near_program`, shape (1,), or by
    `first_program` as few orders as a jet can. `before` and `now` are times, `sizes` steps, `units` units of time,
    `least` the largest step that may be tried, and `sizes_before` the steps last taken, shape (lanes,); `member` is the
    number of a motion, −1 for none, and `is_pending` whether a step waits for its verdict (1), or, negative, how often
    the first series was out of range. `is_cut` says whether it ends where one of so many `conditions` of the forces
    changes. `turn`, shape (3,), has the motion that is taken up next, how many lanes are busy (−1 before they begin),
    and the row of coefficients that comes next.
    """

    code: Addresses
    order: int
    degrees: int
    conditions: int
    given: Floats
    coefficients: Floats
    work: Floats
    program: Integers
    rows: Floats
    states: Floats
    told: Floats
    nudges: Floats
    near_given: Floats
    near: Floats
    near_program: Integers
    first_program: Integers
    old: Floats
    new: Floats
    old_rest: Floats
    new_rest: Floats
    before: Floats
    now: Floats
    sizes: Floats
    sizes_before: Floats
    units: Floats
    least: Floats
    member: Integers
    is_pending: Integers
    is_cut: Integers
    turn: Integers


def make_lanes(
    code: Addresses,
    orders: tuple[int, int],
    degrees: int,
    width: int,
    sizes: tuple[int, int, int, int, int],
) -> Lanes:
    """The arrays for code; `sizes` are conditions, components, constants, work space, lanes.

    `orders` are those of the motions' series and of their neighbours'.
    """
    conditions, components, constants, work, count = sizes
    given, first = width + 2 + constants, STATES * width
    block, rows = aligned(first + ROWS + constants + given, count), aligned(4, count)
    states = block[:first].reshape(STATES, width, count)
    behind = first + ROWS
    return Lanes(
        code,
        orders[0],
        degrees,
        conditions,
        aligned(given, count),
        aligned(2, MOST_ORDERS, components, count),
        aligned(work),
        np.array(orders[:1], dtype=np.int64),
        block,
        states,
        block[first:behind],
        block[behind : behind + constants],
        block[behind + constants :],
        aligned(orders[1] + 1, components, count),
        np.array(orders[1:], dtype=np.int64),
        np.array([LEAST_JET], dtype=np.int64),
        states[OLD],
        states[NEW],
        states[OLD_REST],
        states[NEW_REST],
        rows[0],
        rows[1],
        rows[2],
        rows[3],
        np.ones(count),
        np.full(count, np.inf),
        np.full(count, -1, dtype=np.int64),
        np.zeros(count, dtype=np.int64),
        np.zeros(count, dtype=np.int64),
        np.array([0, -1, 0], dtype=np.int64),
    )


@inline
def take_up(lanes: Lanes, members: Members, lane: int, member: int, near: float) -> None:
    """A lane begins with a motion, or with none (−1)."""
    lanes.member[lane] = member
    lanes.is_pending[lane] = 0
    if member < 0:
        return
    for d in range(lanes.new.shape[0]):
        lanes.old[d, lane] = lanes.new[d, lane] = members.samples[member, 0, d] = members.states[member, d]
        lanes.old_rest[d, lane] = lanes.new_rest[d, lane] = 0.0
    for c in range(members.constants.shape[1]):
        lanes.given[lanes.new.shape[0] + 2 + c, lane] = members.constants[member, c]
    lanes.given[0, lane] = 2.0 ** np.floor(np.log2(near))  # whatever the motion before has left there
    lanes.now[lane] = members.times[0]
    lanes.sizes[lane], lanes.least[lane] = near, np.inf
    members.filled[member] = 1
    record_end(lanes, members, lane, member)
    if members.errors.shape[2] > 0:
        begin_beside(lanes, members, lane, member)


@inline
def record_end(lanes: Lanes, members: Members, lane: int, member: int) -> None:
    """Records where a lane is in the mesh of its motion, which has room for it."""
    if members.mesh_rows.shape[1] == 0:
        return
    place, width = members.mesh_counts[member], members.mesh_rows.shape[2] - 1
    for d in range(width):
        members.mesh_rows[member, place, d] = lanes.new[d, lane]
    members.mesh_rows[member, place, width] = lanes.now[lane]
    members.mesh_counts[member] = place + 1


@inline
def begin_beside(lanes: Lanes, members: Members, lane: int, member: int) -> None:
    """A lane's neighbour begins: some units in the last place away, which are enlarged."""
    n = members.errors.shape[2]
    for d in range(n):
        apart = FIRST_SCALE * members.nudges[member, d]
        for row in (APART, APART_AHEAD, APART_FOUND):
            lanes.states[row, d, lane] = apart
        lanes.states[ERRORS, d, lane] = lanes.states[ERRORS_FOUND, d, lane] = members.errors[member, 0, d] = 0.0
    for c in range(lanes.nudges.shape[0]):
        lanes.nudges[c, lane] = members.nudges[member, n + c]
    lanes.told[SCALE, lane], lanes.told[KEPT, lane] = FIRST_SCALE, 1.0


@inline
def expand_all(lanes: Lanes, row: int, tolerance: float, judged: int) -> None:
    """The coefficients at the new states of all lanes, each in a power of two near its step as the unit of time.

    What they tell of the step before, and the step that they want, stand in `told`; and errors, where so many numbers
    of each motion are judged.
    """
    width = lanes.new.shape[0]
    for lane in range(lanes.now.size):
        near, unit = lanes.sizes[lane], lanes.given[0, lane]
        if not (0.25 * unit <= near <= 4.0 * unit):
            unit = lanes.given[0, lane] = 2.0 ** np.floor(np.log2(near))
        lanes.given[1 + width, lane] = lanes.now[lane]
        lanes.told[GONE, lane] = lanes.sizes_before[lane] / unit
        lanes.told[UNIT, lane] = unit
        lanes.told[TOLERANCE, lane] = tolerance
    for d in range(width):
        for lane in range(lanes.now.size):
            lanes.given[1 + d, lane] = lanes.new[d, lane]
    call_jet(lanes.code.jet, lanes.coefficients[row], lanes.given, lanes.work, lanes.program)
    call_jet(lanes.code.measure, lanes.coefficients[row], lanes.states, lanes.told, lanes.program)
    if judged > 0:
        for lane in range(lanes.now.size):
            is_step = lanes.is_pending[lane] > 0 and lanes.is_cut[lane] == 0
            lanes.told[SHARE, lane] = 1.0 / (lanes.order + 1) if is_step else 0.0
        call_jet(lanes.code.settle, lanes.coefficients[row], lanes.states, lanes.told, lanes.program)


@inline
def state_of(lanes: Lanes, lane: int) -> int:
    """Whether a lane's series can be used: FINE, SINGULAR, NOT_FINITE or TOO_LARGE."""
    if lanes.told[MARGINS, lane] <= 0.0:
        return SINGULAR
    total = lanes.told[SIZES, lane]
    if total <= LARGEST_VALUE and not np.isnan(lanes.told[PIVOTS, lane]):
        return FINE
    return TOO_LARGE if total > LARGEST_VALUE else NOT_FINITE


@inline
def sample_lane(lanes: Lanes, row: int, lane: int, members: Members) -> None:
    """The samples within the step that is accepted, from its series."""
    member, count = lanes.member[lane], members.times.size
    place, end = members.filled[member], lanes.now[lane]
    is_last = end >= members.times[count - 1]
    while place < count and (is_last or members.times[place] <= end):
        theta = (members.times[place] - lanes.before[lane]) / lanes.units[lane]
        for d in range(lanes.old.shape[0]):
            value = 0.0
            for k in range(lanes.order, 0, -1):
                value = (value + lanes.coefficients[row, k, d, lane]) * theta
            members.samples[member, place, d] = lanes.old[d, lane] + (value + lanes.old_rest[d, lane])
        for d in range(members.errors.shape[2]):
            members.errors[member, place, d] = lanes.states[ERRORS_FOUND, d, lane]
        place += 1
    members.filled[member] = place


@inline
def begin_again(lanes: Lanes, lane: int, outcome: int) -> int:
    """0 if a motion's first series, whose coefficients are out of range, is found again in a smaller unit of time.

    The first unit is the longest step, within which a fast motion may turn many times. Else the outcome, negative.
    """
    if outcome == SINGULAR or lanes.is_pending[lane] <= -MOST_UNITS:
        return -outcome
    for d in range(2 * lanes.degrees):
        if not abs(lanes.new[d, lane]) <= LARGEST_VALUE:
            return -outcome
    lanes.is_pending[lane] -= 1
    lanes.sizes[lane] *= SMALLER
    return 0


@inline
def judge_lane(lanes: Lanes, lane: int, members: Members, tolerance: float) -> int:
    """What becomes of the step before: accepted (1), or taken back (0); a negative number ends the motion."""
    outcome = state_of(lanes, lane)
    if lanes.is_pending[lane] <= 0:
        return 1 if outcome == FINE else begin_again(lanes, lane, outcome)
    h = lanes.sizes_before[lane]
    defect = max(lanes.told[DEFECTS, lane], lanes.told[INSIDE, lane]) if outcome == FINE else np.inf
    if outcome == FINE and lanes.is_cut[lane] == 1:  # behind the place the forces are others
        defect = 0.0
    if defect > max(UNNOTICED * tolerance, ALWAYS_UNNOTICED) and lanes.least[lane] > LEAST_OF_SURPRISING * h:
        lanes.least[lane] = lanes.sizes[lane] = SHORTER * h
        lanes.now[lane], lanes.is_pending[lane] = lanes.before[lane], 0
        for d in range(lanes.new.shape[0]):
            lanes.new[d, lane], lanes.new_rest[d, lane] = lanes.old[d, lane], lanes.old_rest[d, lane]
        return 0 if lanes.now[lane] + lanes.least[lane] > lanes.now[lane] else -STEP_UNDERFLOW
    if outcome != FINE:
        return -outcome
    members.steps[lanes.member[lane]] += 1
    lanes.least[lane], lanes.is_pending[lane] = np.inf, 0
    return 1


@inline
def cut_of(lanes: Lanes, row: int, lane: int, h: float) -> float:
    """A step up to h that ends a little behind where the first condition changes, if one does."""
    found, width = h, lanes.new.shape[0]
    for c in range(lanes.conditions):
        column = lanes.coefficients[row, :, width + c, lane]
        at = sign_change(column, lanes.order, lanes.units[lane], found)
        if at >= 0.0:
            found = min(found, at + ROOM * ROUNDING * max(lanes.now[lane], h))
    return found


@inline
def plan_lane(lanes: Lanes, row: int, lane: int, largest: float, end: float) -> None:
    """The next step of a lane, as in `taylor`."""
    lanes.units[lane] = lanes.given[0, lane]
    wanted, left = min(lanes.told[WANTED, lane], largest, lanes.least[lane]), end - lanes.now[lane]
    lanes.before[lane] = lanes.now[lane]
    h = left if wanted * (1.0 + 1e-9) >= left else wanted
    cut = cut_of(lanes, row, lane, h) if lanes.conditions > 0 else h
    lanes.is_cut[lane] = 1 if cut < h else 0
    size = cut if cut == left else to_a_number(lanes.now[lane], cut)
    lanes.sizes[lane] = lanes.sizes_before[lane] = size
    lanes.now[lane] = end if size == left else lanes.now[lane] + size
    lanes.is_pending[lane] = 1


@inline
def advance_all(lanes: Lanes, row: int, judged: int) -> None:
    """Lanes whose step is planned go it, with neighbours where they are judged; the others stay where they are."""
    for lane in range(lanes.now.size):
        lanes.told[THETA, lane] = lanes.sizes[lane] / lanes.units[lane] if lanes.is_pending[lane] > 0 else 0.0
    call_jet(lanes.code.advance, lanes.coefficients[row], lanes.states, lanes.told, lanes.program)
    if judged > 0:
        call_jet(lanes.code.begin, lanes.coefficients[row], lanes.given, lanes.rows, lanes.program)
        call_jet(lanes.code.jet, lanes.near, lanes.near_given, lanes.work, lanes.near_program)
        call_jet(lanes.code.carry, lanes.near, lanes.coefficients[row], lanes.rows, lanes.near_program)
        call_jet(lanes.code.look, lanes.coefficients[row], lanes.given, lanes.rows, lanes.program)
        call_jet(lanes.code.jet, lanes.near, lanes.near_given, lanes.work, lanes.first_program)
        call_jet(lanes.code.compare, lanes.near, lanes.given, lanes.rows, lanes.program)


@inline
def verdict_on(
    lanes: Lanes, row: int, lane: int, members: Members, tolerance: float, limit: int, cancelled: Integers
) -> int:
    """GOES_ON where a lane may take its next step, RESTS where it has no series for that, ENDED with its motion.

    `cancelled` has shape (1,). The samples of an accepted step are written, and the outcome of a motion that ended.
    """
    member = lanes.member[lane]
    if member < 0:
        return RESTS
    was_pending = lanes.is_pending[lane] == 1
    outcome = judge_lane(lanes, lane, members, tolerance)
    lanes.told[KEPT, lane] = 1.0 if outcome == 1 else 0.0
    if outcome == 1 and was_pending:
        sample_lane(lanes, 1 - row, lane, members)
        record_end(lanes, members, lane, member)
    if outcome == 1 and members.steps[member] >= limit:
        outcome = -STEP_LIMIT
    if cancelled[0] != 0:
        outcome = -CANCELLED
    if outcome < 0 or (outcome == 1 and lanes.now[lane] >= members.times[members.times.size - 1]):
        members.outcomes[member] = -outcome if outcome < 0 else FINE
        members.reached[member] = lanes.now[lane]
        return ENDED
    return GOES_ON if outcome == 1 else RESTS


@inline
def begin_all(lanes: Lanes, members: Members, largest: float) -> None:
    """The first motions, one in each lane."""
    count = members.states.shape[0]
    for lane in range(lanes.now.size):
        take_up(lanes, members, lane, lane if lane < count else -1, largest)
        if lanes.member[lane] < 0:
            lanes.sizes[lane] = largest
    lanes.turn[NEXT], lanes.turn[BUSY], lanes.turn[ROW] = lanes.now.size, min(lanes.now.size, count), 0


@kernel
def integrate_members(
    lanes: Lanes, members: Members, tolerance: float, largest: float, limit: int, cancelled: Integers
) -> bool:
    """All motions from times[0] to times[-1], each with steps up to `largest` and `limit` steps at most.

    `cancelled`, shape (1,), ends them when it is not 0. Returns whether some have not come to their end: where the mesh
    of one is full, all wait until it is called again with room in all meshes.
    """
    count, judged, end = members.states.shape[0], members.errors.shape[2], members.times[members.times.size - 1]
    room, is_full = members.mesh_rows.shape[1], False
    if lanes.turn[BUSY] < 0:
        begin_all(lanes, members, largest)
    while lanes.turn[BUSY] > 0 and not is_full:
        row = lanes.turn[ROW]
        expand_all(lanes, row, tolerance, judged)
        for lane in range(lanes.now.size):
            verdict = verdict_on(lanes, row, lane, members, tolerance, limit, cancelled)
            if verdict == GOES_ON:
                plan_lane(lanes, row, lane, largest, end)
                is_full = is_full or members.mesh_counts[lanes.member[lane]] == room > 0
                continue
            lanes.units[lane] = lanes.given[0, lane]  # its series is not known yet: it rests for this round
            if verdict == ENDED:
                following = lanes.turn[NEXT]
                take_up(lanes, members, lane, following if following < count else -1, largest)
                lanes.turn[BUSY] -= 1 if following >= count else 0
                lanes.turn[NEXT] += 1
        advance_all(lanes, row, judged)
        lanes.turn[ROW] = 1 - row
    return bool(lanes.turn[BUSY] > 0)
