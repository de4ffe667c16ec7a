"""Stability of methods."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from ...vocabulary import Status
from ..base import Answer, Pair, examples
from ..experiment import ExperimentAnswer, ExperimentRequest, FreeAnswer, MethodIds

Place = Literal["state", "rest"]
Basis = Literal["linearization", "flow"]
Cause = Literal["", "grows", "newton_failed"]
NotTold = Literal["", "motion-lost", "motion-spreads", "motion-unknown"]


class FailingStep(Answer):
    """A method, its region of stability, and the step at which it fails.

    Of steps null stands for every step, and for one that cannot be told; `basis` and `reason` say which.
    """

    method: str
    implicit: bool
    region: tuple[tuple[Pair, ...], ...] = Field(description="lines |R(z)| = 1 of points [Re z, Im z]")
    bound: float | None = Field(description="the largest step for which nothing grows")
    predicted: float | None = Field(description="the step of failure, by the linearization")
    measured: float | None = Field(description="the same, by running the method")
    deviation: float | None = Field(description="(measured − predicted) / predicted")
    cause: Cause = Field(description="how the failing run ended")
    basis: Basis = Field(description="what the method was held against")
    reason: NotTold = Field(description="why no step could be measured")
    limit: float | None = Field(description="the step from which on that is so")


class StiffRun(Answer):
    """What a tolerance costs at some stiffness."""

    method: str
    factor: float = Field(description="of the stiffness")
    status: Status
    evaluations: int = Field(description="of the right-hand side")
    time: float = Field(description="seconds")
    error: float | None


class StabilityAnswer(FreeAnswer):
    """The scene's eigenvalues, the step at which each method fails, and what a stiffness costs."""

    eigenvalues: tuple[Pair, ...] = Field(description="[Re λ, Im λ] in 1/s")
    at: Place = Field(description="where the scene was to be linearized")
    rest: bool = Field(description="whether it rests there")
    varies: float = Field(description="how much the linearization changes along the motion")
    methods: tuple[FailingStep, ...]
    stiffness: str = Field(description="the parameter of the series; empty where there is none")
    series: tuple[StiffRun, ...]


class StabilityRequest(ExperimentRequest):
    """Regions of stability with the eigenvalues of the scene, steps of failure, and a series over a stiffness."""

    experiment: ClassVar[str] = "stability"
    answer: ClassVar[type[ExperimentAnswer]] = StabilityAnswer

    methods: MethodIds = ()
    at: Place = Field("state", description="where the scene is linearized: state or rest")
    stiffness: str | None = Field(None, max_length=64, description="parameter that is made larger; a spring's if empty")

    model_config = examples({"scene": "pendulum", "methods": ["rk4"], "at": "rest"})
