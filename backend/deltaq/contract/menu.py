"""What may be asked of the experiments, for pages that ask it: read from the declarations of the requests."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal

from pydantic import Field

from .base import Answer, SceneWithInitialValues
from .experiment import ExperimentRequest

KINDS: Mapping[str, Literal["number", "tick"]] = {"number": "number", "integer": "number", "boolean": "tick"}
OF_ALL = {*SceneWithInitialValues.model_fields, "lang", "fresh"}


class OptionEntry(Answer):
    """A field of the request that holds a number, a yes or no, or one of a few words."""

    name: str = Field(examples=["t_end"])
    kind: Literal["number", "tick", "choice"]
    description: str
    default: float | bool | str | None = Field(description="null where it may be left out and has no single value")
    min: float | None = Field(None, description="of a number")
    max: float | None = Field(None, description="of a number")
    choices: tuple[str, ...] = Field((), description="the words, of a choice")


class ExperimentEntry(Answer):
    """An experiment by its id, the last part of its address."""

    id: str = Field(examples=["work-precision"])
    description: str
    options: tuple[OptionEntry, ...]


class ExperimentList(Answer):
    """All experiments."""

    experiments: tuple[ExperimentEntry, ...]


def options_of(request: type[ExperimentRequest]) -> Iterator[OptionEntry]:
    """What such a request may say besides its scene, in the order of its fields; lists and objects are left out."""
    schema = request.model_json_schema()
    for name, field in schema["properties"].items():
        kinds = [_resolved(one, schema) for one in field.get("anyOf", [field])]
        told = [one for one in kinds if one.get("type") != "null"]
        if name not in OF_ALL and len(told) == 1:
            yield from _option(name, field, told[0])


def _resolved(node: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """The node itself, or the definition to which it refers."""
    found: dict[str, Any] = schema["$defs"][node["$ref"].rpartition("/")[2]] if "$ref" in node else node
    return found


def _option(name: str, field: dict[str, Any], kind: dict[str, Any]) -> Iterator[OptionEntry]:
    """The option, if it is of a kind that can be offered; whether a bound is open, the service says when it is hit."""
    told = {"name": name, "description": field.get("description", ""), "default": field.get("default")}
    if "enum" in kind:
        yield OptionEntry(**told, kind="choice", choices=tuple(kind["enum"]))
    elif kind.get("type") in KINDS:
        low, high = (kind.get(side, kind.get(f"exclusive{side.title()}")) for side in ("minimum", "maximum"))
        yield OptionEntry(**told, kind=KINDS[kind["type"]], min=low, max=high)
