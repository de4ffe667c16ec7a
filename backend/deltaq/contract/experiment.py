"""Experiments: what may be asked of any, and what belongs into every result.

What one of them asks and finds of its own stands in a file of `experiments/`; the file's name is the experiment's.
"""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import Field

from ..packages import classes_of
from ..vocabulary import TriedStatus
from .base import Answer, AskedLanguage, Names, SceneWithInitialValues, examples
from .figure import Begin, Chart

LONGEST = 1000.0  # seconds of motion
SHORTEST = 1e-6  # seconds; below it differences of times are lost in rounding


class Measured(Answer):
    """When and under which circumstances times were measured."""

    date: str = Field(description="ISO 8601, UTC", examples=["2026-11-22T12:57:00+00:00"])
    load: float | None = Field(description="programs that wanted to run, mean of one minute, per processor")
    repetitions: int = Field(description="how often a run was measured at most")
    processors: int


class ExperimentAnswer(Answer):
    """What was found, as numbers and as charts."""

    experiment: str = Field(examples=["work-precision"])
    scene: str
    title: dict[str, str] = Field(description="of the scene, by language")
    names: dict[str, str | dict[str, str]] = Field(description="how what the scene names is written; words by language")
    t_end: float = Field(description="seconds of motion")
    parameters: dict[str, float] = Field(description="their values")
    initial: dict[str, Begin] = Field(description="where the motion began, by free coordinate")
    charts: tuple[Chart, ...]
    taken: Measured | None = Field(None, description="where the answer has times")


class FreeAnswer(ExperimentAnswer):
    """What was found in coordinates that keep constraints by themselves, where the scene has some."""

    minimal: tuple[str, ...] = Field((), description="these coordinates, if they are not the scene's own")


class ExperimentRequest(SceneWithInitialValues):
    """The scene to experiment on, with its changes and values."""

    experiment: ClassVar[str]
    answer: ClassVar[type[ExperimentAnswer]] = ExperimentAnswer
    kernels: ClassVar[tuple[str, ...] | None] = None  # the methods, or ensembles, whose kernels it takes; None: of all

    t_end: float = Field(10.0, ge=SHORTEST, le=LONGEST, description="seconds of motion", examples=[10.0])
    lang: AskedLanguage = None
    fresh: bool = Field(
        default=False, description="whether to measure anew what was measured before, as Cache-Control: no-cache does"
    )

    model_config = examples({"scene": "pendulum"})


def request_of(identifier: str) -> type[ExperimentRequest]:
    """What the experiment of this id is asked; `answer` of it is what it finds."""
    found: type[ExperimentRequest] = classes_of("deltaq.contract.experiments", "experiment")[identifier]
    return found


MethodIds = Annotated[Names, Field(description="methods of GET /methods; all if empty", examples=[["rk4", "dop853"]])]


class ReferenceMotion(Answer):
    """The motion that errors were measured against: two unlike methods of high order agree on it."""

    methods: tuple[str, ...]
    error: float = Field(description="in the measure of a tolerance: absolute below 1, relative above")
    t: float = Field(description="how far it is known, in seconds")
    complete: bool = Field(description="whether that is the whole span")


class MethodRun(Answer):
    """One run of a method; it was steered by a tolerance or by a step."""

    method: str
    tolerance: float | None = Field(None, description="local tolerance of variable steps")
    step: float | None = Field(None, description="fixed step in seconds")
    status: TriedStatus
    error: float | None = Field(description="largest of any coordinate: absolute below 1, relative above")
    evaluations: int = Field(description="of the right-hand side")
    steps: int
    time: float = Field(description="seconds, the median of the repeated runs")
    times: tuple[float, ...] = Field(description="seconds of each of them, ascending")
    preparation: float | None = Field(
        None, description="seconds before, in which code was compiled for these equations and this tolerance; of heyoka"
    )


class Machine(Answer):
    """What the times were measured on."""

    processor: str
    cores: int
