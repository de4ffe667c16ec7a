"""Large scenes at random: particles in rings, chains, nets, held by rods or springs, rigid bodies on hinges, angles."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

Document = dict[str, Any]
GRAVITY = {"name": "g", "unit": "m/s^2", "value": 9.81}
MASS = {"name": "m", "unit": "kg", "value": 1.5}
LENGTH = {"name": "l", "unit": "m", "value": 1.0}


def document(dimension: int, coordinates: list[Document], bodies: list[Document], **parts: Any) -> Document:
    """A scene document of these parts, under gravity unless it has other loads."""
    down = ["0", "-g", "0"][:dimension]
    words = {"de": "Groß.", "en": "Large."}
    made = {
        "format": 1,
        "id": "large",
        "title": words,
        "summary": words,
        "dimension": dimension,
        "coordinates": coordinates,
        "parameters": [GRAVITY, MASS, LENGTH],
        "bodies": bodies,
        "loads": [{"kind": "gravity", "acceleration": down}],
        "drawing": {"elements": [{"kind": "bob", "at": bodies[0]["name"]}]},
    }
    return {**made, **parts}


def particles(count: int, dimension: int, source: random.Random) -> tuple[list[Document], list[Document]]:
    """Free particles and their coordinates."""
    axes = "xyz"[:dimension]
    places = [[source.uniform(-2.0, 2.0) for _ in axes] for _ in range(count)]
    coordinates = [
        {"name": f"{axis}{i}", "unit": "m", "value": place}
        for i, place_of in enumerate(places, 1)
        for axis, place in zip(axes, place_of, strict=True)
    ]
    bodies = [
        {"name": f"b{i}", "kind": "particle", "mass": "m", "position": [f"{axis}{i}" for axis in axes]}
        for i in range(1, count + 1)
    ]
    return coordinates, bodies


def rods(count: int, source: random.Random) -> Document:
    """A ring or an open chain of rods between free particles, of lengths of their own that they begin with."""
    dimension, is_closed = source.choice((2, 3)), source.random() < 0.5
    coordinates, bodies = particles(count, dimension, source)
    value = {each["name"]: each["value"] for each in coordinates}
    constraints, lengths = [], []
    for i in range(1, count + is_closed):
        j, axes = i % count + 1, "xyz"[:dimension]
        length = sum((value[f"{axis}{i}"] - value[f"{axis}{j}"]) ** 2 for axis in axes) ** 0.5
        lengths.append({"name": f"l{i}", "unit": "m", "value": length})
        constraints.append({"kind": "distance", "name": f"rod{i}", "from": f"b{i}", "to": f"b{j}", "length": f"l{i}"})
    parameters = [GRAVITY, MASS, *lengths]
    return document(dimension, coordinates, bodies, constraints=constraints, parameters=parameters)


def springs(count: int, source: random.Random) -> Document:
    """Particles on springs between neighbours."""
    coordinates, bodies = particles(count, 2, source)
    loads = [
        {"kind": "spring", "name": f"s{i}", "from": f"b{i}", "to": f"b{i + 1}", "stiffness": "k", "rest_length": "l"}
        for i in range(1, count)
    ]
    parameters = [MASS, LENGTH, {"name": "k", "unit": "N/m", "value": 3.0}]
    return document(2, coordinates, bodies, loads=loads, parameters=parameters)


def hinges(count: int, _: random.Random) -> Document:
    """Rigid bodies in the plane, each hinged to the end of the one before."""
    coordinates, bodies, constraints = [], [], []
    for i in range(1, count + 1):
        lengths = [{"name": f"x{i}", "unit": "m", "value": i - 0.5}, {"name": f"y{i}", "unit": "m", "value": 0.0}]
        coordinates += [*lengths, {"name": f"phi{i}", "unit": "rad", "value": 0.0}]
        own = {"name": f"b{i}", "kind": "rigid", "mass": "m", "inertia": "J", "angle": f"phi{i}"}
        bodies.append({**own, "position": [f"x{i}", f"y{i}"]})
        for axis, wave in ("x", "cos"), ("y", "sin"):
            before = f" - {axis}{i - 1} - l*{wave}(phi{i - 1})/2" if i > 1 else ""
            equation = f"{axis}{i} - l*{wave}(phi{i})/2{before}"
            constraints.append({"kind": "equation", "name": f"hinge{i}{axis}", "equation": equation})
    parameters = [GRAVITY, MASS, LENGTH, {"name": "J", "unit": "kg*m^2", "value": 0.2}]
    return document(2, coordinates, bodies, constraints=constraints, parameters=parameters)


def links(count: int, _: random.Random) -> Document:
    """A chain of links by their angles, without constraints."""
    coordinates = [{"name": f"phi{i}", "unit": "rad", "value": 0.1 * i} for i in range(1, count + 1)]
    bodies = []
    for i in range(1, count + 1):
        across, down = (" + ".join(f"l*{wave}(phi{k})" for k in range(1, i + 1)) for wave in ("sin", "cos"))
        bodies.append({"name": f"b{i}", "kind": "particle", "mass": "m", "position": [across, f"-({down})"]})
    return document(2, coordinates, bodies)


KINDS: dict[str, Callable[[int, random.Random], Document]] = {
    "rods": rods,
    "springs": springs,
    "hinges": hinges,
    "links": links,
}


def large_scene(kind: str, count: int, seed: int) -> Document:
    """A scene of `count` bodies, the same for the same seed."""
    return KINDS[kind](count, random.Random(seed))
