"""Scenes with constraints whose motion is known, and what is known of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene

Document = dict[str, object]
G = 9.81


def scene(
    coordinates: dict[str, tuple[float, float]],
    parameters: dict[str, float],
    bodies: Sequence[Document],
    constraints: Sequence[Document],
    *,
    points: dict[str, list[str]] | None = None,
    weight: bool = True,
    dimension: int = 2,
    loads: Sequence[Document] = (),
    events: Sequence[Document] = (),
    positive: bool = False,
) -> Scene:
    """A scene without units: coordinates with value and rate, parameters with values; weight along the last axis."""
    down = [*["0"] * (dimension - 1), "-g"]
    gravity: list[Document] = [{"name": "weight", "kind": "gravity", "acceleration": down}] if weight else []
    return read_scene(
        {
            "format": 1,
            "id": "own",
            "title": {"de": "Eigene", "en": "Own"},
            "summary": {"de": "Eigene", "en": "Own"},
            "dimension": dimension,
            "coordinates": [{"name": name, "value": q, "rate": v} for name, (q, v) in coordinates.items()],
            "parameters": [{"name": name, "value": value, "positive": positive} for name, value in parameters.items()],
            "points": [{"name": name, "position": at} for name, at in (points or {}).items()],
            "bodies": list(bodies),
            "loads": [*gravity, *loads],
            "constraints": list(constraints),
            "events": list(events),
        }
    )


def particle(name: str, *position: str, mass: str = "m") -> Document:
    """A particle by its position."""
    return {"name": name, "kind": "particle", "mass": mass, "position": list(position)}


def rod(name: str, start: str, end: str, length: str = "l") -> Document:
    """A rod without mass between two places; its multiplier has its name."""
    return {"name": f"rod_{name}", "kind": "distance", "from": start, "to": end, "length": length, "multiplier": name}


def equation(name: str, text: str) -> Document:
    """A constraint as an equation; its multiplier has its name."""
    return {"name": f"law_{name}", "kind": "equation", "equation": text, "multiplier": name}


def pendulum(
    x: float = 1.0, y: float = 0.0, u: float = 0.0, v: float = 0.0, pivot: tuple[str, str] = ("0", "0")
) -> Scene:
    """A pendulum of length 1 m in x and y."""
    return scene(
        {"x": (x, u), "y": (y, v)},
        {"m": 1.0, "l": 1.0, "g": G, "a": 0.1, "Omega": 3.0},
        [particle("bob", "x", "y")],
        [rod("S", "pivot", "bob")],
        points={"pivot": list(pivot)},
    )


def double_pendulum(angles: tuple[float, float], rates: tuple[float, float], values: dict[str, float]) -> Scene:
    """Two particles on rods in x₁, y₁, x₂, y₂, begun where angles from the downward vertical and their rates say."""
    at, speed = (np.zeros(2), np.zeros(2))
    coordinates: dict[str, tuple[float, float]] = {}
    for k, (angle, rate) in enumerate(zip(angles, rates, strict=True), start=1):
        along, across = np.array([np.sin(angle), -np.cos(angle)]), np.array([np.cos(angle), np.sin(angle)])
        at, speed = at + values[f"l{k}"] * along, speed + values[f"l{k}"] * rate * across
        coordinates |= {f"x{k}": (at[0], speed[0]), f"y{k}": (at[1], speed[1])}
    return scene(
        coordinates,
        values,
        [particle("upper", "x1", "y1", mass="m1"), particle("lower", "x2", "y2", mass="m2")],
        [rod("S1", "pivot", "upper", "l1"), rod("S2", "upper", "lower", "l2")],
        points={"pivot": ["0", "0"]},
    )


def four_bar(coupler: float = 1.6, ground: float = 1.5) -> Scene:
    """Crank of 0.5 m and rocker of 1.2 m, with a coupler between: three angles and a closed loop."""
    return scene(
        {"a": (1.0, 4.0), "b": (0.3, 0.0), "c": (1.9, 0.0)},
        {"m": 1.0, "r": 0.5, "k": coupler, "s": 1.2, "d": ground, "g": G},
        [
            particle("crank", "r*cos(a)", "r*sin(a)"),
            particle("middle", "r*cos(a) + k/2*cos(b)", "r*sin(a) + k/2*sin(b)"),
            particle("rocker", "d + s*cos(c)", "s*sin(c)"),
        ],
        [equation("X", "r*cos(a) + k*cos(b) - d - s*cos(c) = 0"), equation("Y", "r*sin(a) + k*sin(b) - s*sin(c) = 0")],
    )


def parallelogram(rate: float = 3.0) -> Scene:
    """Two cranks of 1 m and a coupler as long as the ground: where it lies flat it may fold or not."""
    return scene(
        {"x1": (0.0, -rate), "y1": (1.0, 0.0), "x2": (2.0, -rate), "y2": (1.0, 0.0)},
        {"m": 1.0, "l": 1.0, "d": 2.0, "g": G},
        [particle("one", "x1", "y1"), particle("two", "x2", "y2")],
        [rod("S1", "left", "one"), rod("S2", "right", "two"), rod("S3", "one", "two", "d")],
        points={"left": ["0", "0"], "right": ["d", "0"]},
        weight=False,
    )


def flat_linkage() -> Scene:
    """The parallelogram in three angles, with a coupler that has mass: it lies flat after (π − 0.5)/2 s."""
    crank, other = ("l*cos(a)", "l*sin(a)"), ("d + l*cos(c)", "l*sin(c)")
    coupler: Document = {
        "name": "coupler",
        "kind": "rigid",
        "mass": "m",
        "inertia": "m*d^2/12",
        "angle": "b",
        "position": ["l*cos(a) + d*cos(b)/2", "l*sin(a) + d*sin(b)/2"],
    }
    return scene(
        {"a": (0.5, 2.0), "b": (0.0, 0.0), "c": (0.5, 2.0)},
        {"m": 1.0, "l": 1.0, "d": 2.0},
        [particle("one", *crank), particle("two", *other), coupler],
        [
            equation("along", "l*cos(a) + d*cos(b) = d + l*cos(c)"),
            equation("across", "l*sin(a) + d*sin(b) = l*sin(c)"),
        ],
        weight=False,
    )


def swing_seat() -> Scene:
    """A seat that hangs level on two parallel rods of 1 m: it does not turn, and swings as a pendulum does."""
    ends = {name: [f"x + ({at})*cos(p)", f"y + ({at})*sin(p)"] for name, at in (("left", "-1/2"), ("right", "1/2"))}
    pivots = {"over_left": ["-1/2", "0"], "over_right": ["1/2", "0"]}
    return scene(
        {"x": (0.6, 0.0), "y": (-0.8, 0.0), "p": (0.0, 0.0)},
        {"m": 2.0, "J": 0.3, "l": 1.0, "g": G},
        [{"name": "seat", "kind": "rigid", "mass": "m", "inertia": "J", "angle": "p", "position": ["x", "y"]}],
        [rod(f"of_{name}", f"over_{name}", name) for name in ends],
        points=ends | pivots,
        positive=True,
    )


def platform(rods: int, *more: Document, begin: tuple[float, float] = (0.6, -0.8), positive: bool = False) -> Scene:
    """A platform of 2 kg on so many parallel rods of 1 m: it does not turn, and swings as a pendulum does.

    Two rods would do: from the third on they follow from these where they all hold, and nowhere else.
    """
    at = [f"{k}/2 - 1/2" for k in range(rods)]
    pivots = {f"above{k}": [x, "0"] for k, x in enumerate(at)}
    ends = {f"end{k}": [f"x + ({x})*cos(p)", f"y + ({x})*sin(p)"] for k, x in enumerate(at)}
    bar: Document = {"name": "bar", "kind": "rigid", "mass": "m", "inertia": "J", "angle": "p", "position": ["x", "y"]}
    return scene(
        {"x": (begin[0], 0.0), "y": (begin[1], 0.0), "p": (0.0, 0.0)},
        {"m": 2.0, "J": 0.3, "l": 1.0, "g": G},
        [bar],
        [*(rod(f"S{k}", f"above{k}", f"end{k}") for k in range(rods)), *more],
        points=pivots | ends,
        positive=positive,
    )


def equal_slider_crank() -> Scene:
    """Crank and rod of one length: where both stand upright, the slider may stay and the crank turn on."""
    bars: list[Document] = [
        {"name": name, "kind": "rigid", "mass": "m", "inertia": "m*l^2/12", "angle": angle, "position": [x, y]}
        for name, angle, x, y in (
            ("crank", "a", "l*cos(a)/2", "l*sin(a)/2"),
            ("rod", "b", "x - l*cos(b)/2", "l*sin(b)/2"),
        )
    ]
    return scene(
        {"a": (0.5, 0.64), "b": (0.5, 0.64), "x": (2.0 * np.cos(0.5), -1.28 * np.sin(0.5))},
        {"m": 1.0, "l": 1.0},
        [*bars, particle("slider", "x", "0")],
        [equation("along", "l*cos(a) + l*cos(b) = x"), equation("across", "l*sin(a) = l*sin(b)")],
        weight=False,
    )


def sleigh(speed: float = 0.2, spin: float = 1.5) -> Scene:
    """Chaplygin's sleigh: a skate at (x, y) along θ, the centre of mass a ahead of it."""
    body: Document = {
        "name": "sleigh",
        "kind": "rigid",
        "mass": "m",
        "inertia": "J",
        "angle": "theta",
        "position": ["x + a*cos(theta)", "y + a*sin(theta)"],
    }
    return scene(
        {"x": (0.0, speed), "y": (0.0, 0.0), "theta": (0.0, spin)},
        {"m": 2.0, "J": 0.3, "a": 0.4},
        [body],
        [equation("N", "dot(y)*cos(theta) - dot(x)*sin(theta) = 0")],
        weight=False,
    )
