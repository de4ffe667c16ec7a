"""Scenes whose equilibria, frequencies and conserved quantities textbooks state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from deltaq.derivation.engine import derive
from deltaq.derivation.step import Step
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene


def particle(
    coordinates: Sequence[str], parameters: Mapping[str, float], position: Sequence[str], *loads: Mapping[str, object]
) -> Scene:
    """One particle of mass m with these coordinates."""
    return read_scene(
        {
            "id": "particle",
            "dimension": len(position),
            "coordinates": [{"name": name, "value": 0.3} for name in coordinates],
            "parameters": [{"name": name, "value": value} for name, value in {"m": 1.0, **parameters}.items()],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": list(position)}],
            "loads": list(loads),
        }
    )


def rotating_hoop(speed: float) -> Scene:
    """A bead on a hoop that turns about its vertical diameter at a given rate; g/r = 20 1/s²."""
    position = ["r*sin(phi)*cos(Omega*t)", "r*sin(phi)*sin(Omega*t)", "-r*cos(phi)"]
    weight = {"kind": "gravity", "acceleration": ["0", "0", "-g"]}
    return particle(["phi"], {"r": 0.5, "g": 10.0, "Omega": speed}, position, weight)


def spherical_pendulum() -> Scene:
    position = ["l*sin(theta)*cos(psi)", "l*sin(theta)*sin(psi)", "-l*cos(theta)"]
    return particle(["theta", "psi"], {"l": 1.0, "g": 9.81}, position, gravity(3))


def gravity(dimension: int) -> Mapping[str, object]:
    return {"kind": "gravity", "acceleration": ["0"] * (dimension - 1) + ["-g"]}


def heavy_top() -> Scene:
    """Lagrange's top with Euler angles, its centre of mass at the height s cos θ."""
    omega = [
        "dot(psi)*sin(theta)*sin(phi) + dot(theta)*cos(phi)",
        "dot(psi)*sin(theta)*cos(phi) - dot(theta)*sin(phi)",
        "dot(psi)*cos(theta) + dot(phi)",
    ]
    position = ["s*sin(theta)*sin(psi)", "-s*sin(theta)*cos(psi)", "s*cos(theta)"]
    body = {"name": "top", "kind": "rigid", "mass": "m", "position": position, "inertia": ["A", "A", "C"]}
    return read_scene(
        {
            "id": "heavy-top",
            "dimension": 3,
            "coordinates": [{"name": name, "value": 0.5} for name in ("theta", "psi", "phi")],
            "parameters": [{"name": name, "value": 1.0} for name in ("m", "s", "g", "A", "C")],
            "bodies": [body | {"angular_velocity": omega}],
            "loads": [gravity(3)],
        }
    )


def model_steps(scene: Scene) -> dict[str, Step]:
    _, derivation = derive(scene)
    chapter = next(chapter for chapter in derivation.chapters if chapter.id == "model")
    return {step.id: step for outer in chapter.steps for step in outer.walk()}
