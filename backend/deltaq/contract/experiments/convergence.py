"""Convergence."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from ..base import Answer, examples
from ..experiment import ExperimentAnswer, ExperimentRequest, MethodIds, MethodRun, ReferenceMotion


class OrderOfConvergence(Answer):
    """p of error ∝ step^p."""

    measured: float
    theory: int


class ConvergenceAnswer(ExperimentAnswer):
    """Errors over steps, and the orders that they show."""

    reference: ReferenceMotion
    events: bool = Field(description="whether motions go on behind events: impacts, kinks, sticking and slipping")
    points: tuple[MethodRun, ...] = Field(description="every run, also one that failed")
    orders: dict[str, OrderOfConvergence] = Field(description="by method, where one shows")


class ConvergenceRequest(ExperimentRequest):
    """Order of convergence: the error of each method against its step."""

    experiment: ClassVar[str] = "convergence"
    answer: ClassVar[type[ExperimentAnswer]] = ConvergenceAnswer

    methods: MethodIds = ()

    model_config = examples({"scene": "pendulum", "t_end": 2.0, "methods": ["heun", "rk4"]})
