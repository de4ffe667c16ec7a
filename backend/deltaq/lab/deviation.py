"""A small deviation of a motion, followed stretch by stretch in steps that pass over no force thinner than themselves.

What the forces do within the steps is bounded behind each part (`simulation.audit`). Where they may have been missed
the part is taken again, in shorter steps there, up to what the next round finds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..simulation.audit import Audit
from ..simulation.kernels.motion import STEP_UNDERFLOW
from ..simulation.kernels.plan import CAPACITY, COUNT, STRIDE, Plan, make_plan
from ..simulation.kernels.tangent import Pair, Progress, Trace, begin_pair, follow_stretches
from ..simulation.march import SEEN
from ..simulation.pieces import BlindStretch, Pieces
from ..simulation.problem import Floats
from ..simulation.run import Mesh

ROUNDS, FEW = 16, 3  # of a part, each by shorter steps where one before was blind; after a few of them it is cut
WHOLE = 1e-9  # of a stretch
Bound: TypeAlias = tuple[float, float, float]  # start, end, largest step


def make_record(largest: float, width: int) -> Plan:
    """Steps up to the `largest` wherever nothing else is asked for, with room for where they end."""
    return make_plan(np.array([np.inf]), np.array([largest]), width, CAPACITY)


@dataclass(frozen=True)
class Deviation:
    """A motion, its neighbour, and what has come of them: all are written to as they go on.

    A `stretch` is so many seconds long. The audit's problem is as long as what is followed at a time, in which forces
    that move coordinates by hardly anything do not count.
    """

    pair: Pair
    progress: Progress
    trace: Trace
    audit: Audit
    stretch: float

    def begin(self) -> int:
        """Sets the neighbour beside the motion; returns the outcome."""
        direction = np.random.default_rng(0).normal(size=self.pair.scales.size)
        return int(begin_pair(self.pair, self.progress, direction / np.linalg.norm(direction)))

    def advance(self, done: int, most: int) -> tuple[int, int]:
        """Follows up to `most` stretches behind those that are done; returns the outcome, and how many are done then.

        They are fewer where more and more forces turn out to have been missed.
        """
        begun, bounds = self._saved(), list[Bound]()
        for number in range(ROUNDS):
            outcome, reached, blind = self._follow(done, most, bounds)
            if not blind:
                return outcome, reached
            self._restore(begun)
            bounds += [(each.start, each.end, each.step) for each in blind]
            clear = int(min(each.start for each in blind) / self.stretch - done + WHOLE)
            if number >= FEW and clear > 0:
                return self._follow(done, clear, bounds)[:2]
            most = most if number < FEW else 1
        return STEP_UNDERFLOW, done

    def _follow(self, first: int, count: int, bounds: Sequence[Bound]) -> tuple[int, int, tuple[BlindStretch, ...]]:
        """Some stretches by steps with bounds: the outcome, how many stretches are done, and what may be missed."""
        plan, end = self.pair.control.plan, (first + count) * self.stretch
        pieces = Pieces.whole(end).with_bounds(bounds)
        ends, largest = np.array([*pieces.ends[:-1], np.inf]), pieces.bounded(float(self.pair.control.largest_step))
        pair = self.pair._replace(control=self.pair.control._replace(plan=plan._replace(ends=ends, sizes=largest)))
        plan.times[0], plan.states[0] = self.progress.clock[0], self.pair.workspace.old[: plan.states.shape[1]]
        plan.progress[:] = 1, 1, 0
        self.trace.growths[first : first + count] = np.nan
        outcome = follow_stretches(pair, self.progress, 0.0, self.stretch, first, count, self.trace)
        reached = first + int(np.isfinite(self.trace.growths[first : first + count]).sum())
        return int(outcome), reached, self._missed()

    def _missed(self) -> tuple[BlindStretch, ...]:
        """Where the steps just taken were too long to see what the forces do."""
        plan, problem = self.pair.control.plan, self.audit.problem
        count, stride = int(plan.progress[COUNT]), int(plan.progress[STRIDE])
        times, states = plan.times[:count], plan.states[:count]
        return self.audit.after_each((Mesh(problem, float(times[0]), times, states, stride),), SEEN)

    @property
    def _memory(self) -> tuple[Floats, ...]:
        return (*self.pair.workspace, *self.pair.neighbour, *self.progress)

    def _saved(self) -> tuple[Floats, ...]:
        return tuple(each.copy() for each in self._memory)

    def _restore(self, saved: tuple[Floats, ...]) -> None:
        for each, before in zip(self._memory, saved, strict=True):
            each[:] = before
