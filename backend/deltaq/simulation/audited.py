"""A motion at given times, by steps of which none passes over a force that is thinner than itself.

It is audited part by part, each short enough to meet few such forces: what is behind one that was missed is another
motion, in which nothing can be found beforehand.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .audit import Audit
from .integration import Flag
from .kernels.motion import EVENT, FINE, STEP_UNDERFLOW
from .method import Method
from .pieces import BlindStretch, Pieces
from .problem import Floats, Problem
from .run import Mesh, Run, Steps
from .run import run as run_once

ROUNDS = 12  # of a part, each with shorter steps where the one before was blind


@dataclass(frozen=True)
class AuditedMotion:
    """The `states` (q, q̇) at the times, shape (times, 2n), NaN behind where the motion ended with an `outcome`."""

    states: Floats
    outcome: int
    steps: int


@dataclass(frozen=True)
class AuditedParts:
    """What moves coordinates by less than the `tolerance` may be missed; parts are about as long as `longest` seconds.

    A part goes up to a sample, so that times are `divided` beforehand.
    """

    tolerance: float
    longest: float

    def divided(self, times: Floats) -> Floats:
        """The times, shape (times,), ascending, with others between them so that no two are too far apart."""
        counts = np.maximum(np.ceil(np.diff(times) / self.longest).astype(np.int64), 1).tolist()
        spans = zip(times[:-1].tolist(), times[1:].tolist(), counts, strict=True)
        return np.concatenate([*(np.linspace(start, end, count + 1)[:-1] for start, end, count in spans), times[-1:]])

    def first_part(self, problem: Problem, method: Method, times: Floats, cancelled: Flag, steps: Steps) -> Run:
        """A run up to the first of the times, shape (times,), that are so far, or to an event before."""
        count = max(int(np.searchsorted(times, times[0] + self.longest, side="right")), 2)
        found, blind = audited_run(problem, method, times[:count], steps, self.tolerance, cancelled, ROUNDS)
        return replace(found, result=found.result._replace(outcome=STEP_UNDERFLOW), event=None) if blind else found


def mesh_of(problem: Problem, found: Run) -> Mesh:
    """The mesh of a run up to the event that ended it, if one did."""
    event, width = found.event, 2 * problem.degrees
    times, states = found.mesh_times, found.mesh_states
    if event is not None and times.size:
        before = int(times.searchsorted(event.time))
        times = np.concatenate([times[:before], [event.time]])
        states = np.concatenate([states[:before], event.state[None, :width]])
    return Mesh(problem, float(found.times[0]), times, states, found.stride)


def audited_motion(
    problem: Problem, method: Method, times: Floats, steps: Steps, tolerance: float, longest: float, cancelled: Flag
) -> AuditedMotion:
    """The problem's motion at `times`, shape (times,), in parts up to the `longest`, in seconds.

    `steps` bounds them and their local errors; what moves coordinates by less than the `tolerance` may be missed.
    """
    state, taken = problem.state[: 2 * problem.degrees], 0
    states = np.full((len(times), len(state)), np.nan)
    states[0] = state
    for place in range(1, len(times)):
        start, end = float(times[place - 1]), float(times[place])
        ends = np.linspace(start, end, 1 + int(np.ceil((end - start) / longest)))
        for k in range(1, len(ends)):
            n = problem.degrees
            own = replace(problem, values=tuple(state[:n].tolist()), rates=tuple(state[n:].tolist()), t_end=ends[k])
            whole = replace(steps, pieces=Pieces.whole(ends[k]))
            found, blind = audited_run(own, method, ends[k - 1 : k + 1], whole, tolerance, cancelled, ROUNDS)
            outcome = STEP_UNDERFLOW if blind else found.result.outcome
            taken += found.result.steps
            if outcome != FINE:
                return AuditedMotion(states, outcome, taken)
            state = found.states[-1, : 2 * n]
        states[place] = state
    return AuditedMotion(states, FINE, taken)


def audited_run(
    problem: Problem, method: Method, times: Floats, steps: Steps, tolerance: float, cancelled: Flag, rounds: int
) -> tuple[Run, tuple[BlindStretch, ...]]:
    """A recorded run with samples at `times`, shape (times,), and where it is still blind after so many rounds.

    Each round has shorter steps where the one before could have passed over what moves coordinates by more than the
    `tolerance`. A run that ends early, but by an event, is told as it is.
    """
    audit, pieces = Audit(problem, method), steps.pieces or Pieces.whole(float(times[-1]))
    for _ in range(rounds):
        found = run_once(problem, method, times, cancelled, replace(steps, pieces=pieces, is_recorded=True))
        is_done = found.result.outcome in (FINE, EVENT)
        blind = audit.after_each((mesh_of(problem, found),), tolerance) if is_done else ()
        if not blind:
            break
        pieces = pieces.with_bounds([(each.start, each.end, each.step) for each in blind])
    return found, blind
