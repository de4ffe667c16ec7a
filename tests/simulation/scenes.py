"""Scenes that the library does not have, and the problems they pose."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

Table = Mapping[str, object]


def scene(
    coordinates: Mapping[str, tuple[float, float]],
    parameters: Mapping[str, float],
    bodies: Mapping[str, tuple[str, Sequence[str]]],
    loads: Sequence[Table] = (),
    guides: Mapping[str, str] | None = None,
    points: Mapping[str, Sequence[str]] | None = None,
) -> Scene:
    """A scene in short: coordinates as (value, rate), bodies as (mass, position)."""
    return read_scene(document(coordinates, parameters, bodies, loads, guides, points))


def document(
    coordinates: Mapping[str, tuple[float, float]],
    parameters: Mapping[str, float],
    bodies: Mapping[str, tuple[str, Sequence[str]]],
    loads: Sequence[Table] = (),
    guides: Mapping[str, str] | None = None,
    points: Mapping[str, Sequence[str]] | None = None,
) -> dict[str, object]:
    """The document of such a scene, as a request has it."""
    dimension = len(next(iter(bodies.values()))[1])
    return {
        "format": 1,
        "id": "test",
        "dimension": dimension,
        "coordinates": [{"name": n, "value": v, "rate": u, "unit": _unit(n)} for n, (v, u) in coordinates.items()],
        "parameters": [{"name": n, "value": v, "positive": False} for n, v in parameters.items()],
        "points": [{"name": n, "position": list(r)} for n, r in (points or {}).items()],
        "bodies": [{"name": n, "kind": "particle", "mass": m, "position": list(r)} for n, (m, r) in bodies.items()],
        "loads": list(loads),
        "guides": [{"coordinate": n, "value": v} for n, v in (guides or {}).items()],
    }


def _unit(name: str) -> str:
    return "rad" if name.startswith(("phi", "theta", "psi")) else ""


WEIGHT = {"kind": "gravity", "acceleration": ["0", "g"]}


def double_pendulum() -> Scene:
    """Chaotic from these initial values on."""
    return scene(
        {"phi1": (2.0, 0.0), "phi2": (2.8, 0.0)},
        {"m1": 1.0, "m2": 0.7, "l1": 1.0, "l2": 0.8, "g": 9.81},
        {
            "upper": ("m1", ["l1*sin(phi1)", "l1*cos(phi1)"]),
            "lower": ("m2", ["l1*sin(phi1) + l2*sin(phi2)", "l1*cos(phi1) + l2*cos(phi2)"]),
        },
        [WEIGHT],
    )


def oscillator(force: str = "-k*x", **initial: float) -> Scene:
    """One particle on a line under one force; by default, harmonic."""
    return scene(
        {"x": (initial.get("x", 1.0), initial.get("u", 0.0))},
        {"m": 1.0, "k": 4.0, "c": 0.3, "F0": 2.0, "omega": 1.7},
        {"mass": ("m", ["x", "0"])},
        [{"kind": "force", "name": "pull", "at": "mass", "force": [force, "0"]}],
    )


def driven_by_everything() -> Scene:
    """A guide, a position that depends on time, a potential that does, a damping and a follower force."""
    return scene(
        {"y": (0.0, 0.0), "phi": (0.7, 0.2), "s": (0.1, 0.0)},
        {"m": 1.2, "l": 0.9, "k": 30.0, "g": 9.81, "c": 0.4, "F0": 1.5, "a": 0.2, "omega": 3.0},
        {
            "bob": ("m", ["(l + s)*sin(phi)", "y + (l + s)*cos(phi)"]),
            "cart": ("2*m", ["s + a*sin(omega*t)", "s*cos(phi)"]),
        },
        [
            WEIGHT,
            {"kind": "potential", "name": "spring", "energy": "k/2*(s - a*cos(omega*t))^2"},
            {"kind": "force", "name": "drag", "at": "bob", "force": ["-c*dot(phi)", "-c*dot(s) + c*dot(y)"]},
            {"kind": "force", "name": "follower", "at": "cart", "force": ["F0*cos(phi)", "F0*sin(omega*t)"]},
        ],
        guides={"y": "a*sin(omega*t)^2"},
    )


def spherical_pendulum(theta: float = 1.0, rate: float = 2.0) -> Scene:
    """In space; the pole θ = 0 is a singularity of the coordinates."""
    return scene(
        {"theta": (theta, 0.0), "psi": (0.0, rate)},
        {"m": 1.0, "l": 1.0, "g": 9.81},
        {"bob": ("m", ["l*sin(theta)*cos(psi)", "l*sin(theta)*sin(psi)", "-l*cos(theta)"])},
        [{"kind": "gravity", "acceleration": ["0", "0", "-g"]}],
    )


def standstill() -> Scene:
    """At x = 0 the coordinate moves no mass: r = x² has no slope there."""
    return scene({"x": (0.0, 1.0)}, {"m": 1.0, "a": 1.0}, {"mass": ("m", ["x^2", "a"])})


OWN = {
    "wild-double-pendulum": double_pendulum,
    "driven-by-everything": driven_by_everything,
    "damped-oscillator": lambda: oscillator("-k*x - c*dot(x) + F0*cos(omega*t)"),
    "fast-spherical-pendulum": spherical_pendulum,
}


def all_scenes() -> tuple[str, ...]:
    return (*scene_ids(), *OWN)


def get_scene(name: str) -> Scene:
    """A scene by its name, its equations as if nothing ended them."""
    return OWN[name]() if name in OWN else replace(load_scene(name), events=())
