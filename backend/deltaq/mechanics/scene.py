"""The scene: a mechanical system described as data."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

from ..errors import Problem, escaped
from ..language.expression import Expression
from ..language.names import Names, Symbol
from .bodies import Body
from .checks import demand, load_name_problem
from .contributions import Contribution, DistributedForce
from .coordinate import Coordinate
from .drawing import Drawing
from .event import Event
from .guide import Guide
from .loads import Load
from .material import Material
from .parameter import Parameter
from .point import Point
from .user_text import Translated

_DECIMAL = re.compile(r"\d\.\d")


@dataclass(frozen=True)
class Scene:
    """A mechanical system (scene format 1): coordinates, parameters, points, bodies, loads, guides, events, a drawing.

    `dimension` is the number of components of every vector, 2 (plane) or 3 (space). Points and bodies are both places,
    and share their names; loads have names of their own. `labels` say what they are called in sentences, by language.
    """

    id: str
    title: Translated
    summary: Translated
    dimension: int
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...]
    points: tuple[Point, ...]
    bodies: tuple[Body, ...]
    loads: tuple[Load, ...]
    guides: tuple[Guide, ...] = ()
    drawing: Drawing = Drawing()
    labels: Mapping[str, Translated] = field(default_factory=dict)
    events: tuple[Event, ...] = ()

    def __post_init__(self) -> None:
        demand(*self._problems())

    def _problems(self) -> Iterator[Problem]:
        if not self.bodies:
            yield Problem("no-body", "/bodies")
        if not self.coordinates:
            yield Problem("no-coordinate", "/coordinates")
        elif not self.free:
            yield Problem("no-free-coordinate", "/guides")
        yield from _repeated("/points", [*(p.name for p in self.points), *(b.name for b in self.bodies)])
        yield from _repeated("/loads", [load.name for load in self.loads])
        yield from _repeated("/guides", [guide.coordinate for guide in self.guides])
        yield from _repeated("/events", [event.name for event in self.events])
        yield from filter(None, (load_name_problem(load.name, f"/loads/{i}/name") for i, load in enumerate(self.loads)))
        for name in sorted(self.labels.keys() - self.places.keys() - self._others):
            yield Problem("label-of-nothing", f"/labels/{escaped(name)}", parameters={"name": name[:40]})
        for index, guide in enumerate(self.guides):
            yield from self._guide_problems(f"/guides/{index}", guide)

    def _guide_problems(self, pointer: str, guide: Guide) -> Iterator[Problem]:
        known = tuple(coordinate.name for coordinate in self.coordinates)
        if guide.coordinate not in known:
            parameters = {"name": guide.coordinate[:40], "known": ", ".join(known)}
            yield Problem("unknown-coordinate", f"{pointer}/coordinate", parameters=parameters)
        for name in sorted(guide.value.names & set(known)):
            yield Problem("guide-by-coordinate", f"{pointer}/value", parameters={"name": name})

    @cached_property
    def names(self) -> Names:
        """What its expressions may refer to, material coordinates included."""
        return names_of(self.coordinates, self.parameters, self.material)

    @cached_property
    def writes_decimals(self) -> bool:
        """Whether its bodies, loads or guides are stated with decimals, 0.5 and not 1/2."""
        things: tuple[Body | Load | Guide, ...] = (*self.bodies, *self.loads, *self.guides)
        return any(_DECIMAL.search(text) for thing in things for text in _texts(thing))

    @cached_property
    def material(self) -> tuple[Material, ...]:
        """The material coordinates of its continua and distributed forces, each name once."""
        loads = (part.material for part in self.contributions if isinstance(part, DistributedForce))
        found = (coordinate for each in (*(body.material for body in self.bodies), *loads) for coordinate in each)
        return tuple({coordinate.name: coordinate for coordinate in found}.values())

    @cached_property
    def free(self) -> tuple[Coordinate, ...]:
        """The coordinates that no guide prescribes: the degrees of freedom."""
        guided = {guide.coordinate for guide in self.guides}
        return tuple(coordinate for coordinate in self.coordinates if coordinate.name not in guided)

    @cached_property
    def places(self) -> Mapping[str, tuple[Expression, ...]]:
        """Positions of all points and bodies without material coordinates, by name."""
        points = {point.name: point.position for point in self.points}
        return MappingProxyType(points | {body.name: body.position for body in self.bodies if not body.material})

    def place(self, name: str) -> tuple[Expression, ...]:
        """The position of a place, or the position field of a continuum."""
        fields = {body.name: body.position for body in self.bodies if body.material}
        return fields[name] if name in fields else self.places[name]

    @cached_property
    def contributions(self) -> tuple[Contribution, ...]:
        """The forces and potentials that the loads come down to, in the order of the loads."""
        return tuple(part for load in self.loads for part in load.contributions(self.places, self.bodies))

    @property
    def _others(self) -> set[str]:
        """Names of what is no place: loads and continua."""
        return {load.name for load in self.loads} | {body.name for body in self.bodies}

    def __reduce__(self) -> tuple[object, ...]:
        # A mapping proxy cannot be pickled; the cached properties need not be.
        fields = (self.id, dict(self.title), dict(self.summary), self.dimension, self.coordinates, self.parameters)
        things = (self.points, self.bodies, self.loads, self.guides, self.drawing)
        labels = {name: dict(label) for name, label in self.labels.items()}
        return Scene, (*fields, *things, labels, self.events)


def names_of(
    coordinates: tuple[Coordinate, ...], parameters: tuple[Parameter, ...], material: tuple[Material, ...] = ()
) -> Names:
    """The names of coordinates (in their order) and parameters. Raises InputError for repeated and reserved ones."""
    return Names(
        tuple(Symbol(c.name, "coordinate", c.latex) for c in coordinates)
        + tuple(Symbol(p.name, "parameter", p.latex, p.positive) for p in parameters)
        + tuple(Symbol(m.name, "material") for m in material)
    )


def _texts(thing: Body | Load | Guide) -> Iterator[str]:
    """What is stated of a body, load or guide, as written."""
    for stated in vars(thing).values():
        parts = stated if isinstance(stated, tuple) else (stated,)
        yield from (part.text for part in parts if isinstance(part, Expression))


def _repeated(pointer: str, names: list[str]) -> Iterator[Problem]:
    for name, count in Counter(names).items():
        if count > 1:
            yield Problem("duplicate-name", pointer, parameters={"name": name})
