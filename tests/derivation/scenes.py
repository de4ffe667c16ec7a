"""Scenes that only tests need, beside the library's."""

from __future__ import annotations

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene


def chain(n: int) -> Scene:
    """A pendulum of n links under gravity, angles against the vertical."""
    angles = [f"phi{i}" for i in range(1, n + 1)]

    def position(i: int, function: str) -> str:
        return " + ".join(f"l*{function}({angle})" for angle in angles[:i])

    bodies = [
        {"name": f"bob{i}", "kind": "particle", "mass": "m", "position": [position(i, "sin"), position(i, "cos")]}
        for i in range(1, n + 1)
    ]
    return read_scene(
        {
            "id": f"chain-{n}",
            "coordinates": [{"name": angle} for angle in angles],
            "parameters": [{"name": name} for name in ("m", "l", "g")],
            "bodies": bodies,
            "loads": [{"kind": "gravity", "acceleration": ["0", "g"]}],
        }
    )


def spring_in_space() -> Scene:
    """A particle in space on a spring with a rest length, dragged by a force that depends on its rate."""
    return read_scene(
        {
            "id": "spring-in-space",
            "dimension": 3,
            "coordinates": [{"name": name} for name in ("x", "y", "z")],
            "parameters": [{"name": name} for name in ("m", "k", "s", "c")],
            "points": [{"name": "origin", "position": ["0", "0", "0"]}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y", "z"]}],
            "loads": [
                {"kind": "spring", "from": "origin", "to": "bob", "stiffness": "k", "rest_length": "s"},
                {"kind": "force", "name": "drag", "at": "bob", "force": ["-c*dot(x)", "-c*dot(y)", "-c*dot(z)"]},
            ],
        }
    )
