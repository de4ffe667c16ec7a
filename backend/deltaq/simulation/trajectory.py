"""What was computed."""

from __future__ import annotations

from dataclasses import dataclass

from .estimate import Estimate
from .event import Happening
from .outcome import Outcome
from .problem import Floats


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
    """A motion at `times`, as far as it came: q and q̇ of the free coordinates, shape (samples, degrees), and ∫P dt.

    `estimate` is None if it was not asked for; `reached` is the time at which the runs ended. `conditioning` is the
    smallest pivot of the mass matrix met, relative to its largest diagonal entry. Where an event ended the motion, its
    time is the last sample.
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
    event: Happening | None = None

    @property
    def trusted_until(self) -> float:
        """The time up to which at least one digit is right."""
        horizon = self.estimate.horizon if self.estimate else None
        return self.reached if horizon is None else min(horizon, self.reached)
