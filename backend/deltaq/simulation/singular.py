"""What has no finite value where a run could not go on: the margin of its right-hand side that was coming to zero."""

from __future__ import annotations

import numpy as np

from ..model.model import of_motion
from ..model.singularities import Margins, margins_of
from .derivatives import accelerations
from .problem import Floats, Problem
from .run import Run

STEPS = 4.0  # so many steps of the run ahead, or
AHEAD = 1e-6  # so much of the span, a margin may still last by its rate,
LEFT = 1e-6  # or so little be left of it, relative to its largest value on the way
TRIED = 1e-9  # of the span, over which the rate is taken


def vanishing_margin(problem: Problem, run: Run) -> str | None:
    """What comes to zero where the run ended, as the language of scenes has it; None if nothing does."""
    model = problem.model
    margins = model.kept("margins", lambda: margins_of(of_motion(model.eqs), model.eqs.symbols))
    if margins is None:
        return None
    times, states, step = last_known(problem, run)
    rows = problem.inputs(times, states)
    values = margins.at(rows)
    left = margins.left(values)
    is_over = left[-1] == 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        lasts = -values[-1] / _rates(problem, margins, times[-1:], states[-1:])  # negative of what grows
        lasts = np.where(is_over, 0.0, np.where(lasts > 0.0, lasts, np.inf))
        share = np.where(is_over, 0.0, left[-1] / left.max(axis=0))
    window = max(STEPS * step, AHEAD * problem.t_end) + max(float(run.result.reached) - times[-1], 0.0)
    urgency = np.minimum(lasts / window, share / LEFT)
    first = int(np.argmin(urgency))
    return margins.names[first] if urgency[first] <= 1.0 else None


def last_known(problem: Problem, run: Run) -> tuple[Floats, Floats, float]:
    """The times and states (q, q̇) at which the run is known, and the length of its last step in seconds.

    The times have shape (states,), the states shape (states, 2n).
    """
    width = 2 * problem.degrees
    times, states = run.times, run.states[:, :width]
    known = np.isfinite(states).all(axis=1) & (times <= run.result.reached)
    known[0] = True
    times, states = times[known], states[known]
    if run.mesh_times.size > 1 and run.mesh_times[-1] >= times[-1]:
        return (
            np.append(times, run.mesh_times[-1]),
            np.vstack([states, run.mesh_states[-1:]]),
            float(run.mesh_times[-1] - run.mesh_times[-2]) / run.stride,
        )
    return times, states, float(run.result.reached) / max(int(run.result.steps), 1)


def _rates(problem: Problem, margins: Margins, time: Floats, state: Floats) -> Floats:
    """How fast the margins change: shape (margins,). `time` has shape (1,), `state` shape (1, 2n)."""
    n, h = problem.degrees, TRIED * problem.t_end
    q, v = state[:, :n], state[:, n:]
    moved = np.hstack([q + h * v, v + h * accelerations(problem, time, state)])
    before, behind = (margins.at(problem.inputs(t, s))[0] for t, s in ((time, state), (time + h, moved)))
    return np.asarray((behind - before) / h)
