"""Linear forces F(t) − D ẋ − K x as loads of a scene.

The symmetric part of K is a potential ½ xᵀ K x − Fᵀ x, that of D a dissipation function ½ ẋᵀ D ẋ; the skew parts are
forces along each coordinate (circulatory and gyroscopic).
Source: Lurie, Analytical Mechanics, ch. 12; Ziegler, Principles of Structural Stability, ch. 2.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from ...language.expression import Expression
from ...language.names import is_name
from ...language.parser import parse
from ...language.tree import Number
from ...mechanics.coordinate import Coordinate
from ...mechanics.loads import Load
from ...mechanics.loads.dissipation import Dissipation
from ...mechanics.loads.force import Force
from ...mechanics.loads.moment import FreeMoment
from ...mechanics.loads.potential import Potential
from ...mechanics.parameter import Parameter
from ...mechanics.point import Point
from ...mechanics.scene import Scene
from ...mechanics.units import dimension_of
from ...model.linear_laws import Coefficient, Entries, LinearLaws
from .names import fresh, with_parameters

NOTHING = Expression("0", Number(Fraction(0)))
Texts = Mapping[tuple[str, ...], str]


def with_linear_loads(laws: LinearLaws, rest: Mapping[str, str]) -> Scene:
    """The scene of the laws with their forces; `rest` names the parameters that hold q₀ where it is not zero."""
    named = _Named(laws.scene)
    stiffness, circulatory = named.texts("k", laws.stiffness, "J"), named.texts("n", laws.circulatory, "J")
    damping, gyroscopic = named.texts("d", laws.damping, "J s"), named.texts("g", laws.gyroscopic, "J s")
    given = named.texts("f", {(name,): force for name, force in laws.given.items()}, "J")
    scene = named.scene
    apart = {each.name: f"({each.name} - {rest[each.name]})" if each.name in rest else each.name for each in scene.free}
    rates = {name: f"dot({name})" for name in apart}
    energy = [*_form(stiffness, apart), *(f"-{force}*{apart[name]}" for (name,), force in given.items())]
    skew = {name: [*_row(circulatory, name, apart), *_row(gyroscopic, name, rates)] for name in apart}
    loads: list[Load] = [Potential("restoring", _sum(energy, scene))] if energy else []
    loads += [Dissipation("damping", _sum(_form(damping, rates), scene))] if damping else []
    pushed = [each for each in scene.free if skew[each.name]]
    units = {each.name: unit for each in pushed if (unit := _unit(scene, each)) is not None}
    wider = with_parameters(scene, tuple(units.values()))
    loads += [_push(wider, each, units.get(each.name), _sum(skew[each.name], scene)) for each in pushed]
    points = tuple(_place(wider, each, units.get(each.name)) for each in pushed if _is_length(each))
    return replace(wider, points=(*scene.points, *points), loads=tuple(loads))


def _sum(terms: Iterable[str], scene: Scene) -> Expression:
    return parse(" + ".join(terms).replace("+ -", "- "), scene.names)


@dataclass
class _Named:
    """Coefficients as texts; those that are numbers become parameters of the scene."""

    scene: Scene

    def texts(self, letter: str, entries: Entries, unit: str) -> Texts:
        return {names: self._text(letter, names, value, unit) for names, value in entries.items()}

    def _text(self, letter: str, names: tuple[str, ...], value: Coefficient, unit: str) -> str:
        if isinstance(value, Expression):
            return value.text if is_name(value.text) else f"({value.text})"
        units = {each.name: each.unit or "1" for each in self.scene.coordinates}
        name = fresh(self.scene, "_".join((letter, *names)))
        below = " ".join(units[each] for each in names)
        self.scene = with_parameters(
            self.scene, (Parameter(name, unit=f"{unit}/({below})", value=value, positive=False),)
        )
        return name


def _form(entries: Texts, vector: Mapping[str, str]) -> Iterator[str]:
    """The terms of ½ xᵀ S x."""
    for (a, b), text in entries.items():
        yield f"{text}*{vector[a]}^2/2" if a == b else f"{text}*{vector[a]}*{vector[b]}"


def _row(entries: Texts, name: str, vector: Mapping[str, str]) -> Iterator[str]:
    """The terms of a row of −A x."""
    for (a, b), text in entries.items():
        if a == name:
            yield f"{_negative(text)}*{vector[b]}"
        if b == name:
            yield f"{text}*{vector[a]}"


def _negative(text: str) -> str:
    return text[2:-1] if text.startswith("(-") and is_name(text[2:-1]) else f"-{text}"


def _is_length(coordinate: Coordinate) -> bool:
    found = dimension_of(coordinate.unit)
    return found is not None and found.length == 1


def _unit(scene: Scene, coordinate: Coordinate) -> Parameter | None:
    """How many metres or radians the coordinate's unit has; None where it is one."""
    found, name = dimension_of(coordinate.unit), fresh(scene, f"unit_{coordinate.name}")
    if found is None or found.scale == 1.0:
        return None
    return Parameter(name, unit=f"{'m' if _is_length(coordinate) else 'rad'}/{coordinate.unit}", value=found.scale)


def _push(scene: Scene, coordinate: Coordinate, unit: Parameter | None, force: Expression) -> Load:
    """A generalized force: at a point that moves by a length, or as a moment on an angle."""
    name = f"along_{coordinate.name}"[:32]
    if unit is not None:
        force = parse(f"({force.text})/{unit.name}", scene.names)
    if _is_length(coordinate):
        place = _place(scene, coordinate, unit).name
        return Force(name, place, (force, *(NOTHING,) * (scene.dimension - 1)))
    return FreeMoment(name, _itself(scene, coordinate, unit), force)


def _place(scene: Scene, coordinate: Coordinate, unit: Parameter | None) -> Point:
    position = (_itself(scene, coordinate, unit), *(NOTHING,) * (scene.dimension - 1))
    return Point(f"place_{coordinate.name}"[:32], position)


def _itself(scene: Scene, coordinate: Coordinate, unit: Parameter | None) -> Expression:
    return parse(coordinate.name if unit is None else f"{coordinate.name}*{unit.name}", scene.names)
