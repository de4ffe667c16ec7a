"""What all requests and answers share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from ..vocabulary import Language
from .document import SceneReference

OF_KIND = "of kind "  # before the names of alternatives, which are no part of a place in a document


class Request(BaseModel):
    """A request body: unknown fields are mistakes, numbers are numbers, and finite."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


def examples(*bodies: dict[str, Any]) -> ConfigDict:
    """Bodies that the description of the API shows and that answer with 200."""
    return ConfigDict(json_schema_extra={"examples": list(bodies)})


class Answer(BaseModel):
    """An answer body; later versions may add fields."""

    # Few are ever checked: what does is built when the first one is, for the service waits while it begins.
    model_config = ConfigDict(extra="allow", frozen=True, defer_build=True)


def items(**bounds: Any) -> Any:
    """A field that is a list. Of its items the first that is wrong is told: each may be one of many."""
    return Field(strict=False, fail_fast=True, **bounds)


def outside(value: float, low: float, high: float) -> PydanticCustomError:
    """That a number is out of bounds that no schema can tell, since they depend on other fields."""
    return PydanticCustomError("request-outside", "out of bounds", {"value": value, "min": low, "max": high})


@dataclass(frozen=True)
class NotAbove:
    """The bound of a positive number by another field of the request, which is declared before it.

    `usual` is the bound where the other field cannot be read.
    """

    field: str
    usual: float

    def bound(self, document: Mapping[str, object]) -> float:
        """The largest value that a document leaves."""
        found = document.get(self.field)
        return float(found) if isinstance(found, int | float) and 0 < found <= self.usual else self.usual

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_after_validator_function(self._checked, handler(source))

    def _checked(self, value: float | None, info: ValidationInfo) -> float | None:
        most = info.data.get(self.field)
        if value is not None and most is not None and value > most:
            raise outside(value, 0.0, most)
        return value


Name = Annotated[str, Field(min_length=1, max_length=64)]
ExpressionText = Annotated[str, Field(min_length=1, max_length=2000)]
Pair = Annotated[tuple[float, ...], Field(min_length=2, max_length=2)]


class GuideChange(Request):
    """A coordinate made a given function of time."""

    coordinate: Name = Field(description="which one", examples=["y"])
    value: ExpressionText = Field(description="its function of time", examples=["y0*sin(omega*t)"])


class InitialValue(Request):
    """Value and rate of a coordinate at t = 0; what is left out is the scene's own."""

    value: float | None = Field(None, description="at t = 0", examples=[0.5])
    rate: float | None = Field(None, description="its derivative at t = 0", examples=[0.0])

    @property
    def given(self) -> dict[str, float]:
        """What is not left out."""
        return {name: value for name, value in (("value", self.value), ("rate", self.rate)) if value is not None}


Names = Annotated[tuple[Name, ...], items(max_length=32)]
Guides = Annotated[
    tuple[GuideChange, ...],
    items(max_length=32, description="coordinates to be made functions of time"),
]
Frozen = Annotated[Names, Field(description="coordinates to be held constant", examples=[[]])]
Released = Annotated[
    Names,
    Field(description="lengths, and coordinates guided or frozen, whose reactions are asked for", examples=[["l"]]),
]
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

    @property
    def given_guides(self) -> tuple[dict[str, str], ...]:
        """The guides as plain data."""
        return tuple({"coordinate": guide.coordinate, "value": guide.value} for guide in self.guides)


class SceneWithInitialValues(SceneWithChanges):
    """A scene with its changes, and where its motion begins."""

    initial: InitialValues = Field({})

    @property
    def given_initial(self) -> dict[str, dict[str, float]]:
        """What is given of the initial values, by coordinate."""
        return {name: one.given for name, one in self.initial.items()}
