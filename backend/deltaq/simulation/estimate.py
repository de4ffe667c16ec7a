"""How wrong a computed motion is: two runs of unlike fineness, compared.

The difference of two runs, taken as it is, says too little where a motion turns back: there even a wrong phase gives
the right value. So coordinates and rates are compared together, |Δq|² + τ²|Δq̇|², with the coordinate's own time scale
τ (from root mean squares), as far as the differences nearby bear it out. Neighbouring samples share their largest one.

Arrays have a row for each coordinate (and rate), and a column for each sample: they are looked through along samples.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..model.model import DISTURBANCE
from .derivatives import accelerations
from .event import Approach, EventOccurrence, event_values
from .held_at_rest import held_at_rest
from .held_rounding import held_rounding
from .problem import Floats, Problem, Stretch
from .reactions import reactions_along
from .run import Run
from .stiffness import NUDGE

# Neighbourhoods as parts of all samples to each side, and what counts of the wider one.
NEAR, FAR, SHARE = 160, 10, 0.5
SLOPES = 160  # samples at which the slopes of multipliers are taken
ANYWHERE = 0.1  # what counts of the largest before and behind, wherever it is
TURNING = 4.0  # times the largest difference nearby: more than that no phase hides where a motion turns back
ROUNDING, EPSILON = 4e-16, 2.0**-52
OF_STATE = 4.0 * EPSILON  # of a coordinate or rate: its rounding where λ is computed from it
STOPS = 1.5  # times the difference of two stops
OF_TERMS = 3.2e-15  # of the largest multiplier: rounding errors of the terms that each is the difference of
CLOSE = 3e-14  # so much of a difference may be one of rounding errors, which are no smaller in the finer run
MATTERS = 0.05  # of the estimate: rounding that could be more is looked at
LINEAR = 0.1  # of the size of a coordinate: differences up to that are proportional to errors
PROPORTIONAL = 0.02  # the same of a run that a much finer one is held against
LOST = 0.5  # an error this large, relative to the size of the coordinate, leaves no digit
UNKNOWN = 1e300  # for an error that is no number; with room for sums


@dataclass(frozen=True)
class Estimate:
    """`errors[i]`, shape (samples,), estimates the largest error of any coordinate at times[i].

    After `horizon` seconds no digit is left; None if that is never so. `worst` is the largest error in the measure of a
    tolerance: absolute below 1 and relative above. `event` is the error of the time of the event that ended both runs;
    the last of `errors` is that of the state then. `doubtful` is an event that may have happened or not, as far as the
    errors tell. `stop` is the error of where friction holds the motion. `multipliers`, shape (samples, m), are the
    errors of the multipliers of constraints, where there are any. `scales` are the time scales τ of the coordinates,
    shape (n, 1), None where they are not those of the whole finer run.
    """

    errors: Floats
    worst: float
    horizon: float | None
    event: float | None = None
    stop: float = 0.0
    doubtful: EventOccurrence | None = None
    multipliers: Floats | None = None
    scales: Floats | None = None


def estimate(problem: Problem, coarse: Run, fine: Run, factor: float) -> Estimate:
    """The error of one of two runs, from `factor` times their difference over the samples that both have.

    Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4 (Richardson extrapolation).
    """
    n = problem.degrees
    times, states, others = _together(problem, coarse, fine)
    difference, scales = np.abs(others - states), _time_scales(problem, times, states)
    together = np.hypot(difference[:n], scales * difference[n : 2 * n])
    together = np.minimum(together, TURNING * _largest_within(difference[:n], max(2, len(times) // FAR)))
    factors = _factors(problem, factor, difference[:n], np.abs(states[:n]))
    differences = np.vstack([together, difference[n : 2 * n]])
    spread = _spread(factors * differences + np.minimum(differences, CLOSE))
    floor, sizes = _rounding_floor(problem, times, fine), np.abs(states[:n])
    ones = np.maximum(1.0, sizes)
    errors = _known(np.maximum(spread[:n], floor * ones))
    at_rest = held_at_rest(problem, fine.meshes, states[:n])  # of which what they are moved by is the error
    errors[at_rest] = np.maximum(errors[at_rest], np.abs(states[:n] - states[:n, :1])[at_rest])
    moving, held = np.where(at_rest[:, None], 0.0, sizes), held_rounding(problem, times, states.T)
    horizon = _horizon(problem, times, errors, moving, np.maximum(floor, held))
    if horizon is not None:
        # Beyond the horizon both runs are wrong, and their difference may shrink by chance.
        late = times >= horizon
        errors[:, late] = 2.0 * np.maximum.accumulate(errors[:, late], axis=1)
    stop = _of_stop(problem, coarse, fine, factor)
    worst = max(float(np.max(errors / ones)), stop)
    doubts = np.vstack([errors, np.maximum(spread[n:], floor)])
    of_event = _of_event(problem, coarse, fine, factor, doubts[:, -1])
    doubtful = _doubtful(problem, coarse, fine, times, doubts)
    reactions = _of_multipliers(problem, coarse, fine, difference[: 2 * n], factors)
    of_all = scales if len(times) == len(fine.times) else None
    return Estimate(errors.max(axis=0), worst, horizon, of_event, stop, doubtful, reactions, of_all)


def says_more(problem: Problem, coarse: Run, fine: Run, factor: float, known: Estimate) -> bool:
    """Whether `factor` times the difference to a much coarser run is more than the error known, at some sample.

    Not where that run is so far off that the errors of both may not be proportional.
    """
    count, n = min(len(coarse.times), len(fine.times), len(known.errors)), problem.degrees
    states = fine.states[:count, :n].T
    off = np.abs(coarse.states[:count, :n].T - states)
    is_near = (off <= PROPORTIONAL * _sizes(problem, np.abs(states))).all() if count else False
    return bool(is_near and (factor * off.max(axis=0) > known.errors[:count]).any())


def larger(one: Estimate, other: Estimate) -> Estimate:
    """The sample-wise maximum of two estimates of the same motion."""
    count = min(len(one.errors), len(other.errors))
    errors = one.errors.copy()
    errors[:count] = np.maximum(errors[:count], other.errors[:count])
    horizons = [each for each in (one.horizon, other.horizon) if each is not None]
    worst, stop = max(one.worst, other.worst), max(one.stop, other.stop)
    reactions = one.multipliers
    if reactions is not None and other.multipliers is not None:
        reactions = reactions.copy()
        both = min(len(reactions), len(other.multipliers))
        reactions[:both] = np.maximum(reactions[:both], other.multipliers[:both])
    return replace(
        one, errors=errors, worst=worst, stop=stop, horizon=min(horizons, default=None), multipliers=reactions
    )


def rounding_matters(problem: Problem, fine: Run, found: Estimate) -> bool:
    """Whether ε · (condition of M) · (radians of the motion) · |q| is comparable to the estimate.

    Rounded entries of M and f change q̈ by up to ε times the condition; the motion adds this up over its radians, and
    what impacts do to its rates over their number.
    """
    times, states = fine.times, fine.states.T
    if len(times) < 2 or not fine.conditioning > 0.0:
        return False
    scales = _time_scales(problem, times, states) if found.scales is None else found.scales
    times_added = max((1.0, float(len(fine.transitions)), *(problem.t_end / scales[scales > 0.0])))
    sizes = np.abs(states[: problem.degrees])
    share = np.max(sizes / np.maximum(1.0, sizes))
    return bool(EPSILON / fine.conditioning * times_added * share > MATTERS * found.worst)


def with_rounding(problem: Problem, found: Estimate, fine: Run, other: Run) -> Estimate:
    """The estimate, no smaller than the effect of rounding: the effect of a disturbed model, scaled down to ε."""
    count = min(len(found.errors), len(other.times), len(fine.times))
    moved = np.abs(other.states[:count, : problem.degrees] - fine.states[:count, : problem.degrees]).T
    floor = _known(6.0 * EPSILON / DISTURBANCE * _spread(moved))
    errors = found.errors.copy()
    errors[:count] = np.maximum(errors[:count], floor.max(axis=0))
    ones = np.maximum(1.0, np.abs(fine.states[:count, : problem.degrees].T))
    worst, reactions = max(found.worst, float(np.max(floor / ones))), found.multipliers
    if reactions is not None and other.reactions is not None and fine.reactions is not None:
        apart = np.abs(other.reactions.multipliers[:count] - fine.reactions.multipliers[:count]).T
        reactions = reactions.copy()
        reactions[:count] = np.maximum(reactions[:count], _known(6.0 * EPSILON / DISTURBANCE * _spread(apart)).T)
    return replace(found, errors=errors, worst=worst, multipliers=reactions)


def _of_multipliers(problem: Problem, coarse: Run, fine: Run, difference: Floats, factors: Floats) -> Floats | None:
    """The error of each multiplier, shape (samples, m); None where there are none.

    λ follows from q and q̇ without any integration: its error is Σ |∂λ/∂y| times theirs, by the `difference` of both
    runs, shape (2n, samples), and the `factors`, shape (samples,).
    Where λ peaks, as in a rod that whips round, it may be a hundred times what it is in between, so that a difference
    of two λ spread over a neighbourhood would say too much there; but no sum says more than the largest difference
    nearby bears out, for λ may not depend on what is wrong, such as a direction. Rounding is that of the state, and of
    the terms that λ is left of, about as large as the largest one.
    """
    if fine.reactions is None or coarse.reactions is None:
        return None
    found, other = fine.reactions.multipliers.T, coarse.reactions.multipliers.T
    doubts = _spread(factors * difference + np.minimum(difference, CLOSE))
    count = min(found.shape[1], other.shape[1], doubts.shape[1])
    found, other = found[:, :count], other[:, :count]
    largest = np.abs(found).max(axis=1, initial=0.0)[:, None]
    rounding = OF_TERMS * largest / np.sqrt(fine.conditioning) if fine.conditioning > 0.0 else np.inf
    slopes, apart = _slopes(problem, fine, count), np.abs(other - found)
    doubts = _not_faded(doubts[:, :count])
    reach = max(2, count // FAR)
    differences = factors[:count] * apart + np.minimum(apart, CLOSE * largest)
    differences = _faded_with(differences, _largest_within(np.abs(found), reach))
    errors = np.minimum(_summed(slopes, doubts), TURNING * _largest_within(differences, reach))
    own = _summed(slopes, OF_STATE * np.abs(fine.states[:count, : doubts.shape[0]].T))
    return _known(np.maximum(errors, np.maximum(own, rounding))).T


def _not_faded(errors: Floats) -> Floats:
    """Errors no smaller than a share of the largest before, in each row: shape (rows, samples).

    Towards the end, where nothing larger follows, both runs may come through zero, and that tells of no small error.
    """
    return np.asarray(np.maximum(errors, ANYWHERE * np.maximum.accumulate(errors, axis=1)))


def _faded_with(errors: Floats, sizes: Floats) -> Floats:
    """The same, but where a value itself fades away, its error does as well: the share is of relative errors, too.

    `errors` and the `sizes` nearby have shape (rows, samples).
    """
    relative = np.divide(errors, sizes, out=np.zeros_like(errors), where=sizes > 0.0)
    ever, ever_relative = np.maximum.accumulate(errors, axis=1), np.maximum.accumulate(relative, axis=1)
    return np.asarray(np.maximum(errors, ANYWHERE * np.minimum(ever, ever_relative * sizes)))


def _slopes(problem: Problem, fine: Run, count: int) -> Floats:
    """|∂λ/∂y| of y = (q, q̇) kept on the constraints: shape (2n, count, m); infinite where there is no λ.

    They are taken at some of the samples, and hold for those around.
    """
    width, stride = 2 * problem.degrees, max(1, count // SLOPES)
    chosen = np.arange(0, count, stride)
    times, states = fine.times[chosen], fine.states[chosen]
    steps = NUDGE * np.maximum(1.0, np.abs(states[:, :width]).max(axis=0))
    rows = np.tile(states, (width + 1, 1)).reshape(width + 1, *states.shape)
    rows[np.arange(width) + 1, :, np.arange(width)] += steps[:, None]
    stretches = tuple(Stretch(each.start, each.problem) for each in fine.meshes)  # each in its mode
    every = np.tile(times, width + 1), rows.reshape(-1, states.shape[1])
    found, reactions = reactions_along(problem, *every, stretches)
    if len(found) < rows.shape[0] * rows.shape[1]:
        return np.full((width, count, reactions.multipliers.shape[1]), np.inf)
    table = reactions.multipliers.reshape(width + 1, len(chosen), -1)
    slopes = np.abs(table[1:] - table[0]) / steps[:, None, None]
    slopes = np.maximum(slopes, np.roll(slopes, -1, axis=1)) if len(chosen) > 1 else slopes
    near = np.minimum(np.arange(count) // stride, len(chosen) - 1)
    return np.asarray(slopes[:, near])


def _summed(slopes: Floats, doubts: Floats) -> Floats:
    """Σ |∂λ/∂y| times the errors of y: shape (m, count)."""
    return np.asarray(np.einsum("kts,kt->st", slopes, doubts[:, : slopes.shape[1]]))


def _together(problem: Problem, coarse: Run, fine: Run) -> tuple[Floats, Floats, Floats]:
    """Times and states (fine, coarse) of the samples that both runs have, and of the event if both ended with one.

    The coarse run's state is carried over to the fine one's time of the event.
    """
    count, n = min(len(coarse.times), len(fine.times)), problem.degrees
    times, states, others = fine.times[:count], fine.states[:count].T.copy(), coarse.states[:count].T.copy()
    if fine.event is None or coarse.event is None:
        return times, states, others
    at, late = np.array([fine.event.time]), fine.event.time - coarse.event.time
    rates = np.zeros(fine.event.state.size)
    rates[:n] = fine.event.state[n : 2 * n]
    rates[n : 2 * n] = accelerations(problem, at, fine.event.state[None, :])[0]
    moved = coarse.event.state + late * rates
    return np.append(times, at), np.column_stack([states, fine.event.state]), np.column_stack([others, moved])


def _factors(problem: Problem, factor: float, difference: Floats, sizes: Floats) -> Floats:
    """The factor at each sample; 1 at least from where the coarser run is so far off that it tells nothing more."""
    is_off = (difference > LINEAR * _sizes(problem, sizes)).any(axis=0)
    return np.asarray(np.where(np.logical_or.accumulate(is_off), max(factor, 1.0), factor))


def _known(errors: Floats) -> Floats:
    """Errors that are numbers: what is none, of states near the end of all numbers, is larger than any of them."""
    return np.nan_to_num(errors, nan=UNKNOWN, posinf=UNKNOWN)


def _of_stop(problem: Problem, coarse: Run, fine: Run, factor: float) -> float:
    """The error of where friction holds the motion, by the two runs; no stop is better than of order 2."""
    if coarse.held is None or fine.held is None:
        return 0.0
    n = problem.degrees
    return max(factor, STOPS) * float(np.max(np.abs(coarse.held.state[:n] - fine.held.state[:n])))


def _of_event(problem: Problem, coarse: Run, fine: Run, factor: float, doubts: Floats) -> float | None:
    """The error of the time of an event: by the two runs' times, and by how wrong its value may be where it falls.

    `doubts` are the errors of q and q̇ at the event.
    """
    if fine.event is None or coarse.event is None:
        return None
    event = fine.event
    doubt = _doubt(problem, event.index, event.time, event.state, doubts)
    apart = factor * abs(event.time - coarse.event.time)
    rounding = ROUNDING * float(np.sqrt(1.0 + fine.result.steps)) * event.time
    return max(apart, event.late_by(doubt)) + rounding


def _doubtful(problem: Problem, coarse: Run, fine: Run, times: Floats, doubts: Floats) -> EventOccurrence | None:
    """The first event that only one run met, or whose value came closer to zero than it is known."""
    met = [run.event for run in (fine, coarse) if run.event]
    if met:
        event = met[0]
        doubt = _doubt(problem, event.index, event.time, event.state, doubts[:, -1])
        is_sure = len(met) == 2 and not event.may_not_be(doubt)
        return None if is_sure else EventOccurrence(event.index, event.time, None)

    def is_close(a: Approach) -> bool:
        row = min(int(np.searchsorted(times, a.time)), len(times) - 1)
        return a.value <= _doubt(problem, a.index, a.time, a.state, doubts[:, row])

    close = [EventOccurrence(a.index, a.time, None) for a in fine.approaches if is_close(a)]
    return min(close, key=lambda occurrence: occurrence.time, default=None)


def _doubt(problem: Problem, index: int, time: float, state: Floats, doubts: Floats) -> float:
    """How wrong an event's value may be: Σ |∂g/∂y| times the errors of y = (q, q̇)."""
    width = doubts.size
    nudges = NUDGE * np.maximum(1.0, np.abs(state[:width])) * np.eye(width)
    rows = np.vstack([state[:width] + nudges, state[:width] - nudges])
    values = event_values(problem, np.full(len(rows), time), rows)[:, index]
    return float(np.abs((values[:width] - values[width:]) / (2.0 * nudges.diagonal())) @ doubts)


def _rounding_floor(problem: Problem, times: Floats, fine: Run) -> Floats:
    """The rounding floor ε√steps, shape (samples,): one rounding error for each step adds up as a random walk."""
    return np.asarray(ROUNDING * np.sqrt(1.0 + fine.result.steps * times / problem.t_end))


def _time_scales(problem: Problem, times: Floats, states: Floats) -> Floats:
    """τ of each coordinate, from root mean squares without drift: rate over acceleration, or value over rate.

    Where a fast motion rides on a slow one, the former is the scale of the fast and the latter that of the slow.
    """
    n, rates = problem.degrees, states[problem.degrees : 2 * problem.degrees]
    drift = rates.mean(axis=1, keepdims=True)
    swing = states[:n] - drift * times
    bends = accelerations(problem, times, states.T).T
    value, rate, bend = (_size(x) for x in (swing - swing.mean(axis=1, keepdims=True), rates - drift, bends))
    fast = np.divide(rate, bend, out=np.zeros((n, 1)), where=bend > 0)
    slow = np.divide(value, rate, out=np.zeros((n, 1)), where=rate > 0)
    return np.asarray(np.minimum(np.maximum(fast, slow), problem.t_end))


def _size(values: Floats) -> Floats:
    """Root mean square of each row."""
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", values, values) / values.shape[1])[:, None])


def _spread(errors: Floats) -> Floats:
    """Each sample takes the largest error nearby, and a share of the largest in a wider neighbourhood.

    The first keeps its own, which is exact.
    """
    near = _largest_within(errors, max(2, errors.shape[1] // NEAR))
    before, behind = _largest_beside(errors, max(2, errors.shape[1] // FAR))
    ever, later = np.maximum.accumulate(errors, axis=1), np.maximum.accumulate(errors[:, ::-1], axis=1)[:, ::-1]
    spread = np.maximum(near, SHARE * np.minimum(before, behind))
    spread = np.maximum(spread, ANYWHERE * np.minimum(ever, later))
    spread[:, 0] = errors[:, 0]
    return spread


def _largest_beside(errors: Floats, reach: int) -> tuple[Floats, Floats]:
    """The largest value up to `reach` samples before each, and behind; next to an end, where few are left, of both."""
    count = errors.shape[1]
    window = np.zeros((len(errors), count + 2 * reach))
    window[:, reach:-reach] = errors
    sides = _windowed(window, reach + 1)
    before, behind = sides[:, :count].copy(), sides[:, reach : reach + count].copy()
    half = reach // 2
    before[:, :half] = np.maximum(before[:, :half], behind[:, :half])
    behind[:, -half:] = np.maximum(before[:, -half:], behind[:, -half:])
    return before, behind


def _largest_within(errors: Floats, reach: int) -> Floats:
    """The largest value up to `reach` samples away, by windows that double."""
    window = np.zeros((len(errors), errors.shape[1] + 2 * reach))
    window[:, reach:-reach] = errors
    return _windowed(window, 2 * reach + 1)


def _windowed(window: Floats, width: int) -> Floats:
    """The largest of each `width` values that follow one another."""
    size = 1
    while 2 * size <= width:
        window = np.maximum(window[:, :-size], window[:, size:])
        size *= 2
    rest = width - size
    return np.asarray(np.maximum(window[:, : window.shape[1] - rest], window[:, rest:]))


def _horizon(problem: Problem, times: Floats, errors: Floats, sizes: Floats, floor: Floats) -> float | None:
    """The first time at which the error of a coordinate is as large as the coordinate, or a sizeable angle.

    A coordinate that never exceeds the floor of rounding, shape (n or 1, samples), is zero: nothing of it can be lost.
    """
    scale = _sizes(problem, sizes)
    lost = ((errors >= LOST * scale) & (scale > floor)).any(axis=0)
    return float(times[np.argmax(lost)]) if lost.any() else None


def _sizes(problem: Problem, sizes: Floats) -> Floats:
    """How large each coordinate becomes; of an angle no more than a radian counts."""
    largest = sizes.max(axis=1)
    angular = np.array(problem.angular or (False,) * problem.degrees)
    return np.asarray(np.where(angular, np.minimum(largest, 1.0), largest)[:, None])
