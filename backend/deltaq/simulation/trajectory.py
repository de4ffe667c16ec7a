"""What was computed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .constraints import Reactions
from .estimate import Estimate
from .event import EventOccurrence
from .outcome import Outcome
from .problem import Floats, Stretch
from .transitions import Transition

MOST_TOLD = 1000  # events behind which a motion went on


@dataclass(frozen=True)
class Cost:
    """What the answer took: steps of the run that is returned; evaluations and seconds of all runs together."""

    steps: int
    rejected: int
    rhs_evaluations: int
    wall_time: float
    runs: int
    run_time: float  # seconds of the returned run alone
    run_evaluations: int


@dataclass(frozen=True)
class Trajectory:
    """A motion at `times`, shape (samples,), as far as it came.

    `values` and `rates` are q and q̇ of the free coordinates, shape (samples, n); `work` is ∫P dt, shape (samples,).
    `estimate` is None if it was not asked for; `reached` is the time at which the runs ended. `conditioning` is the
    smallest pivot of the mass matrix met, relative to the diagonal entry it is left of. Where an event ended the
    motion, its time is the last sample; `transitions` are events behind which it went on, and their times are samples
    twice, before and behind them; `stretches` are the parts between events, each in its mode. Behind `seen_until` steps
    were too long to see what the forces do. `reactions` are those of the constraints at the samples, where there are
    any.
    """

    method: str
    outcome: Outcome
    times: Floats
    values: Floats
    rates: Floats
    work: Floats
    estimate: Estimate | None
    tolerance_reached: bool | None
    reached: float
    conditioning: float
    cost: Cost
    event: EventOccurrence | None = None
    seen_until: float = np.inf
    reactions: Reactions | None = None
    transitions: tuple[Transition, ...] = ()
    stretches: tuple[Stretch, ...] = ()

    @property
    def trusted_until(self) -> float:
        """The time up to which at least one digit is right."""
        horizon = self.estimate.horizon if self.estimate else None
        return min(self.reached, self.seen_until, np.inf if horizon is None else horizon)
