"""The same motion as another observer writes it down: other units, other origins, a moving frame.

Nothing of the physics changes, so neither may anything that is said about it. Scenes are rewritten as documents: what
stands in them as x becomes what x is in the new coordinate, and what comes out is told in the new units. The factors
are parameters of the new scene, as units are no part of its laws.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from tests.lab.ladder.climbing import Climbed

from deltaq.lab.ladder.findings import FULL
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene

# Dimensions of what expressions give, as powers of metre, second, kilogram; by section or kind, and field.
DIMENSIONS: Mapping[str, Mapping[str, tuple[int, int, int]]] = {
    "points": {"position": (1, 0, 0)},
    "particle": {"mass": (0, 0, 1), "position": (1, 0, 0)},
    "rigid": {
        "mass": (0, 0, 1),
        "position": (1, 0, 0),
        "inertia": (2, 0, 1),
        "angle": (0, 0, 0),
        "angular_velocity": (0, -1, 0),
    },
    "continuum": {"density": (0, 0, 1), "position": (1, 0, 0)},
    "gravity": {"acceleration": (1, -2, 0)},
    "potential": {"energy": (2, -2, 1)},
    "generalized-potential": {"energy": (2, -2, 1)},
    "dissipation": {"function": (2, -3, 1)},
    "spring": {"stiffness": (0, -2, 1), "rest_length": (1, 0, 0)},
    "damper": {"coefficient": (0, -1, 1), "damping": (0, -1, 1)},
    "force": {"force": (1, -2, 1)},
    "moment": {"moment": (2, -2, 1), "angle": (0, 0, 0)},
    "distributed": {"position": (1, 0, 0), "density": (1, -2, 1)},
    "events": {"value": (0, 0, 0)},
}


@dataclass(frozen=True)
class Observer:
    """How many of the new units one old unit is; degrees instead of radians; how much earlier each coordinate begins.

    `boost` is the velocity of the observer's frame, in old units, along each axis in turn; `carried` are rates added to
    coordinates, and taken out of what they mean.
    """

    name: str
    metre: float = 1.0
    second: float = 1.0
    kilogram: float = 1.0
    in_degrees: bool = False
    origins: tuple[float, ...] = ()
    boost: tuple[float, ...] = ()
    carried: Mapping[str, float] = field(default_factory=dict)
    nudge: float = 0.0  # of all initial values, in old units: not the same motion, but not another verdict either

    def sees(self, scene: Scene) -> Scene:
        return _Rewriting(self, scene).scene()


@dataclass(frozen=True)
class _Rewriting:
    observer: Observer
    old: Scene

    def scene(self) -> Scene:
        document = write_scene(self.old)
        document.pop("drawing")
        document["coordinates"] = [self._coordinate(each) for each in document["coordinates"]]
        document["parameters"] = [*document["parameters"], *self._constants()]
        for section in ("points", "bodies", "loads", "events"):
            document[section] = [self._things(each, each.get("kind", section)) for each in document.get(section, [])]
        document["guides"] = [self._guide(each) for each in document["guides"]]
        return read_scene(document)

    def _origin(self, name: str) -> float:
        origins, place = self.observer.origins, [each.name for each in self.old.coordinates].index(name)
        return origins[place % len(origins)] if origins else 0.0

    def _scale(self, unit: str) -> tuple[str, float]:
        """What a coordinate of this unit is multiplied by: the parameter, and its value."""
        if unit == "m":
            return "u_metre", self.observer.metre
        return ("u_degree", 180.0 / math.pi) if self.observer.in_degrees and unit == "rad" else ("u_one", 1.0)

    def _coordinate(self, one: dict[str, Any]) -> dict[str, Any]:
        name, scale = one["name"], self._scale(one["unit"])[1]
        origin, rate = self._origin(name), one["rate"] + self.observer.carried.get(name, 0.0)
        moved = {
            key: scale * (one[key] + origin + self.observer.nudge * (key == "value"))
            for key in ("value", "min", "max")
            if one.get(key) is not None
        }
        unit = "deg" if self.observer.in_degrees and one["unit"] == "rad" else one["unit"]
        return one | moved | {"rate": scale * rate / self.observer.second, "unit": unit}

    def _constants(self) -> list[dict[str, Any]]:
        seen = self.observer
        values = {"u_metre": seen.metre, "u_second": seen.second, "u_kilogram": seen.kilogram, "u_one": 1.0}
        values |= {"u_degree": 180.0 / math.pi}
        values |= {f"o_{each.name}": self._origin(each.name) for each in self.old.coordinates}
        values |= {f"b_{axis}": speed for axis, speed in enumerate(seen.boost) if speed}
        values |= {f"c_{name}": rate for name, rate in seen.carried.items()}
        return [{"name": name, "value": value, "positive": False} for name, value in values.items()]

    def _guide(self, guide: dict[str, Any]) -> dict[str, Any]:
        unit = next(each.unit for each in self.old.coordinates if each.name == guide["coordinate"])
        told = f"{self._scale(unit)[0]}*({self._read(guide['value'])} + o_{guide['coordinate']})"
        return guide | {"value": told}

    def _things(self, thing: dict[str, Any], kind: str) -> dict[str, Any]:
        found = {key: self._told(thing[key], powers) for key, powers in DIMENSIONS[kind].items() if key in thing}
        if "position" in found and self.observer.boost:
            found["position"] = [self._moving(each, axis) for axis, each in enumerate(found["position"])]
        return thing | found

    def _moving(self, component: str, axis: int) -> str:
        return f"{component} + u_metre*b_{axis}*t/u_second" if self.observer.boost[axis] else component

    def _told(self, value: Any, powers: tuple[int, int, int]) -> Any:
        if isinstance(value, list):
            return [self._told(each, powers) for each in value]
        names = zip(("u_metre", "u_second", "u_kilogram"), powers, strict=True)
        factor = "*".join(f"{name}^({power})" for name, power in names if power) or "1"
        return f"{factor}*({self._read(str(value))})"

    def _read(self, expression: str) -> str:
        """What the expression says, from the new coordinates and the new time."""
        scales = {each.name: self._scale(each.unit)[0] for each in self.old.coordinates}
        carried = self.observer.carried

        def rate(found: re.Match[str]) -> str:
            name = found[1]
            return f"(dot({name})*u_second/{scales[name]}" + (f" - c_{name})" if name in carried else ")")

        def value(found: re.Match[str]) -> str:
            name = found[0]
            if name == "t":
                return "(t/u_second)"
            if name not in scales:
                return name
            drift = f" - c_{name}*t/u_second" if name in carried else ""
            return f"({name}/{scales[name]} - o_{name}{drift})"

        pieces = re.split(r"(dot\(\w+\))", expression)
        return "".join(
            re.sub(r"dot\((\w+)\)", rate, piece) if piece.startswith("dot(") else re.sub(r"[A-Za-z_]\w*", value, piece)
            for piece in pieces
        )


UNITS = (
    Observer("mm, ds, g", metre=1e3, second=10.0, kilogram=1e3),
    Observer("km, h", metre=1e-3, second=1 / 3600.0),
    Observer("degrees", in_degrees=True),
)
ORIGINS = (Observer("origins", origins=(0.7, -1.3, 2.9)), Observer("far origins", origins=(-31.0, 57.0)))


EXACT = 1e-5  # what errors of rungs may differ by: that of the integration
NUDGES = tuple(Observer(f"nudge of {size:g}", origins=(), nudge=size) for size in (1e-6, -1e-6))


def frames(dimension: int) -> tuple[Observer, ...]:
    """Moving frames, along each axis."""
    return tuple(
        Observer(f"frame along axis {axis}", boost=tuple(3.7 * (k == axis) for k in range(dimension)))
        for axis in range(dimension)
    )


def another(dimension: int) -> Observer:
    """All of it at once."""
    return Observer("another", 1e3, 10.0, 1e-3, True, (0.7, -1.3, 2.9), tuple(3.7 for _ in range(dimension)))


@dataclass(frozen=True)
class Verdict:
    """What a ladder says of a scene, without what depends on the observer's words."""

    rungs: frozenset[str]
    least: str | None
    until: float  # for how much of the span that is said
    survive: Mapping[str, bool | None]
    errors: Mapping[str, float | None]

    @classmethod
    def of(cls, found: Climbed) -> Verdict:
        sound = {name: each for name, each in found.measured.items() if each.deviation is not None}
        return cls(
            frozenset(rung.id for rung in found.ladder.rungs),
            found.least.rung,
            found.least.until / found.ladder.span,
            {name: each.survives for name, each in found.measured.items()},
            {name: each.deviation.relative for name, each in sound.items() if each.deviation is not None},
        )

    def differs(self, other: Verdict, apart: float) -> list[str]:
        """In what another verdict is not the same, one line each; errors may be `apart` by that and two per cent."""
        found = [f"rungs {sorted(self.rungs ^ other.rungs)}"] if self.rungs != other.rungs else []
        found += [f"least {self.least} {other.least}"] if self.least != other.least else []
        for name in sorted(self.rungs & other.rungs):
            if self.survive.get(name) != other.survive.get(name):
                found.append(f"{name} survives {self.survive.get(name)} {other.survive.get(name)}")
            if not _alike(self.errors.get(name), other.errors.get(name), apart):
                found.append(f"{name} errs by {self.errors.get(name)} {other.errors.get(name)}")
        return found

    def misleads(self, nudged: Verdict) -> list[str]:
        """Rungs said to do here that do not from a start that is really nudged, and another least one.

        Where it is said that nothing can be said, nothing can mislead.
        """
        if self.least is None:
            return []
        found = [f"least {self.least} {nudged.least}"] if self.least != nudged.least else []
        good = {name for name, survives in self.survive.items() if survives and name != FULL}
        return found + [f"{name} only seems to do" for name in sorted(good) if not nudged.survive.get(name)]


def _alike(one: float | None, other: float | None, apart: float) -> bool:
    if one is None or other is None:
        return one is other
    return abs(one - other) <= 0.02 * max(one, other) + apart
