"""Where a motion runs into a state at which its coordinates fail, and whether it is determined beyond.

M(q) has no inverse there. At the pole of a sphere only the azimuth jumps, and the motion in space goes on; where a mass
is pulled into the centre of polar coordinates on a pulley, whatever misses the centre by ever so little is thrown back,
and the motion that meets it has no continuation. What tells the two apart is whether motions that pass by at ever
smaller distances come to lie where the motion does: it then depends continuously on its start, as all else does.
Source: Arnold, Ordinary Differential Equations, §7 (continuous dependence); Tufillaro, Abbott, Griffiths, Am. J. Phys.
52 (1984) 895 (the collisions of the swinging Atwood machine).
"""

from __future__ import annotations

import numpy as np

from ...simulation.derivatives import accelerations
from ...simulation.problem import Floats, Problem
from .distance import Yardstick

SHALLOW = 1e-2  # of the usual smallest eigenvalue of M: lower ones are looked at closely
SINGULAR = 1e-10  # of the largest: what rounding leaves of an eigenvalue that is zero
ZOOMS, POINTS = 4, 33
AROUND = 5  # samples before and after a passage that the motions beside it are followed for
BESIDE = (0.1, 0.02)  # by how much these pass by, as parts of the way around
STEPS = 2000
STAYS = 0.5  # of how far the wide one is off: a narrow one that is as far off does not come back to the motion
LEAST = 1e-3  # of the way: less apart than that is together


def determined_until(full: Yardstick) -> float:
    """The time in seconds at which the motion stops to depend continuously on its start; infinite if it never does."""
    times = _passages(full)
    return float(np.min(times[~_goes_on(full, times)], initial=np.inf)) if len(times) else np.inf


def _passages(full: Yardstick) -> Floats:
    """The times at which M is singular along the motion, between its samples too."""
    if len(full.times) < 2 * AROUND or full.problem.is_constrained:  # there the run itself ends, and says why
        return np.zeros(0)
    low = _smallest(full, full.times, full.states)
    inner = (low[1:-1] <= low[:-2]) & (low[1:-1] <= low[2:]) & (low[1:-1] < SHALLOW * np.median(low))
    centres = full.times[1:-1][inner]
    if not len(centres):
        return centres
    reach = full.times[1] - full.times[0]
    for _ in range(ZOOMS):
        around = centres[:, None] + reach * np.linspace(-1.0, 1.0, POINTS)
        deep = _smallest(full, around.ravel(), _between(full, around.ravel())).reshape(around.shape)
        centres = around[np.arange(len(centres)), deep.argmin(axis=1)]
        reach *= 2.0 / (POINTS - 1)
    return np.asarray(centres[deep.min(axis=1) <= SINGULAR * low.max()])


def _smallest(full: Yardstick, times: Floats, states: Floats) -> Floats:
    """The smallest eigenvalue of M in the natural units of the coordinates, those of the largest entries met."""
    masses = full.problem.system(times, states).mass
    sizes = np.sqrt(np.maximum(np.einsum("tii->ti", full.masses).max(axis=0), 1e-300))
    return np.asarray(np.linalg.eigvalsh(masses / np.outer(sizes, sizes))[:, 0])


def _between(full: Yardstick, times: Floats) -> Floats:
    """States between samples: q by Hermite's cubic polynomials, q̇ by straight lines."""
    n = full.problem.degrees
    step = full.times[1] - full.times[0]
    left = np.clip(np.searchsorted(full.times, times, side="right") - 1, 0, len(full.times) - 2)
    s = ((times - full.times[left]) / step)[:, None]
    one, other = full.states[left], full.states[left + 1]
    q = (1 - s) ** 2 * ((1 + 2 * s) * one[:, :n] + step * s * one[:, n : 2 * n])
    q += s**2 * ((3 - 2 * s) * other[:, :n] + step * (s - 1) * other[:, n : 2 * n])
    return np.hstack([q, (1 - s) * one[:, n : 2 * n] + s * other[:, n : 2 * n]])


def _goes_on(full: Yardstick, times: Floats) -> np.ndarray:
    """For each passage, whether motions that pass by beside it end up the nearer to it, the nearer they pass."""
    places = np.searchsorted(full.times, times)
    first, last = np.maximum(0, places - AROUND), np.minimum(len(full.times) - 1, places + AROUND)
    ways = full.lengths(full.values[last] - full.values[first], first)
    wide, narrow = (_apart(full, first, last, part * ways) for part in BESIDE)
    return np.asarray(narrow <= np.maximum(STAYS * wide, LEAST * ways))


def _apart(full: Yardstick, first: np.ndarray, last: np.ndarray, beside: Floats) -> Floats:
    """How far two motions that begin that far beside it, one to either side, are off in the end; the farther one's."""
    n, begin, end = full.problem.degrees, full.times[first], full.times[last]
    steps = full.steps(beside, first)
    aside = np.hstack([steps, steps / (end - begin)[:, None]])
    here = full.states[first, : 2 * n]
    ends = (_followed(full.problem, begin, end, here + sign * aside)[:, :n] for sign in (1.0, -1.0))
    return np.asarray(np.max([full.at(last).distances(each) for each in ends], axis=0))


def _followed(problem: Problem, begin: Floats, end: Floats, states: Floats) -> Floats:
    """Where motions get to, each from its own time to another: the classical method of order 4, all at once."""
    step, n = (end - begin)[:, None] / STEPS, problem.degrees

    def rhs(times: Floats, rows: Floats) -> Floats:
        return np.hstack([rows[:, n:], accelerations(problem, times, rows)])

    for k in range(STEPS):
        time = begin + k * step[:, 0]
        middle = time + step[:, 0] / 2.0
        k1 = rhs(time, states)
        k2 = rhs(middle, states + step / 2.0 * k1)
        k3 = rhs(middle, states + step / 2.0 * k2)
        k4 = rhs(time + step[:, 0], states + step * k3)
        states = states + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return states
