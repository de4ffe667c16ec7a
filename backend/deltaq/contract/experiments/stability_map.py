"""Stability of the motion."""

from __future__ import annotations

from typing import ClassVar

from pydantic import ConfigDict, Field, ValidationInfo, field_validator

from ..base import Answer, Name, Request, examples, outside
from ..experiment import ExperimentAnswer, ExperimentRequest, FreeAnswer

LARGEST = 1e9  # value of a parameter
FEWEST_VALUES = 8  # of a parameter


class MapAxis(Request):
    """A parameter and its range."""

    parameter: Name = Field(description="of the scene", examples=["omega"])
    start: float = Field(alias="from", description="its least value", examples=[20.0])
    to: float = Field(description="its largest value", examples=[120.0])
    count: int = Field(200, ge=FEWEST_VALUES, le=400, description="points on this side")

    model_config = ConfigDict(serialize_by_alias=True)

    @field_validator("start", "to")
    @classmethod
    def _is_moderate(cls, value: float) -> float:
        if abs(value) > LARGEST:
            raise outside(value, -LARGEST, LARGEST)
        return value

    @field_validator("to")
    @classmethod
    def _comes_after(cls, to: float, info: ValidationInfo) -> float:
        start = info.data.get("start")
        if start is not None and not start < to:
            raise outside(to, start, LARGEST)
        return to


class MapSide(Answer):
    """A parameter and its values along a side of the map."""

    parameter: str
    values: tuple[float, ...]


class StabilityMapAnswer(FreeAnswer):
    """The largest Floquet multiplier at each point of a plane."""

    x: MapSide
    y: MapSide
    growth: tuple[tuple[float | None, ...], ...] = Field(description="|μ|, row by row; null where there is none")
    stable: float = Field(description="the part of the plane where nothing grows")
    time: float = Field(description="seconds that the map took")


class StabilityMapRequest(ExperimentRequest):
    """Floquet multipliers over two parameters of a scene that something drives periodically."""

    experiment: ClassVar[str] = "stability-map"
    answer: ClassVar[type[ExperimentAnswer]] = StabilityMapAnswer
    kernels: ClassVar[tuple[str, ...] | None] = ("dop853",)

    x: MapAxis = Field(description="to the right")
    y: MapAxis = Field(description="upwards")

    model_config = examples(
        {
            "scene": "kapitza",
            "x": {"parameter": "omega", "from": 20.0, "to": 120.0, "count": 12},
            "y": {"parameter": "y0", "from": 0.05, "to": 0.3, "count": 12},
        }
    )
