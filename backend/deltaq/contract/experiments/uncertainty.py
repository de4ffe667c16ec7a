"""Uncertainty: what a tolerance of the start, or of parameters, does to a prediction."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from ...vocabulary import Status
from ..base import Answer, examples
from ..ensemble import Quantity
from ..experiment import SHORTEST, ExperimentAnswer, ExperimentRequest, FreeAnswer
from ..figure import Numbers

LONGEST = 1000.0  # seconds of one motion
MOST_RUNS = 2000
MOST_SECONDS = 100_000.0  # of all motions together
LARGEST = 1e6  # of a tolerance

Uncertain = Literal["start", "values", "parameters", "all"]
Distribution = Literal["normal", "uniform"]
Tolerance = Annotated[float, Field(gt=0.0, le=LARGEST)]


class UncertaintyHorizon(Answer):
    """When a prediction is worth nothing, with what the number of runs leaves open."""

    t: float = Field(description="seconds; by the standard deviation of the runs")
    early: float = Field(description="by the upper end of its interval")
    late: float | None = Field(description="by the lower end; null: not in this time")


class UncertainCoordinate(Answer):
    """How far the runs are spread in one coordinate; each column has an entry for each time."""

    coordinate: str
    reference: tuple[float, ...] = Field(description="the motion from the nominal start")
    mean: Numbers = Field(description="over the runs")
    deviation: Numbers = Field(description="standard deviation of the runs")
    low: Numbers = Field(description="lower end of the interval for that of infinitely many runs")
    high: Numbers = Field(description="its upper end")
    linear: Numbers = Field(description="standard deviation by linear propagation; null: not known")
    nonlinearity: Numbers = Field(description="what linear propagation leaves of the deviations of the runs, 0 to …")
    error: Numbers = Field(description="median over the runs of the estimated error of integration")
    quantiles: tuple[Numbers, ...] = Field(description="of the runs, a column for each level")
    range: float = Field(description="over which the nominal motion goes; of an angle no more than a turn")
    linear_until: float | None = Field(description="seconds; null: linear propagation describes the runs to the end")
    error_from: float | None = Field(description="seconds from which the error of integration counts; null: never")
    horizon: UncertaintyHorizon | None = Field(description="null: not reached, or the nominal motion has no range")
    budget: dict[str, float] = Field(description="parts of the linear variance at the end of its reach, by quantity")


class UncertaintyAnswer(FreeAnswer):
    """Spread of a cloud of runs against linear propagation, by coordinate."""

    distribution: Distribution
    tolerances: dict[str, float] = Field(description="by quantity: standard deviation, or half the width if uniform")
    share: float = Field(description="of the range: a prediction that is spread further is worth nothing")
    confidence: float = Field(description="of the intervals")
    levels: tuple[float, ...] = Field(examples=[[0.05, 0.25, 0.5, 0.75, 0.95]])
    t: tuple[float, ...] = Field(description="seconds")
    reached: tuple[int, ...] = Field(description="how many runs have come to each time")
    runs: int = Field(description="so far")
    statuses: dict[Status, int] = Field(description="how many runs ended how")
    coordinates: tuple[UncertainCoordinate, ...]


class UncertaintyRequest(ExperimentRequest):
    """A cloud of runs from starts within a tolerance, beside the linear propagation of that tolerance."""

    experiment: ClassVar[str] = "uncertainty"
    answer: ClassVar[type[ExperimentAnswer]] = UncertaintyAnswer
    kernels: ClassVar[tuple[str, ...] | None] = ("taylor", "ensembles")

    t_end: float = Field(10.0, ge=SHORTEST, le=LONGEST, description="seconds of each motion")
    uncertain: Uncertain = Field("start", description="what has the tolerance: initial values and rates, or others")
    tolerance: Tolerance = Field(
        0.01,
        description="of initial values in their units, of parameters as a part of their values: standard deviation, or "
        "half the width",
    )
    tolerances: dict[Quantity, Tolerance] = Field(
        {},
        max_length=16,
        description="in place of both, tolerances in the units of the quantities: NAME of a coordinate or parameter, "
        "dot(NAME) of a rate, or as in ensembles initial.NAME.value, initial.NAME.rate, parameters.NAME; all others "
        "are exact",
        examples=[{"phi1": 0.01}],
    )
    distribution: Distribution = Field("normal", description="of what is uncertain, each quantity by itself")
    runs: int = Field(400, ge=30, le=MOST_RUNS, description="runs of the cloud")
    seed: int = Field(0, ge=0, le=2**31 - 1, description="of the random numbers")
    share: float = Field(
        0.25, gt=0.0, le=1.0, description="of the range of the motion: what is spread further is worth nothing"
    )

    model_config = examples(
        {"scene": "double-pendulum", "t_end": 4.0, "runs": 60},
        {"scene": "pendulum", "t_end": 2.0, "runs": 60, "tolerances": {"l": 0.01}},
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        seconds = self.runs * self.t_end
        if seconds > MOST_SECONDS:
            told = {"runs": self.runs, "seconds": seconds, "most_seconds": MOST_SECONDS, "at": "/runs"}
            raise PydanticCustomError("uncertainty-too-large", "too large", told)
        return self
