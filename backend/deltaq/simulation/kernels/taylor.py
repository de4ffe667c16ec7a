"""The stepping loop of Taylor series, fixed step and adaptive.

The step follows from the last two coefficients: the local error of a series of order p is about their size at its end
(Jorba, Zou, Experimental Mathematics 14 (2005) 99–117, §3). How far the next series is from the derivative of this one
at its end tells what the step really did, for nothing: a step that is worse than it seemed is taken again, shorter.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline, kernel, runtime_int, subroutine
from .loop import Result, advance_time, begin, interruption
from .motion import (
    FINE,
    HELD,
    NOT_FINITE,
    ROUNDING,
    SINGULAR,
    SMALLEST_PIVOT,
    STEP_UNDERFLOW,
    TOO_LARGE,
    Floats,
    Motion,
)
from .plan import enter_piece, fit_step, record
from .pointer import call_jet
from .step import LARGEST_VALUE
from .step_control import Control, is_resolvable
from .switch import AHEAD, detect_hold, held_or_failed, is_held_before
from .watch import Watch, check_events, set_sample_times

MOST_ORDERS = 40  # room for coefficients 0 … 39
UNNOTICED, ALWAYS_UNNOTICED = 1e3, 1e-11  # a defect up to so many times the tolerance, or so large, is no surprise
SHORTER, LEAST_OF_SURPRISING = 0.25, 1e-3  # a step tried again; shorter by so much, what surprises is rounding
PLACES = 16  # of a step in which the sign of a condition's argument is looked at
ROOM = 4.0  # units in the last place of a time by which a step goes past the zero of such an argument


class Series(NamedTuple):
    """Code for Taylor coefficients with the arrays that it reads and writes.

    `given`, shape (numbers,), holds the unit of time, the state, t and constants; `coefficients`, shape (2,
    MOST_ORDERS, components), the rows of this step and of the next: a state, arguments of so many `conditions`, and in
    row 0 the pivots with their diagonal entries. `work`, shape (numbers,), is room for the code; `program`, shape
    (≥ 1,), begins with the order. `units`, shape (2,), are the units of time of both steps. The states `old` and `new`
    and what Kahan's summation keeps of them, `compensation` and `new_compensation`, have shape (width,), as
    `slopes`, h ẋ at the end of a step.
    """

    address: int
    order: int
    conditions: int
    given: Floats
    coefficients: Floats
    work: Floats
    program: NDArray[np.int64]
    units: Floats
    old: Floats
    compensation: Floats
    new: Floats
    new_compensation: Floats
    slopes: Floats


def make_series(
    address: int, order: int, program: tuple[int, ...], sizes: tuple[int, int, int], state: Floats, constants: Floats
) -> Series:
    """The arrays for code at an address; `sizes` are the conditions, the components of a row, and the work space.

    `state` has shape (width,), `constants` shape (constants,).
    """
    conditions, components, work = sizes
    given = np.array([1.0, *state, 0.0, *constants])
    return Series(
        address,
        order,
        conditions,
        given,
        np.zeros((2, MOST_ORDERS, components)),
        np.zeros(work),
        np.array([order, *program], dtype=np.int64),
        np.ones(2),
        state.copy(),
        np.zeros_like(state),
        state.copy(),
        np.zeros_like(state),
        np.zeros_like(state),
    )


class Choice(NamedTuple):
    """A step of this size, whether it ends a piece, and whether it ends behind a jump of a force."""

    size: float
    ends_piece: bool
    is_cut: bool


@subroutine
def expand(series: Series, row: int, t: float, state: Floats, motion: Motion, near: float) -> int:
    """The coefficients at a state of shape (width,), in a power of two not far from `near` as the unit of time.

    So they stay in range, however fast the motion is; the unit is halved many times where they do not. Returns FINE,
    SINGULAR or NOT_FINITE.
    """
    width, outcome = state.size, NOT_FINITE
    coefficients, unit = series.coefficients[row], series.given[0]
    if not (0.25 * unit <= near <= 4.0 * unit):
        unit = 2.0 ** np.floor(np.log2(near))
    for _ in range(4):
        series.given[0] = series.units[row] = unit
        for d in range(width):
            series.given[1 + d] = state[d]
        series.given[1 + width] = t
        call_jet(series.address, coefficients, series.given, series.work, series.program)
        place = width + series.conditions
        for i in range(place, coefficients.shape[1], 2):
            pivot, diagonal = coefficients[0, i], coefficients[0, i + 1]
            if not pivot > SMALLEST_PIVOT * diagonal:
                return NOT_FINITE if np.isnan(pivot) else SINGULAR
            motion.conditioning[0] = min(motion.conditioning[0], pivot / diagonal)
        total = 0.0
        for d in range(2 * motion.degrees):
            total += abs(coefficients[1, d]) + abs(coefficients[series.order, d])
        if total < np.inf:
            outcome = FINE
            break
        unit *= 2.0**-24
    return outcome


@inline
def wanted_step(series: Series, row: int, tolerance: float, degrees: int) -> float:
    """The step by which the last two coefficients of (q, q̇) shrink to the tolerance: (ε/|xₖ|)^(1/k)."""
    coefficients, order = series.coefficients[row], series.order
    last, before = 0.0, 0.0
    for d in range(2 * degrees):
        scale = 1.0 / max(1.0, abs(coefficients[0, d]))
        last = max(last, abs(coefficients[order, d]) * scale)
        before = max(before, abs(coefficients[order - 1, d]) * scale)
    steepest = max(
        np.log(last / tolerance) / order if last > 0.0 else -np.inf,
        np.log(before / tolerance) / (order - 1.0) if before > 0.0 else -np.inf,
    )
    return float(series.units[row] * np.exp(-0.7 / (order - 1.0) - steepest))


@inline
def increment(series: Series, row: int, d: int, theta: float) -> float:
    """What component d of a row grows by, θ units of time behind its beginning."""
    value = 0.0
    for k in range(series.order, 0, -1):
        value = (value + series.coefficients[row, k, d]) * theta
    return value


@inline
def advance(series: Series, row: int, h: float) -> int:
    """The state after a step of size h by Kahan's summation, and what its series ends with as h ẋ, into `slopes`.

    Returns the outcome. All components go through the orders together, by Horner's rule, as a processor likes best.
    """
    theta, width = h / series.units[row], series.old.size
    values, slopes, coefficients = series.new_compensation, series.slopes, series.coefficients
    for d in range(width):
        values[d] = coefficients[row, series.order, d]
        slopes[d] = 0.0
    for k in range(series.order - 1, 0, -1):
        for d in range(width):
            slopes[d] = slopes[d] * theta + values[d]
            values[d] = values[d] * theta + coefficients[row, k, d]
    outcome = FINE
    for d in range(width):
        slopes[d] = theta * (values[d] + theta * slopes[d])
        change = values[d] * theta + series.compensation[d]
        series.new[d] = series.old[d] + change
        series.new_compensation[d] = change - (series.new[d] - series.old[d])
        if not abs(series.new[d]) <= LARGEST_VALUE:
            outcome = NOT_FINITE if np.isnan(series.new[d]) else TOO_LARGE
    return outcome


@inline
def defect_of(series: Series, row: int, h: float, degrees: int) -> float:
    """h |x′ − f| at the end of a step, x′ the derivative of its series and f that of the next; over max(1, |x|)."""
    theta, largest = h / series.units[1 - row], 0.0
    for d in range(2 * degrees):
        apart = abs(series.slopes[d] - theta * series.coefficients[1 - row, 1, d])
        largest = max(largest, apart / max(1.0, abs(series.new[d])))
    return largest


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
        column = series.coefficients[row, :, series.old.size + c]
        at = sign_change(column, series.order, series.units[row], found)
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
    is_last = reached >= times[count - 1] - 1e-9 * h
    while first < count and (is_last or times[first] <= reached):
        theta = min(times[first] - t, h) / series.units[row]
        for d in range(series.old.size):
            out[first, d] = series.old[d] + (increment(series, row, d, theta) + series.compensation[d])
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
def choose_step(series: Series, row: int, control: Control, piece: int, t: float, least: float, n: int) -> Choice:
    """The step by its series, the piece and the conditions."""
    wanted = wanted_step(series, row, control.tolerance, n) if control.tolerance > 0.0 else np.inf
    h, ends_piece = fit_step(control.plan, piece, t, min(wanted, least))
    cut = first_change(series, row, t, h) if series.conditions > 0 else h
    return Choice(cut, ends_piece and cut >= h, cut < h)


@inline
def try_step(series: Series, row: int, t: float, step: Choice, motion: Motion) -> tuple[int, float]:
    """The state behind a step and the series there; returns the outcome and the defect."""
    outcome = advance(series, row, step.size)
    if outcome == FINE:
        outcome = expand(series, 1 - row, t + step.size, series.new, motion, step.size)
    if outcome != FINE or step.is_cut:
        return outcome, ROOM * ROUNDING * max(t, step.size)
    return FINE, defect_of(series, row, step.size, motion.degrees)


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
def accept_step(series: Series) -> None:
    """The new state becomes the old one."""
    for d in range(series.old.size):
        series.old[d] = series.new[d]
        series.compensation[d] = series.new_compensation[d]


@kernel
def integrate_series(
    motion: Motion, series: Series, control: Control, watch: Watch, derivative: Floats, times: Floats, out: Floats
) -> Result:
    """Steps from times[0] to times[-1]; out[i] becomes the state at times[i], as far as all goes well.

    The initial state stands in `series.old`. `derivative` has shape (width,), `times` shape (samples,), `out` shape
    (samples, width).
    """
    t, time_compensation, plan, n = times[0], 0.0, control.plan, motion.degrees
    outcome = begin(motion, plan, watch, t, series.old, derivative, out)
    row, piece, filled, steps, rejected = runtime_int(0), runtime_int(0), runtime_int(1), runtime_int(0), runtime_int(0)
    is_known, least, near = False, np.inf, control.largest_step
    fixed, evaluations = 0 if control.tolerance > 0.0 else 1, runtime_int(1)
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        piece, t, jumped = enter_piece(plan, piece, t)
        if jumped:
            time_compensation, is_known = 0.0, False
            record(plan, t, series.old)
        if outcome == FINE and not is_known:
            outcome = expand(series, row, t, series.old, motion, near)
            evaluations += series.order
        if outcome != FINE:
            break
        step, is_known = choose_step(series, row, control, piece, t, least, n), True
        outcome, defect = try_step(series, row, t, step, motion)
        evaluations += series.order
        if is_refused(control, outcome, defect, step.size, least):
            rejected += 1
            least = SHORTER * step.size
            outcome = retried(control, t, least, outcome)
            continue
        if outcome != FINE:
            break
        held = detect_hold(motion, watch.switch, t, step.size, fixed, series.old, series.new)
        if is_held_before(watch.switch, t + step.size, held):
            outcome = held
            break
        filled = sample_series(series, row, t, step.size, times, out, filled)
        outcome = watch_series(series, row, t, step.size, watch, n) or held
        accept_step(series)
        steps += 1
        near, row, least = step.size, 1 - row, np.inf
        t, time_compensation = advance_time(plan, piece, t, near, time_compensation, 1 if step.ends_piece else 0)
        record(plan, t, series.old)
    if outcome == STEP_UNDERFLOW:
        reach = AHEAD * control.largest_step
        outcome = held_or_failed(motion, watch.switch, t, reach, series.old, derivative, outcome)
    return Result(outcome, filled, steps, rejected, evaluations, watch.switch.when[0] if outcome == HELD else t)
