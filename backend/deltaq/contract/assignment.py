"""Assignments, format 1, as files and in requests; `homework/assignment.py` looks whether scenes have the tasks."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, date, datetime
from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    Field,
    GetJsonSchemaHandler,
    ValidationError,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from .base import Request, SceneWithChanges
from .document import Text

FOLLOW_THROUGH = 0.5  # share of the points for what follows from a wrong line
SIMPLIFIED = 0.5  # share of those where the mistake made it easier
MOST_TASKS = 64
MOST_ATTEMPTS = 1000
LONGEST_TIME = 40  # signs
# What differs from student to student: parameter values; the axes, and the side it is seen from; from where coordinates
# count, and in which sense; quantities that are multiples of their letters.
Aspect = Literal["values", "axes", "coordinates", "factors"]
USUAL: tuple[Aspect, ...] = ("values",)
VARY = Field(
    USUAL,
    strict=False,
    max_length=4,
    description="what differs from student to student: values of parameters, axes, how coordinates count, factors",
    examples=[["values", "axes", "coordinates", "factors"]],
)
NEEDED = ("scene", "task")


def _told_as(
    code: Literal[
        "assignment-format", "assignment-share", "assignment-time", "assignment-attempts", "request-not-number"
    ],
    **told: Any,
) -> WrapValidator:
    """Whatever is wrong with the value is told by one sentence."""

    def check(value: Any, validate: ValidatorFunctionWrapHandler) -> Any:
        try:
            return validate(value)
        except ValidationError:
            raise PydanticCustomError(code, code, told) from None

    return WrapValidator(check)


def instant(written: str) -> datetime:
    """A time of ISO 8601 (2026-11-30T23:59+01:00); without an offset it is UTC. Raises ValueError."""
    found = datetime.fromisoformat(written.strip())
    return found if found.tzinfo else found.replace(tzinfo=UTC)


def _instant_text(given: Any) -> str:
    """TOML has times of its own."""
    written = given.isoformat() if isinstance(given, date) else given
    if not isinstance(written, str) or len(written) > LONGEST_TIME:
        raise ValueError("no time")
    instant(written)
    return written


def _by_language(title: Any) -> Any:
    """By language; a title without one is for all."""
    if isinstance(title, Mapping):
        return title
    if not isinstance(title, str):
        raise PydanticCustomError("request-not-text", "a text, or one by language")
    return dict.fromkeys(("en", "de"), title) if title else {}


def _are_some(tasks: Any) -> Any:
    if isinstance(tasks, list | tuple) and tasks:
        return tasks
    raise PydanticCustomError("assignment-no-task", "a list of tasks")


ABOUT = ("title", "description", "default", "examples")


class _NullIsNothing(Request):
    """A document of which every field that may be left out may be null as well."""

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        named = handler(core)
        schema = handler.resolve_ref_schema(named)
        for name, field in schema["properties"].items():
            if name in schema["required"] or {"type": "null"} in field.get("anyOf", ()):
                continue
            kinds = {key: field.pop(key) for key in [*field] if key not in ABOUT}
            field["anyOf"] = [*(kinds.get("anyOf") or [kinds]), {"type": "null"}]
            if field.get("default") == {}:
                field["default"] = None  # as good as an empty object, which generators cannot tell the type of
        return named


class AssignedTaskDocument(_NullIsNothing, SceneWithChanges):
    """A task of an assignment, and what is changed in its scene before."""

    task: str = Field(description="a task of the scene by its id", examples=["equation:phi"])
    points: Annotated[float | None, Field(ge=0, le=1000), _told_as("request-not-number")] = Field(
        None, description="as usual if empty"
    )

    @model_validator(mode="before")
    @classmethod
    def _in_order(cls, document: Any) -> Any:
        """Unknown fields are told by name; a field that is null was not given."""
        if not isinstance(document, Mapping):
            return document
        return {name: value for name, value in sorted(document.items()) if value is not None or name in NEEDED}


class AssignmentDocument(_NullIsNothing):
    """An assignment, format 1."""

    format: Annotated[int, Field(ge=1, le=1), _told_as("assignment-format", format=1)] = Field(
        description="of the document"
    )
    title: Annotated[dict[str, str], BeforeValidator(_by_language, json_schema_input_type=Text | None)] = Field(
        {}, description="what the assignment is called"
    )
    individual: bool = Field(default=False, description="whether each student has tasks of their own")
    vary: tuple[Aspect, ...] = VARY
    follow_through: Annotated[float, Field(ge=0, le=1), _told_as("assignment-share")] = Field(
        FOLLOW_THROUGH, description="share of the points for a right consequence"
    )
    simplified: Annotated[float, Field(ge=0, le=1), _told_as("assignment-share")] = Field(
        SIMPLIFIED, description="share of what a right consequence earns, where the mistake before it made it easier"
    )
    deadline: Annotated[str | None, BeforeValidator(_instant_text), _told_as("assignment-time")] = Field(
        None, description="when it is to be handed in (ISO 8601, UTC without an offset)"
    )
    late: Annotated[float, Field(ge=0, le=1), _told_as("assignment-share")] = Field(
        0.0, description="share of the points that an answer earns after the deadline"
    )
    attempts: Annotated[int | None, Field(ge=1, le=MOST_ATTEMPTS), _told_as("assignment-attempts")] = Field(
        None, description="how many different answers of a person to a task count, the first ones; all if empty"
    )
    tasks: Annotated[
        tuple[AssignedTaskDocument, ...], Field(strict=False, max_length=MOST_TASKS), BeforeValidator(_are_some)
    ] = Field(description="one after the other")

    @model_validator(mode="before")
    @classmethod
    def _in_order(cls, document: Any) -> Any:
        """What is missing is told as what is wrong there, and unknown fields by name; null is as good as nothing."""
        if not isinstance(document, Mapping):
            return document
        given = {name: value for name, value in sorted(document.items()) if value is not None}
        return {"format": None, "tasks": None} | given
