"""The stepping loop of Taylor series, fixed step and adaptive.

The step follows from the last two coefficients: the local error of a series of order p is about their size at its end
(Jorba, Zou, Experimental Mathematics 14 (2005) 99–117, §3). How far the next series is from the derivative of this one
at its end tells what the step really did, for nothing: a step that is worse than it seemed is taken again, shorter.
"""

from __future__ import annotations

from itertools import accumulate
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .aligned import aligned
from .compiler import inline, kernel, runtime_int, subroutine
from .loop import Result, advance_time, begin, interruption, sample_at_jump, time_reached, to_a_number
from .motion import (
    FINE,
    NOT_FINITE,
    ROUNDING,
    SINGULAR,
    SMALLEST_PIVOT,
    STEP_UNDERFLOW,
    TOO_LARGE,
    Floats,
    Motion,
)
from .plan import comes_to, enter_piece, fit_step, record
from .pointer import call_jet
from .step_control import Control, is_resolvable
from .switch import AHEAD, detect_hold, held_or_failed, is_held_before
from .watch import Watch, check_events, set_sample_times

MOST_ORDERS = 40  # room for coefficients 0 … 39
UNNOTICED, ALWAYS_UNNOTICED = 1e3, 1e-11  # a defect up to so many times the tolerance, or so large, is no surprise
SHORTER, LEAST_OF_SURPRISING = 0.25, 1e-3  # a step tried again; shorter by so much, what surprises is rounding
PLACES = 16  # of a step in which the sign of a condition's argument is looked at
ROOM = 4.0  # units in the last place of a time by which a step goes past the zero of such an argument


# Rows of states: where the step begins and ends, what rounding has left of both, and h ẋ at its end.
OLD, NEW, OLD_REST, NEW_REST, SLOPES = 0, 1, 2, 3, 4
STATES, LANES = 5, 4  # how many rows, and how many components one vector has
# What the code is told of a step, and tells: θ, the step before and H in units of time; of the order and the tolerance
# (`single.told_of`); whether the state fits, the size of the series, the defect, the step wanted; the units of rows.
THETA, GONE, UNIT, SAFETY, SHARES, FITS, SIZE, DEFECT, WANTED, UNITS = 0, 1, 2, 3, 4, 6, 7, 8, 9, 10
TOLD = 12
# And in integers: the order, the components of a row, the vectors of a state, its width, how many of it are judged.
ORDER, COMPONENTS, VECTORS, WIDTH, JUDGED = 0, 1, 2, 3, 4


class Addresses(NamedTuple):
    """Addresses: of what finds coefficients, of what goes a step, and of what tells what it did (`series.single`)."""

    jet: int
    step: int
    measure: int


class Series(NamedTuple):
    """Code for Taylor coefficients with the arrays that it reads and writes.

    `given`, shape (numbers,), holds the unit of time, the state, t and constants; `coefficients`, shape (2, order + 1,
    components), the rows of this step and of the next: a state, arguments of so many `conditions`, and in row 0 the
    pivots with their diagonal entries. `work`, shape (numbers,), is room for the code; `program`, shape (≥ 1,), begins
    with the order. `states` has shape (STATES, ≥ width), `told`, shape (TOLD,), what the code is told of steps, and
    tells; `plan`, shape (5,), the sizes of all this.
    """

    code: Addresses
    order: int
    width: int
    conditions: int
    given: Floats
    coefficients: Floats
    work: Floats
    program: NDArray[np.int64]
    states: Floats
    told: Floats
    plan: NDArray[np.int64]


def make_series(
    code: Addresses, program: tuple[int, ...], width: int, constants: int, sizes: tuple[int, int, int, int]
) -> Series:
    """The arrays, in one block, for code whose program begins with the order.

    The state has so many components and the code so many constants; `sizes` are how many are judged, the conditions,
    the components of a row, and the work space.
    """
    order, (judged, conditions, components, work) = program[0], sizes
    vectors = -(-width // LANES)
    length, rows = vectors * LANES, 2 * (order + 1) * components
    lengths = (-(-work // 8) * 8, STATES * length, TOLD, width + 2 + constants, rows)
    ends = list(accumulate(lengths))
    block = aligned(ends[-1] + LANES)  # the last vector goes past the last row
    of_work, states, told, given, both = (block[end - size : end] for end, size in zip(ends, lengths, strict=True))
    return Series(
        code,
        order,
        width,
        conditions,
        given,
        both.reshape(2, order + 1, components),
        of_work,
        np.array(program, dtype=np.int64),
        states.reshape(STATES, length),
        told,
        np.array((order, components, vectors, width, judged), dtype=np.int64),
    )


def begin_series(series: Series, told: tuple[float, ...], state: Floats, constants: Floats) -> None:
    """A motion begins, whatever the arrays were used for before; `told` is what stands from the place SAFETY on.

    `state` has shape (width,), `constants` shape (constants,).
    """
    width, given = series.width, series.given
    given[0], given[1 : 1 + width], given[2 + width :] = 1.0, state, constants
    series.told[SAFETY : SAFETY + len(told)] = told
    series.states[:] = 0.0
    series.states[: NEW + 1, :width] = state


class Choice(NamedTuple):
    """A step of this size, whether it ends a piece, and whether it ends behind a jump of a force."""

    size: float
    ends_piece: bool
    is_cut: bool


@inline
def expand(series: Series, row: int, t: float, motion: Motion, near: float, gone: float) -> int:
    """The coefficients at the new state, in a power of two not far from `near` as the unit of time.

    So they stay in range, however fast the motion is; the unit is halved many times where they do not. They tell of a
    step of `gone` seconds before. Returns FINE, SINGULAR or NOT_FINITE.
    """
    width, outcome, told, given = series.width, NOT_FINITE, series.told, series.given
    coefficients, unit = series.coefficients[row], given[0]
    if not (0.25 * unit <= near <= 4.0 * unit):
        unit = 2.0 ** np.floor(np.log2(near))
    for d in range(width):
        given[1 + d] = series.states[NEW, d]
    given[1 + width] = t
    for _ in range(4):
        given[0] = told[UNIT] = told[UNITS + row] = unit
        told[GONE] = gone / unit
        call_jet(series.code.jet, coefficients, given, series.work, series.program)
        for i in range(width + series.conditions, coefficients.shape[1], 2):
            pivot, diagonal = coefficients[0, i], coefficients[0, i + 1]
            if not pivot > SMALLEST_PIVOT * diagonal:
                return NOT_FINITE if np.isnan(pivot) else SINGULAR
            motion.conditioning[0] = min(motion.conditioning[0], pivot / diagonal)
        call_jet(series.code.measure, coefficients, series.states, told, series.plan)
        if told[SIZE] < np.inf:
            outcome = FINE
            break
        unit *= 2.0**-24
    return outcome


@inline
def increment(series: Series, row: int, d: int, theta: float) -> float:
    """What component d of a row grows by, θ units of time behind its beginning."""
    value = 0.0
    for k in range(series.order, 0, -1):
        value = (value + series.coefficients[row, k, d]) * theta
    return value


@inline
def advance(series: Series, row: int, h: float) -> int:
    """The state after a step of size h with its rest, and what its series ends with as h ẋ; returns the outcome."""
    series.told[THETA] = h / series.told[UNITS + row]
    call_jet(series.code.step, series.coefficients[row], series.states, series.told, series.plan)
    if series.told[FITS] == 1.0:
        return FINE
    for d in range(series.width):
        if np.isnan(series.states[NEW, d]):
            return NOT_FINITE
    return TOO_LARGE


@inline
def grown(column: Floats, order: int, theta: float) -> float:
    """Σ cₖ θᵏ over k ≥ 1; `column`, shape (≥ order + 1,), has the coefficients."""
    value = 0.0
    for k in range(order, 0, -1):
        value = (value + column[k]) * theta
    return value


@subroutine
def sign_change(column: Floats, order: int, unit: float, h: float) -> float:
    """Where in a step of size h a polynomial has changed the sign that it begins with, at its first root; −1 if never.

    `column`, shape (≥ order + 1,), has its coefficients for times in `unit`.
    """
    start, below, above = column[0], 0.0, -1.0
    for i in range(1, PLACES + 1):
        at = h * i / PLACES
        value = start + grown(column, order, at / unit)
        if (start > 0.0 and value <= 0.0) or (start < 0.0 and value >= 0.0) or (start == 0.0 and value != 0.0):
            above = at
            break
        below = at
    if above < 0.0:
        return above
    for _ in range(60):
        middle = 0.5 * (below + above)
        value = start + grown(column, order, middle / unit)
        if (start > 0.0 and value > 0.0) or (start < 0.0 and value < 0.0):
            below = middle
        else:
            above = middle
    return above


@inline
def first_change(series: Series, row: int, t: float, h: float) -> float:
    """Where in a step of size h the first argument of a condition changes its sign, and a little further; else h."""
    found = h
    for c in range(series.conditions):
        column = series.coefficients[row, :, series.width + c]
        at = sign_change(column, series.order, series.told[UNITS + row], found)
        if at >= 0.0:
            found = min(found, at + ROOM * ROUNDING * max(t, h))
    return found


@inline
def sample_series(series: Series, row: int, t: float, h: float, times: Floats, out: Floats, first: int) -> int:
    """Samples number `first` and on, as far as they lie in the step; returns the next one.

    `times` has shape (samples,), `out`, which is written, shape (samples, width).
    """
    count = times.size
    reached = t + h
    is_last = comes_to(times[count - 1], reached)
    while first < count and (is_last or times[first] <= reached):
        theta = min(times[first] - t, h) / series.told[UNITS + row]
        for d in range(series.width):
            grows = increment(series, row, d, theta) + series.states[OLD_REST, d]
            out[first, d] = series.states[OLD, d] + grows
        first += 1
    return first


@inline
def watch_series(series: Series, row: int, t: float, h: float, watch: Watch, degrees: int) -> int:
    """Whether an event happens in the step."""
    if watch.functions == 0:
        return FINE
    set_sample_times(watch, t, h)
    sample_series(series, row, t, h, watch.times, watch.states, runtime_int(0))
    return check_events(watch, degrees)


@inline
def choose_step(series: Series, row: int, control: Control, piece: int, t: float, most: float) -> Choice:
    """A step of up to `most` seconds, by the piece and the conditions."""
    h, ends_piece = fit_step(control.plan, piece, t, most)
    cut = first_change(series, row, t, h) if series.conditions > 0 else h
    is_last = ends_piece and cut >= h
    size = cut if is_last or control.tolerance == 0.0 else to_a_number(t, cut)
    return Choice(size, is_last, cut < h)


@inline
def try_step(series: Series, row: int, t: float, step: Choice, motion: Motion) -> tuple[int, float]:
    """The state behind a step and the series there; returns the outcome and the defect."""
    outcome = advance(series, row, step.size)
    if outcome == FINE:
        outcome = expand(series, 1 - row, t + step.size, motion, step.size, step.size)
    if outcome != FINE or step.is_cut:
        return outcome, ROOM * ROUNDING * max(t, step.size)
    return FINE, series.told[DEFECT]


@inline
def is_refused(control: Control, outcome: int, defect: float, h: float, least: float) -> bool:
    """Whether a step is to be tried again, shorter: it failed or was worse than it seemed, and shortening may help."""
    surprising = defect > max(UNNOTICED * control.tolerance, ALWAYS_UNNOTICED)
    return control.tolerance > 0.0 and (outcome != FINE or surprising) and least > LEAST_OF_SURPRISING * h


@inline
def retried(control: Control, t: float, h: float, outcome: int) -> int:
    """FINE if a step of size h can be tried, or what ends the run: t + h is no longer different from t."""
    if is_resolvable(control, t, h):
        return FINE
    return STEP_UNDERFLOW if outcome == FINE else outcome


@inline
def accept_step(states: Floats) -> None:
    """The new state becomes the old one; `states` has shape (STATES, ≥ width)."""
    for d in range(states.shape[1]):
        states[OLD, d] = states[NEW, d]
        states[OLD_REST, d] = states[NEW_REST, d]


@kernel
def integrate_series(
    motion: Motion, series: Series, control: Control, watch: Watch, times: Floats, out: Floats
) -> Result:
    """Steps from times[0] to times[-1]; out[i] becomes the state at times[i], as far as all goes well.

    The motion has begun by `begin_series`. `times` has shape (samples,), `out` shape (samples, width).
    """
    t, time_compensation, plan, n = times[0], 0.0, control.plan, motion.degrees
    old, new = series.states[OLD, : series.width], series.states[NEW, : series.width]
    derivative = series.states[SLOPES, : series.width]  # for as long as there is no step
    outcome = begin(motion, plan, watch, t, old, derivative, out)
    row, piece, filled, steps, rejected = runtime_int(0), runtime_int(0), runtime_int(1), runtime_int(0), runtime_int(0)
    is_known, least, near, wanted = False, np.inf, control.largest_step, np.inf
    fixed, evaluations = 0 if control.tolerance > 0.0 else 1, runtime_int(1)
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        piece, t, jumped = enter_piece(plan, piece, t)
        if jumped:
            time_compensation, is_known = 0.0, False
            record(plan, t, old)
        if outcome == FINE and not is_known:
            outcome = expand(series, row, t, motion, near, 0.0)
            evaluations += series.order
            wanted = series.told[WANTED] if fixed == 0 else np.inf
        if outcome != FINE:
            break
        step, is_known = choose_step(series, row, control, piece, t, min(wanted, least)), True
        outcome, defect = try_step(series, row, t, step, motion)
        evaluations += series.order
        if is_refused(control, outcome, defect, step.size, least):
            rejected += 1
            least = SHORTER * step.size
            outcome = retried(control, t, least, outcome)
            continue
        if outcome != FINE:
            break
        held = detect_hold(motion, watch.switch, t, step.size, fixed, old, new)
        if is_held_before(watch.switch, t + step.size, held):
            outcome = held
            break
        filled = sample_series(series, row, t, step.size, times, out, filled)
        outcome = watch_series(series, row, t, step.size, watch, n) or held
        accept_step(series.states)
        steps += 1
        near, row, least, wanted = step.size, 1 - row, np.inf, series.told[WANTED] if fixed == 0 else np.inf
        t, time_compensation = advance_time(plan, piece, t, near, time_compensation, 1 if step.ends_piece else 0)
        filled = sample_at_jump(plan, piece, t, filled, out, old)
        record(plan, t, old)
    if outcome == STEP_UNDERFLOW:
        reach = AHEAD * control.largest_step
        outcome = held_or_failed(motion, watch.switch, t, reach, old, derivative, outcome)
    return Result(outcome, filled, steps, rejected, evaluations, time_reached(watch, outcome, times, filled, t))
