"""What all wire models share."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, WithJsonSchema
from pydantic_core import PydanticCustomError


class Request(BaseModel):
    """A request body: unknown fields are mistakes, numbers are numbers, and finite."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


def examples(*bodies: dict[str, Any]) -> ConfigDict:
    """Bodies that the description of the API shows and that answer with 200."""
    return ConfigDict(json_schema_extra={"examples": list(bodies)})


class Answer(BaseModel):
    """An answer body; later versions may add fields."""

    model_config = ConfigDict(extra="allow", frozen=True)


def _scene(value: Any) -> Any:
    if isinstance(value, (str, dict)):
        return value
    raise PydanticCustomError("request-scene-type", "a scene is given by its id or as a document")


SceneReference = Annotated[
    Any,
    AfterValidator(_scene),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "string", "description": "id of a built-in scene", "maxLength": 64},
                {"type": "object", "description": "scene document, format 1"},
            ]
        }
    ),
    Field(description="a built-in scene by its id, or a scene document of format 1", examples=["elastic-pendulum"]),
]
Name = Annotated[str, Field(min_length=1, max_length=64)]
ExpressionText = Annotated[str, Field(min_length=1, max_length=2000)]


class GuideChange(Request):
    """A coordinate made a given function of time."""

    coordinate: Name = Field(examples=["y"])
    value: ExpressionText = Field(examples=["y0*sin(omega*t)"])


Guides = Annotated[tuple[GuideChange, ...], Field(strict=False, max_length=32)]
Names = Annotated[tuple[Name, ...], Field(strict=False, max_length=32)]
Values = Annotated[dict[Name, float], Field(max_length=256)]
