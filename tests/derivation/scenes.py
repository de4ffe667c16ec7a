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


def _particle(**more: object) -> dict[str, object]:
    """A weight in the plane, y downwards, with what more a document says."""
    return {
        "coordinates": [{"name": name, "unit": "m", "value": value} for name, value in (("x", 0.6), ("y", 0.8))],
        "parameters": [{"name": "m", "unit": "kg"}, {"name": "l", "unit": "m"}, {"name": "g", "unit": "m/s^2"}],
        "points": [{"name": "pivot", "position": ["0", "0"]}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
        "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}],
        **more,
    }


def _equation(text: str, name: str = "track") -> dict[str, str]:
    return {"kind": "equation", "name": name, "equation": text}


def _parameters(**units: str) -> list[dict[str, object]]:
    return [{"name": name, "unit": unit} for name, unit in units.items()]


ROD = {"kind": "distance", "name": "rod", "from": "pivot", "to": "bob", "length": "l", "multiplier": "S"}
SLEIGH: dict[str, object] = {
    "coordinates": [{"name": "x", "unit": "m"}, {"name": "y", "unit": "m"}, {"name": "phi", "unit": "rad"}],
    "parameters": _parameters(m="kg", J="kg m^2", a="m"),
    "bodies": [
        {
            "name": "sleigh",
            "kind": "rigid",
            "mass": "m",
            "inertia": "J",
            "angle": "phi",
            "position": ["x + a*cos(phi)", "y + a*sin(phi)"],
        }
    ],
    "constraints": [_equation("dot(y)*cos(phi) - dot(x)*sin(phi) = 0", "blade")],
}
TWO_RODS = {
    "coordinates": [
        {"name": name, "unit": "m", "value": v} for name, v in {"x1": 0, "y1": 1, "x2": 1, "y2": 1}.items()
    ],
    "parameters": _parameters(m1="kg", m2="kg", l1="m", l2="m", g="m/s^2"),
    "bodies": [
        {"name": f"bob{k}", "kind": "particle", "mass": f"m{k}", "position": [f"x{k}", f"y{k}"]} for k in (1, 2)
    ],
    "constraints": [
        {"kind": "distance", "name": "upper", "from": "pivot", "to": "bob1", "length": "l1"},
        {"kind": "distance", "name": "lower", "from": "bob1", "to": "bob2", "length": "l2"},
    ],
}


def constrained() -> tuple[Scene, ...]:
    """Scenes with constraints of every kind, in forms that the built-in scenes need not have."""
    wire = {"parameters": _parameters(m="kg", l="m", omega="1/s", g="m/s^2"), "constraints": None}
    documents = {
        "particle-on-a-circle": _particle(constraints=[_equation("x^2 + y^2 = l^2")]),
        "particle-on-a-rod": _particle(constraints=[ROD]),
        "particle-on-a-turning-line": _particle(
            **{**wire, "constraints": [_equation("y*cos(omega*t) = x*sin(omega*t)")]}
        ),
        "particle-on-a-belt": _particle(**{**wire, "constraints": [_equation("dot(x) + omega*y = omega*l")]}),
        "sleigh": SLEIGH,
        "two-rods": _particle(**TWO_RODS),
    }
    return tuple(read_scene({"id": name, **document}) for name, document in documents.items())
