"""A cloud of runs from starts within a tolerance, and how far it is spread.

Run by run it is compared with what linear propagation makes of the same start, so that no chance is in the comparison.
The standard deviation has an interval that holds for any distribution with four moments.
Source: D. G. Bonett, Computational Statistics & Data Analysis 50 (2006) 775–782.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..simulation.ensemble import Ensemble, EnsembleMotion, run_ensemble
from ..simulation.march import Integers, Truths
from ..simulation.problem import Floats, Problem
from .propagation import Propagation

CONFIDENCE, QUANTILE = 0.95, 1.959963984540054  # of the standard normal distribution, for both sides
LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
LINEAR = 0.3  # what linear propagation may leave of the deviations: the spread is wrong by some 5 % then
COUNTS = 0.1  # of the spread: an error of integration that counts
FEWEST = 20  # runs, for a spread
BESIDE = 5  # samples to each side, over which that is looked at
NOISE = 4.0  # times the error of integration: what is not more is no deviation from anything


@dataclass(frozen=True)
class Cloud:
    """Starts and parameters of the runs as `deviations` of (q, q̇, p), shape (runs, quantities), and what came of them.

    `values` and `rates`, shape (runs, samples, n), are NaN behind the end of a run; `errors` are those of the values.
    """

    deviations: Floats
    values: Floats
    rates: Floats
    errors: Floats
    statuses: tuple[str, ...]

    @property
    def reached(self) -> Integers:
        """How many runs have come to each sample, shape (samples,)."""
        return np.asarray(np.isfinite(self.values).all(axis=2).sum(axis=0))


def drawn(sizes: Floats, runs: int, seed: int, *, is_normal: bool) -> Floats:
    """Deviations, shape (runs, quantities), by the standard deviations or half widths `sizes`, shape (quantities,).

    Each quantity has random numbers of its own: what else is uncertain does not change them.
    """
    columns = []
    for place, size in enumerate(sizes.tolist()):
        random = np.random.default_rng([seed, place])
        columns.append(size * (random.normal(size=runs) if is_normal else random.uniform(-1.0, 1.0, runs)))
    return np.ascontiguousarray(np.column_stack(columns))


def flown(problem: Problem, deviations: Floats, tolerance: float, together: int) -> Iterator[Cloud]:
    """The cloud as it grows by so many runs; `deviations` has shape (runs, quantities)."""
    start = np.array([*problem.values, *problem.rates, *problem.parameters])
    split, found = 2 * problem.degrees, list[EnsembleMotion]()
    for first in range(0, len(deviations), together):
        rows = start + deviations[first : first + together]
        ensemble = Ensemble(problem, np.ascontiguousarray(rows[:, :split]), np.ascontiguousarray(rows[:, split:]))
        found.append(run_ensemble(ensemble, tolerance))
        values, rates, errors = (
            np.concatenate([getattr(one, n) for one in found]) for n in ("values", "rates", "errors")
        )
        statuses = tuple(outcome.status for one in found for outcome in one.outcomes)
        yield Cloud(deviations[: first + together], values, rates, errors, statuses)


@dataclass(frozen=True)
class Spread:
    """Of one coordinate at all samples: what the cloud and the linear propagation say.

    `mean`, `deviation`, its interval from `low` to `high`, its `linear` prediction, the `nonlinearity` that this leaves
    and the `error` of integration have shape (samples,), `quantiles` (levels, samples). `size`, shape (samples,), is
    the spread of the cloud in phase space, in the unit of the coordinate, which does not vanish where the motions meet.
    """

    mean: Floats
    deviation: Floats
    low: Floats
    high: Floats
    quantiles: Floats
    size: Floats
    linear: Floats
    nonlinearity: Floats
    error: Floats


def spread(cloud: Cloud, flow: Propagation, places: Integers, sigmas: Floats, coordinate: int) -> Spread:
    """The spread of a coordinate; `places` are those of the columns of D among all quantities.

    `sigmas` are the standard deviations of these; both have shape (2n + parameters,).
    """
    n, samples = cloud.values.shape[2], len(flow.times)
    both = (cloud.values[:, :samples, coordinate], coordinate), (cloud.rates[:, :samples, coordinate], n + coordinate)
    (mean, deviation, low, high), of_rate = deviations_of(both[0][0]), np.nanstd(both[1][0], axis=0, ddof=1)
    pace = min(_pace(deviation, of_rate), float(flow.times[-1]))
    unlike = [
        np.sqrt(np.nanmean((seen - flow.states[:, row] - flow.carried(cloud.deviations[:, places], row)) ** 2, axis=0))
        for seen, row in both
    ]
    linear = [np.sqrt(flow.variances(sigmas, row).sum(axis=1)) for _, row in both]
    error = np.nanmedian(cloud.errors[:, :samples, coordinate], axis=0)
    left, carried = (_nearby(np.hypot(one[0], pace * one[1])) for one in (unlike, linear))
    with np.errstate(invalid="ignore", divide="ignore"):
        nonlinearity = np.where(left <= NOISE * error, 0.0, left / carried)
    quantiles = np.nanquantile(both[0][0], LEVELS, axis=0)
    size = np.hypot(deviation, pace * of_rate)
    return Spread(mean, deviation, low, high, quantiles, size, linear[0], nonlinearity, error)


def _nearby(sizes: Floats) -> Floats:
    """Root mean square over the samples beside each: where the motions meet for a moment, little is spread at all."""
    beside, own = np.ones(2 * BESIDE + 1), slice(BESIDE, BESIDE + len(sizes))
    # Not `mode="same"`, which gives as many as the longer of both has.
    total, count = (np.convolve(one, beside)[own] for one in (sizes**2, np.ones_like(sizes)))
    return np.asarray(np.sqrt(total / count))


def _pace(values: Floats, rates: Floats) -> float:
    """The time by which a rate is to be multiplied to be as large as its coordinate."""
    with np.errstate(invalid="ignore", divide="ignore"):
        found = values / rates
    known = found[np.isfinite(found) & (found > 0.0)]
    return float(np.median(known)) if len(known) else 0.0


def deviations_of(values: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Mean and standard deviation of the rows that are numbers, and the interval of the latter; shape (samples,) each.

    `values` has shape (runs, samples).
    """
    count = np.isfinite(values).sum(axis=0).astype(np.float64)
    mean, deviation = np.nanmean(values, axis=0), np.nanstd(values, axis=0, ddof=1)
    centre = _trimmed(values, count)
    with np.errstate(invalid="ignore", divide="ignore"):
        fourth = np.nansum((values - centre) ** 4, axis=0)
        second = np.nansum((values - mean) ** 2, axis=0)
        kurtosis = np.where(second > 0.0, count * fourth / second**2, 3.0)
        factor = count / (count - QUANTILE)
        error = factor * np.sqrt(np.maximum(kurtosis - (count - 3.0) / count, 0.0) / (count - 1.0))
    low, high = (deviation * np.sqrt(factor * np.exp(sign * QUANTILE * error)) for sign in (-1.0, 1.0))
    return mean, deviation, low, high


def _trimmed(values: Floats, count: Floats) -> Floats:
    """The mean without the outer 1/(2 √(n − 4)) on each side, shape (samples,)."""
    ordered = np.sort(values, axis=0)  # NaN last
    cut = np.floor(count * 0.5 / np.sqrt(np.maximum(count - 4.0, 1.0)))
    rank = np.arange(len(values))[:, None]
    inner = (rank >= cut) & (rank < count - cut)
    return np.asarray(np.where(inner, ordered, 0.0).sum(axis=0) / np.maximum(inner.sum(axis=0), 1))


def usable(cloud: Cloud, flow: Propagation) -> int:
    """The number of samples to which the nominal motion and enough of the runs have come."""
    enough = cloud.reached >= max(FEWEST, 0.5 * len(cloud.values))
    return min(int(enough.cumprod().sum()), len(flow.times))


def first_above(times: Floats, values: Floats, bound: float | Floats) -> float | None:
    """The first time at which values exceed a bound, between two samples linearly; None if they never do.

    `times`, `values` and the bound, if it is no number, have shape (samples,).
    """
    with np.errstate(invalid="ignore"):
        excess = np.nan_to_num(values - bound, nan=-np.inf)
    above: Truths = excess > 0.0
    if not above.any():
        return None
    last = int(np.argmax(above))
    before, now = (excess[last - 1] if last else 0.0), excess[last]
    if last == 0 or not np.isfinite(before) or now == before:
        return float(times[last])
    return float(times[last - 1] + (times[last] - times[last - 1]) * -before / (now - before))


def shortened(flow: Propagation, samples: int) -> Propagation:
    """The first samples."""
    return replace(flow, times=flow.times[:samples], states=flow.states[:samples], matrices=flow.matrices[:samples])
