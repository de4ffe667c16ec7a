"""Whether the components of an angular velocity belong to axes that are fixed in the body.

With ω = Σ wⱼ q̇ⱼ along such axes, ∂wⱼ/∂qₖ − ∂wₖ/∂qⱼ = wⱼ × wₖ for each pair of coordinates, since the rotation that they
come from has second derivatives that do not depend on their order. Along axes fixed in space the right side is wₖ × wⱼ.
Where constraints hold between coordinates, as between Euler parameters, this is asked where they hold, and of pairs of
directions along them: Σ uⱼ vₖ of both sides. Beside them the components may be those of no rotation.
A body of revolution has the same kinetic energy along axes that do not spin with it, which is looked at as well.
Source: Whittaker, A Treatise on the Analytical Dynamics of Particles and Rigid Bodies, 4th ed., §16.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from itertools import combinations, permutations

from ..errors import Problem
from .kinetics import Rotation
from .mass import rates_of_turning, tensor
from .redundancy import position_on
from .rows import NOTHING, dot, independent, minus, row_of, unit
from .scene import Scene

POINTS = 3
STEPS = (1e-5, 1e-7, 1e-9)  # for angles of arcs on circles as small as a micrometre; the one that fits best counts
CLOSE = 1e-6  # of the sizes: differences are good to about 1e-7

Vector = tuple[float, ...]
AXES = range(3)


def body_axes_problems(scene: Scene) -> Iterator[Problem]:
    """Angular velocities of no rotation, which is a warning where moments that are equal may make the energy right."""
    parts = [
        (index, body, part)
        for index, body in enumerate(scene.bodies)
        for part in body.kinetics
        if isinstance(part, Rotation) and len(part.angular_velocity) == len(AXES)
    ]
    points = list(_points(scene)) if parts else []
    for index, body, part in parts:
        left = [gap for point in points for gap in _gaps(part, scene, point)]
        if not any(abs(entry) > CLOSE for gap in left for entry in gap):
            continue
        place, told = f"/bodies/{index}/angular_velocity", {"name": body.name}
        if all(_may_have_right_energy(tensor(part, point), left) for point in points):
            yield Problem("angular-velocity-beside-body", place, parameters=told, severity="warning")
        else:
            yield Problem("angular-velocity-of-none", place, parameters=told)


def _directions(scene: Scene, point: Mapping[str, float]) -> list[Vector]:
    """A basis of what moves the free coordinates along all holonomic constraints: all of them where there is none."""
    free = [coordinate.name for coordinate in scene.free]
    units = [tuple(float(i == k) for i in range(len(free))) for k in range(len(free))]
    rows = [row_of(each, free, point) for each in scene.conditions if each.is_holonomic]
    if not rows:
        return units
    across, found = [unit(rows[k]) for k in independent(rows, NOTHING)], list[Vector]()
    normal = list[Vector]()
    for row in across:
        normal.append(unit(_beside(row, normal)))
    for each in units:
        left = _beside(each, [*normal, *found])
        if dot(left, left) > NOTHING:
            found.append(unit(left))
    return found


def _beside(row: Vector, basis: list[Vector]) -> Vector:
    """What is left of a row beside rows of length 1 that are orthogonal; taken twice, for what rounding leaves."""
    for each in (*basis, *basis):
        row = minus(row, each, dot(row, each))
    return row


def _gaps(part: Rotation, scene: Scene, point: Mapping[str, float]) -> Iterator[Vector]:
    """∂wⱼ/∂qₖ − ∂wₖ/∂qⱼ − wⱼ × wₖ of all pairs, relative to the sizes in it; NaN where that has no value."""
    tried = [_gaps_by(part, scene, point, step) for step in STEPS]
    yield from (min(each, key=lambda gap: max(map(abs, gap))) for each in zip(*tried, strict=True))


def _gaps_by(part: Rotation, scene: Scene, point: Mapping[str, float], step: float) -> Iterator[Vector]:
    """The same by differences of this step."""
    here = rates_of_turning(part, scene, point)
    slopes = [_slope(part, scene, point, coordinate.name, step) for coordinate in scene.free]
    for u, v in combinations(_directions(scene, point), 2):
        total, size = [0.0] * len(AXES), 1.0
        for j, k in permutations(range(len(here)), 2):
            turned, share = _cross(here[j], here[k]), u[j] * v[k]
            if share == 0.0:
                continue
            size += sum(abs(share * x) for each in (slopes[k][j], slopes[j][k], turned) for x in each)
            for i in AXES:
                total[i] += share * (slopes[k][j][i] - slopes[j][k][i] - turned[i])
        yield tuple(entry / size for entry in total)


def _slope(part: Rotation, scene: Scene, point: Mapping[str, float], name: str, step: float) -> list[Vector]:
    """∂wⱼ/∂q of all j by central differences."""
    ahead, behind = (rates_of_turning(part, scene, {**point, name: point[name] + side}) for side in (step, -step))
    pairs = zip(ahead, behind, strict=True)
    return [tuple((a - b) / (2 * step) for a, b in zip(one, other, strict=True)) for one, other in pairs]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _may_have_right_energy(moments: list[list[float]], gaps: list[Vector]) -> bool:
    """Whether the body looks the same along some other axes: any, or those that turn about its axis of revolution.

    Its energy is right if the components belong to such axes, which is not looked at: of a ball any may.
    """
    size = max(abs(entry) for row in moments for entry in row)
    products = max(abs(moments[k][l]) for k, l in combinations(AXES, 2))
    if products > CLOSE * size:
        return False
    equal = [abs(moments[k - 2][k - 2] - moments[k - 1][k - 1]) <= CLOSE * size for k in AXES]
    return all(equal) or any(equal[k] and all(abs(gap[k]) <= CLOSE for gap in gaps) for k in AXES)


def _points(scene: Scene) -> Iterator[dict[str, float]]:
    """Random configurations, with other parameters than the scene's: moments that are equal by chance are not."""
    source = random.Random(1)
    for _ in range(POINTS):
        parameters = {p.name: p.value * source.uniform(0.7, 1.3) for p in scene.parameters}
        coordinates = {c.name: c.value + source.uniform(0.2, 0.9) for c in scene.coordinates}
        point = parameters | coordinates | {"t": source.uniform(0.1, 1.0)}
        held = position_on(scene.conditions, [c.name for c in scene.free], point) if scene.conditions else point
        if held is not None:
            yield dict(held)
