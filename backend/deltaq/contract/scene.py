"""Scenes: the list, a document, and whether a document is valid."""

from __future__ import annotations

from pydantic import Field

from .base import Answer
from .document import GivenScene
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

    scene: GivenScene


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
