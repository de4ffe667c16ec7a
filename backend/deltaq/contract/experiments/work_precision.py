"""Work and precision."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from ..base import examples
from ..experiment import ExperimentAnswer, ExperimentRequest, Machine, MethodIds, MethodRun, ReferenceMotion


class CheapestRun(MethodRun):
    """Of the runs within an error, the one that took least time."""

    wanted: float = Field(description="the error")


class WorkPrecisionAnswer(ExperimentAnswer):
    """Errors over times and over right-hand sides, and which method is the cheapest for each error."""

    reference: ReferenceMotion
    events: bool = Field(description="whether motions go on behind events: impacts, kinks, sticking and slipping")
    peers_left_out: bool = Field(description="whether integrators of others were wanted that cannot follow the motion")
    machine: Machine
    repeats: int = Field(description="how often a run was measured at most")
    points: tuple[MethodRun, ...] = Field(description="every run, also one that failed")
    orders: dict[str, float] = Field(description="by method, p of error ∝ evaluations^−p where it shows")
    cheapest: tuple[CheapestRun, ...] = Field(description="for errors from 0.1 down, as far as any run came")


class WorkPrecisionRequest(ExperimentRequest):
    """Speed against accuracy: the error of each method against time and right-hand sides."""

    experiment: ClassVar[str] = "work-precision"
    answer: ClassVar[type[ExperimentAnswer]] = WorkPrecisionAnswer

    methods: MethodIds = ()
    peers: bool = Field(default=False, description="whether SciPy's integrators and heyoka take part, where installed")

    model_config = examples({"scene": "pendulum", "t_end": 2.0, "methods": ["rk4", "dop853"]})
