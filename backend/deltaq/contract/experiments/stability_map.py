"""Stability of the motion: what may be asked."""

from __future__ import annotations

from typing import ClassVar

from pydantic import ConfigDict, Field

from ..bounds import MAP_POINTS, USUAL_MAP
from ..base import Name, Request, examples
from ..experiment import ExperimentRequest


class MapAxis(Request):
    """A parameter and its range."""

    parameter: Name = Field(description="of the scene", examples=["omega"])
    start: float = Field(alias="from", description="its least value", examples=[20.0])
    to: float = Field(description="its largest value", examples=[120.0])
    count: int = Field(USUAL_MAP, ge=MAP_POINTS[0], le=MAP_POINTS[1], description="points on this side")

    model_config = ConfigDict(serialize_by_alias=True)


class StabilityMapRequest(ExperimentRequest):
    """Floquet multipliers over two parameters of a scene that something drives periodically."""

    experiment: ClassVar[str] = "stability-map"

    x: MapAxis = Field(description="to the right")
    y: MapAxis = Field(description="upwards")

    model_config = examples(
        {
            "scene": "kapitza",
            "x": {"parameter": "omega", "from": 20.0, "to": 120.0, "count": 12},
            "y": {"parameter": "y0", "from": 0.05, "to": 0.3, "count": 12},
        }
    )
