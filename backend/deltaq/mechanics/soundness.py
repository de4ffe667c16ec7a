"""What can be wrong with a scene that reads well: idle parameters, units that do not fit, coordinates without mass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

from ..errors import Problem
from ..language.expression import Expression
from ..language.tree import Rate, walk
from .body_axes import body_axes_problems
from .bounds import friction_bounds, start_of
from .continuity import continuity_problems
from .definedness import definedness_problems
from .homogeneity import SECOND, dimension_problems
from .independence import gap_problems, independence_problems
from .inertia import inertia_problems, moment_problems
from .integrability import integrability_problems
from .material import Material
from .scene import Scene
from .units import Dimension, dimension_of


@dataclass(frozen=True)
class Field:
    """One expression of a scene: where it stands, and the unit that its quantity has."""

    pointer: str
    expression: Expression
    dimension: Dimension | None


def soundness_problems(scene: Scene) -> Iterator[Problem]:
    """Errors and warnings. Masses, and then integrals, are looked at where all else is sound."""
    found = tuple(expressions(scene))
    yield from _idle_parameters(scene, found)
    yield from _units(scene, found)
    yield from (each.problem for each in friction_bounds(scene, start_of(scene)))
    yield from moment_problems(scene)
    yield from body_axes_problems(scene)
    accelerated = tuple(_accelerations(found))
    undefined = tuple(definedness_problems(scene, ((field.pointer, field.expression) for field in found)))
    jumping = () if accelerated or undefined else tuple(continuity_problems(scene))
    held = () if undefined or jumping else (*independence_problems(scene), *gap_problems(scene))
    yield from (
        accelerated or undefined or jumping or held or tuple(inertia_problems(scene)) or integrability_problems(scene)
    )


def expressions(scene: Scene) -> Iterator[Field]:
    """Every expression of a scene with its JSON pointer."""
    lists = {"points": scene.points, "bodies": scene.bodies, "loads": scene.loads, "events": scene.events}
    lists |= {"constraints": scene.constraints}
    for key, things in lists.items():
        for index, thing in enumerate(things):
            yield from _fields(f"/{key}/{index}", thing)
    units = {coordinate.name: coordinate.unit for coordinate in scene.coordinates}
    for index, guide in enumerate(scene.guides):
        yield Field(f"/guides/{index}/value", guide.value, dimension_of(units[guide.coordinate]))


def _fields(pointer: str, thing: object) -> Iterator[Field]:
    for item in fields(thing):  # type: ignore[arg-type] # every kind of point, body and load is a dataclass
        place = f"{pointer}/{item.metadata.get('key', item.name)}"
        dimension = dimension_of(item.metadata.get("unit", ""))
        match getattr(thing, item.name):
            case Expression() as expression:
                yield Field(place, expression, dimension)
            case tuple(parts):
                yield from (each for i, part in enumerate(parts) for each in _parts(f"{place}/{i}", part, dimension))


def _parts(place: str, part: object, dimension: Dimension | None) -> Iterator[Field]:
    match part:
        case Expression():
            yield Field(place, part, dimension)
        case tuple(row):
            yield from (each for i, entry in enumerate(row) for each in _parts(f"{place}/{i}", entry, dimension))
        case Material(lower=lower, upper=upper):
            yield Field(f"{place}/from", lower, None)
            yield Field(f"{place}/to", upper, None)


def _idle_parameters(scene: Scene, found: tuple[Field, ...]) -> Iterator[Problem]:
    used = scene.drawing.sizes.union(*(field.expression.names for field in found))
    for index, parameter in enumerate(scene.parameters):
        if parameter.name not in used:
            parameters = {"name": parameter.name}
            yield Problem("unused-parameter", f"/parameters/{index}", parameters=parameters, severity="warning")


def _accelerations(found: tuple[Field, ...]) -> Iterator[Problem]:
    """In M q̈ = f(q, q̇, t) accelerations stand with the masses only: a force that holds one is no f."""
    for field in found:
        nodes = (node for node in walk(field.expression.tree) if isinstance(node, Rate) and node.order > 1)
        for name in sorted({node.name for node in nodes}):
            yield Problem("acceleration-in-scene", field.pointer, parameters={"coordinate": name})


def _units(scene: Scene, found: tuple[Field, ...]) -> Iterator[Problem]:
    coordinates = [(f"/coordinates/{i}/unit", c.name, c.unit) for i, c in enumerate(scene.coordinates)]
    parameters = [(f"/parameters/{i}/unit", p.name, p.unit) for i, p in enumerate(scene.parameters)]
    given = coordinates + parameters
    for pointer, _, unit in given:
        if unit and dimension_of(unit) is None:
            yield Problem("unknown-unit", pointer, parameters={"unit": unit[:20]}, severity="warning")
    units = {name: dimension_of(unit) for _, name, unit in given}
    units["t"] = SECOND if all(units.values()) else None  # who writes no units may write sin(t)
    for field in found:
        for problem in dimension_problems(field.expression, field.dimension, units):
            yield problem.below(field.pointer)
