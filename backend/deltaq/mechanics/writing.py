"""Writing scenes: the document of format 1, as plain data for JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields

from ..language.expression import Expression
from .bodies import Body
from .constraints import Constraint
from .coordinate import Coordinate
from .document import FORMAT
from .event import Event
from .guide import Guide
from .loads import Load
from .material import Material
from .parameter import Parameter
from .point import Point
from .scene import Scene
from .user_text import UserText, plainly


def write_scene(scene: Scene) -> dict[str, object]:
    """The document of a scene, as plain data for JSON."""
    drawing = {
        "vertical": scene.drawing.vertical,
        "view": list(scene.drawing.view) if scene.drawing.view else None,
        "elements": [element.write() for element in scene.drawing.elements],
    }
    return {
        "format": FORMAT,
        "id": scene.id,
        "title": plainly(scene.title),
        "summary": plainly(scene.summary),
        "dimension": scene.dimension,
        "coordinates": [_write(thing) for thing in scene.coordinates],
        "parameters": [_write(thing) for thing in scene.parameters],
        "points": [_write(thing) for thing in scene.points],
        "bodies": [_write(thing) for thing in scene.bodies],
        "loads": [_write(thing) for thing in scene.loads],
        "guides": [_write(thing) for thing in scene.guides],
        **({"constraints": [_write(thing) for thing in scene.constraints]} if scene.constraints else {}),
        **({"events": [_write(thing) for thing in scene.events]} if scene.events else {}),
        "labels": {name: plainly(label) for name, label in scene.labels.items()},
        "drawing": {key: value for key, value in drawing.items() if value is not None},
    }


def _write(thing: Coordinate | Parameter | Point | Body | Load | Guide | Constraint | Event) -> dict[str, object]:
    kind = {"kind": thing.kind} if hasattr(thing, "kind") else {}
    values = {item.metadata.get("key", item.name): getattr(thing, item.name) for item in fields(thing)}  # type: ignore[arg-type]
    return kind | {key: _plain(value) for key, value in values.items() if value is not None}


def _plain(value: object) -> object:
    if isinstance(value, Expression):
        return value.text
    if isinstance(value, Material):
        return value.write()
    if isinstance(value, UserText):
        return value.plain
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
