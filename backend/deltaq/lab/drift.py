"""How far the energy balance E + V − ∫P dt of a run departs from its start, how that grows, and what is left of it.

Growth is judged together with the size: an error as large as the energy is lost, however little it grows from there on.
Symplectic methods keep the error in a band over very long times; others drift, mostly in proportion to the time.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, IX.8.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from ..contract.experiments.energy_drift import DriftVerdict as Kind
from ..simulation.library import get_method
from ..simulation.problem import Floats, Problem
from ..simulation.reference import require_motion
from ..simulation.run import Run, Steps
from ..simulation.run import run as run_once

WINDOWS, IN_WINDOW = 120, 80
EARLIEST = 1e-4  # of the span: where the logarithmic axis begins
FEWEST, BLOCKS = 8, 6  # windows for a fit; blocks of them that are left out in turn for its interval
MOST = 1e99  # of the energy: what is told of an error that is no number
LOST = 0.3  # of the energy: an error this large leaves nothing of its balance
EPSILON, WALK = 2.3e-16, 10.0  # rounding of one step in parts of the energy, and how far its random walk may go
BIASED = 5.0  # times EPSILON and the steps: rounding that always goes one way, as that of Newton's iteration
FLAT = 0.25  # a power whose interval reaches down to it may be none
BAND = 1.5  # the last decade of a band is at most so many times as wide as the one before
DRIFTS, CLEAR = 0.25, 0.9  # a trend beneath a band: its part of the band, and how much of the means it must explain
UNLIKE = 0.4  # its halves may differ from it by that part; those of a slow beat differ more
LINEAR = (0.8, 1.25)  # powers of the time


@dataclass(frozen=True)
class Growth:
    """p of error ∝ t^p, with an interval of about 95 %."""

    power: float
    lower: float
    upper: float


@dataclass(frozen=True)
class Departure:
    """The departure in each stretch of time, in parts of the energy, by the end of the stretch.

    `times` (ends, in seconds), `errors` (the largest absolute ones) and `means` (the mean signed ones) have shape
    (stretches,); `steps` is how many steps were taken.
    """

    times: Floats
    errors: Floats
    means: Floats
    steps: int = 0

    @property
    def largest(self) -> float:
        """The largest error; infinite where one is not a number."""
        return float(np.nan_to_num(self.errors, nan=np.inf).max(initial=0.0))

    @cached_property
    def before_loss(self) -> int:
        """How many stretches there are before the energy is lost."""
        return int((np.nan_to_num(self.errors, nan=np.inf) <= LOST).cumprod().sum())

    @property
    def lost_at(self) -> float | None:
        """When the energy was lost; None if it never was."""
        return float(self.times[self.before_loss]) if self.before_loss < self.times.size else None

    @property
    def kind(self) -> Kind:
        """The verdict, by size first."""
        if self.lost_at is not None:
            return Kind.LOST
        if self.largest <= EPSILON * WALK * (WALK + np.sqrt(self.steps)):
            return Kind.ROUNDING
        kind = self._growing
        is_rounding = kind != Kind.BOUNDED and self.largest <= EPSILON * BIASED * self.steps
        return Kind.ROUNDING if is_rounding else kind

    @property
    def _growing(self) -> Kind:
        """How an error grows that is no rounding: by its envelope, its power, and the trend of its means."""
        growth = self.growth
        grows = growth is not None and growth.lower > FLAT
        if self._drifts or (growth is not None and grows and LINEAR[0] <= growth.power <= LINEAR[1]):
            return Kind.LINEAR
        if grows:
            return Kind.GROWS
        return Kind.BOUNDED if self._stays else Kind.UNCLEAR

    @property
    def growth(self) -> Growth | None:
        """The power over the last decade of time before the energy is lost; None where too little shows."""
        late = self._last_decade & (self.errors > EPSILON)
        if late.sum() < FEWEST:
            return None
        logs = np.log(self.times[late]), np.log(np.maximum.accumulate(self.errors[late]))
        power, reach = _slope(*logs), _jackknife(*logs)
        return Growth(power, power - 2.0 * reach, power + 2.0 * reach)

    @property
    def _last_decade(self) -> np.ndarray:
        known = np.arange(self.times.size) < self.before_loss
        end = self.times[self.before_loss - 1] if self.before_loss else 0.0
        return np.asarray(known & (self.times > 0.1 * end))

    @property
    def _stays(self) -> bool:
        """Whether the last decade is no wider than the one before it."""
        late, end = self._last_decade, self.times[-1]
        before = (self.times > 0.01 * end) & ~late
        return bool(self.errors[late].max(initial=0.0) <= BAND * self.errors[before].max(initial=0.0))

    @property
    def _drifts(self) -> bool:
        """Whether the means follow one line over the time, early as late, that makes up a good part of the error."""
        late = self._last_decade
        if late.sum() < 2 * FEWEST:
            return False
        times, means = self.times[late], self.means[late]
        rate, total = _slope(times, means), float(np.var(means))
        explained = rate * rate * float(np.var(times)) / total if total > 0.0 else 0.0
        halves = [_slope(*half) for half in zip(np.array_split(times, 2), np.array_split(means, 2), strict=True)]
        is_one = all(abs(half - rate) < UNLIKE * abs(rate) for half in halves)
        return is_one and explained > CLEAR and abs(rate) * float(np.ptp(times)) > DRIFTS * self.largest


def _slope(x: Floats, y: Floats) -> float:
    return float(np.polyfit(x, y, 1)[0])


def _jackknife(x: Floats, y: Floats) -> float:
    """The standard error of a slope, from fits that leave out one block of neighbours in turn."""
    blocks = np.array_split(np.arange(x.size), BLOCKS)
    slopes = np.array([_slope(np.delete(x, block), np.delete(y, block)) for block in blocks])
    return float(np.sqrt((BLOCKS - 1) / BLOCKS * np.sum((slopes - slopes.mean()) ** 2)))


def sample_times(t_end: float, step: float) -> Floats:
    """Times dense at the start and out of tune with any period: shape (samples,), in seconds.

    They are whole steps, so that nothing is interpolated.
    """
    edges = _edges(t_end)
    chance = np.random.default_rng(1).uniform(size=(WINDOWS - 1, IN_WINDOW))
    times = np.sort((edges[:-1, None] + chance * np.diff(edges)[:, None]).ravel())
    whole = np.round(times / step) * step if step else times
    return np.unique(np.concatenate([[0.0], whole[whole < t_end], [t_end]]))


def departure(problem: Problem, found: Run, scale: float) -> Departure:
    """Of a run with samples at `sample_times`, in parts of the energy `scale`; at most MOST of it,
    also where the balance is no number any more.
    """
    balance = _balance(problem, found)
    off = np.clip(np.nan_to_num((balance - balance[0]) / scale, nan=MOST), -MOST, MOST)
    places = np.searchsorted(found.times, _edges(problem.t_end))
    windows = [slice(a, b) for a, b in pairwise(places) if a < b]
    ends = np.array([found.times[window.stop - 1] for window in windows])
    errors, means = (np.array([of(off[window]) for window in windows]) for of in (_largest, np.mean))
    return Departure(ends, errors, means, int(found.result.steps))


def _largest(errors: Floats) -> float:
    return float(np.abs(errors).max())


def energy_scale(problem: Problem, span: float) -> float:
    """The largest kinetic energy within a first span, by an accurate run; at rest, the potential energy or 1 J.

    Raises RequestError where it is no number.
    """
    short, times = replace(problem, t_end=span), np.linspace(0.0, span, 400)
    found = run_once(short, get_method("dop853"), times, np.zeros(1, dtype=np.int64), Steps(span / 10, 1e-9))
    seen = problem.model.observe(problem.inputs(found.times, found.states[:, : 2 * problem.degrees]))
    kinetic, potential = (float(np.abs(energy).max(initial=0.0)) for energy in (seen.kinetic, seen.potential))
    require_motion(found.times, kinetic + potential)
    return kinetic or potential or 1.0


def _edges(t_end: float) -> Floats:
    return np.asarray(np.geomspace(EARLIEST, 1.0, WINDOWS) * t_end)


def _balance(problem: Problem, found: Run) -> Floats:
    n = problem.degrees
    seen = problem.model.observe(problem.inputs(found.times, found.states[:, : 2 * n]))
    work = found.states[:, 2 * n] if found.states.shape[1] > 2 * n else 0.0
    return np.asarray(seen.kinetic + seen.potential - work)
