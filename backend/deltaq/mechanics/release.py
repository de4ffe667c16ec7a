"""What a scene holds fixed, and the scene in which it is let go: the first step to the reaction that holds it.

A length l, or a coordinate that is guided or frozen, becomes a coordinate that varies freely. Its generalized reaction
Z, δW = Z δl, is what Lagrange's equation of that coordinate lacks when it is kept as it was.
Source: Szabó, Höhere Technische Mechanik, §I.4 (principle of release); Lanczos, ch. III.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ..errors import Problem, UnknownNameError
from ..language.expression import Expression, expressions_in
from ..vocabulary import HoldKind
from .coordinate import Coordinate
from .loads.spring import Spring
from .parameter import Parameter
from .scene import Scene
from .units import Dimension, dimension_of

RODS = frozenset({"rod", "string"})


@dataclass(frozen=True)
class Held:
    """Something held fixed: a length by its unit, `lengths` if several rods are drawn with it, an angle, or a guide."""

    name: str
    kind: HoldKind


def held(scene: Scene) -> tuple[Held, ...]:
    """What can be released: parameters of positions that say nothing of mass, stiffness or turning; guided coordinates.

    A parameter that is also in a moment of inertia, a rest length or an angle of turning would change the bodies
    themselves, and not only where they are.
    """
    return (*_parameters(scene), *(Held(guide.coordinate, "guide") for guide in scene.guides))


def released(scene: Scene, name: str, pointer: str) -> Scene:
    """The scene in which this is a coordinate more; raises UnknownNameError at the pointer if it cannot be released."""
    known = {each.name: each.kind for each in held(scene)}
    if name not in known:
        parameters = {"name": name[:40], "known": ", ".join(known)}
        raise UnknownNameError(Problem("cannot-release", pointer, parameters=parameters))
    if known[name] == "guide":
        return replace(scene, guides=tuple(guide for guide in scene.guides if guide.coordinate != name))
    parameter = next(each for each in scene.parameters if each.name == name)
    kept = tuple(each for each in scene.parameters if each is not parameter)
    return replace(scene, coordinates=(*scene.coordinates, _as_coordinate(parameter)), parameters=kept)


def _as_coordinate(parameter: Parameter) -> Coordinate:
    return Coordinate(
        parameter.name, parameter.latex, parameter.unit, parameter.value, 0.0, parameter.min, parameter.max
    )


def _parameters(scene: Scene) -> Iterator[Held]:
    geometric, material = _names(_positions(scene)), _names(_properties(scene))
    for parameter in scene.parameters:
        kind = _kind(dimension_of(parameter.unit))
        if kind and parameter.name in geometric - material:
            yield Held(parameter.name, "lengths" if kind == "length" and _is_shared(scene, parameter) else kind)


def _is_shared(scene: Scene, length: Parameter) -> bool:
    """Whether several rods or strings have this length: what holds it is then the sum of what they exert."""
    rods = [
        each for each in scene.drawing.elements if each.kind in RODS and dict(each.options).get("label") == length.name
    ]
    return len(rods) > 1


def _kind(dimension: Dimension | None) -> HoldKind | None:
    """A length is one by its unit; what has no unit is taken for one, a quotient of units is none."""
    if dimension is None:
        return "length"
    if dimension.mass or dimension.time or dimension.length not in (0, 1):
        return None
    return "length" if dimension.length else "angle"


def _positions(scene: Scene) -> Iterator[Expression]:
    """Where bodies are."""
    return (component for body in scene.bodies for component in body.position)


def _properties(scene: Scene) -> Iterator[Expression]:
    """What bodies and springs are made of, how bodies turn, and what guides prescribe."""
    for body in scene.bodies:
        for key in ("mass", "inertia", "density", "angle", "angular_velocity"):
            yield from expressions_in(getattr(body, key, ()))
        for material in body.material:
            yield from (material.lower, material.upper)
    for load in scene.loads:
        if isinstance(load, Spring):
            yield from (load.stiffness, load.rest_length)
    yield from (guide.value for guide in scene.guides)


def _names(expressions: Iterator[Expression]) -> frozenset[str]:
    return frozenset[str]().union(*(expression.names for expression in expressions))
