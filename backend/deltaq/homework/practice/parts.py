"""What practice systems are put together from: pieces of a scene, each with the sentence that tells of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from ...narration.catalog import LANGUAGES, template
from .draw import Draw
from .symbols import USUAL, Kind, latex_of, names_in, shown

Document = dict[str, Any]
Vertical = Literal["up", "down"]
Told = tuple[str, Mapping[str, str]]  # the key of a sentence, and what stands in it


@dataclass(frozen=True)
class Part:
    """A piece of a scene. Pieces are added up; the first one that has a title gives it to the whole.

    `told` are the sentences of the problem, `adds` the keys of what the title names besides. `kinds` are the quantities
    of parameters that do not have their usual one, `called` the keys of labels of places that are not called by name.
    """

    title: str = ""
    vertical: Vertical = "up"
    told: tuple[Told, ...] = ()
    adds: tuple[str, ...] = ()
    kinds: Mapping[str, Kind] = field(default_factory=dict)
    called: Mapping[str, str] = field(default_factory=dict)
    coordinates: tuple[Document, ...] = ()
    points: tuple[Document, ...] = ()
    bodies: tuple[Document, ...] = ()
    loads: tuple[Document, ...] = ()
    guides: tuple[Document, ...] = ()
    events: tuple[Document, ...] = ()
    elements: tuple[Document, ...] = ()
    view: tuple[float, ...] = ()  # what is shown where the motion does not tell

    def __add__(self, other: Part) -> Part:
        return Part(
            title=self.title or other.title,
            vertical=self.vertical,
            told=self.told + other.told,
            adds=self.adds + other.adds,
            kinds={**self.kinds, **other.kinds},
            called={**self.called, **other.called},
            coordinates=self.coordinates + other.coordinates,
            points=self.points + other.points,
            bodies=self.bodies + other.bodies,
            loads=self.loads + other.loads,
            guides=self.guides + other.guides,
            events=self.events + other.events,
            elements=self.elements + other.elements,
            view=self.view or other.view,
        )


def told(key: str, **names: str) -> tuple[Told, ...]:
    """A sentence of the problem with the names in it."""
    return ((key, {name: shown(value) for name, value in names.items()}),)


def coordinate(
    name: str, unit: str, value: float, reach: float, *, rate: float = 0.0, least: float | None = None
) -> Document:
    """A coordinate that begins at a value and whose slider goes to ± reach, or from `least` on."""
    low = -reach if least is None else least
    written = {"name": name, "latex": latex_of(name), "unit": unit, "value": value, "rate": rate}
    return {**written, "min": low, "max": reach}


def angle(name: str, value: float, *, rate: float = 0.0) -> Document:
    """An angle in radians."""
    return coordinate(name, "rad", value, 3.1, rate=rate)


def length(name: str, value: float, reach: float = 1.0, *, rate: float = 0.0, least: float | None = None) -> Document:
    """A way in metres."""
    return coordinate(name, "m", value, reach, rate=rate, least=least)


def point(name: str, *position: str) -> Document:
    """A place without mass."""
    return {"name": name, "position": list(position)}


def particle(name: str, mass: str, *position: str) -> Document:
    """A point mass."""
    return {"name": name, "kind": "particle", "mass": mass, "position": list(position)}


def rigid(name: str, mass: str, inertia: str, turned: str, *position: str) -> Document:
    """A rigid body in the plane; the inertia is about its centre of mass."""
    return {
        "name": name,
        "kind": "rigid",
        "mass": mass,
        "inertia": inertia,
        "angle": turned,
        "position": list(position),
    }


def gravity(*acceleration: str) -> Document:
    """The weight of all bodies."""
    return {"name": "weight", "kind": "gravity", "acceleration": list(acceleration)}


def potential(name: str, energy: str) -> Document:
    """A load by its potential."""
    return {"name": name, "kind": "potential", "energy": energy}


def dissipation(function: str) -> Document:
    """A damper by Rayleigh's function."""
    return {"name": "damper", "kind": "dissipation", "function": function}


def force(name: str, at: str, *components: str) -> Document:
    """A force at a place."""
    return {"name": name, "kind": "force", "at": at, "force": list(components)}


def element(kind: str, **options: str | float) -> Document:
    """A primitive of the drawing; `start` is where it begins."""
    return {"kind": kind, **{{"start": "from"}.get(name, name): value for name, value in options.items()}}


ORIGIN = point("origin", "0", "0")  # has no label but what a part calls it


def upright(draw: Draw) -> Vertical:
    """Which way the second axis points."""
    return draw.one_of(("down", "up"))


def total(*terms: str) -> str:
    """The sum of terms as it is written."""
    written = " + ".join(term for term in terms if term not in ("0", ""))
    return written.replace("+ -", "- ") or "0"


def below(vertical: Vertical, *terms: str) -> str:
    """The vertical component of what is so far below the origin."""
    return total(*terms) if vertical == "down" else total(*(_negative(term) for term in terms if term != "0"))


def _negative(term: str) -> str:
    return term[1:] if term.startswith("-") else f"-{term}"


def weight(vertical: Vertical, dimension: int = 2) -> Part:
    """Gravity along the last axis."""
    return Part(loads=(gravity(*["0"] * (dimension - 1), below(vertical, "g")),))


def ending(at: str, *values: str) -> Part:
    """The motion ends where one of these values falls to zero: a rope or a way is at its end."""
    title = _in_each("practice.end")
    return Part(
        events=tuple({"name": f"end{n}", "value": value, "title": title, "at": at} for n, value in enumerate(values, 1))
    )


def document_of(whole: Part, draw: Draw, identifier: str) -> Document:
    """The scene document of a system, its values drawn."""
    labels = {thing["name"]: thing["name"] for thing in (*whole.points, *whole.bodies, *whole.loads)}
    labels = {name: key for name, key in (labels | dict(whole.called)).items() if key != ORIGIN["name"]}
    return {
        "format": 1,
        "id": identifier,
        "title": {language: _title(whole, language) for language in LANGUAGES},
        "summary": {language: _summary(whole, language) for language in LANGUAGES},
        "dimension": len(whole.bodies[0]["position"]),
        "coordinates": list(whole.coordinates),
        "parameters": [_parameter(name, whole, draw) for name in _constants(whole)],
        "points": list(whole.points),
        "bodies": list(whole.bodies),
        "loads": list(whole.loads),
        "guides": list(whole.guides),
        "events": list(whole.events),
        "labels": {name: _in_each(f"practice.labels.{key}") for name, key in sorted(labels.items())},
        "drawing": _drawing(whole),
    }


def _drawing(whole: Part) -> Document:
    view = {"view": list(whole.view)} if whole.view else {}
    return {"vertical": whole.vertical, **view, "elements": list(whole.elements)}


def _constants(whole: Part) -> Iterator[str]:
    """The parameters in the order in which they first occur."""
    moving = {each["name"] for each in whole.coordinates}
    known = {*USUAL, *whole.kinds} - moving
    texts = (
        text
        for thing in (*whole.bodies, *whole.loads, *whole.guides, *whole.points, *whole.events)
        for text in _texts(thing)
    )
    yield from dict.fromkeys(name for text in texts for name in names_in(text) if name in known)


NOT_EXPRESSIONS = ("name", "title", "kind", "at", "coordinate", "from", "to")


def _texts(thing: Document) -> Iterator[str]:
    for key, value in thing.items():
        if key not in NOT_EXPRESSIONS:
            yield from value if isinstance(value, list) else (value,)


def _parameter(name: str, whole: Part, draw: Draw) -> Document:
    kind = whole.kinds.get(name, USUAL.get(name))
    if kind is None:
        raise KeyError(f"no quantity is known for {name}")
    bounds = {"min": round(0.2 * min(kind.values), 3), "max": round(2.5 * max(kind.values), 3)}
    return {"name": name, "latex": latex_of(name), "unit": kind.unit, "value": draw.one_of(kind.values), **bounds}


def _title(whole: Part, language: str) -> str:
    title = template(language, f"practice.titles.{whole.title}")
    adds = [template(language, f"practice.adds.{key}") for key in whole.adds]
    if not adds:
        return title
    *most, last = adds
    joined = template(language, "practice.and").format(most=", ".join(most), last=last) if most else last
    return template(language, "practice.with").format(title=title, adds=joined)


def _summary(whole: Part, language: str) -> str:
    return " ".join(template(language, f"practice.told.{key}").format(**names) for key, names in whole.told)


def _in_each(key: str) -> dict[str, str]:
    return {language: template(language, key) for language in LANGUAGES}
