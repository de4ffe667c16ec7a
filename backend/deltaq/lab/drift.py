"""How far the energy balance E + V − ∫P dt of a run departs from its start, and how that grows.

Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, IX.8.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..simulation.library import get_method
from ..simulation.problem import Floats, Problem
from ..simulation.run import Run, Steps
from ..simulation.run import run as run_once
from .report import significant

WINDOWS, IN_WINDOW = 120, 80
EARLIEST = 1e-4  # of the span: where the logarithmic axis begins
SHOWS, FEWEST = 1e-15, 8


@dataclass(frozen=True)
class Departure:
    """The largest departure in each stretch of time, by the end of the stretch."""

    times: Floats
    errors: Floats

    @property
    def growth(self) -> float | None:
        """The exponent p of error ∝ t^p over the last decade of time: about 0 is bounded, 1 linear."""
        if not self.times.size:
            return None
        late = (self.times > 0.1 * self.times[-1]) & (self.errors > SHOWS) & np.isfinite(self.errors)
        if late.sum() < FEWEST:
            return None
        logs = np.log(self.times[late]), np.log(np.maximum.accumulate(self.errors[late]))
        return significant(float(np.polyfit(*logs, 1)[0]), 2)


def sample_times(t_end: float, step: float) -> Floats:
    """Times dense at the start and out of tune with any period; whole steps, so that nothing is interpolated."""
    edges = _edges(t_end)
    chance = np.random.default_rng(1).uniform(size=(WINDOWS - 1, IN_WINDOW))
    times = np.sort((edges[:-1, None] + chance * np.diff(edges)[:, None]).ravel())
    whole = np.round(times / step) * step if step else times
    return np.unique(np.concatenate([[0.0], whole[whole < t_end], [t_end]]))


def departure(problem: Problem, found: Run, scale: float) -> Departure:
    """Of a run with samples at `sample_times`, in parts of the energy `scale`."""
    balance = _balance(problem, found)
    off = np.abs(balance - balance[0]) / scale
    places = np.searchsorted(found.times, _edges(problem.t_end))
    windows = [slice(a, b) for a, b in pairwise(places) if a < b]
    ends = np.array([found.times[window.stop - 1] for window in windows])
    return Departure(ends, np.array([off[window].max() for window in windows]))


def energy_scale(problem: Problem, span: float) -> float:
    """The largest kinetic energy within a first span, by an accurate run."""
    short, times = replace(problem, t_end=span), np.linspace(0.0, span, 400)
    found = run_once(short, get_method("dop853"), times, np.zeros(1, dtype=np.int64), Steps(span / 10, 1e-9))
    seen = problem.model.observe(problem.inputs(found.times, found.states[:, : 2 * problem.degrees]))
    return float(max(seen.kinetic.max(initial=0.0), 1e-300))


def _edges(t_end: float) -> Floats:
    return np.asarray(np.geomspace(EARLIEST, 1.0, WINDOWS) * t_end)


def _balance(problem: Problem, found: Run) -> Floats:
    n = problem.degrees
    seen = problem.model.observe(problem.inputs(found.times, found.states[:, : 2 * n]))
    work = found.states[:, 2 * n] if found.states.shape[1] > 2 * n else 0.0
    return np.asarray(seen.kinetic + seen.potential - work)
