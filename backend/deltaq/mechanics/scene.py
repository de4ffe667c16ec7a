"""The scene: a mechanical system described as data."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from types import MappingProxyType

from ..errors import Problem, escaped
from ..language.expression import Expression, expressions_in
from ..language.floats import evaluate
from ..language.names import Names, Symbol, is_reserved
from ..language.spelling import spell_rate
from .bodies import Body
from .checks import demand, load_name_problem
from .conditions import Condition
from .constraints import Constraint
from .constraints.distance import DistanceConstraint
from .contributions import Contribution, DistributedForce
from .coordinate import Coordinate
from .dependence import dependence_problems, random_points
from .drawing import Drawing
from .event import Event
from .guide import Guide
from .lengths import with_signed_roots
from .loads import Load
from .material import Material
from .mechanics import Mechanics
from .parameter import Parameter
from .point import Point
from .redundancy import Independence, independence
from .user_text import Translated

_DECIMAL = re.compile(r"\d\.\d")


@dataclass(frozen=True)
class Scene:
    """A mechanical system (scene format 1): coordinates, parameters, bodies, loads, guides, constraints, events.

    `dimension` is the number of components of every vector, 2 (plane) or 3 (space). Points and bodies are both places,
    and share their names; loads and constraints have names of their own. `labels` say what they are called in
    sentences, by language.
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
    constraints: tuple[Constraint, ...] = ()

    def __post_init__(self) -> None:
        demand(*self._problems())

    def _problems(self) -> Iterator[Problem]:
        if not self.bodies:
            yield Problem("no-body", "/bodies")
        if not self.coordinates:
            yield Problem("no-coordinate", "/coordinates")
        elif not self.free:
            yield Problem("no-free-coordinate", "/guides")
        yield from _repeated(_named("/points", self.points), _named("/bodies", self.bodies))
        yield from _repeated(_named("/loads", self.loads))
        yield from _repeated((f"/guides/{i}/coordinate", guide.coordinate) for i, guide in enumerate(self.guides))
        yield from _repeated(_named("/events", self.events))
        for index, event in enumerate(self.events):
            yield from self._restitution_problems(f"/events/{index}/restitution", event)
        yield from _repeated(_named("/constraints", self.constraints))
        yield from self._multiplier_problems()
        yield from filter(None, (load_name_problem(load.name, f"/loads/{i}/name") for i, load in enumerate(self.loads)))
        for name in sorted(self.labels.keys() - self.places.keys() - self._others):
            yield Problem("label-of-nothing", f"/labels/{escaped(name)}", parameters={"name": name[:40]})
        for index, guide in enumerate(self.guides):
            yield from self._guide_problems(f"/guides/{index}", guide)
        if self.free:
            yield from list(self._constraint_problems()) or self._freedom_problems()

    def _restitution_problems(self, pointer: str, event: Event) -> Iterator[Problem]:
        """Newton's coefficient is a constant from 0 to 1."""
        if event.restitution is None:
            return
        moving = {coordinate.name for coordinate in self.coordinates} | {"t"}
        found = sorted((event.restitution.names & moving) | event.restitution.rates)
        if found:
            yield Problem("restitution-varies", pointer, parameters={"name": found[0]})
            return
        value = evaluate(event.restitution.tree, self.parameter_values)
        if not 0.0 <= value <= 1.0:
            yield restitution_problem(pointer, value)

    def _guide_problems(self, pointer: str, guide: Guide) -> Iterator[Problem]:
        known = tuple(coordinate.name for coordinate in self.coordinates)
        if guide.coordinate not in known:
            parameters = {"name": guide.coordinate[:40], "known": ", ".join(known)}
            yield Problem("unknown-coordinate", f"{pointer}/coordinate", parameters=parameters)
        for name in sorted(guide.value.names & set(known)):
            yield Problem("guide-by-coordinate", f"{pointer}/value", parameters={"name": name})

    def _multiplier_problems(self) -> Iterator[Problem]:
        """The names that multipliers are given must be free, and none of two."""
        taken = {symbol.name for symbol in self.stated_names.symbols}
        for index, constraint in enumerate(self.constraints):
            name = constraint.multiplier
            if name and (name in taken or is_reserved(name)):
                code = "duplicate-name" if name in taken else "reserved-name"
                yield Problem(code, f"/constraints/{index}/multiplier", parameters={"name": name})
            taken.add(name)

    def _constraint_problems(self) -> Iterator[Problem]:
        """Each constraint must hold something that is free."""
        free, known = ({c.name for c in each} for each in (self.free, self.coordinates))
        for index, condition in enumerate(self.conditions):
            names = Expression("", condition.value).names
            if not names & known:
                yield Problem("constraint-without-coordinates", f"/constraints/{index}")
            elif not names & free:
                yield Problem(
                    "constraint-of-guided", f"/constraints/{index}", parameters={"names": _listed(names & known)}
                )

    def _freedom_problems(self) -> Iterator[Problem]:
        """All constraints together must leave a motion, which fewer of them than coordinates do."""
        if len(self.constraints) < len(self.free) or self.degrees_of_freedom > 0:
            return
        unmet = self.independence.unmet
        if unmet is None:
            parameters = {"count": len(self.constraints), "free": len(self.free)}
            yield Problem("too-many-constraints", f"/constraints/{len(self.free) - 1}", parameters=parameters)
            return
        free, names = ([coordinate.name for coordinate in each] for each in (self.free, self.coordinates))
        told = tuple(dependence_problems(self.conditions, free, random_points(self.start, names)))
        gap = {"gap": float(f"{self.independence.gap:.3g}")}
        yield from told or (Problem("constraint-not-met", f"/constraints/{unmet}", parameters=gap),)

    @cached_property
    def names(self) -> Names:
        """What its results may refer to: the names of its expressions, and the multipliers."""
        return Names((*self.stated_names.symbols, *self.multipliers)) if self.constraints else self.stated_names

    @cached_property
    def stated_names(self) -> Names:
        """What its expressions may refer to, material coordinates included."""
        return names_of(self.coordinates, self.parameters, self.material)

    @cached_property
    def multipliers(self) -> tuple[Symbol, ...]:
        """The symbols of the multipliers, in the order of the constraints: as they say, else λ or λ₁, λ₂ …"""
        taken = {symbol.name for symbol in self.stated_names.symbols} | {each.multiplier for each in self.constraints}
        nameless = [constraint.name for constraint in self.constraints if not constraint.multiplier]
        plain = ["lambda"] if len(nameless) == 1 else []
        fresh = (name for name in (*plain, *(f"lambda_{k}" for k in range(1, len(taken) + 200))) if name not in taken)
        names = [constraint.multiplier or next(fresh) for constraint in self.constraints]
        return tuple(Symbol(name, "multiplier", c.latex) for name, c in zip(names, self.constraints, strict=True))

    @cached_property
    def writes_decimals(self) -> bool:
        """Whether its bodies, loads, guides or constraints are stated with decimals, 0.5 and not 1/2."""
        things: tuple[Body | Load | Guide | Constraint, ...]
        things = (*self.bodies, *self.loads, *self.guides, *self.constraints)
        return any(_DECIMAL.search(text) for thing in things for text in _texts(thing))

    @cached_property
    def material(self) -> tuple[Material, ...]:
        """The material coordinates of its continua and distributed forces, each name once."""
        loads = (part.material for part in self.contributions if isinstance(part, DistributedForce))
        found = (coordinate for each in (*(body.material for body in self.bodies), *loads) for coordinate in each)
        return tuple({coordinate.name: coordinate for coordinate in found}.values())

    @cached_property
    def mechanics(self) -> Mechanics:
        """What its equations depend on."""
        names = tuple(c.name for c in self.coordinates), tuple((p.name, p.positive) for p in self.parameters)
        events = tuple((event.name, event.value, event.then, event.restitution) for event in self.events)
        constraints = self.conditions, tuple(symbol.name for symbol in self.multipliers), self.independence.chosen
        return Mechanics(
            (self.dimension, names, self.points, self.bodies, self.loads, self.guides, events, constraints)
        )

    @cached_property
    def free(self) -> tuple[Coordinate, ...]:
        """The coordinates that no guide prescribes: the degrees of freedom, if there are no constraints."""
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

    @cached_property
    def conditions(self) -> tuple[Condition, ...]:
        """The expressions that the constraints keep at zero, in their order; distances along a line have a sign."""
        found = tuple(constraint.condition(self.places) for constraint in self.constraints)
        points = tuple(random_points(self.start, [coordinate.name for coordinate in self.coordinates])) if found else ()
        return tuple(
            replace(condition, value=with_signed_roots(condition.value, self.start, points))
            if isinstance(constraint, DistanceConstraint)
            else condition
            for condition, constraint in zip(found, self.constraints, strict=True)
        )

    @property
    def degrees_of_freedom(self) -> int:
        """How many rates may be chosen at will: free coordinates less independent constraints."""
        return self.independence.freedoms

    @property
    def is_redundant(self) -> bool:
        """Whether constraints follow from others wherever they all hold, so that not all multipliers are unique."""
        return len(self.independence.chosen) < len(self.constraints)

    @cached_property
    def independence(self) -> Independence:
        """How many constraints are independent where they all hold, near the start."""
        if not self.constraints:
            return Independence((), len(self.free))
        return independence(self.conditions, [coordinate.name for coordinate in self.free], self.start)

    @property
    def parameter_values(self) -> dict[str, float]:
        """The value of each parameter by name."""
        return {parameter.name: parameter.value for parameter in self.parameters}

    @property
    def stated_values(self) -> dict[str, float]:
        """Parameters and coordinates at t = 0 by name, all as they are stated: `start` has guided ones as they move."""
        return self.parameter_values | {c.name: c.value for c in self.coordinates} | {"t": 0.0}

    @property
    def start(self) -> dict[str, float]:
        """Parameters, coordinates and rates at t = 0 by name; guided ones as their guides say, their rates left out."""
        known = self.parameter_values | {"t": 0.0}
        guided = {guide.coordinate: evaluate(guide.value.tree, known) for guide in self.guides}
        rates = {spell_rate(coordinate.name, 1): 0.0 for coordinate in self.coordinates}
        return known | {coordinate.name: coordinate.value for coordinate in self.coordinates} | guided | rates

    @property
    def _others(self) -> set[str]:
        """Names of what is no place: loads, constraints and continua."""
        things: tuple[Load | Constraint | Body, ...] = (*self.loads, *self.constraints, *self.bodies)
        return {thing.name for thing in things}

    def __reduce__(self) -> tuple[object, ...]:
        # A mapping proxy cannot be pickled; the cached properties need not be.
        fields = (self.id, dict(self.title), dict(self.summary), self.dimension, self.coordinates, self.parameters)
        things = (self.points, self.bodies, self.loads, self.guides, self.drawing)
        labels = {name: dict(label) for name, label in self.labels.items()}
        return Scene, (*fields, *things, labels, self.events, self.constraints)


def restitution_problem(pointer: str, value: float) -> Problem:
    """What is wrong with a coefficient of restitution that is not between 0 and 1."""
    return Problem("restitution-outside", pointer, parameters={"value": float(f"{value:g}")})


def names_of(
    coordinates: tuple[Coordinate, ...], parameters: tuple[Parameter, ...], material: tuple[Material, ...] = ()
) -> Names:
    """The names of coordinates (in their order) and parameters. Raises InputError for repeated and reserved ones."""
    return Names(
        tuple(Symbol(c.name, "coordinate", c.latex) for c in coordinates)
        + tuple(Symbol(p.name, "parameter", p.latex, p.positive) for p in parameters)
        + tuple(Symbol(m.name, "material") for m in material)
    )


def _texts(thing: Body | Load | Guide | Constraint) -> Iterator[str]:
    """What is stated of a body, load, guide or constraint, as written."""
    for stated in vars(thing).values():
        yield from (part.text for part in expressions_in(stated))


def _listed(names: frozenset[str]) -> str:
    return ", ".join(sorted(names))


def _named(pointer: str, things: Iterable[Point | Body | Load | Event | Constraint]) -> Iterator[tuple[str, str]]:
    """Where each name stands, and the name."""
    return ((f"{pointer}/{index}/name", thing.name) for index, thing in enumerate(things))


def _repeated(*places: Iterable[tuple[str, str]]) -> Iterator[Problem]:
    """Names that stand a second time, there; what stands more often is told once."""
    met, told = set[str](), set[str]()
    for pointer, name in chain.from_iterable(places):
        if name in met - told:
            yield Problem("duplicate-name", pointer, parameters={"name": name})
            told.add(name)
        met.add(name)
