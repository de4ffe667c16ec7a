"""Basins of attraction."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from ..base import Answer, Pair, examples
from ..experiment import SHORTEST, ExperimentAnswer, ExperimentRequest
from ..figure import Begin

LONGEST = 1000.0  # seconds of one motion
MOST_SECONDS = 250_000.0  # of all motions together
SCALES = 7  # distances at which neighbours of a start are looked at

LARGEST = 1e9  # where a map may begin or end
Quantity = Annotated[str, Field(max_length=80)]


class BasinSide(Answer):
    """What stands on a side of the map, and the starts along it."""

    quantity: str = Field(description="a coordinate, or dot of it: its rate", examples=["x"])
    values: tuple[float, ...]


class OrbitColumn(Answer):
    """One coordinate along a closed orbit."""

    values: tuple[float, ...]
    rates: tuple[float, ...]


class Attractor(Answer):
    """A motion that others come to: a rest, or one that repeats itself.

    That is after some periods of what drives the scene or, where nothing does, by itself: a limit cycle.
    """

    state: dict[str, Begin] = Field(description="where it is at the beginning of a period, by free coordinate")
    period: float | None = Field(description="seconds after which it repeats itself; null: a position of rest")
    orbit: dict[str, OrbitColumn] | None = Field(
        None, description="points of a limit cycle in their order, by free coordinate; null: it is none"
    )
    contraction: float = Field(description="what is left of a deviation after a second, at most: below 1")
    share: float = Field(description="the part of the starts that come to it")
    interval: Pair = Field(description="of that part: as if the starts were drawn at random")


class Neighbourhood(Answer):
    """How many starts have a neighbour at a distance that comes to another attractor."""

    distance: float = Field(description="over the sides of the map")
    uncertain: float = Field(description="the part of the starts")


class BoundaryDimension(Answer):
    """Of the boundary of the basins: 2 less the exponent α by which the part of uncertain starts falls, f ~ ε^α."""

    dimension: float
    interval: Pair
    exponent: float


class BasinsAnswer(ExperimentAnswer):
    """Which attractor each start of a plane comes to, and how fine the boundary is."""

    x: BasinSide
    y: BasinSide
    basins: tuple[tuple[int | None, ...], ...] = Field(
        description="row by row the number of the attractor; null: not known yet, −1: it came to none in time"
    )
    attractors: tuple[Attractor, ...]
    confidence: float
    driven: bool = Field(description="whether something drives the scene periodically")
    unsettled: float = Field(description="the part of the starts that came to no attractor in time, or ended early")
    unsure: float = Field(description="the part whose motion is not known well enough to tell")
    neighbourhoods: tuple[Neighbourhood, ...] = Field(description="empty until they are looked at")
    boundary: BoundaryDimension | None = Field(description="null: too few uncertain starts, or a single attractor")


class BasinsRequest(ExperimentRequest):
    """Where motions from a grid of starts end: attractors, their shares, and the dimension of the boundary."""

    experiment: ClassVar[str] = "basins"
    answer: ClassVar[type[ExperimentAnswer]] = BasinsAnswer

    t_end: float = Field(
        15.0, ge=SHORTEST, le=LONGEST, description="seconds of motion; what has not settled goes on, up to four times"
    )
    horizontal: Quantity = Field("", description="a coordinate, or dot(NAME) for its rate; empty: the first")
    vertical: Quantity = Field("", description="another one; empty: the next coordinate, or the rate of the only one")
    x_from: float | None = Field(
        None,
        ge=-LARGEST,
        le=LARGEST,
        description="where the map begins; if empty, the least value of the scene's slider",
    )
    x_to: float | None = Field(None, ge=-LARGEST, le=LARGEST, description="where it ends")
    y_from: float | None = Field(None, ge=-LARGEST, le=LARGEST, description="the same, upwards")
    y_to: float | None = Field(None, ge=-LARGEST, le=LARGEST, description="where it ends")
    count: int = Field(48, ge=8, le=150, description="starts on a side of the grid")
    pairs: int = Field(
        150, ge=0, le=1500, description=f"starts whose neighbours at {SCALES} distances are looked at; 0: none"
    )
    seed: int = Field(0, ge=0, le=2**31 - 1, description="of these starts")

    model_config = examples({"scene": "magnetic-pendulum", "count": 12, "pairs": 0, "t_end": 10.0})

    @property
    def runs(self) -> int:
        """How many motions are asked for."""
        return self.count**2 + self.pairs * (1 + 2 * SCALES)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        seconds = self.runs * self.t_end
        if seconds > MOST_SECONDS:
            told = {"runs": self.runs, "seconds": seconds, "most_seconds": MOST_SECONDS, "at": "/count"}
            raise PydanticCustomError("basins-too-large", "too large", told)
        return self
