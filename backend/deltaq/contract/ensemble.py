"""Ensembles: one scene, many initial values or parameters, run together."""

from __future__ import annotations

from collections.abc import Mapping
from math import prod
from typing import Annotated, Literal, Self

from pydantic import ConfigDict, Discriminator, Field, Tag, model_validator
from pydantic_core import PydanticCustomError

from ..vocabulary import SectionStatus, Status
from .base import OF_KIND, Answer, AskedLanguage, ExpressionText, Request, SceneWithInitialValues, examples, items
from .experiments.poincare_section import Direction
from .simulation import LARGEST_SPAN, USUAL_TOLERANCE, Base64, Column, Written

MOST_RUNS = 100_000
MOST_SECONDS = 500_000.0  # of all motions together
MOST_NUMBERS = 20_000_000  # runs × samples
MOST_POINTS = 250_000  # in a section, of all motions together
LARGEST = 1e300  # of what values are made of: differences and sums of such numbers are numbers


class Evenly(Request):
    """Values evenly spaced, both ends included."""

    model_config = ConfigDict(serialize_by_alias=True)

    begin: float = Field(alias="from", ge=-LARGEST, le=LARGEST, description="the first", examples=[0.5])
    to: float = Field(ge=-LARGEST, le=LARGEST, description="the last", examples=[1.5])
    count: int = Field(ge=1, le=MOST_RUNS, description="how many", examples=[11])


class Drawn(Request):
    """Values drawn from a normal distribution; the same seed draws the same ones."""

    normal: Annotated[tuple[float, ...], items(min_length=2, max_length=2)] = Field(
        description="mean and standard deviation", examples=[[1.0, 0.01]]
    )
    count: int = Field(ge=1, le=MOST_RUNS, description="how many", examples=[100])
    seed: int = Field(0, ge=0, le=2**53, description="of the random numbers; each quantity has its own")


Listed = Annotated[tuple[float, ...], items(min_length=1, max_length=MOST_RUNS)]


def _kind(given: object) -> str:
    """Which of the three a value is meant to be: so only what is wrong with that one is told."""
    if isinstance(given, Mapping):
        return OF_KIND + ("drawn" if "normal" in given else "evenly")
    return OF_KIND + ("drawn" if isinstance(given, Drawn) else "evenly" if isinstance(given, Evenly) else "values")


Variation = Annotated[
    Annotated[Listed, Tag(OF_KIND + "values")]
    | Annotated[Evenly, Tag(OF_KIND + "evenly")]
    | Annotated[Drawn, Tag(OF_KIND + "drawn")],
    Discriminator(_kind),
]
Quantity = Annotated[str, Field(max_length=160)]
Statistic = Literal["mean", "quantiles", "density"]


class SectionRequest(Request):
    """Where points of all motions are asked for: where an expression passes zero."""

    value: ExpressionText = Field(
        description="of coordinates, rates (dot(q)), parameters and t; an angle by itself passes zero at every turn",
        examples=["phi1"],
    )
    direction: Direction = Field("rising", description="which way it goes through zero")
    points: int = Field(100, ge=1, le=20_000, description="of each motion, at most; the first ones")


class EnsembleRequest(SceneWithInitialValues):
    """A scene, and which of its initial values and parameters take which values."""

    t_end: float = Field(gt=0, le=LARGEST_SPAN, description="seconds", examples=[10.0])
    vary: dict[Quantity, Variation] = Field(
        min_length=1,
        max_length=16,
        description="values by quantity: initial.NAME.value, initial.NAME.rate or parameters.NAME",
        examples=[{"initial.phi.value": {"from": 0.5, "to": 1.5, "count": 5}}],
    )
    combine: Literal["grid", "together"] = Field(
        "grid", description="every value with every other, or the first of each, the second of each …"
    )
    samples: int = Field(51, ge=2, le=2001, description="number of samples, evenly spaced, both ends included")
    tolerance: float = Field(USUAL_TOLERANCE, ge=1e-13, le=1e-1, description="wanted error of the coordinates")
    statistics: Annotated[tuple[Statistic, ...], items(max_length=3)] = Field(
        (),
        description="over the runs that came so far: mean, quantiles at 5, 25, 50, 75 and 95 %, or their density",
        examples=[[]],
    )
    runs: bool = Field(default=True, description="whether the coordinates of every run are wanted")
    section: SectionRequest | None = Field(None, description="where points of all runs are asked for", examples=[None])
    columns: Written = Field("numbers", description="how arrays are written; base64: little-endian doubles")
    lang: AskedLanguage = None

    model_config = examples(
        {
            "scene": "pendulum",
            "t_end": 2.0,
            "samples": 3,
            "vary": {"initial.phi.value": [0.5, 1.0], "parameters.l": {"from": 0.5, "to": 1.0, "count": 2}},
        },
        {
            "scene": "double-pendulum",
            "t_end": 2.0,
            "samples": 3,
            "runs": False,
            "statistics": ["mean", "quantiles", "density"],
            "vary": {"initial.phi1.value": {"normal": [1.0, 0.01], "count": 40, "seed": 7}},
        },
        {
            "scene": "double-pendulum",
            "t_end": 5.0,
            "samples": 2,
            "vary": {"initial.phi1.value": [0.1, 0.2]},
            "section": {"value": "phi2", "direction": "both"},
        },
    )

    @property
    def count(self) -> int:
        """How many runs are asked for."""
        sizes = self._sizes
        return prod(sizes if self.combine == "grid" else sizes[:1])

    @property
    def _sizes(self) -> list[int]:
        """How many values each quantity takes."""
        return [len(one) if isinstance(one, tuple) else one.count for one in self.vary.values()]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.combine == "together" and len(set(self._sizes)) > 1:
            raise PydanticCustomError("ensemble-unlike", "unlike numbers of values", {"at": "/vary"})
        count = self.count
        told = {"at": "/vary", "runs": count, "seconds": count * self.t_end}
        bounds = {"most_runs": MOST_RUNS, "most_seconds": MOST_SECONDS, "most_numbers": MOST_NUMBERS}
        if count > MOST_RUNS or count * self.t_end > MOST_SECONDS or count * self.samples > MOST_NUMBERS:
            raise PydanticCustomError("ensemble-too-large", "too large", told | bounds)
        if self.section is not None and count * self.section.points > MOST_POINTS:
            told = {"at": "/section/points", "runs": count, "points": self.section.points, "most_points": MOST_POINTS}
            raise PydanticCustomError("ensemble-section-too-large", "too large", told)
        return self


class Quantiles(Answer):
    """At each sample, over the runs that reached it."""

    levels: tuple[float, ...] = Field(examples=[[0.05, 0.25, 0.5, 0.75, 0.95]])
    values: dict[str, tuple[Column, ...]] = Field(description="by coordinate, a column for each level")


class Density(Answer):
    """How the runs are spread over a coordinate at each sample: ∫ ρ dx = 1 over those that reached it."""

    edges: Column = Field(description="of intervals of the same width, in order; they hold all runs at all times")
    values: tuple[Column, ...] = Field(description="for each sample a column of ρ, an entry for each interval")


class SectionPoints(Answer):
    """Where each run passed the section: a column for each, in the order of time.

    A start that lies in the section counts. Points are as accurate as numbers allow, whatever the tolerance.
    """

    status: tuple[SectionStatus, ...] = Field(
        description="of the search along each run: never_met, contained (all of it lies in the section), full (it has "
        "more points than were asked for), or how the run ended before its time; see `reasons`",
        examples=[["ok", "never_met"]],
    )
    t: tuple[Column, ...] = Field(description="seconds")
    coordinates: dict[str, tuple[Column, ...]] = Field(description="by coordinate")
    rates: dict[str, tuple[Column, ...]] = Field(description="by coordinate")
    error: tuple[tuple[float | None, ...] | Base64, ...] = Field(
        description="of coordinates and rates, the largest: absolute below 1, relative above; null (packed, NaN) where "
        "a run grazes the section, so that a neighbour has no such point"
    )
    t_error: tuple[tuple[float | None, ...] | Base64, ...] = Field(description="seconds")


class EnsembleRuns(Answer):
    """What is told of each run."""

    quantities: dict[str, Column] = Field(description="the values of what varies, by run")
    status: tuple[Status, ...] = Field(description="of each run", examples=[["ok", "ok"]])
    reasons: dict[str, str] = Field(description="what each status that occurs means, and what to do")
    coordinates: dict[str, tuple[Column, ...]] | None = Field(None, description="by coordinate, a column for each run")
    error: tuple[float | None, ...] | Base64 = Field(
        description="largest estimated error of each run: absolute below 1, relative above; "
        "null (packed, NaN) of a run that came to no end"
    )
    steps: tuple[int, ...] = Field(description="of each run")
    section: SectionPoints | None = None
    columns: Written = "numbers"


class EnsembleBlock(EnsembleRuns):
    """Some runs of a stream, in their order: a `block` is told as soon as it is done, whatever its place."""

    first: int = Field(description="the number of the first of them, from 0", examples=[64])
    runs: int = Field(description="how many", examples=[64])
    of: int = Field(description="how many runs there are", examples=[1000])


class EnsembleTotals(Answer):
    """What is told of all runs together: in a stream, at its end."""

    runs: int
    t: Column
    reasons: dict[str, str] = Field(description="what each status that occurs means, and what to do")
    mean: dict[str, Column] | None = Field(None, description="over the runs, by coordinate")
    quantiles: Quantiles | None = None
    density: dict[str, Density] | None = Field(None, description="over time, by coordinate")
    columns: Written = "numbers"
    wall_time: float = Field(description="seconds")


class EnsembleAnswer(EnsembleRuns, EnsembleTotals):
    """All runs in the order of the values; of a grid the last quantity changes fastest."""
