"""Whether every coordinate moves mass of its own, in plain numbers; how much mass that is does not matter.

The mass matrix is singular everywhere if a coordinate moves no mass, or if coordinates only ever
move together; at single points it may be singular in any scene (the pole of the spherical pendulum).
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.6.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator

from ..errors import Parameter, Problem
from ..language.expression import Expression, expressions_in
from ..language.floats import evaluate
from ..language.tree import Node
from .bodies import Body
from .kinetics import Distribution, Rotation, Translation
from .mass import Matrix, Point, motions_matrix, nodes, squares, squares_of, tensor
from .material import Material
from .rows import NOTHING
from .scene import Scene

POINTS = 5


def inertia_problems(scene: Scene) -> Iterator[Problem]:
    """Bodies whose mass is not positive, and coordinates that move no mass of their own."""
    values = scene.stated_values
    yield from _varying(scene)
    light = [problem for _, problem in light_problems(scene, values)]
    if light:
        yield from light
        return
    matrices = [matrix for point in _points(scene) if (matrix := motions_matrix(scene, point)) is not None]
    dependent = [_dependent(matrix) for matrix in matrices]
    if matrices and all(dependent):
        yield from _singular(scene, min(dependent, key=len))


def light_problems(scene: Scene, values: Point) -> Iterator[tuple[Body, Problem]]:
    """Bodies whose mass is not positive, with values of parameters by name."""
    for index, body in enumerate(scene.bodies):
        yield from ((body, problem) for problem in _light(index, body, values))


def names_of_mass(body: Body) -> frozenset[str]:
    """What says how much mass a body has, and where, depends on."""
    return frozenset[str]().union(*(part.names for _, part in _of_mass(body)))


def moment_problems(scene: Scene) -> Iterator[Problem]:
    """Warnings of bodies in space with moments of inertia that no distribution of mass has.

    ∫ r rᵀ dm = (tr J/2) 1 − J is negative in no direction, so that no principal moment exceeds the sum of the others.
    The equations of motion make sense all the same.
    Source: Landau, Lifshitz, Mechanics, 3rd ed., §32.
    """
    values = scene.stated_values
    for index, body in enumerate(scene.bodies):
        for part in body.kinetics:
            if isinstance(part, Rotation) and len(part.inertia) == 3 and _is_of_no_body(tensor(part, values)):
                told = {"name": body.name}
                yield Problem("inertia-of-no-body", f"/bodies/{index}/inertia", parameters=told, severity="warning")


def _is_of_no_body(moments: Matrix) -> bool:
    """Whether J itself is sound, and what it follows from is not."""
    half = 0.5 * sum(moments[k][k] for k in range(len(moments)))
    spread = [[half * (k == l) - entry for l, entry in enumerate(row)] for k, row in enumerate(moments)]
    return math.isfinite(half) and squares_of(moments) is not None and squares_of(spread) is None


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
        yield from ((f"/{key}", part) for part in expressions_in(getattr(body, key, ())))
    for number, material in enumerate(body.material):
        yield f"/material/{number}/from", material.lower
        yield f"/material/{number}/to", material.upper


def _light(index: int, body: Body, values: Point) -> Iterator[Problem]:
    for part in body.kinetics:
        match part:
            case Translation(mass=mass):
                yield from _not_positive("mass", index, body, evaluate(mass, values))
            case Rotation():
                yield from _light_turning(index, body, part, values)
            case Distribution(density=density, material=material):
                yield from _light_continuum(index, body, density, material, values)


def _light_turning(index: int, body: Body, part: Rotation, values: Point) -> Iterator[Problem]:
    """1/2 Σ Jₖₗ ωₖ ωₗ is negative for no ω: no moment is, and no pivot of Gaussian elimination."""
    least = min(evaluate(moment, values) for moment in part.inertia)
    if least < 0:
        yield from _not_positive("inertia", index, body, least)
    elif squares(part, values) is None:
        yield Problem("inertia-indefinite", f"/bodies/{index}/inertia", parameters={"name": body.name})


def _light_continuum(
    index: int, body: Body, density: Node, material: tuple[Material, ...], values: Point
) -> Iterator[Problem]:
    for number, each in enumerate(material):
        lower, upper = evaluate(each.lower.tree, values), evaluate(each.upper.tree, values)
        if not lower < upper:
            parameters: dict[str, Parameter] = {
                "name": each.name,
                "min": float(f"{lower:g}"),
                "max": float(f"{upper:g}"),
            }
            yield Problem("empty-material", f"/bodies/{index}/material/{number}/to", parameters=parameters)
            return
    densities = [value for _, inside in nodes(material, values) if math.isfinite(value := evaluate(density, inside))]
    yield from _not_positive("density", index, body, min(densities, default=math.nan))


def _not_positive(key: str, index: int, body: Body, value: float) -> Iterator[Problem]:
    if not value > 0:
        parameters: dict[str, Parameter] = {"name": body.name, "value": float(f"{value:g}")}
        yield Problem(f"{key}-not-positive", f"/bodies/{index}/{key}", parameters=parameters)


def _singular(scene: Scene, columns: tuple[int, ...]) -> Iterator[Problem]:
    names = [scene.free[column].name for column in columns]
    index = next(i for i, c in enumerate(scene.coordinates) if c.name == names[-1])
    code = "coordinate-without-inertia" if len(names) == 1 else "dependent-coordinates"
    conditions = [Expression("", condition.value) for condition in scene.conditions]
    if len(names) == 1 and any(names[0] in each.names | each.rates for each in conditions):
        code = "held-coordinate-without-inertia"
    yield Problem(code, f"/coordinates/{index}", parameters={"name": names[-1], "names": ", ".join(names)})


def _points(scene: Scene) -> Iterator[Point]:
    """Random configurations, away from the symmetric ones that initial values tend to be, and one beside these.

    A rope that runs over an edge no longer moves when all of it is behind.
    """
    source = random.Random(1)
    parameters = scene.parameter_values
    for low, high in (*((0.2, 0.9),) * POINTS, (0.02, 0.08)):
        coordinates = {c.name: c.value + source.uniform(low, high) for c in scene.coordinates}
        yield parameters | coordinates | {"t": source.uniform(0.1, 1.0)}


def _dependent(matrix: Matrix) -> tuple[int, ...]:
    """The columns of a singular matrix that depend on one another; empty if it is regular.

    Gaussian elimination with complete pivoting on the matrix scaled to a unit diagonal.
    """
    scales = [math.sqrt(max(row[i], 0.0)) for i, row in enumerate(matrix)]
    for i, scale in enumerate(scales):
        if scale == 0.0:
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
