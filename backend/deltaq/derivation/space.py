"""Space moved as a whole, in coordinates that it does not act on by affine functions: angles, distances, Euler angles.

A translation δr = a or a rotation δr = n × r of all bodies asks of the changes ξ that ∂r/∂q ξ = δr for each body, and
of a rigid body with the angular velocity ω = B(q) q̇ in its own frame that B ξ = Rᵀ n, where R turns it from where it
began; where it turns alone about its centre of mass, no position changes. R is found from B: the angle whose axis is
fixed in the body turned last, and without it the next one.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §§4.4, 4.9; Marsden, Ratiu, Introduction to Mechanics and
Symmetry, 2nd ed., §15.7.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import sympy as sp

from ..language.derivatives import diff
from ..language.memory import cached_method
from ..mechanics.kinetics import Distribution, Rotation
from .system import System

MOST_TOGETHER = 3  # coordinates of one body, to be solved for
AXES = "xyz"
Shifts = Mapping[str, sp.Expr]


@dataclass(frozen=True)
class Motion:
    """δr = shift + axis × r of all that moves; with `alone` a rigid body turns about its centre of mass."""

    word: str
    shift: sp.ImmutableMatrix
    axis: sp.ImmutableMatrix
    alone: str = ""


@dataclass(frozen=True)
class _Condition:
    """∂r/∂q ξ = δr of one body, or B ξ = Rᵀ n: a matrix with a column for each coordinate, and the right side."""

    matrix: sp.ImmutableMatrix
    right: sp.ImmutableMatrix


@cached_method
def displacements(system: System) -> dict[Motion, Shifts]:
    """ξ of what moves as a whole, where it is not affine in the coordinates, and no sum of others that are."""
    known = motions(system)
    found = {motion: shifts for motion, shifts in known.items() if not _is_affine(system, shifts)}
    spins = [(motion.axis, shifts) for motion, shifts in known.items() if motion.alone]
    return {
        motion: shifts
        for motion, shifts in found.items()
        if motion.alone
        or not any(axis == motion.axis and _is_affine(system, _less(shifts, spin)) for axis, spin in spins)
    }


@cached_method
def motions(system: System) -> dict[Motion, Shifts]:
    """ξ of each motion of space that the bodies can follow, where some coordinate is more than a component."""
    if not _has_waves(system):
        return {}
    found = ((motion, _shifts(system, motion)) for motion in _motions(system))
    return {motion: shifts for motion, shifts in found if shifts}


def _less(one: Shifts, other: Shifts) -> Shifts:
    return {q: one.get(q, sp.S.Zero) - other.get(q, sp.S.Zero) for q in {**one, **other}}


def _has_waves(system: System) -> bool:
    """Whether a position or an angular velocity holds a coordinate otherwise than in a sum of multiples."""
    bodies = system.scene.bodies
    if any(isinstance(part, Distribution) for body in bodies for part in body.kinetics):
        return False  # each of its points would have to move
    turning = (
        list(system.angular_velocity(part)) for body in bodies for part in body.kinetics if isinstance(part, Rotation)
    )
    parts = [*(x for body in bodies for x in system.position(body.name)), *(w for each in turning for w in each)]
    return any(diff(x, system.q(q)).has(*map(system.q, system.free)) for x in parts for q in system.free)


def _motions(system: System) -> Iterator[Motion]:
    """Translations and rotations; in the plane about the third axis. Then the turns of rigid bodies alone."""
    size = len(system.scene.bodies[0].position)
    units = [sp.ImmutableMatrix([int(i == k) for i in range(3)]) for k in range(3)]
    nothing = sp.ImmutableMatrix([0, 0, 0])
    yield from (Motion(f"translation-{AXES[k]}", units[k], nothing) for k in range(size))
    if size == 2:
        yield Motion("rotation-origin", nothing, units[2])
        return
    yield from (Motion(f"rotation-{AXES[k]}", nothing, units[k]) for k in range(3))
    turning = [body.name for body in system.scene.bodies if any(isinstance(part, Rotation) for part in body.kinetics)]
    if any(any(system.position(name)) for name in turning):  # else these are the rotations about the origin
        yield from (Motion(f"spin-{AXES[k]}", nothing, units[k], name) for name in turning for k in range(3))


def _shifts(system: System, motion: Motion) -> Shifts | None:
    """ξ of all coordinates; None where the bodies cannot follow."""
    known: dict[str, sp.Expr] = {}
    for condition in _conditions(system, motion):
        if condition is None or not _solve(system, condition, known):
            return None
    return {q: shift for q, shift in known.items() if shift != 0}


def _conditions(system: System, motion: Motion) -> Iterator[_Condition | None]:
    """Of all orientations, then of all positions."""
    for body in system.scene.bodies:
        axis = motion.axis if motion.alone in ("", body.name) else 0 * motion.axis
        yield from (_of_orientation(system, part, axis) for part in body.kinetics if isinstance(part, Rotation))
    for body in system.scene.bodies:
        position = list(system.position(body.name))
        place = sp.Matrix([*position, *[0] * (3 - len(position))])
        change = motion.shift + (0 * place if motion.alone else motion.axis.cross(place))
        yield _Condition(_slopes(system, position), sp.ImmutableMatrix(list(change)[: len(position)]))


def _slopes(system: System, values: list[sp.Expr]) -> sp.ImmutableMatrix:
    return sp.ImmutableMatrix([[diff(x, system.q(q)) for q in system.free] for x in values])


def _of_orientation(system: System, part: Rotation, axis: sp.Matrix) -> _Condition | None:
    omega = system.angular_velocity(part)
    columns = {q: sp.Matrix([diff(w, system.rate(q)) for w in omega]) for q in system.free}
    matrix = sp.ImmutableMatrix(sp.Matrix.hstack(*columns.values()))
    if len(omega) == 1:
        return _Condition(matrix, sp.ImmutableMatrix([axis[2]]))
    turned = _transposed_rotation(system, {q: c for q, c in columns.items() if any(c)})
    return None if turned is None else _Condition(matrix, sp.ImmutableMatrix(turned * axis))


def _transposed_rotation(system: System, columns: dict[str, sp.Matrix]) -> sp.Matrix | None:
    """Rᵀ, made of the turns about axes of the body, the last one first; None where no axis is fixed in it."""
    found = sp.eye(3)
    while columns:
        fixed = (q for q, axis in columns.items() if not axis.free_symbols and axis.dot(axis) == 1)
        last = next(fixed, None)
        if last is None:
            return None
        axis, angle = columns.pop(last), system.q(last)
        found = found * _rotation(axis, -angle)
        before = {q: (_rotation(axis, angle) * other).applyfunc(system.display) for q, other in columns.items()}
        if any(other.has(angle) for other in before.values()):
            return None
        columns = before
    return found


def _rotation(axis: sp.Matrix, angle: sp.Expr) -> sp.Matrix:
    """Rodrigues: n nᵀ + cos φ (1 − n nᵀ) + sin φ n×"""
    along, (x, y, z) = axis * axis.T, axis
    cross = sp.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return along + sp.cos(angle) * (sp.eye(3) - along) + sp.sin(angle) * cross


def _solve(system: System, condition: _Condition, known: dict[str, sp.Expr]) -> bool:
    """Adds what the condition says of further coordinates; whether it can be fulfilled."""
    columns = {q: condition.matrix[:, k] for k, q in enumerate(system.free)}
    moving = {q: column for q, column in columns.items() if any(column)}
    right = condition.right
    for q, column in moving.items():
        right = right - column * known.get(q, system.zero)
    missing = [q for q in moving if q not in known]
    if len(missing) > MOST_TOGETHER:
        return False
    if missing:
        matrix = sp.Matrix.hstack(*(columns[q] for q in missing))
        square = (matrix.T * matrix).applyfunc(system.display)
        determinant = system.display(square.det(method="berkowitz"))
        if determinant == 0:
            return False
        solution = square.adjugate() * (matrix.T * right) / determinant
        known.update((q, system.display(value)) for q, value in zip(missing, solution, strict=True))
        right = right - matrix * sp.Matrix([known[q] for q in missing])
    return all(system.is_zero(entry) for entry in right)


def _is_affine(system: System, shifts: Shifts) -> bool:
    symbols = [system.q(q) for q in system.free]
    return not any(diff(shift, q).has(*symbols) for shift in shifts.values() for q in symbols)
