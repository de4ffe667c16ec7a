"""Limit cycles: closed orbits of motions that nothing drives, which their neighbours come to.

Where a motion has come to, it returns to the plane across its own direction after about a period T. From there Newton's
method solves φ(y, T) = y for the state and the period, with y bound to that plane, since every state of the orbit is a
solution. The Floquet multiplier 1 along the orbit is left out: the orbit attracts if all others are below 1 in size.
Source: Seydel, Practical Bifurcation and Stability Analysis, 3rd ed., §7.3, §7.4.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..simulation.derivatives import accelerations
from ..simulation.ensemble import Ensemble, run_ensemble
from ..simulation.problem import Floats, Problem
from .propagation import propagated

SAMPLES = 2001  # of a motion that is looked at for its return
POINTS = 512  # of an orbit, evenly spread over its length
RETURNED, AWAY = 0.05, 0.2  # of what the motion covers: back where it was, and how far away in between
NEWTON, SOLVED = 10, 1e-10
LONGEST = 2.0  # times the first guess of the period
ROUNDING = 1e-4  # by which the multiplier along the orbit may miss 1
BELOW = 1e-6  # 1 less a multiplier that contracts
TOLERANCE = 1e-8
Apart = Callable[[Floats, Floats], Floats]


@dataclass(frozen=True)
class LimitCycle:
    """The `states` along a closed orbit, shape (points, 2n), its `period` in seconds, and the `size` of multipliers.

    That is the largest but the one along the orbit. The first state has the largest first coordinate.
    """

    states: Floats
    period: float
    size: float


def limit_cycle(problem: Problem, start: Floats, apart: Apart) -> LimitCycle | None:
    """That near a state, shape (2n,), by the differences `apart` of states; None where none is found that attracts."""
    motion = _motion(problem, start, problem.t_end)
    if motion is None:
        return None
    period = _return(np.linspace(0.0, problem.t_end, SAMPLES), motion, apart)
    solved = None if period is None else _solved(problem, start, period, apart)
    if solved is None:
        return None
    state, period, size = solved
    orbit = _motion(problem, state, period)
    return None if orbit is None else LimitCycle(_spread(orbit, apart), period, size)


def _motion(problem: Problem, start: Floats, span: float) -> Floats | None:
    """States at evenly spread times, shape (SAMPLES, 2n); None where it does not come so far."""
    longer = replace(problem, t_end=span, samples=SAMPLES)
    found = run_ensemble(Ensemble(longer, start[None, :].copy(), np.array([problem.parameters])), TOLERANCE)
    states = np.hstack([found.values[0], found.rates[0]])
    return states if np.isfinite(states).all() else None


def _return(times: Floats, states: Floats, apart: Apart) -> float | None:
    """When a motion first passes where it began, in the same direction; shapes (samples,) and (samples, 2n)."""
    moved = apart(states, states[0])
    moved = moved / np.maximum(np.ptp(moved, axis=0), 1e-300)
    far = np.abs(moved).max(axis=1)
    along = moved @ moved[1]
    has_left = np.maximum.accumulate(far) > AWAY
    passes = (along[:-1] < 0.0) & (along[1:] >= 0.0) & has_left[:-1]
    for place in np.flatnonzero(passes & (np.minimum(far[:-1], far[1:]) < RETURNED)):
        share = along[place] / (along[place] - along[place + 1])
        return float(times[place] + share * (times[place + 1] - times[place]))
    return None


def _rate(problem: Problem, state: Floats) -> Floats:
    """d/dt (q, q̇) at a state, shape (2n,)."""
    (own,) = accelerations(problem, np.zeros(1), state[None, :])
    return np.concatenate([state[problem.degrees :], own])


def _solved(problem: Problem, start: Floats, guess: float, apart: Apart) -> tuple[Floats, float, float] | None:
    """State, period, and the largest multiplier but that along the orbit; None where there is no such orbit."""
    state, period, width = start.copy(), guess, len(start)
    across = _rate(problem, start)
    scale = float(np.abs(start).max()) or 1.0
    for _ in range(NEWTON):
        found = _flown(problem, state, period)
        if found is None:
            return None
        end, matrix = found
        rows = np.zeros((width + 1, width + 1))
        rows[:width, :width], rows[:width, width] = matrix - np.eye(width), _rate(problem, end)
        rows[width, :width] = across
        change = np.linalg.lstsq(rows, np.append(-apart(end, state), 0.0), rcond=1e-13)[0]
        state, period = state + change[:width], period + change[width]
        if not guess / LONGEST < period < guess * LONGEST:
            return None
        if np.abs(change[:width]).max() <= SOLVED * scale and abs(change[width]) <= SOLVED * period:
            break
    else:
        return None
    return _attracting(problem, state, period)


def _attracting(problem: Problem, state: Floats, period: float) -> tuple[Floats, float, float] | None:
    """The orbit through a state, if its neighbours come to it."""
    found = _flown(problem, state, period)
    if found is None:
        return None
    multipliers = np.linalg.eigvals(found[1])
    along = int(np.argmin(np.abs(multipliers - 1.0)))
    size = float(np.abs(np.delete(multipliers, along)).max())
    is_one = abs(multipliers[along] - 1.0) < ROUNDING
    return (state, period, size) if is_one and size < 1.0 - BELOW else None


def _flown(problem: Problem, state: Floats, span: float) -> tuple[Floats, Floats] | None:
    """The state after so many seconds, shape (2n,), and its derivative by that before, shape (2n, 2n)."""
    n = problem.degrees
    values, rates = tuple(map(float, state[:n])), tuple(map(float, state[n:]))
    flow = propagated(
        replace(problem, values=values, rates=rates, t_end=span), 3, (), np.full(2 * n, float(np.abs(state).max()) or 1)
    )
    if len(flow.times) < 3 or not np.isfinite(flow.matrices[-1]).all():
        return None
    return flow.states[-1], flow.matrices[-1]


def _spread(orbit: Floats, apart: Apart) -> Floats:
    """Points of an orbit, shape (samples, 2n) with both ends, evenly spread over its length: shape (POINTS, 2n).

    Angles may have gone round; the first point has the largest first coordinate.
    """
    steps = apart(orbit[1:], orbit[:-1])
    lengths = np.sqrt(((steps / np.maximum(np.ptp(orbit, axis=0), 1e-300)) ** 2).sum(axis=1))
    places = np.concatenate([[0.0], np.cumsum(lengths)])
    first = int(np.argmax(apart(orbit[:-1], np.zeros_like(orbit[:-1]))[:, 0]))
    path = orbit[0] + np.concatenate([np.zeros((1, orbit.shape[1])), np.cumsum(steps, axis=0)])
    wanted = places[first] + places[-1] * np.arange(POINTS) / POINTS
    rounds, inside = np.divmod(wanted, places[-1])
    whole = path[-1] - path[0]
    columns = [np.interp(inside, places, path[:, i]) + rounds * whole[i] for i in range(orbit.shape[1])]
    return np.column_stack(columns)
