"""Fidelity."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from ...vocabulary import RungStatus
from ..base import Answer, examples
from ..document import GivenScene
from ..experiment import ExperimentAnswer, ExperimentRequest, Machine, MethodRun

LARGEST_ERROR = 10.0  # of a simpler model, relative

# Why the full motion is not known to the end; empty where it is.
Ending = Literal["", "start", "passage", "digits", "event", "ended"]


class Simplification(Answer):
    """One thing that is left out."""

    kind: str = Field(examples=["frozen"])
    parameters: dict[str, str] = Field(description="what it is done to", examples=[{"coordinate": "y"}])


class Refusal(Answer):
    """Why there is no such model."""

    code: str
    parameters: dict[str, str | float]


class LadderRung(Answer):
    """A model: what is left out, and the scene that this leads to."""

    id: str = Field(examples=["frozen:y"])
    parts: tuple[Simplification, ...] = Field(description="none: the full model")
    degrees: int = Field(description="of freedom")
    scene: GivenScene | None = Field(description="null where there is no such scene")
    refused: tuple[Refusal, ...] = Field(description="why not")


class RungOperations(Answer):
    """The arithmetic of one right-hand side."""

    additions: int
    multiplications: int
    functions: int
    solving: int
    total: int


class MeasuredRung(Answer):
    """A model held against the full one; what could not be measured is missing."""

    rung: str = Field(description="its id")
    status: RungStatus
    largest: float | None = Field(None, description="distance from the full motion, in metres")
    until: float | None = Field(None, description="how long both could be compared, in seconds")
    error: float | None = Field(None, description="the distance as a part of the extent of the full motion")
    survives: bool | None = Field(None, description="whether the verdict stands after a nudge of the initial values")
    nudged: float | None = Field(None, description="the error after it")
    operations: RungOperations | None = None
    method: str | None = None
    evaluations: int | None = Field(None, description="of the right-hand side")
    time: tuple[float, ...] | None = Field(
        None, min_length=3, max_length=3, description="seconds: median and quartiles"
    )
    per_evaluation: float | None = Field(None, description="seconds, the median")


class RungGrowth(Answer):
    """How the error of a model grows with the amplitude: error ∝ amplitude^slope."""

    rung: str = Field(description="its id")
    relative: tuple[float | None, ...] = Field(description="the error for each of the amplitudes")
    slope: float | None


class StepTimes(Answer):
    """Seconds that one step of a method takes."""

    method: str
    kept: float = Field(description="with multipliers")
    minimal: float = Field(description="in minimal coordinates")


class MultiplierComparison(Answer):
    """A motion with multipliers held against the same in minimal coordinates, whose q̈ tells λ by M q̈ − f = Aᵀλ."""

    t: tuple[float, ...] = Field(description="seconds")
    apart: tuple[float, ...] = Field(description="largest difference of a coordinate")
    estimate: tuple[float, ...] = Field(description="of it, by the error estimates of both")
    gap: tuple[float, ...] = Field(description="largest |g|: how far the constraints are missed")
    errors: dict[str, tuple[float, ...]] = Field(description="of each multiplier, as a part of its largest value")
    estimates: dict[str, tuple[float, ...]] = Field(description="of these, by the error estimate")
    steps: tuple[StepTimes, ...] = Field(description="what a step costs, by method")


class FidelityAnswer(ExperimentAnswer):
    """The models there are, each with its cost and its error, and the least that will do."""

    tolerance: float = Field(description="relative error allowed of the least rung")
    machine: Machine
    repeats: int = Field(description="how often a run was measured")
    rungs: tuple[LadderRung, ...] = Field(description="the full model first")
    amplitudes: tuple[float, ...] = Field(description="factors of the initial deviation from the centre")
    centre: dict[str, float] = Field(description="coordinates at rest or in steady motion; empty where there is none")
    measured: tuple[MeasuredRung, ...]
    growth: tuple[RungGrowth, ...]
    points: tuple[MethodRun, ...] = Field(description="the full model by several methods, roughly and finely")
    minimal: tuple[MethodRun, ...] = Field(
        (), description="likewise in minimal coordinates, for scenes with constraints"
    )
    multipliers: MultiplierComparison | None = Field(None, description="what multipliers cost, where there are any")
    least: str = Field(description="id of the least rung that will do; empty where that cannot be told")
    until: float = Field(description="up to when that is said, in seconds")
    ending: Ending


class FidelityRequest(ExperimentRequest):
    """The least model that will do: simpler models of the scene, each with its cost and its error."""

    experiment: ClassVar[str] = "fidelity"
    answer: ClassVar[type[ExperimentAnswer]] = FidelityAnswer

    tolerance: float | None = Field(
        None, ge=1e-9, le=LARGEST_ERROR, description="relative error allowed of the least rung; 0.01 if empty"
    )

    model_config = examples({"scene": "elastic-pendulum", "tolerance": 0.05})
