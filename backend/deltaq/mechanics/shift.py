"""Places that a length says, moved in thought: what the length also says of bodies themselves stays as it is.

A length l may be in moments of inertia, rest lengths or the limits of a continuum as well as in places. Then not l is
let go, but a displacement u that is zero in the motion. A rod from A to B with the unit vector e along it is moved
along itself, away from A, with all that hangs on its other end: r + u e. What A exerts holds it, δW = Z δu. Of
bodies that a length puts somewhere otherwise, l + u stands for l in what says where they are.
Source: Szabó, Höhere Technische Mechanik, §I.4 (principle of release).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from ..language.expression import Expression, expressions_in
from ..language.floats import evaluate
from ..language.gradients import gradient
from ..language.names import is_reserved
from ..language.tree import Name, Node, Number, Product, Sum, TreeAlgebra, fold
from .bodies import Body
from .constraints import Constraint
from .constraints.distance import DistanceConstraint
from .constraints.equation import EquationConstraint
from .coordinate import Coordinate
from .dependence import random_points
from .loads import Load
from .loads.distributed import Distributed
from .material import Material
from .parameter import Parameter
from .point import Point
from .redundancy import position_on
from .rows import Point as Values
from .scene import Scene

SAME = 1e-9  # of a length or of a unit vector: what rounding and the settling of constraints leave
LARGEST = 100  # of the denominators of the part of a rod at which a place is
PARTS = (0.3, 1.0, 1.7)  # of the length, to see whether places are linear in it
ALONG = (0.0, 0.3, 0.7, 1.0)  # of the material of a rod, to see whether it lies evenly between its ends
REACH = 0.05  # of the length, by which a rod is moved on its constraints to see where its end comes to be
ONE = Fraction(1)

Vector = tuple[Expression, ...]


@dataclass(frozen=True)
class Rod:
    """The drawn rod or string whose length a parameter is, from the place `start` to the place `end`."""

    start: str
    end: str

    def length(self, scene: Scene, point: Values) -> float:
        """How far apart its ends are."""
        return math.dist(*(_at(scene.places[name], point) for name in (self.start, self.end)))


@dataclass(frozen=True)
class Shift:
    """A scene, a length of it, and the rod that is moved along itself; without a rod, places by l + u."""

    scene: Scene
    length: Parameter
    rod: Rod | None

    @cached_property
    def displacement(self) -> str:
        """The name of u, or of u₁, u₂ … where that is taken."""
        taken = {symbol.name for symbol in self.scene.names.symbols}
        tried = ("u", *(f"u_{k}" for k in range(1, len(taken) + 2)))
        return next(name for name in tried if name not in taken and not is_reserved(name))

    @cached_property
    def moved(self) -> tuple[str, ...]:
        """The bodies that are moved."""
        scene, other = self.scene, self.wider
        return tuple(a.name for a, b in zip(scene.bodies, other.bodies, strict=True) if a.position != b.position)

    @cached_property
    def wider(self) -> Scene:
        """The scene with u as one coordinate more, and places by it."""
        added = Coordinate(self.displacement, "", self.length.unit)
        return replace(
            self.scene,
            coordinates=(*self.scene.coordinates, added),
            bodies=tuple(map(self._body, self.scene.bodies)),
            points=tuple(map(self._point, self.scene.points)),
            loads=tuple(map(self._load, self.scene.loads)),
            constraints=tuple(map(self._constraint, self.scene.constraints)),
        )

    @property
    def name(self) -> str:
        """l"""
        return self.length.name

    def _body(self, body: Body) -> Body:
        position = self._along(body.position, body.material)
        return body if position == body.position else replace(body, position=position)  # type: ignore[type-var]

    def _point(self, point: Point) -> Point:
        """The point, moved with what moves: points of the frame stay."""
        return replace(point, position=self._along(point.position, ())) if self._moves(point.position) else point

    def _load(self, load: Load) -> Load:
        if not isinstance(load, Distributed):
            return load
        return replace(load, position=self._along(load.position, load.material))

    def _constraint(self, constraint: Constraint) -> Constraint:
        """What hangs on the other end is bound to it; conditions on rates say nothing of places."""
        if isinstance(constraint, DistanceConstraint):
            return replace(constraint, length=self._put(constraint.length, self.name, ONE))
        if isinstance(constraint, EquationConstraint) and not constraint.equation.rates:
            return replace(constraint, equation=self._put(constraint.equation, self.name, ONE))
        return constraint

    def _along(self, position: Vector, material: tuple[Material, ...]) -> Vector:
        """r + u e: each particle of a continuum along the rod goes to where the one was that is u further along."""
        along = along_rod(material, self.name) if self.rod else None
        if along is not None:
            return tuple(self._put(part, along.name, ONE) for part in position)
        part = self.part(position, material) if self.rod else ONE
        return tuple(self._put(each, self.name, 1 / part) for each in position) if part else position

    def _put(self, expression: Expression, name: str, factor: Fraction) -> Expression:
        """The expression with name + factor u in place of a name."""
        moved: Node = Name(self.displacement)
        if factor != 1:
            moved = Product((Number(factor), moved))
        tree: Node = fold(expression.tree, _Put(name, Sum((Name(name), moved))))
        return expression if tree == expression.tree else Expression(expression.text, tree)

    def part(self, position: Vector, material: tuple[Material, ...]) -> Fraction | None:
        """|∂r/∂l|, if that is the same everywhere and for every l: at which part of its length a rod has a place.

        0 where the place does not depend on it; of a continuum the same for all of its particles.
        """
        if self.name not in names_in(position):
            return Fraction(0)
        particles = (each for point in self.places for each in _particles(material, point))
        sizes = [math.hypot(*slope) for point in particles for slope in self._slopes(position, point)]
        part = Fraction(sizes[0]).limit_denominator(LARGEST) if sizes and math.isfinite(sizes[0]) else Fraction(0)
        return part if part and all(abs(size - part) <= SAME for size in sizes) else None

    def _slopes(self, position: Vector, point: Values) -> Iterator[tuple[float, ...]]:
        for part in PARTS:
            values = {**point, self.name: part * self.length.value}
            yield tuple(gradient(each.tree, values, [self.name])[0] for each in position)

    @cached_property
    def places(self) -> tuple[Values, ...]:
        """Some configurations, on the constraints where there are any."""
        scene = self.scene
        near = random_points(scene.start, [coordinate.name for coordinate in scene.coordinates])
        found = (self._settled(scene, point) for point in near)
        return tuple(point for point in found if point is not None)

    def _moves(self, position: Vector) -> bool:
        return bool(names_in(position) & {"t", *(coordinate.name for coordinate in self.scene.coordinates)})

    @property
    def is_by_length(self) -> bool:
        """Whether every body moves by as much as the length grows by, or not at all."""
        return all(self.part(body.position, body.material) in (0, 1) for body in self.scene.bodies)

    @property
    def is_whole(self) -> bool:
        """Whether everything moved hangs on the far end of the rod, and no point of the frame is told by its length.

        Then letting go the length itself moves nothing else.
        """
        bodies = all(not body.material and self.part(body.position, ()) in (0, 1) for body in self.scene.bodies)
        frame = (point.position for point in self.scene.points if not self._moves(point.position))
        return bodies and not any(self.name in names_in(position) for position in frame)

    @property
    def is_along_rod(self) -> bool:
        """Whether the rod has this length from end to end, and all that moves with it does so along it."""
        rod, scene = self.rod, self.scene
        if rod is None or not {rod.start, rod.end} <= scene.places.keys() or not self.length.value > 0.0:
            return False
        start = scene.places[rod.start]
        is_held = self.name not in names_in(start) and self._moves(scene.places[rod.end])
        return is_held and not self._is_in_rates and bool(self.places) and self._fits_all(rod)

    @property
    def _is_in_rates(self) -> bool:
        """Whether a condition on rates has the length: what keeps that would act on what is moved."""
        equations = (each.equation for each in self.scene.constraints if isinstance(each, EquationConstraint))
        return any(equation.rates and self.name in equation.names for equation in equations)

    def _fits_all(self, rod: Rod) -> bool:
        bodies = [body for body in self.scene.bodies if self.name in _of_place(body)]
        known = bodies and all(
            along_rod(body.material, self.name) or self.part(body.position, body.material) for body in bodies
        )
        fits = known and all(self._fits(rod, body, point) for body in bodies for point in self.places)
        return bool(fits) and self.lengthens

    @property
    def lengthens(self) -> bool:
        """Whether the ends of the rod are l apart, and l + u where it is moved by u, on the constraints."""
        rod = self.rod
        return rod is not None and bool(self.places) and all(self._lengthens(rod, point) for point in self.places)

    def _fits(self, rod: Rod, body: Body, point: Values) -> bool:
        """Whether the body is moved by e, and a continuum lies between the ends of the rod."""
        start, end = (_at(self.scene.places[name], point) for name in (rod.start, rod.end))
        direction = _direction(start, end)
        along = along_rod(body.material, self.name)
        if along is None:
            particles = _particles(body.material, point)
            slopes = (tuple(gradient(part.tree, at, [self.name])[0] for part in body.position) for at in particles)
            return all(_is_close(_direction((0.0,) * len(slope), slope), direction) for slope in slopes)
        first, last = (evaluate(limit.tree, point) for limit in (along.lower, along.upper))
        found = [_at(body.position, {**point, along.name: first + part * (last - first)}) for part in ALONG]
        there = [tuple(a + part * (b - a) for a, b in zip(start, end, strict=True)) for part in ALONG]
        return all(_is_close(a, b) for a, b in zip(found, there, strict=True))

    def _lengthens(self, rod: Rod, point: Values) -> bool:
        wider, whole = self.wider, self.length.value
        there = self._settled(wider, {**point, self.displacement: REACH * whole})
        lengths = ((self.scene, point, whole), (wider, there, whole + REACH * whole))
        return all(at is not None and abs(rod.length(scene, at) - l) <= SAME * whole for scene, at, l in lengths)

    def _settled(self, scene: Scene, point: Values) -> Values | None:
        """The configuration next to a point that keeps all holonomic constraints, if one is found; u as it is."""
        if not scene.constraints:
            return point
        return position_on(scene.conditions, [coordinate.name for coordinate in self.scene.free], point)


@dataclass(frozen=True)
class _Put(TreeAlgebra):
    """A tree with another one in place of a name."""

    this: str
    by: Node

    def name(self, name: str) -> Node:
        return self.by if name == self.this else Name(name)


def along_rod(material: tuple[Material, ...], length: str) -> Material | None:
    """The material coordinate that ends at this length."""
    return next((each for each in material if each.upper.tree == Name(length)), None)


def names_in(given: object) -> frozenset[str]:
    """The names in the expressions of what is stated."""
    return frozenset[str]().union(*(expression.names for expression in expressions_in(given)))


def _of_place(body: Body) -> frozenset[str]:
    """The names in a body's place and in the limits of its material."""
    limits = frozenset[str]().union(*(each.lower.names | each.upper.names for each in body.material))
    return names_in(body.position) | limits


def _particles(material: tuple[Material, ...], point: Values) -> Iterator[Values]:
    """Some particles of a continuum at a configuration; of a body that is none the configuration itself."""
    if not material:
        yield point
        return
    first, *others = material
    lower, upper = (evaluate(limit.tree, point) for limit in (first.lower, first.upper))
    for part in ALONG:
        yield from _particles(tuple(others), {**point, first.name: lower + part * (upper - lower)})


def _at(position: Vector, point: Values) -> tuple[float, ...]:
    return tuple(evaluate(part.tree, point) for part in position)


def _direction(start: tuple[float, ...], end: tuple[float, ...]) -> tuple[float, ...]:
    apart = math.dist(start, end)
    return tuple((b - a) / apart for a, b in zip(start, end, strict=True)) if apart else start


def _is_close(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return math.dist(a, b) <= SAME * max(1.0, math.hypot(*b))
