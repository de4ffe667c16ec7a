"""Scenes: the list, a document, and whether a document is valid."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field, WithJsonSchema

from .base import Answer
from .problem import ProblemEntry


class FamilyEntry(Answer):
    """The whole number that chooses the member of a family, its bounds and the usual value."""

    parameter: str = Field(examples=["n"])
    min: int
    max: int
    value: int


class SceneEntry(Answer):
    """A built-in scene in the list."""

    id: str = Field(examples=["elastic-pendulum"])
    title: dict[str, str] = Field(examples=[{"de": "Federpendel", "en": "Elastic pendulum"}])
    summary: dict[str, str] | None = Field(None, description="what the scene is about")
    degrees_of_freedom: int = Field(examples=[2])
    family: FamilyEntry | None = Field(None, description="of a chain: how many members it may have")


class SceneList(Answer):
    """The built-in scenes."""

    scenes: tuple[SceneEntry, ...]


class SceneValidity(Answer):
    """Whether a scene document describes a mechanical system."""

    valid: bool
    problems: tuple[ProblemEntry, ...]


class SceneText(Answer):
    """What a text in TOML says, as JSON."""

    scene: dict[str, Any]


EXAMPLE = {
    "format": 1,
    "id": "my-pendulum",
    "title": {"de": "Mein Pendel", "en": "My pendulum"},
    "summary": {"de": "Ein ebenes Pendel.", "en": "A plane pendulum."},
    "dimension": 2,
    "coordinates": [{"name": "phi", "unit": "rad", "value": 0.5, "rate": 0.0}],
    "parameters": [
        {"name": "m", "unit": "kg", "value": 1.0},
        {"name": "l", "latex": "\\ell", "unit": "m", "value": 1.0},
        {"name": "g", "unit": "m/s^2", "value": 9.81},
    ],
    "points": [{"name": "pivot", "position": ["0", "0"]}],
    "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["l*sin(phi)", "l*cos(phi)"]}],
    "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}],
}

TOML_EXAMPLE = """format = 1
id = "slide"
title = { de = "Perle auf dem Draht", en = "Bead on a wire" }
summary = { de = "Eine Perle rutscht.", en = "A bead slides." }
dimension = 2
coordinates = [{ name = "s", unit = "m" }]
parameters = [{ name = "m", unit = "kg" }, { name = "a" }, { name = "g", value = 9.81 }]
bodies = [{ name = "bead", kind = "particle", mass = "m", position = ["s*cos(a)", "-s*sin(a)"] }]
loads = [{ kind = "gravity", acceleration = ["0", "-g"] }]
"""

SceneDocument = Annotated[
    dict[str, Any],
    WithJsonSchema({"type": "object", "title": "Scene, format 1", "examples": [EXAMPLE]}),
]
