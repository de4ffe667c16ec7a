"""The flow of a scene whose motions go on behind events (impacts, sticking and slipping), over one of its parameters.

Motions are followed one by one, from event to event. Where neighbours pass the same events in the same order, the flow
is as smooth as between events, and derivatives by differences hold as well; where a motion grazes a contact, or begins
behind one, there are none.
Source: di Bernardo, Budd, Champneys, Kowalczyk, Piecewise-smooth Dynamical Systems, §2.2 and §2.5.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..model.modes import Modes
from ..simulation.audit import Audit
from ..simulation.audited import AuditedParts
from ..simulation.event import event_values
from ..simulation.hybrid import run_on
from ..simulation.kernels.motion import EVENT
from ..simulation.library import get_method
from ..simulation.march import SEEN, Truths
from ..simulation.problem import Floats
from ..simulation.run import Run, Steps
from ..simulation.section import Surface
from .flow import PARTS, TOLERANCE, Flow, Image, Passed, Traced
from .hybrid_orbits import TOUCHING, crossings_of


@dataclass
class Allowance:
    """Behind how many events motions may go on for derivatives: of the `whole`, so many for `each` branch.

    An event takes as long as thousands of steps. `passed` are all so far, those of sweeps among them.
    """

    whole: int = 40_000
    each: int = 16_000
    left: int = 0
    passed: int = 0
    is_exhausted: bool = False

    def renew(self) -> None:
        """For the next branch."""
        self.left = min(self.each, self.whole)

    def spend(self, events: int) -> None:
        """So many were passed for a derivative."""
        self.left, self.whole = self.left - events, self.whole - events
        self.is_exhausted |= self.left <= 0


@dataclass(frozen=True)
class HybridFlow(Flow):
    """The same of a problem in modes."""

    modes: Modes
    allowance: Allowance

    def image(self, state: Floats, span: float, value: float, parts: int = 1, longer: float = 0.0) -> Image | None:
        """As of any flow, from a state of shape (2n,), as long as the allowance lasts."""
        if self.allowance.left <= 0:
            return None
        before = self.allowance.passed
        found = super().image(state, span, value, parts, longer)
        self.allowance.spend(self.allowance.passed - before)
        return found

    def admits(self, value: float, states: Floats) -> Truths:
        """Which of the states (q, q̇) at the time 0, shape (states, 2n), are behind no contact: shape (states,)."""
        gaps = event_values(self.at(value), np.zeros(len(states)), states)
        size = np.maximum(1.0, np.abs(states).max(axis=1, keepdims=True))
        return np.asarray((gaps >= -TOUCHING * size).all(axis=1))

    def traced(self, values: Floats, states: Floats, times: Floats, tolerance: float = TOLERANCE) -> Traced:
        """As of any flow; what begins behind a contact goes nowhere.

        `values` has shape (motions,), `states` (motions, 2n), `times` (times,).
        """
        width, count = states.shape[1], len(states)
        found = Traced(np.full((count, len(times), width), np.nan), np.full(count, EVENT), np.zeros(count, dtype=int))
        for index, (value, state) in enumerate(zip(values.tolist(), states, strict=True)):
            if not self.admits(value, state[None, :])[0]:
                continue
            run = self.run(value, state, times, tolerance)
            states_of_run = run.states[np.isin(run.times, times), :width]
            found.states[index, : len(states_of_run)] = states_of_run
            self.allowance.passed += len(run.transitions)
            found.outcomes[index], found.steps[index] = run.result.outcome, run.result.steps
        return found

    @property
    def is_exhausted(self) -> bool:
        return self.allowance.is_exhausted

    def renew(self) -> None:
        self.allowance.renew()

    def passed(self, value: float, state: Floats, times: Floats, surface: Surface) -> Passed:
        """As of any flow; where the plane is the gap of a contact, each of its impacts is a passage.

        `state` has shape (2n,), `times` shape (times,).
        """
        run = self.run(value, state, times)
        end = run.states[-1, : len(state)] if len(run.states) else state
        return Passed(crossings_of(run, surface), end, run.result.outcome)

    def events(self, value: float, state: Floats, span: float) -> int:
        """Behind how many events the motion from a state, shape (2n,), goes on in a span, as far as it comes."""
        return len(self.run(value, state, np.array([0.0, span])).transitions)

    def run(self, value: float, state: Floats, times: Floats, tolerance: float = TOLERANCE) -> Run:
        """The motion from a state, shape (2n,), with samples at `times`, shape (times,), that begin with 0.

        One that may have missed a force is followed again in parts, with samples at their ends, too.
        """
        n = self.problem.degrees
        own = replace(
            self.at(value),
            model=self.modes.model,
            values=tuple(state[:n].tolist()),
            rates=tuple(state[n:].tolist()),
            t_end=float(times[-1]),
        )
        taylor, steps = get_method("taylor"), Steps(self.largest, tolerance, is_recorded=True)
        found = run_on(own, self.modes, taylor, times, self.cancelled, steps)
        if not found.meshes or not Audit(found.meshes[0].problem, taylor).after_each(found.meshes, SEEN):
            return found
        parts = AuditedParts(SEEN, PARTS * self.largest)
        return run_on(own, self.modes, taylor, parts.divided(times), self.cancelled, steps, parts)
