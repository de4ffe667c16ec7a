"""The pendulum of n links, the double pendulum among them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

GREEK = "\\varphi"
MOST_LETTERED = 3  # links: for the arcs of more there is no room


@dataclass(frozen=True)
class ChainPendulum:
    """n particles on massless rods of equal length, hung one below the other; angles against the vertical.

    For n = 2 it is the double pendulum, for large n it approaches the swinging rope.
    Source: Lagrange, Mécanique analytique (1788), part 2, section 6.
    """

    id: ClassVar[str] = "chain-pendulum"
    parameter: ClassVar[str] = "n"
    least: ClassVar[int] = 1
    most: ClassVar[int] = 12
    default: ClassVar[int] = 4

    def document(self, size: int) -> dict[str, object]:
        """The scene with `size` links, together 1.2 m long."""
        links = range(1, size + 1)
        return {
            "format": 1,
            "id": self.id,
            "title": {"de": f"Pendelkette mit {size} Gliedern", "en": f"Chain pendulum of {size} links"},
            "summary": SUMMARY,
            "dimension": 2,
            "coordinates": [_angle(i) for i in links],
            "parameters": [
                {"name": "m", "unit": "kg", "value": 1.0, "min": 0.1, "max": 5.0},
                {"name": "l", "latex": "\\ell", "unit": "m", "value": 1.2 / size, "min": 0.05, "max": 1.2},
                {"name": "g", "unit": "m/s^2", "value": 9.81, "min": 1.0, "max": 25.0},
            ],
            "points": [{"name": "pivot", "position": ["0", "0"]}],
            "bodies": [_bob(i) for i in links],
            "loads": [{"kind": "gravity", "name": "weight", "acceleration": ["0", "g"]}],
            "labels": LABELS | {f"bob{i}": {"de": f"Masse {i}", "en": f"bob {i}"} for i in links},
            "drawing": {"vertical": "down", "view": [-1.4, 1.4, -1.3, 1.4], "elements": _elements(size)},
        }


SUMMARY = {
    "de": "Gleiche Punktmassen an gleich langen masselosen Stäben, eine unter der anderen. Zwei Glieder sind das "
    "Doppelpendel, viele nähern sich dem schwingenden Seil. Lagrange behandelt die Kette 1788.",
    "en": "Equal particles on massless rods of equal length, one below the other. Two links are the double pendulum, "
    "many come close to a swinging rope. Lagrange treats the chain in 1788.",
}
LABELS = {"pivot": {"de": "Aufhängung", "en": "pivot"}, "weight": {"de": "Gewicht", "en": "weight"}}


def _angle(i: int) -> dict[str, object]:
    name, latex = f"phi{i}", f"{GREEK}_{{{i}}}"
    return {"name": name, "latex": latex, "unit": "rad", "value": 0.9, "min": -3.1, "max": 3.1}


def _bob(i: int) -> dict[str, object]:
    def sum_of(function: str) -> str:
        return " + ".join(f"l*{function}(phi{k})" for k in range(1, i + 1))

    return {"name": f"bob{i}", "kind": "particle", "mass": "m", "position": [sum_of("sin"), sum_of("cos")]}


def _elements(size: int) -> list[dict[str, object]]:
    places = ["pivot", *(f"bob{i}" for i in range(1, size + 1))]
    rods: list[dict[str, object]] = [{"kind": "rod", "from": a, "to": b, "label": "l"} for a, b in pairwise(places)]
    lettered = size <= MOST_LETTERED
    angles: list[dict[str, object]] = [
        {"kind": "angle", "at": at, "coordinate": f"phi{i}"} for i, at in enumerate(places[:-1], 1) if lettered
    ]
    bobs: list[dict[str, object]] = [{"kind": "bob", "at": bob} for bob in places[1:]]
    support: list[dict[str, object]] = [{"kind": "ground", "at": "pivot"}, {"kind": "trail", "at": places[-1]}]
    return [*support, *rods, {"kind": "pivot", "at": "pivot"}, *angles, *bobs]
