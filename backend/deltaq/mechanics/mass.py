"""How much mass a scene has, and which of it its coordinates move: J = ∂r/∂q in plain numbers.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.6.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ..language.floats import evaluate
from ..language.gradients import gradient
from ..language.spelling import spell_rate
from ..language.tree import Node, TimeDerivative
from .kinetics import Distribution, Kinetics, Rotation, Translation
from .material import Material
from .scene import Scene

NOTHING = 1e-12  # of the largest entry of a tensor: what elimination leaves of nothing
GAUSS = ((0.5 - math.sqrt(0.15), 5 / 18), (0.5, 8 / 18), (0.5 + math.sqrt(0.15), 5 / 18))  # on the unit interval

Matrix = list[list[float]]
Point = Mapping[str, float]
Share = tuple[float, list[list[float]]]  # an inertia, and the velocity it has for each unit rate


def motions_matrix(scene: Scene, point: Point) -> Matrix | None:
    """Σ JᵀJ over all that has mass, however little: singular just where M is, since M = Σ m Jᵀ J with m > 0.

    None where a position has no slope.
    """
    size = range(len(scene.free))
    total = [[0.0] * len(size) for _ in size]
    for body in scene.bodies:
        for part in body.kinetics:
            for columns in (columns for inertia, columns in _shares(part, scene, point) if inertia > 0.0):
                moved = [i for i in size if any(columns[i])]
                for i in moved:
                    for j in moved:
                        total[i][j] += sum(a * b for a, b in zip(columns[i], columns[j], strict=True))
    return total if all(math.isfinite(entry) for row in total for entry in row) else None


def total_mass(scene: Scene) -> float:
    """The mass of all bodies at the scene's own values of the parameters."""
    values = scene.parameter_values
    return sum(_mass(part, values) for body in scene.bodies for part in body.kinetics)


def _mass(part: Kinetics, values: Point) -> float:
    match part:
        case Translation(mass=mass):
            return evaluate(mass, values)
        case Distribution(density=density, material=material):
            return sum(weight * evaluate(density, inside) for weight, inside in nodes(material, values))
        case Rotation():
            return 0.0


def _shares(part: Kinetics, scene: Scene, point: Point) -> Iterator[Share]:
    """The part as inertias, each with its velocity for unit rates of the free coordinates."""
    match part:
        case Translation(mass=mass, position=position):
            yield evaluate(mass, _guided(scene, point)), _tangents(position, scene, point)
        case Rotation():
            turning = rates_of_turning(part, scene, point)
            for moment, weights in squares(part, _guided(scene, point)) or ():
                yield moment, [[_weighted(weights, rates)] for rates in turning]
        case Distribution(density=density, position=position, material=material):
            for weight, inside in nodes(material, point):
                yield weight * evaluate(density, _guided(scene, inside)), _tangents(position, scene, inside)


def squares(part: Rotation, values: Point) -> list[tuple[float, list[float]]] | None:
    """Σ Jₖₗ ωₖ ωₗ as Σ d (w·ω)², each d ≥ 0 with its w: J = L D Lᵀ; None where some ω makes it negative.

    Source: Golub, Van Loan, Matrix Computations, 4th ed., §4.2.8 (semidefinite systems).
    """
    return squares_of(tensor(part, values))


def tensor(part: Rotation, values: Point) -> Matrix:
    """Jₖₗ in numbers, all rows."""
    size = len(part.inertia)
    found = [[0.0] * size for _ in range(size)]
    for k, l, entry in part.entries:
        found[k][l] = found[l][k] = evaluate(entry, values)
    return found


def squares_of(matrix: Matrix) -> list[tuple[float, list[float]]] | None:
    """Those of any symmetric matrix; None where it is not positive semidefinite."""
    size, left = len(matrix), [list(row) for row in matrix]
    floor = NOTHING * max(map(abs, (entry for row in left for entry in row)), default=0.0)
    found = []
    for k in range(size):
        pivot, column = left[k][k], [row[k] for row in left]
        if pivot <= floor:
            if pivot < -floor or max(map(abs, column)) > floor:
                return None
            continue
        weights = [entry / pivot for entry in column]
        found.append((pivot, weights))
        for i in range(size):
            for j in range(size):
                left[i][j] -= pivot * weights[i] * weights[j]
    return found


def _weighted(weights: list[float], rates: tuple[float, ...]) -> float:
    return sum(weight * rate for weight, rate in zip(weights, rates, strict=True))


def _tangents(position: tuple[Node, ...], scene: Scene, point: Point) -> list[list[float]]:
    """∂r/∂q for every free coordinate."""
    values, names = _guided(scene, point), [c.name for c in scene.free]
    return [list(each) for each in zip(*(gradient(component, values, names) for component in position), strict=True)]


def rates_of_turning(part: Rotation, scene: Scene, point: Point) -> list[tuple[float, ...]]:
    """∂ω/∂q̇ for every free coordinate, all components of each."""
    turning = [_turning(omega, scene, point) for omega in part.angular_velocity]
    return [tuple(rate for (rate,) in rates) for rates in zip(*turning, strict=True)]


def _turning(omega: Node, scene: Scene, point: Point) -> list[list[float]]:
    """∂ω/∂q̇ for every free coordinate; ω is the rate of an angle, or given with rates."""
    if isinstance(omega, TimeDerivative):
        return _tangents((omega.operand,), scene, point)
    rest = {spell_rate(c.name, 1): 0.0 for c in scene.coordinates}
    slopes = gradient(omega, _guided(scene, {**point, **rest}), [spell_rate(c.name, 1) for c in scene.free])
    return [[slope] for slope in slopes]


def nodes(material: tuple[Material, ...], point: Point) -> Iterator[tuple[float, Point]]:
    """Gauss points of the material coordinates with their weights."""
    if not material:
        yield 1.0, point
        return
    first, *rest = material
    lower, upper = evaluate(first.lower.tree, point), evaluate(first.upper.tree, point)
    for place, weight in GAUSS:
        inner = {**point, first.name: lower + place * (upper - lower)}
        for other, inside in nodes(tuple(rest), inner):
            yield weight * (upper - lower) * other, inside


def _guided(scene: Scene, point: Point) -> Point:
    return {**point, **{guide.coordinate: evaluate(guide.value.tree, point) for guide in scene.guides}}
