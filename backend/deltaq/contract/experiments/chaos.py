"""Chaos."""

from __future__ import annotations

from enum import StrEnum
from typing import ClassVar, Literal

from pydantic import Field

from ...vocabulary import Status
from ..base import Answer, Pair, examples
from ..experiment import SHORTEST, ExperimentAnswer, ExperimentRequest, FreeAnswer


class ChaosVerdict(StrEnum):
    """What a motion is found to be."""

    REGULAR = "regular"
    CHAOTIC = "chaotic"
    UNDECIDED = "undecided"


class ChaosReason(StrEnum):
    """Why there is no verdict."""

    NONE = ""
    ENDED = "ended"  # the motion ended before its time
    SHORT = "short"  # too little could be followed
    UNSETTLED = "unsettled"  # still decaying or growing
    WIDE = "wide"  # the interval holds both zero and clear growth
    DISAGREE = "disagree"  # exponent and 0–1 test


class TwinRuns(Answer):
    """The distance of two motions that begin close to each other."""

    t: tuple[float, ...]
    distance: tuple[float, ...]


class ExponentialReading(Answer):
    """Growth read as e^(rate t)."""

    rate: float
    misfit: float = Field(description="of its logarithm, root mean square")


class PowerReading(Answer):
    """Growth read as t^power."""

    power: float
    misfit: float = Field(description="of its logarithm, root mean square")


class GrowthReadings(Answer):
    """How deviations grow, read in two ways."""

    exponential: ExponentialReading
    power: PowerReading


class SecondIndicator(Answer):
    """A witness that sees the motion alone."""

    name: Literal["0-1 test"]
    value: float | None = Field(description="K: near 0 regular, near 1 chaotic; null where it was not asked")


class LyapunovExponent(Answer):
    """The largest Lyapunov exponent in 1/s, with a verdict; without numbers where too little could be followed."""

    status: Status = Field(description="ok, or how the motion ended before its time")
    span: float = Field(description="seconds that were followed")
    confidence: float = Field(description="of the interval")
    t: tuple[float, ...]
    values: tuple[float, ...] = Field(description="the mean rate up to each time")
    last: float | None = Field(description="the exponent")
    spread: float | None = Field(description="what the later half of the values still wanders by")
    interval: Pair | None
    transient: float | None = Field(description="seconds at the beginning that do not count")
    growth: GrowthReadings | None = None
    verdict: ChaosVerdict
    reason: ChaosReason = Field(description="why there is no verdict; else empty")
    second_indicator: SecondIndicator


class PredictedSpan(Answer):
    """How long a tolerance predicts the motion."""

    tolerance: float
    t: float


class PredictionHorizon(Answer):
    """The time that each tolerance predicts."""

    points: tuple[PredictedSpan, ...]
    per_digit: float | None = Field(description="seconds that one more digit buys (least squares)")
    known_until: float = Field(description="how far the motion is known at all")


class FlipSide(Answer):
    """A coordinate and its values along a side of the map."""

    coordinate: str
    values: tuple[float, ...]


class FlipMap(Answer):
    """When something turns over, by the angles that the motion begins from at rest."""

    x: FlipSide
    y: FlipSide
    t_end: float
    times: tuple[tuple[float | None, ...], ...] = Field(description="−1: not in time; null: not known")


class NoFlipMap(Answer):
    """Why there is no map."""

    missing: Literal["angles", "constraints"] = Field(
        description="`constraints`: it would begin at angles that are not the scene's own"
    )


class ChaosAnswer(FreeAnswer):
    """How fast motions part, whether that is chaos, and how long each tolerance predicts."""

    apart: float = Field(description="how far the twins were apart at first")
    twins: TwinRuns
    exponent: LyapunovExponent
    horizon: PredictionHorizon
    map: FlipMap | NoFlipMap | None = Field(None, description="where it was asked for")


class ChaosRequest(ExperimentRequest):
    """Twin runs, Lyapunov exponent, and the horizon of prediction against the tolerance."""

    experiment: ClassVar[str] = "chaos"
    answer: ClassVar[type[ExperimentAnswer]] = ChaosAnswer

    t_end: float = Field(30.0, ge=SHORTEST, le=200.0, description="seconds of motion")
    apart: float | None = Field(None, ge=1e-15, le=1.0, description="how far the twins are apart at first")
    map: bool = Field(default=False, description="whether to map the times at which angles turn over")
    count: int = Field(96, ge=16, le=160, description="points on a side of the map")

    model_config = examples({"scene": "double-pendulum", "t_end": 10.0})
