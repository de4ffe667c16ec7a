"""Many motions of one model by Taylor series, eight side by side in the lanes of vectors.

Each lane has its own time, step and parameters; one that has come to its end takes up the next motion. The step is that
of `taylor`, and so is the look at what it really did; where that is bad, the lane goes back and takes a shorter one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline, kernel
from .motion import CANCELLED, FINE, NOT_FINITE, SINGULAR, SMALLEST_PIVOT, STEP_LIMIT, STEP_UNDERFLOW, TOO_LARGE, Floats
from .pointer import call_jet
from .step import LARGEST_VALUE
from .taylor import ALWAYS_UNNOTICED, LEAST_OF_SURPRISING, MOST_ORDERS, SHORTER, UNNOTICED

LANES = 8
GOES_ON, RESTS, ENDED = 1, 2, 3
SMALLER, MOST_UNITS = 2.0**-12, 8  # of the unit of time, where the first coefficients are out of range
Integers = NDArray[np.int64]


class Members(NamedTuple):
    """All motions: where they begin, their constants, and what becomes of them.

    `states` has shape (motions, width), `constants` (motions, constants). `samples`, shape (motions, samples, width),
    receives the states at `times`, shape (samples,); `outcomes`, `steps` and `filled` (how many samples) have shape
    (motions,).
    """

    states: Floats
    constants: Floats
    times: Floats
    samples: Floats
    outcomes: Integers
    steps: Integers
    filled: Integers


class Lanes(NamedTuple):
    """The code, and what each lane is at; the last axis of all arrays is that of the lanes.

    `given` has shape (numbers, lanes), `coefficients` (2, MOST_ORDERS, components, lanes); `work` has shape (numbers,),
    `program` (1,). The states `old` and `new`, their rests `old_rest` and `new_rest` and `slopes` have shape (width,
    lanes). `before` and `now` are times, `sizes` steps, `units` units of time, `least` the largest step that may be
    tried, and `sizes_before` the steps last taken, shape (lanes,); `member` is the number of a motion, −1 for none, and
    `is_pending` whether a step waits for its verdict (1), or, negative, how often the first series was out of range.
    """

    address: int
    order: int
    degrees: int
    first_pivot: int
    given: Floats
    coefficients: Floats
    work: Floats
    program: Integers
    old: Floats
    new: Floats
    old_rest: Floats
    new_rest: Floats
    slopes: Floats
    before: Floats
    now: Floats
    sizes: Floats
    sizes_before: Floats
    units: Floats
    least: Floats
    member: Integers
    is_pending: Integers


def make_lanes(address: int, order: int, degrees: int, width: int, sizes: tuple[int, int, int, int]) -> Lanes:
    """The arrays for code at an address; `sizes` are components, the first pivot among them, constants, work space."""
    components, first_pivot, constants, work = sizes
    states, rows = np.zeros((5, width, LANES)), np.zeros((4, LANES))
    return Lanes(
        address,
        order,
        degrees,
        first_pivot,
        np.ones((width + 2 + constants, LANES)),
        np.zeros((2, MOST_ORDERS, components, LANES)),
        np.zeros(work),
        np.array([order], dtype=np.int64),
        states[0],
        states[1],
        states[2],
        states[3],
        states[4],
        rows[0],
        rows[1],
        rows[2],
        rows[3],
        np.ones(LANES),
        np.full(LANES, np.inf),
        np.full(LANES, -1, dtype=np.int64),
        np.zeros(LANES, dtype=np.int64),
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


@inline
def expand_all(lanes: Lanes, row: int) -> None:
    """The coefficients at the new states of all lanes, each in a power of two near its step as the unit of time."""
    width = lanes.new.shape[0]
    for lane in range(LANES):
        near, unit = lanes.sizes[lane], lanes.given[0, lane]
        if not (0.25 * unit <= near <= 4.0 * unit):
            lanes.given[0, lane] = 2.0 ** np.floor(np.log2(near))
        lanes.given[1 + width, lane] = lanes.now[lane]
    for d in range(width):
        for lane in range(LANES):
            lanes.given[1 + d, lane] = lanes.new[d, lane]
    call_jet(lanes.address, lanes.coefficients[row], lanes.given, lanes.work, lanes.program)


@inline
def state_of(lanes: Lanes, row: int, lane: int) -> int:
    """Whether a lane's series can be used: FINE, SINGULAR or NOT_FINITE."""
    coefficients = lanes.coefficients[row]
    for i in range(lanes.first_pivot, coefficients.shape[1], 2):
        pivot, diagonal = coefficients[0, i, lane], coefficients[0, i + 1, lane]
        if not pivot > SMALLEST_PIVOT * diagonal:
            return NOT_FINITE if np.isnan(pivot) else SINGULAR
    total = 0.0
    for d in range(2 * lanes.degrees):
        total += abs(coefficients[1, d, lane]) + abs(coefficients[lanes.order, d, lane]) + abs(lanes.new[d, lane])
    return FINE if total <= LARGEST_VALUE else (NOT_FINITE if np.isnan(total) else TOO_LARGE)


@inline
def defect_in(lanes: Lanes, row: int, lane: int) -> float:
    """h |x′ − f| at the end of the step before, over max(1, |x|)."""
    h, largest = lanes.sizes_before[lane], 0.0
    theta = h / lanes.given[0, lane]
    for d in range(2 * lanes.degrees):
        apart = abs(lanes.slopes[d, lane] - theta * lanes.coefficients[row, 1, d, lane])
        largest = max(largest, apart / max(1.0, abs(lanes.new[d, lane])))
    return largest


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
def judge_lane(lanes: Lanes, row: int, lane: int, members: Members, tolerance: float) -> int:
    """What becomes of the step before: accepted (1), or taken back (0); a negative number ends the motion."""
    outcome = state_of(lanes, row, lane)
    if lanes.is_pending[lane] <= 0:
        return 1 if outcome == FINE else begin_again(lanes, lane, outcome)
    h = lanes.sizes_before[lane]
    defect = defect_in(lanes, row, lane) if outcome == FINE else np.inf
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
def plan_lane(lanes: Lanes, row: int, lane: int, tolerance: float, largest: float, end: float) -> None:
    """The next step of a lane, as in `taylor`."""
    last, earlier, order = 0.0, 0.0, lanes.order
    for d in range(2 * lanes.degrees):
        scale = 1.0 / max(1.0, abs(lanes.new[d, lane]))
        last = max(last, abs(lanes.coefficients[row, order, d, lane]) * scale)
        earlier = max(earlier, abs(lanes.coefficients[row, order - 1, d, lane]) * scale)
    steepest = max(
        np.log(last / tolerance) / order if last > 0.0 else -np.inf,
        np.log(earlier / tolerance) / (order - 1.0) if earlier > 0.0 else -np.inf,
    )
    lanes.units[lane] = lanes.given[0, lane]
    wanted = lanes.given[0, lane] * np.exp(-0.7 / (order - 1.0) - steepest)
    h, left = min(wanted, largest, lanes.least[lane]), end - lanes.now[lane]
    lanes.before[lane] = lanes.now[lane]
    is_last = h * (1.0 + 1e-9) >= left
    lanes.sizes[lane] = lanes.sizes_before[lane] = left if is_last else h
    lanes.now[lane] = end if is_last else lanes.now[lane] + h
    lanes.is_pending[lane] = 1


@inline
def advance_all(lanes: Lanes, row: int) -> None:
    """All lanes go their step, by Horner's rule for the states and for what their series end with as h ẋ."""
    coefficients, values, slopes = lanes.coefficients[row], lanes.new_rest, lanes.slopes
    for d in range(lanes.new.shape[0]):
        for lane in range(LANES):
            lanes.old[d, lane], lanes.old_rest[d, lane] = lanes.new[d, lane], lanes.new_rest[d, lane]
            values[d, lane] = coefficients[lanes.order, d, lane]
            slopes[d, lane] = 0.0
        for k in range(lanes.order - 1, 0, -1):
            for lane in range(LANES):
                theta = lanes.sizes[lane] / lanes.units[lane]
                slopes[d, lane] = slopes[d, lane] * theta + values[d, lane]
                values[d, lane] = values[d, lane] * theta + coefficients[k, d, lane]
        for lane in range(LANES):
            theta = lanes.sizes[lane] / lanes.units[lane]
            slopes[d, lane] = theta * (values[d, lane] + theta * slopes[d, lane])
            change = values[d, lane] * theta + lanes.old_rest[d, lane]
            lanes.new[d, lane] = lanes.old[d, lane] + change
            lanes.new_rest[d, lane] = change - (lanes.new[d, lane] - lanes.old[d, lane])


@inline
def rest_and_advance(lanes: Lanes, row: int) -> None:
    """Lanes whose step is planned go it; the others stay where they are, with a step of length 0 for this round."""
    for lane in range(LANES):
        if lanes.is_pending[lane] <= 0:
            lanes.sizes_before[lane] = lanes.sizes[lane]
            lanes.sizes[lane] = 0.0
            for k in range(1, lanes.order + 1):
                for d in range(lanes.new.shape[0]):
                    lanes.coefficients[row, k, d, lane] = 0.0
    advance_all(lanes, row)
    for lane in range(LANES):
        if lanes.is_pending[lane] <= 0:
            lanes.sizes[lane] = lanes.sizes_before[lane]


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
    outcome = judge_lane(lanes, row, lane, members, tolerance)
    if outcome == 1 and was_pending:
        sample_lane(lanes, 1 - row, lane, members)
    if outcome == 1 and members.steps[member] >= limit:
        outcome = -STEP_LIMIT
    if cancelled[0] != 0:
        outcome = -CANCELLED
    if outcome < 0 or (outcome == 1 and lanes.now[lane] >= members.times[members.times.size - 1]):
        members.outcomes[member] = -outcome if outcome < 0 else FINE
        return ENDED
    return GOES_ON if outcome == 1 else RESTS


@kernel
def integrate_members(
    lanes: Lanes, members: Members, tolerance: float, largest: float, limit: int, cancelled: Integers
) -> None:
    """All motions from times[0] to times[-1], each with steps up to `largest` and `limit` steps at most.

    `cancelled`, shape (1,), ends them when it is not 0.
    """
    count, following, busy, row = members.states.shape[0], 0, 0, 0
    end = members.times[members.times.size - 1]
    for lane in range(LANES):
        take_up(lanes, members, lane, following if following < count else -1, largest)
        busy += 1 if following < count else 0
        following += 1
        if lanes.member[lane] < 0:
            lanes.sizes[lane] = largest
    while busy > 0:
        expand_all(lanes, row)
        for lane in range(LANES):
            verdict = verdict_on(lanes, row, lane, members, tolerance, limit, cancelled)
            if verdict == GOES_ON:
                plan_lane(lanes, row, lane, tolerance, largest, end)
                continue
            lanes.units[lane] = lanes.given[0, lane]  # its series is not known yet: it rests for this round
            if verdict == ENDED:
                take_up(lanes, members, lane, following if following < count else -1, largest)
                busy -= 1 if following >= count else 0
                following += 1
        rest_and_advance(lanes, row)
        row = 1 - row
