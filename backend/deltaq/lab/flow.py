"""The flow of a scene over one of its parameters: where states are after a time, and how that depends on them.

Motions go side by side in the lanes of ensembles. Derivatives are differences of fourth order between neighbours, whose
error is about as small as that of the motions themselves.
Source: Seydel, Practical Bifurcation and Stability Analysis, 3rd ed., §7.3.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..simulation.audit import Audit
from ..simulation.audited import audited_motion
from ..simulation.ensemble import Ensemble, Sight, in_lanes
from ..simulation.integration import Flag
from ..simulation.library import get_method
from ..simulation.march import SEEN, Integers, Truths
from ..simulation.problem import Floats, Problem
from ..simulation.run import Steps
from ..simulation.section import Surface
from .interpolation import crossings

TOLERANCE, FINE = 1e-12, 1e-16  # local: of a sweep, and of derivatives
NUDGE, EARLY = 2e-4, 1e-3  # of the scales and of the time: what differences leave out is as small as rounding
PARTS = 2.0  # of the longest step: how far a motion with a thin force on its way is followed at once
STENCIL, WEIGHTS = np.array([1.0, -1.0, 2.0, -2.0]), np.array([8.0, -8.0, -1.0, 1.0]) / 12.0


@dataclass(frozen=True)
class Traced:
    """Motions at some times: `states` (q, q̇), shape (motions, times, 2n), `outcomes` and `steps` (motions,)."""

    states: Floats
    outcomes: Integers
    steps: Integers

    @property
    def is_fine(self) -> bool:
        """Whether all came to the end."""
        return not self.outcomes.any()


@dataclass(frozen=True)
class Passed:
    """A motion where it is looked at: `rows` (q, q̇, t), shape (passages, 2n + 1), and its `end`, shape (2n,).

    `status` is the outcome of the kernel, 0 where it came to its end.
    """

    rows: Floats
    end: Floats
    status: int


@dataclass(frozen=True)
class Image:
    """What becomes of a state after a span: `end`, shape (2n,), and its derivatives.

    `by_state` has shape (2n, 2n), `by_time` and `by_value` (2n,), the latter with the change of the span. `orbit` are
    the states at the beginning of each part of the span, shape (parts, 2n).
    """

    end: Floats
    by_state: Floats
    by_time: Floats
    by_value: Floats
    orbit: Floats


@dataclass(frozen=True)
class Flow:
    """The motions of a problem whose parameter at `place` takes other values; steps are no longer than `largest`.

    `nudges` are the distances of neighbours, of the components of (q, q̇) and of the parameter, shape (2n + 1,).
    """

    problem: Problem
    place: int
    largest: float
    cancelled: Flag
    nudges: Floats

    def at(self, value: float) -> Problem:
        """The problem at a value of the parameter."""
        parameters = list(self.problem.parameters)
        parameters[self.place] = value
        return replace(self.problem, parameters=tuple(parameters))

    def admits(self, value: float, states: Floats) -> Truths:
        """From which of the states (q, q̇), shape (states, 2n), motions can begin at the time 0: shape (states,)."""
        del value  # nothing is in the way of a motion that one set of equations describes
        return np.asarray(np.isfinite(states).all(axis=1))

    @property
    def is_exhausted(self) -> bool:
        """Whether derivatives were given up, for they would have taken too long."""
        return False

    def renew(self) -> None:
        """For the next branch of periodic motions: its derivatives may take their time anew."""

    def events(self, value: float, state: Floats, span: float) -> int:
        """Behind how many events the motion from a state, shape (2n,), goes on in a span: smooth ones meet none."""
        del value, state, span
        return 0

    def coarser(self, factor: float) -> Flow:
        """The same with neighbours that much farther away: what differs is what differences are wrong by."""
        return replace(self, nudges=factor * self.nudges)

    def traced(self, values: Floats, states: Floats, times: Floats, tolerance: float = TOLERANCE) -> Traced:
        """Motions with these values of the parameter from `states` at the time 0, at `times` that begin with 0.

        `values` has shape (motions,), `states` (motions, 2n), `times` (times,).
        """
        parameters = np.tile(np.array(self.problem.parameters), (len(values), 1))
        parameters[:, self.place] = values
        ensemble, steps = Ensemble(self.problem, states, parameters), Steps(self.largest, tolerance)
        taylor = get_method("taylor")
        audit = Audit(replace(self.problem, t_end=float(times[-1])), taylor)
        members = in_lanes(ensemble, times, steps, self.cancelled, sight=Sight(audit, SEEN))
        found = Traced(members.samples[:, :, : 2 * self.problem.degrees], members.outcomes, members.steps)
        for place in np.flatnonzero(members.blind).tolist():
            again = audited_motion(
                ensemble.member(place), taylor, times, steps, SEEN, PARTS * self.largest, self.cancelled
            )
            found.states[place], found.outcomes[place], found.steps[place] = again.states, again.outcome, again.steps
        return found

    def passed(self, value: float, state: Floats, times: Floats, surface: Surface) -> Passed:
        """Where the motion from a state, shape (2n,), passes a plane, looked at between `times`, shape (times,)."""
        found = self.traced(np.array([value]), state[None, :], times)
        states = found.states[0]
        good = int(np.isfinite(states).all(axis=1).cumprod().sum())
        rows = crossings(self.at(value), np.column_stack([states, times])[:good], surface)
        return Passed(rows, states[-1], int(found.outcomes[0]))

    def image(self, state: Floats, span: float, value: float, parts: int = 1, longer: float = 0.0) -> Image | None:
        """Where a state, shape (2n,), is after a span, with all derivatives; None where motions end before.

        The motion begins anew in each of so many equal parts, of which a change of the parameter makes each `longer` by
        that much. Derivatives are taken over one part, and multiplied: there neighbours have not parted far.
        """
        width, part = len(state), span / parts
        own = self.traced(np.array([value]), state[None, :], np.linspace(0.0, span, parts + 1), FINE)
        if not own.is_fine:
            return None
        orbit = own.states[0]
        moved = np.repeat(np.eye(width + 1) * self.nudges, len(STENCIL), axis=0) * np.tile(STENCIL, width + 1)[:, None]
        moved = np.vstack([np.zeros(width + 1), moved])
        begin = np.column_stack([orbit[:-1], np.full(parts, value)])
        members = (begin[:, None, :] + moved).reshape(-1, width + 1)
        times = np.concatenate([[0.0], part + EARLY * part * np.arange(-2, 3)])
        found = self.traced(members[:, -1], np.ascontiguousarray(members[:, :-1]), times, FINE)
        if not found.is_fine:
            return None
        states = found.states.reshape(parts, len(moved), len(times), width)
        ends = states[:, 1:, 3].reshape(parts, width + 1, len(STENCIL), width)
        slopes = np.einsum("pdsw,s->pwd", ends, WEIGHTS) / self.nudges
        speeds = np.einsum("psw,s->pw", states[:, 0, [4, 2, 5, 1]], WEIGHTS) / (EARLY * part)
        by_state, by_value = np.eye(width), np.zeros(width)
        for slope, speed in zip(slopes, speeds, strict=True):
            by_state = slope[:, :-1] @ by_state
            by_value = slope[:, :-1] @ by_value + slope[:, -1] + longer * speed
        return Image(orbit[-1], by_state, speeds[-1], by_value, orbit[:-1])
