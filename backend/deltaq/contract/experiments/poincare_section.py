"""Poincaré sections."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from ...vocabulary import Status
from ..base import Answer, examples
from ..experiment import SHORTEST, ExperimentAnswer, ExperimentRequest, FreeAnswer
from ..figure import Begin

LONGEST = 10_000.0  # seconds of one motion
MOST_SECONDS = 200_000.0  # of all motions together
MOST_POINTS = 100_000

Direction = Literal["rising", "falling", "both"]
Asked = Annotated[str, Field(max_length=2000)]


class Orbit(Answer):
    """A motion by the points at which it crosses the plane, in their order."""

    initial: dict[str, Begin] = Field(description="where it begins, by free coordinate")
    own: bool = Field(description="whether that is the start of the scene")
    status: Status = Field(description="ok, horizon_reached, or how the motion ended before its time")
    chaotic: bool | None = Field(description="whether it loses its digits exponentially; null: too few points to tell")
    horizon: float | None = Field(description="seconds after which its points are no longer those of this motion")
    t: tuple[float, ...] = Field(description="seconds")
    x: tuple[float, ...]
    y: tuple[float, ...]
    error: tuple[float, ...] = Field(description="of each point: absolute below 1, relative above")


class PoincareSectionAnswer(FreeAnswer):
    """Orbits by their points in the plane, with what is known of their accuracy."""

    plane: str = Field(description="the expression that is zero there", examples=["phi1"])
    direction: Direction
    horizontal: str = Field(description="the expression on the first axis", examples=["phi2"])
    vertical: str = Field(description="the expression on the second axis", examples=["dot(phi2)"])
    driven: bool = Field(description="whether something drives the scene: then no energy is kept")
    energy: float | None = Field(description="of all orbits, where it is kept")
    orbits: tuple[Orbit, ...]
    points: int = Field(description="of all orbits")
    forbidden: int = Field(description="starts of the grid that would need more energy")
    unsolved: int = Field(description="starts of the grid for which no state in the plane was found")
    behind: int = Field(description="starts of the grid that lie behind a contact")
    missed: int = Field(description="orbits that never cross the plane")
    sharp: int = Field(description="points whose error is at most 1e-10")
    kept: float | None = Field(description="how far the energy before the horizons is from that wanted, in parts of it")
    regular: float | None = Field(description="the part of the grid whose orbits are not chaotic")
    extent: float = Field(description="the larger side of the picture")


class PoincareSectionRequest(ExperimentRequest):
    """Where motions cross a plane in phase space: a grid of starts at one energy, or the phases of a drive."""

    experiment: ClassVar[str] = "poincare-section"
    answer: ClassVar[type[ExperimentAnswer]] = PoincareSectionAnswer
    kernels: ClassVar[tuple[str, ...] | None] = ()

    t_end: float = Field(200.0, ge=SHORTEST, le=LONGEST, description="seconds of each motion, at most")
    plane: Asked = Field(
        "",
        description="an expression of coordinates, rates (dot(q)) and t that is zero in the plane; empty: the first "
        "coordinate that changes its sign, or the phase of the drive",
        examples=["phi1"],
    )
    direction: Direction = Field("rising", description="which way the expression goes through zero")
    horizontal: Asked = Field("", description="an expression for the first axis; empty: the next coordinate")
    vertical: Asked = Field("", description="an expression for the second axis; empty: the rate of that coordinate")
    energy: float | None = Field(None, description="of all starts; if empty, that of the scene's own start")
    count: int = Field(6, ge=0, le=64, description="starts on a side of the grid, besides the scene's own start")
    crossings: int = Field(80, ge=1, le=20_000, description="points of an orbit, at most")
    skip: int = Field(0, ge=0, le=10_000, description="first points of each orbit that are left out: a transient")
    beyond: bool = Field(default=True, description="whether points after the horizon of an orbit are shown, marked")

    model_config = examples(
        {
            "scene": "double-pendulum",
            "initial": {"phi1": {"value": 0.4}, "phi2": {"value": 0.4}},
            "t_end": 20.0,
            "count": 2,
            "crossings": 10,
        },
        {"scene": "kapitza", "t_end": 1.0, "count": 2, "crossings": 10},
    )

    @property
    def runs(self) -> int:
        """How many motions are asked for."""
        return self.count**2 + 1

    @model_validator(mode="after")
    def _fits(self) -> Self:
        points, seconds = self.runs * (self.crossings + self.skip), self.runs * self.t_end
        if points > MOST_POINTS or seconds > MOST_SECONDS:
            told = {"runs": self.runs, "seconds": seconds, "points": points, "at": "/count"}
            bounds = {"most_points": MOST_POINTS, "most_seconds": MOST_SECONDS}
            raise PydanticCustomError("section-too-large", "too large", told | bounds)
        return self
