"""What all requests and answers share."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from ..vocabulary import Language
from .document import SceneReference


class Request(BaseModel):
    """A request body: unknown fields are mistakes, numbers are numbers, and finite."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


def examples(*bodies: dict[str, Any]) -> ConfigDict:
    """Bodies that the description of the API shows and that answer with 200."""
    return ConfigDict(json_schema_extra={"examples": list(bodies)})


class Answer(BaseModel):
    """An answer body; later versions may add fields."""

    model_config = ConfigDict(extra="allow", frozen=True)


def items(**bounds: Any) -> Any:
    """A field that is a list. Of its items the first that is wrong is told: each may be one of many."""
    return Field(strict=False, fail_fast=True, **bounds)


Name = Annotated[str, Field(min_length=1, max_length=64)]
ExpressionText = Annotated[str, Field(min_length=1, max_length=2000)]


class GuideChange(Request):
    """A coordinate made a given function of time."""

    coordinate: Name = Field(description="which one", examples=["y"])
    value: ExpressionText = Field(description="its function of time", examples=["y0*sin(omega*t)"])


class InitialValue(Request):
    """Value and rate of a coordinate at t = 0; what is left out is the scene's own."""

    value: float | None = Field(None, description="at t = 0", examples=[0.5])
    rate: float | None = Field(None, description="its derivative at t = 0", examples=[0.0])


Names = Annotated[tuple[Name, ...], items(max_length=32)]
Guides = Annotated[
    tuple[GuideChange, ...],
    items(max_length=32, description="coordinates to be made functions of time"),
]
Frozen = Annotated[Names, Field(description="coordinates to be held constant", examples=[[]])]
Values = Annotated[dict[Name, float], Field(max_length=256, description="values of parameters", examples=[{"l": 0.8}])]
InitialValues = Annotated[
    dict[Name, InitialValue],
    Field(max_length=64, description="where the motion begins, by coordinate", examples=[{"phi": {"value": 0.5}}]),
]
Syntax = Annotated[Literal["plain", "latex"], Field(description="how it is written")]
AskedLanguage = Annotated[Language | None, Field(description="language of the texts; else Accept-Language decides")]


class SceneWithChanges(Request):
    """A scene, and what is changed in it before it is used."""

    scene: SceneReference
    guides: Guides = ()
    freeze: Frozen = ()
    parameters: Values = Field({})
