"""Whether every coordinate moves mass: the mass matrix of a scene, in plain numbers.

M = Σ m Jᵀ J with J = ∂r/∂q. It is singular everywhere if a coordinate moves no mass, or if coordinates only ever
move together; at single points it may be singular in any scene (the pole of the spherical pendulum).
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.6.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping

from ..errors import Problem
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.tree import Node, TimeDerivative
from .bodies import Body
from .kinetics import Distribution, Kinetics, Rotation, Translation
from .material import Material
from .scene import Scene

POINTS = 5
STEP = 1e-5
NOTHING = 1e-7  # the differences are good to about 1e-10
GAUSS = ((0.5 - math.sqrt(0.15), 5 / 18), (0.5, 8 / 18), (0.5 + math.sqrt(0.15), 5 / 18))  # on the unit interval

Matrix = list[list[float]]
Point = Mapping[str, float]
Share = tuple[float, list[list[float]]]  # an inertia, and the velocity it has for each unit rate


def inertia_problems(scene: Scene) -> Iterator[Problem]:
    """Bodies whose mass is not positive, and coordinates that move no mass of their own."""
    values = {p.name: p.value for p in scene.parameters} | {c.name: c.value for c in scene.coordinates} | {"t": 0.0}
    yield from _varying(scene)
    light = [problem for index, body in enumerate(scene.bodies) for problem in _light(index, body, values)]
    if light:
        yield from light
        return
    matrices = [matrix for point in _points(scene) if (matrix := mass_matrix(scene, point)) is not None]
    dependent = [_dependent(matrix) for matrix in matrices]
    if matrices and all(dependent):
        yield from _singular(scene, min(dependent, key=len))


def _varying(scene: Scene) -> Iterator[Problem]:
    """Lagrange's equations in this form need masses that stay as they are."""
    moving = {coordinate.name for coordinate in scene.coordinates} | {"t"}
    for index, body in enumerate(scene.bodies):
        for pointer, part in _of_mass(body):
            if part.names & moving:
                yield Problem("mass-varies", f"/bodies/{index}{pointer}", parameters={"name": body.name})


def _of_mass(body: Body) -> Iterator[tuple[str, Expression]]:
    """What says how much mass there is and where it ends."""
    for key in ("mass", "inertia", "density"):
        quantity = getattr(body, key, ())
        yield from ((f"/{key}", part) for part in (quantity if isinstance(quantity, tuple) else (quantity,)))
    for number, material in enumerate(body.material):
        yield f"/material/{number}/from", material.lower
        yield f"/material/{number}/to", material.upper


def _light(index: int, body: Body, values: Point) -> Iterator[Problem]:
    for part in body.kinetics:
        match part:
            case Translation(mass=mass):
                yield from _not_positive("mass", index, body, evaluate(mass, values))
            case Rotation(inertia=inertia):
                least = min(evaluate(moment, values) for moment in inertia)
                yield from _not_positive("inertia", index, body, least) if least < 0 else ()
            case Distribution(density=density, material=material):
                yield from _light_continuum(index, body, density, material, values)


def _light_continuum(
    index: int, body: Body, density: Node, material: tuple[Material, ...], values: Point
) -> Iterator[Problem]:
    for number, each in enumerate(material):
        lower, upper = evaluate(each.lower.tree, values), evaluate(each.upper.tree, values)
        if not lower < upper:
            parameters = {"name": each.name, "min": f"{lower:g}", "max": f"{upper:g}"}
            yield Problem("empty-material", f"/bodies/{index}/material/{number}/to", parameters=parameters)
            return
    densities = [value for _, inside in _nodes(material, values) if math.isfinite(value := evaluate(density, inside))]
    yield from _not_positive("density", index, body, min(densities, default=math.nan))


def _not_positive(key: str, index: int, body: Body, value: float) -> Iterator[Problem]:
    if not value > 0:
        parameters = {"name": body.name, "value": f"{value:g}"}
        yield Problem(f"{key}-not-positive", f"/bodies/{index}/{key}", parameters=parameters)


def mass_matrix(scene: Scene, point: Point) -> Matrix | None:
    """M at a point, by central differences; None where a position is not defined."""
    size = range(len(scene.free))
    total = [[0.0] * len(size) for _ in size]
    for body in scene.bodies:
        for part in body.kinetics:
            for inertia, columns in _shares(part, scene, point):
                for i in size:
                    for j in size:
                        total[i][j] += inertia * sum(a * b for a, b in zip(columns[i], columns[j], strict=True))
    return total if all(math.isfinite(entry) for row in total for entry in row) else None


def total_mass(scene: Scene) -> float:
    """The mass of all bodies at the scene's own values of the parameters."""
    values = {parameter.name: parameter.value for parameter in scene.parameters}
    return sum(_mass(part, values) for body in scene.bodies for part in body.kinetics)


def _mass(part: Kinetics, values: Point) -> float:
    match part:
        case Translation(mass=mass):
            return evaluate(mass, values)
        case Distribution(density=density, material=material):
            return sum(weight * evaluate(density, inside) for weight, inside in _nodes(material, values))
        case Rotation():
            return 0.0


def _shares(part: Kinetics, scene: Scene, point: Point) -> Iterator[Share]:
    """The part as inertias, each with its velocity for unit rates of the free coordinates."""
    match part:
        case Translation(mass=mass, position=position):
            yield evaluate(mass, _guided(scene, point)), _tangents(position, scene, point)
        case Rotation(inertia=inertia, angular_velocity=angular_velocity):
            for moment, omega in zip(inertia, angular_velocity, strict=True):
                yield evaluate(moment, _guided(scene, point)), _turning(omega, scene, point)
        case Distribution(density=density, position=position, material=material):
            for weight, inside in _nodes(material, point):
                yield weight * evaluate(density, _guided(scene, inside)), _tangents(position, scene, inside)


def _tangents(position: tuple[Node, ...], scene: Scene, point: Point) -> list[list[float]]:
    """∂r/∂q for every free coordinate."""

    def moved(name: str, step: float) -> list[float]:
        values = _guided(scene, {**point, name: point[name] + step})
        return [evaluate(component, values) for component in position]

    pairs = [(moved(c.name, STEP), moved(c.name, -STEP)) for c in scene.free]
    return [[(a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True)] for ahead, behind in pairs]


def _turning(omega: Node, scene: Scene, point: Point) -> list[list[float]]:
    """∂ω/∂q̇ for every free coordinate; ω is the rate of an angle, or given with rates."""
    if isinstance(omega, TimeDerivative):
        return _tangents((omega.operand,), scene, point)
    rest = {f"dot({c.name})": 0.0 for c in scene.coordinates}
    at_rest = evaluate(omega, _guided(scene, {**point, **rest}))
    units = [{**point, **rest, f"dot({c.name})": 1.0} for c in scene.free]
    return [[evaluate(omega, _guided(scene, unit)) - at_rest] for unit in units]


def _nodes(material: tuple[Material, ...], point: Point) -> Iterator[tuple[float, Point]]:
    """Gauss points of the material coordinates with their weights."""
    if not material:
        yield 1.0, point
        return
    first, *rest = material
    lower, upper = evaluate(first.lower.tree, point), evaluate(first.upper.tree, point)
    for place, weight in GAUSS:
        inner = {**point, first.name: lower + place * (upper - lower)}
        for other, inside in _nodes(tuple(rest), inner):
            yield weight * (upper - lower) * other, inside


def _singular(scene: Scene, columns: tuple[int, ...]) -> Iterator[Problem]:
    names = [scene.free[column].name for column in columns]
    index = next(i for i, c in enumerate(scene.coordinates) if c.name == names[-1])
    code = "coordinate-without-inertia" if len(names) == 1 else "dependent-coordinates"
    yield Problem(code, f"/coordinates/{index}", parameters={"name": names[-1], "names": ", ".join(names)})


def _points(scene: Scene) -> Iterator[Point]:
    """Random configurations, away from the symmetric ones that initial values tend to be."""
    source = random.Random(1)
    parameters = {parameter.name: parameter.value for parameter in scene.parameters}
    for _ in range(POINTS):
        coordinates = {c.name: c.value + source.uniform(0.2, 0.9) for c in scene.coordinates}
        yield parameters | coordinates | {"t": source.uniform(0.1, 1.0)}


def _guided(scene: Scene, point: Point) -> Point:
    return {**point, **{guide.coordinate: evaluate(guide.value.tree, point) for guide in scene.guides}}


def _dependent(matrix: Matrix) -> tuple[int, ...]:
    """The columns of a singular matrix that depend on one another; empty if it is regular.

    Gaussian elimination with complete pivoting on the matrix scaled to a unit diagonal.
    """
    scales = [math.sqrt(max(row[i], 0.0)) for i, row in enumerate(matrix)]
    largest = max(scales)
    for i, scale in enumerate(scales):
        if scale <= NOTHING * largest:
            return (i,)
    size = range(len(matrix))
    rows = [[matrix[i][j] / (scales[i] * scales[j]) for j in size] for i in size]
    return _null_vector(rows)


def _null_vector(rows: Matrix) -> tuple[int, ...]:
    left: list[int] = list(range(len(rows)))
    done: list[int] = []
    while left:
        pivot = max(left, key=lambda i: rows[i][i])
        if rows[pivot][pivot] < NOTHING:
            tied = [i for i in done if abs(_solution(rows, done, pivot)[i]) > NOTHING]
            return (*sorted(tied), pivot)
        left.remove(pivot)
        done.append(pivot)
        for i in left:
            factor = rows[i][pivot] / rows[pivot][pivot]
            for j in range(len(rows)):
                rows[i][j] -= factor * rows[pivot][j]
    return ()


def _solution(rows: Matrix, done: list[int], column: int) -> dict[int, float]:
    """How a column is made of the columns eliminated before it: back substitution."""
    weights: dict[int, float] = {}
    for i in reversed(done):
        known = sum(weights[j] * rows[i][j] for j in weights)
        weights[i] = (rows[i][column] - known) / rows[i][i]
    return weights
