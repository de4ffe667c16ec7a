"""What a scene holds fixed, and the scene in which it is let go: the first step to the reaction that holds it.

A length l, or a coordinate that is guided or frozen, becomes a coordinate that varies freely. Its generalized reaction
Z, δW = Z δl, is what Lagrange's equation of that coordinate lacks when it is kept as it was. Where l also says what
bodies are made of, a displacement u of places is let go instead (see `shift`), δW = Z δu.
Source: Szabó, Höhere Technische Mechanik, §I.4 (principle of release); Lanczos, ch. III.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ..errors import Problem, UnknownNameError
from ..language.expression import Expression, expressions_in
from ..language.memory import cached_method
from ..language.tree import Name
from ..vocabulary import HoldKind
from .constraints.distance import DistanceConstraint
from .constraints.equation import EquationConstraint
from .coordinate import Coordinate
from .loads.dissipation import Dissipation
from .loads.friction import DryFriction
from .loads.generalized_potential import VelocityPotential
from .loads.potential import Potential
from .loads.spring import Spring
from .parameter import Parameter
from .scene import Scene
from .shift import Rod, Shift, names_in
from .units import Dimension, dimension_of

RODS = frozenset({"rod", "string"})
OF_COORDINATES = (Potential, VelocityPotential, Dissipation, DryFriction)  # loads that name no places


@dataclass(frozen=True)
class Held:
    """Something held fixed, and what it is.

    A length by its unit, `lengths` if several rods are drawn with it, `scaled` if places move by another amount than it
    grows by, an angle, or a guide; or what is held by its `shift`: a rod with mass at its near end, or the place of
    bodies.
    """

    name: str
    kind: HoldKind
    shift: Shift | None = None


@dataclass(frozen=True)
class LetGo:
    """The scene with a coordinate more, and the name of that coordinate."""

    scene: Scene
    coordinate: str


@cached_method
def held(scene: Scene) -> tuple[Held, ...]:
    """What can be released: lengths and angles that places depend on, and guided coordinates."""
    parameters = filter(None, (_held(scene, each) for each in scene.parameters))
    return (*parameters, *(Held(guide.coordinate, "guide") for guide in scene.guides))


def find_held(scene: Scene, name: str, pointer: str) -> Held:
    """What is held under this name; raises UnknownNameError at the pointer, and says why, if it cannot be released."""
    known = {each.name: each for each in held(scene)}
    if name not in known:
        reason, parameters = _refusal(scene, name)
        parameters = {"name": name[:40], "known": ", ".join(known), **parameters}
        raise UnknownNameError(Problem(reason, pointer, parameters=parameters))
    return known[name]


def let_go(scene: Scene, found: Held) -> LetGo:
    """The scene in which it may vary."""
    name = found.name
    if found.shift is not None:
        return LetGo(found.shift.wider, found.shift.displacement)
    if found.kind == "guide":
        return LetGo(replace(scene, guides=tuple(guide for guide in scene.guides if guide.coordinate != name)), name)
    parameter = next(each for each in scene.parameters if each.name == name)
    kept = tuple(each for each in scene.parameters if each is not parameter)
    return LetGo(replace(scene, coordinates=(*scene.coordinates, _as_coordinate(parameter)), parameters=kept), name)


def _as_coordinate(parameter: Parameter) -> Coordinate:
    return Coordinate(
        parameter.name, parameter.latex, parameter.unit, parameter.value, 0.0, parameter.min, parameter.max
    )


def _held(scene: Scene, parameter: Parameter) -> Held | None:
    """What holds a parameter, if it is a length or an angle and places depend on it."""
    name, kind = parameter.name, _kind(dimension_of(parameter.unit))
    is_placed = any(name in names_in(body.position) for body in scene.bodies)
    is_pure = name not in _names(_properties(scene))
    if kind == "angle":
        return Held(name, kind) if is_placed and is_pure else None
    return _held_length(scene, parameter, is_placed=is_placed, is_pure=is_pure) if kind else None


def _held_length(scene: Scene, length: Parameter, *, is_placed: bool, is_pure: bool) -> Held | None:
    name, rods = length.name, _rods(scene, length.name)
    shift = _shift(scene, length, rods[0]) if len(rods) == 1 else None
    is_tied = _is_length_of_constraint(scene, name) or (shift is not None and _is_in_equation(scene, name))
    if is_pure and not (is_placed or is_tied) and rods and _gap_with(scene, name):
        return Held(name, "lengths" if _is_shared(scene, name) else "length")
    if is_pure and (is_placed or is_tied) and (shift is None or _is_free_of(shift, is_placed=is_placed)):
        alone: HoldKind = "length" if Shift(scene, length, None).is_by_length else "scaled"
        return Held(name, "lengths" if _is_shared(scene, name) else alone)
    if _load_of_coordinates(scene, name) or _gap_with(scene, name):
        return None
    if shift is not None and shift.is_along_rod:
        return Held(name, "rod", shift)
    return Held(name, "place", Shift(scene, length, None)) if is_placed or is_tied else None


def _shift(scene: Scene, length: Parameter, rod: Rod) -> Shift:
    """The rod moved along itself from the end at which it is held: the first one, unless only the other can be."""
    drawn, turned = (Shift(scene, length, each) for each in (rod, Rod(rod.end, rod.start)))
    return turned if turned.is_along_rod and not drawn.is_along_rod else drawn


def _is_free_of(shift: Shift, *, is_placed: bool) -> bool:
    """Whether letting go the length of a rod moves what hangs on its end, and nothing else."""
    return shift.is_whole and (is_placed or shift.lengthens)


def _rods(scene: Scene, name: str) -> tuple[Rod, ...]:
    """The rods and strings that are drawn with this length."""
    drawn = (each for each in scene.drawing.elements if each.kind in RODS)
    labelled = (dict(each.places) for each in drawn if dict(each.options).get("label") == name)
    return tuple(Rod(ends["from"], ends["to"]) for ends in labelled)


def _is_length_of_constraint(scene: Scene, name: str) -> bool:
    return any(isinstance(each, DistanceConstraint) and each.length.tree == Name(name) for each in scene.constraints)


def _is_in_equation(scene: Scene, name: str) -> bool:
    """Whether it stands in a condition on places."""
    equations = (each.equation for each in scene.constraints if isinstance(each, EquationConstraint))
    return any(name in equation.names and not equation.rates for equation in equations)


def _is_shared(scene: Scene, name: str) -> bool:
    """Whether several rods or strings have this length: what holds it is then the sum of what they exert."""
    kept = [each for each in scene.constraints if isinstance(each, DistanceConstraint) and name in each.length.names]
    return len(_rods(scene, name)) > 1 or len(kept) > 1


def _load_of_coordinates(scene: Scene, name: str) -> str | None:
    """A load with this length in it that names no places: whether it means a place or a body is not said."""
    loads = (each for each in scene.loads if isinstance(each, OF_COORDINATES))
    return next((each.name for each in loads if name in names_in(tuple(vars(each).values()))), None)


def _gap_with(scene: Scene, name: str) -> str | None:
    """A contact whose gap has this length in it, as that of a string which may be slack."""
    return next((each.name for each in scene.events if each.bounces and name in each.value.names), None)


def _refusal(scene: Scene, name: str) -> tuple[str, dict[str, str]]:
    """The code that says why a parameter cannot be released, and what it names."""
    length = next((p for p in scene.parameters if p.name == name and _kind(dimension_of(p.unit)) == "length"), None)
    if length is None:
        return "cannot-release", {}
    placed = (body for body in scene.bodies if name in names_in(body.position))
    bounded = next((b.name for b in scene.bodies if any(name in m.upper.names for m in b.material)), None)
    load = _load_of_coordinates(scene, name)
    if load and (bounded or next(placed, None)):
        return "cannot-release-of-load", {"load": load}
    gap = _gap_with(scene, name)
    if gap and (bounded or next(placed, None)):
        return "cannot-release-of-contact", {"event": gap}
    if not bounded:
        return "cannot-release", {}
    return "cannot-release-drawn-limit" if _rods(scene, name) else "cannot-release-limit", {"body": bounded}


def _kind(dimension: Dimension | None) -> HoldKind | None:
    """A length is one by its unit; what has no unit is taken for one, a quotient of units is none."""
    if dimension is None:
        return "length"
    if dimension.mass or dimension.time or dimension.length not in (0, 1):
        return None
    return "length" if dimension.length else "angle"


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
