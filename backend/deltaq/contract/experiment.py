"""Experiments: what may be asked of any, and what a result is."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from .bounds import LONGEST, SHORTEST, SPAN
from .base import Answer, AskedLanguage, InitialValues, Names, SceneWithChanges, examples


class ExperimentRequest(SceneWithChanges):
    """The scene to experiment on, with its changes and values."""

    initial: InitialValues = Field({})
    t_end: float = Field(SPAN, ge=SHORTEST, le=LONGEST, description="seconds of motion", examples=[10.0])
    lang: AskedLanguage = None
    fresh: bool = Field(
        default=False, description="whether to measure anew what was measured before, as Cache-Control: no-cache does"
    )

    model_config = examples({"scene": "pendulum"})


MethodIds = Annotated[Names, Field(description="methods of GET /methods; all if empty", examples=[["rk4", "dop853"]])]


class Chart(Answer):
    """A figure for Plotly, with what it shows and how that was measured."""

    id: str
    title: str
    subject: str = Field(description="scene and values")
    caption: str
    data: tuple[dict[str, Any], ...]
    layout: dict[str, Any]


class Measured(Answer):
    """When and under which circumstances times were measured."""

    date: str = Field(description="ISO 8601, UTC", examples=["2026-11-22T12:57:00+00:00"])
    load: float | None = Field(description="programs that wanted to run, mean of one minute, per processor")
    repetitions: int = Field(description="how often a run was measured at most")
    processors: int


class ExperimentAnswer(Answer):
    """What was found, as numbers and as charts. Members besides these depend on the experiment."""

    experiment: str = Field(examples=["work-precision"])
    scene: str
    t_end: float
    charts: tuple[Chart, ...]
    taken: Measured | None = Field(None, description="where the answer has times")
