"""Energy drift."""

from __future__ import annotations

from enum import StrEnum
from typing import ClassVar

from pydantic import Field

from ...vocabulary import TriedStatus
from ..base import Answer, Pair, examples
from ..experiment import ExperimentAnswer, ExperimentRequest, MethodIds

MOST_STEPS = 1_000_000


class DriftVerdict(StrEnum):
    """What becomes of the energy."""

    LOST = "lost"
    ROUNDING = "rounding"
    BOUNDED = "bounded"
    LINEAR = "linear"
    GROWS = "grows"
    UNCLEAR = "unclear"  # neither a band nor growth can be told from so short a run


class DriftLine(Answer):
    """The departure of one method; of one that would take too long there is no more than that."""

    method: str
    symplectic: bool
    variable: bool = Field(description="whether its steps are")
    status: TriedStatus
    t: tuple[float, ...] = Field((), description="ends of the stretches of time")
    error: tuple[float, ...] = Field((), description="largest departure in each, in parts of the energy")
    verdict: DriftVerdict | None = None
    largest: float | None = Field(None, description="the largest departure; null where one is no number")
    lost_at: float | None = Field(None, description="when nothing was left of the balance")
    growth: float | None = Field(None, description="p of error ∝ t^p, where it shows")
    growth_interval: Pair | None = Field(None, description="of about 95 %")
    steps: int | None = None
    evaluations: int | None = Field(None, description="of the right-hand side")
    time: float | None = Field(None, description="seconds")


class EnergyDriftAnswer(ExperimentAnswer):
    """How the energy balance of each method departs from its start."""

    steps: int = Field(description="how many")
    step: float = Field(description="seconds")
    tolerance: float = Field(description="local tolerance of variable steps")
    lines: tuple[DriftLine, ...]


class EnergyDriftRequest(ExperimentRequest):
    """Departure of the energy balance over many steps, symplectic methods against others.

    The span is the number of steps times the step.
    """

    experiment: ClassVar[str] = "energy-drift"
    answer: ClassVar[type[ExperimentAnswer]] = EnergyDriftAnswer

    methods: MethodIds = ()
    steps: int = Field(100_000, ge=1_000, le=MOST_STEPS, description="how many")
    step: float | None = Field(None, gt=0, le=1e3, description="seconds; else a fortieth of the fastest period")
    tolerance: float | None = Field(None, ge=1e-13, le=1e-1, description="local tolerance of variable steps")

    model_config = examples({"scene": "pendulum", "methods": ["stormer-verlet", "rk4"], "steps": 2000})
