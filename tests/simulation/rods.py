"""Rods, carts and blocks with dry friction and walls, for tests of what holds them."""

from __future__ import annotations

from math import cos, sin
from random import Random
from typing import Any

from tests.simulation.constrained import G
from tests.simulation.scenes import document
from tests.simulation.test_impact import contact

ASKED = {"include": ["coordinates", "rates", "loads", "multipliers", "error"], "tolerance": 1e-10}
LENGTH, MASS = 1.5, 2.0
WEIGHT = {"kind": "gravity", "name": "weight", "acceleration": ["0", f"-{G}"]}


def rod(
    *loads: dict[str, Any], events: tuple[dict[str, object], ...] = (), start: tuple[float, float] = (1.0, 0.0)
) -> dict[str, Any]:
    """A pendulum of mass 2 and length 1.5 with further loads and contacts."""
    bob = {"bob": ("m", ["l*sin(phi)", "-l*cos(phi)"])}
    found = document({"phi": start}, {"m": MASS, "l": LENGTH}, bob, [WEIGHT, *loads])
    return found | {"events": list(events)}


def friction(coordinate: str, force: float, static: float) -> dict[str, Any]:
    return {"kind": "friction", "name": "dry", "coordinate": coordinate, "force": repr(force), "static": repr(static)}


def wind(force: float) -> dict[str, Any]:
    return {"kind": "force", "name": "wind", "at": "bob", "force": [repr(force), "0"]}


def block(guides: dict[str, str], start: tuple[float, float] = (0.0, 0.0)) -> dict[str, Any]:
    dry, bodies = friction("x", 3.0, 4.0), {"bob": ("m", ["x", "y"]), "other": ("m", ["0", "z"])}
    moving = {"x": start, "y": (0.0, 0.0), "z": (0.0, 0.0)}
    return document(moving, {"m": MASS}, bodies, [WEIGHT, dry, wind(5.0)], guides)


def hinged(random: Random) -> tuple[dict[str, Any], dict[str, Any]]:
    """A cart on a track with friction and a pendulum that meets walls: with angles, and by constraints."""
    mass, bob, length = (random.uniform(0.5, 2.0) for _ in range(3))
    force = random.uniform(0.5, 4.0)
    dry = {**friction("x", force, force * random.uniform(1.0, 1.6)), "surface_rate": repr(random.uniform(-1.0, 1.0))}
    spring = {"kind": "potential", "name": "spring", "energy": f"{random.uniform(5.0, 40.0)!r}*x^2/2"}
    angle, turning = random.uniform(-2.0, 2.0), random.uniform(-1.0, 1.0)
    start = random.uniform(-0.3, 0.3)
    u, v = start + length * sin(angle), -length * cos(angle)
    walls = (max(u, 0.0) + random.uniform(0.1, 0.6), min(u, 0.0) - random.uniform(0.1, 0.6))
    e = random.choice([0.0, 0.5, 0.9])
    values = {"m": bob, "l": length}
    places = {"angles": ("x + l*sin(phi)", "-l*cos(phi)"), "rods": ("u", "v")}
    found = {}
    for kind, (across, up) in places.items():
        moving = {"x": (start, 0.0)}
        moving |= {"phi": (angle, turning)} if kind == "angles" else {}
        if kind == "rods":
            moving |= {"u": (u, length * cos(angle) * turning), "v": (v, length * sin(angle) * turning)}
        bodies = {"cart": (repr(mass), ["x", "0"]), "bob": ("m", [across, up])}
        scene: dict[str, Any] = document(moving, values, bodies, [WEIGHT, spring, dry])
        scene["events"] = [
            contact("right", f"{walls[0]!r} - ({across})", e),
            contact("left", f"{across} - {walls[1]!r}", e),
        ]
        found[kind] = scene
    found["rods"]["constraints"] = [
        {"kind": "distance", "name": "rod", "from": "cart", "to": "bob", "length": "l", "multiplier": "S"}
    ]
    return found["angles"], found["rods"]
