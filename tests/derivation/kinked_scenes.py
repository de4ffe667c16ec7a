"""Scenes whose forces jump or stick: one particle in a plane or on a line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene


def potential(energy: str) -> dict[str, object]:
    return {"kind": "potential", "energy": energy}


def friction(force: str, coordinate: str = "x", **more: str) -> dict[str, object]:
    return {"kind": "friction", "coordinate": coordinate, "force": force, **more}


def wall(value: str, name: str = "wall") -> dict[str, object]:
    return {"name": name, "value": value, "then": "bounce", "restitution": "1/2"}


def document(
    loads: Sequence[Mapping[str, object]],
    values: Mapping[str, float],
    events: Sequence[Mapping[str, object]] = (),
    position: Sequence[str] = ("x", "0"),
    coordinates: Sequence[str] = ("x",),
) -> dict[str, Any]:
    """A particle of 1 kg with these coordinates; parameters may be negative."""
    numbers = {"m": 1.0, "g": 9.81, **values}
    return {
        "format": 1, "id": "kinked", "title": "kinked", "dimension": 2,
        "coordinates": [{"name": name, "value": 0.3} for name in coordinates],
        "parameters": [{"name": name, "value": value, "positive": False} for name, value in numbers.items()],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": list(position)}],
        "loads": [{"name": f"load{k}", **load} for k, load in enumerate(loads)], "events": list(events),
    }  # fmt: skip


def line(*loads: Mapping[str, object], events: Sequence[Mapping[str, object]] = (), **values: float) -> Scene:
    return read_scene(document(loads, values, events))


def plane(*loads: Mapping[str, object], events: Sequence[Mapping[str, object]] = (), **values: float) -> Scene:
    return read_scene(document(loads, values, events, ("x", "y"), ("x", "y")))


def swinging(*loads: Mapping[str, object], **values: float) -> Scene:
    """A pendulum of 1 m that hangs at φ = 0."""
    position = ("l*sin(x)", "-l*cos(x)")
    weight = {"kind": "gravity", "acceleration": ["0", "-g"]}
    return read_scene(document((weight, *loads), {"l": 1.0, **values}, (), position))
