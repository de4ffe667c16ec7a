"""Motions whose largest Lyapunov exponents are known from outside: as scenes, and where the truth is kept.

`lyapunov.json` has motions drawn at random from thirteen families. Their exponents were measured by variational
equations in heyoka over 8,000 to 100,000 periods (`python -m tests.benchmarks.bench_lyapunov --write`); `error` is the
standard error of that. Exponents of regular motions without damping are zero.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from deltaq.mechanics.document import read_scene
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of

TABLE = Path(__file__).with_name("lyapunov.json")
GRAVITY = {"kind": "gravity", "name": "weight", "acceleration": ["0", "g"]}
ON_ROD = ["l*sin(theta)", "l*cos(theta)"]
ON_SPRING = ["r*sin(theta)", "r*cos(theta)"]
ON_SECOND_ROD = ["l1*sin(theta1) + l2*sin(theta2)", "l1*cos(theta1) + l2*cos(theta2)"]


@dataclass(frozen=True)
class Motion:
    """A motion of a family, and its exponent in 1/s."""

    family: str
    parameters: Mapping[str, float]
    values: tuple[float, ...]
    rates: tuple[float, ...]
    exponent: float
    error: float = 0.0

    @property
    def problem(self) -> Problem:
        coordinates, bodies, loads = FAMILIES[self.family]
        document = {
            "id": "motion",
            "coordinates": [{"name": name} for name in coordinates],
            "parameters": [
                {"name": name, "value": value, "positive": False} for name, value in self.parameters.items()
            ],
            "bodies": [
                {"name": f"body{mass}", "kind": "particle", "mass": mass, "position": at} for mass, at in bodies
            ],
            "loads": loads,
        }
        return replace(problem_of(read_scene(document), 30.0), values=self.values, rates=self.rates)


def _potential(energy: str) -> dict[str, Any]:
    return {"kind": "potential", "name": "well", "energy": energy}


def _moment(moment: str) -> dict[str, Any]:
    return {"kind": "moment", "name": "moment", "angle": "theta", "moment": moment}


def _force(force: str) -> dict[str, Any]:
    return {"kind": "force", "name": "drive", "at": "bodym", "force": [force, "0"]}


Family = tuple[tuple[str, ...], list[tuple[str, list[str]]], list[dict[str, Any]]]
FAMILIES: dict[str, Family] = {
    "henon": (("x", "y"), [("m", ["x", "y"])], [_potential("(x^2 + y^2)/2 + x^2*y - y^3/3")]),
    "quartic": (("x", "y"), [("m", ["x", "y"])], [_potential("(x^2 + y^2)/2 + c*x^2*y^2/2")]),
    "pendulum": (("theta",), [("m", ON_ROD)], [GRAVITY, _moment("-c*dot(theta)")]),
    "driven": (("theta",), [("m", ON_ROD)], [GRAVITY, _moment("F*cos(w*t) - c*dot(theta)")]),
    "oscillator": (("x",), [("m", ["x", "0"])], [_potential("k*x^2/2"), _force("-c*dot(x)")]),
    "duffing": (("x",), [("m", ["x", "0"])], [_potential("a*x^2/2 + b*x^4/4"), _force("B*cos(w*t) - k*dot(x)")]),
    "spring": (("r", "theta"), [("m", ON_SPRING)], [GRAVITY, _potential("k*(r - l)^2/2")]),
    "atwood": (("r", "theta"), [("m", ON_SPRING), ("M", ["0", "10 - r"])], [GRAVITY]),
    "double": (
        ("theta1", "theta2"),
        [("m1", ["l1*sin(theta1)", "l1*cos(theta1)"]), ("m2", ON_SECOND_ROD)],
        [GRAVITY],
    ),
}


def drawn() -> list[Motion]:
    """The motions of the table."""
    rows = json.loads(TABLE.read_text(encoding="utf-8"))
    return [Motion(**{**row, "values": tuple(row["values"]), "rates": tuple(row["rates"])}) for row in rows]
