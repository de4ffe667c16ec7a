"""Bifurcation diagrams."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from ...vocabulary import Status
from ..base import Answer, examples
from ..experiment import SHORTEST, ExperimentAnswer, ExperimentRequest
from ..figure import Begin
from .poincare_section import LONGEST, Asked, Direction
from .stability_map import MapAxis

MOST_PASSAGES = 400_000  # of both sweeps together, those that are left out included
MOST_FOLDS = 32

Kind = Literal["period-doubling", "saddle-node", "branching", "torus"]


class Visit(Answer):
    """One value of the parameter, and what is seen there after the motion has settled."""

    value: float = Field(description="of the parameter")
    status: Status = Field(description="ok, or how the motion ended before its time")
    folds: int = Field(description="after so many periods or passages it repeats; 0: after none of those looked at")
    seen: tuple[float, ...] = Field(
        description="values of the vertical expression, in their order; of one round if it repeats"
    )
    initial: dict[str, Begin] | None = Field(description="where the motion shown begins; null where it ended before")


class PeriodicMotion(Answer):
    """A periodic motion on a branch, stable or not."""

    value: float = Field(description="of the parameter")
    stable: bool = Field(description="whether no |μ| exceeds 1")
    growth: float = Field(description="the largest |μ|")
    period: float = Field(description="seconds until it closes")
    seen: tuple[float, ...]
    initial: dict[str, Begin]


class OrbitBranch(Answer):
    """Periodic motions that follow one another."""

    folds: int = Field(description="periods or passages until a motion closes")
    motions: tuple[PeriodicMotion, ...]


class FoundBifurcation(Answer):
    """Where a branch changes its character."""

    kind: Kind = Field(description="μ = −1, μ = 1 where the branch turns back, μ = 1 at a crossing, |μ| = 1 complex")
    value: float = Field(description="of the parameter")
    error: float = Field(description="of that value, estimated by a second search with other differences")
    folds: int = Field(description="of the branch that it is on")
    branch: int = Field(description="the number of that branch, from 0")
    period: float = Field(description="seconds until the motion there closes")
    multipliers: tuple[tuple[float, float], ...] = Field(description="μ, real and imaginary part; the largest first")
    seen: tuple[float, ...]
    initial: dict[str, Begin]


class Span(Answer):
    """A stretch of the parameter's values."""

    start: float
    end: float


class BifurcationAnswer(ExperimentAnswer):
    """What is seen over a parameter, swept up and down, with branches of periodic motions."""

    parameter: str = Field(description="what is swept", examples=["gamma"])
    driven: bool = Field(description="whether it is looked at once in each period of a drive")
    period: float | None = Field(description="that of the drive at the first value, in seconds; null without a drive")
    plane: str = Field(description="the expression that is zero where it is looked at; empty: by the period alone")
    direction: Direction
    vertical: str = Field(description="the expression that is seen", examples=["phi"])
    up: tuple[Visit, ...] = Field(description="with growing values, each begun where the one before ended")
    down: tuple[Visit, ...] = Field(description="the same with falling values")
    hysteresis: tuple[Span, ...] = Field(description="where both sweeps see different motions")
    branches: tuple[OrbitBranch, ...]
    bifurcations: tuple[FoundBifurcation, ...]
    feigenbaum: tuple[float, ...] = Field(description="of doublings in a row: quotients of neighbouring distances")
    complete: bool = Field(description="whether all branches that were found have been followed")
    points: int = Field(description="of both sweeps")
    extent: float = Field(description="the height of the picture")


class BifurcationRequest(ExperimentRequest):
    """Which motions a scene settles to while a parameter grows, and where they change."""

    experiment: ClassVar[str] = "bifurcation"
    answer: ClassVar[type[ExperimentAnswer]] = BifurcationAnswer
    kernels: ClassVar[tuple[str, ...] | None] = ("ensembles",)

    t_end: float = Field(2000.0, ge=SHORTEST, le=LONGEST, description="seconds at each value, at most")
    sweep: MapAxis = Field(description="the parameter, from where to where, and how many values", examples=[])
    period: Asked = Field(
        "", description="of the drive, an expression of parameters in seconds; empty: that of the scene", examples=[""]
    )
    plane: Asked = Field(
        "",
        description="an expression of coordinates, rates (dot(q)) and t that is zero where it is looked at; dot(q) "
        "gives extrema; empty: once in each period of the drive, or at maxima of the first coordinate",
        examples=[""],
    )
    direction: Direction = Field("falling", description="which way the plane is passed; falling rates are maxima")
    vertical: Asked = Field("", description="an expression that is seen; empty: the first coordinate")
    crossings: int = Field(48, ge=1, le=2000, description="periods, or passages, that are shown at each value")
    skip: int = Field(100, ge=0, le=10_000, description="periods, or passages, before them: until it has settled")
    orbits: bool = Field(default=True, description="whether periodic motions are followed, with their bifurcations")
    folds: int = Field(8, ge=1, le=MOST_FOLDS, description="periods after which a motion closes, at most")

    model_config = examples(
        {
            "scene": "driven-pendulum",
            "sweep": {"parameter": "gamma", "from": 1.06, "to": 1.08, "count": 8},
            "crossings": 8,
            "skip": 20,
            "folds": 2,
        }
    )

    @property
    def passages(self) -> int:
        """How many periods are asked for, all in all."""
        return 2 * self.sweep.count * (self.crossings + self.skip)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.passages > MOST_PASSAGES:
            told = {"passages": self.passages, "most_passages": MOST_PASSAGES, "at": "/sweep/count"}
            raise PydanticCustomError("bifurcation-too-large", "too large", told)
        return self
