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
from ..language.floats import evaluate
from .scene import Scene

POINTS = 5
STEP = 1e-5
NOTHING = 1e-7  # the differences are good to about 1e-10

Matrix = list[list[float]]
Point = Mapping[str, float]


def inertia_problems(scene: Scene) -> Iterator[Problem]:
    """Bodies whose mass is not positive, and coordinates that move no mass of their own."""
    values = {p.name: p.value for p in scene.parameters} | {c.name: c.value for c in scene.coordinates} | {"t": 0.0}
    for index, body in enumerate(scene.bodies):
        mass = evaluate(body.mass.tree, values)
        if mass <= 0:
            parameters = {"name": body.name, "value": f"{mass:g}"}
            yield Problem("mass-not-positive", f"/bodies/{index}/mass", parameters=parameters)
            return
    matrices = [matrix for point in _points(scene) if (matrix := mass_matrix(scene, point)) is not None]
    dependent = [_dependent(matrix) for matrix in matrices]
    if matrices and all(dependent):
        yield from _singular(scene, min(dependent, key=len))


def mass_matrix(scene: Scene, point: Point) -> Matrix | None:
    """M at a point, by central differences; None where a position is not defined."""
    names = [coordinate.name for coordinate in scene.free]
    total = [[0.0] * len(names) for _ in names]
    for body in scene.bodies:
        mass = evaluate(body.mass.tree, _guided(scene, point))
        ahead = [_position(scene, body.name, {**point, name: point[name] + STEP}) for name in names]
        behind = [_position(scene, body.name, {**point, name: point[name] - STEP}) for name in names]
        tangents = [
            [(a - b) / (2 * STEP) for a, b in zip(p, q, strict=True)] for p, q in zip(ahead, behind, strict=True)
        ]
        for i, first in enumerate(tangents):
            for j, second in enumerate(tangents):
                total[i][j] += mass * sum(a * b for a, b in zip(first, second, strict=True))
    return total if all(math.isfinite(entry) for row in total for entry in row) else None


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


def _position(scene: Scene, place: str, point: Point) -> list[float]:
    values = _guided(scene, point)
    return [evaluate(component.tree, values) for component in scene.place(place)]


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
