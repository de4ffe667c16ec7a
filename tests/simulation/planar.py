"""Newton's and Euler's laws for rigid bodies with pin joints in a plane: accelerations and what the joints exert.

Written without any coordinates of a scene: each body has the accelerations of its centre of mass and of its turning,
each joint a force, and the two points that a joint holds together have one acceleration, a + α × d − ω² d.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
FRAME = -1


@dataclass(frozen=True)
class Body:
    """Mass, moment of inertia about the centre of mass, rate of turning, and the force at the centre of mass."""

    mass: float
    inertia: float
    rate: float
    force: tuple[float, float]


@dataclass(frozen=True)
class Pin:
    """A joint: a body and the way from its centre of mass to the joint; the same of the other, or the FRAME."""

    body: int
    arm: Floats
    other: int = FRAME
    other_arm: Floats | None = None


@dataclass(frozen=True)
class Found:
    """Accelerations of bodies, shape (bodies, 3) with that of turning last; forces on each pin's first body."""

    accelerations: Floats
    forces: Floats


def newton_euler(bodies: list[Body], pins: list[Pin], slides: list[tuple[int, int]] | None = None) -> Found:
    """Solves for all accelerations and joint forces at once. `slides`: a body, and which acceleration of it is zero."""
    slides = slides or []
    n, m = 3 * len(bodies), 2 * len(pins)
    size = n + m + len(slides)
    left, right = np.zeros((size, size)), np.zeros(size)
    for k, body in enumerate(bodies):
        left[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] = np.diag([body.mass, body.mass, body.inertia])
        right[3 * k : 3 * k + 2] = body.force
    for j, pin in enumerate(pins):
        ends = [(pin.body, pin.arm, 1.0), (pin.other, pin.other_arm, -1.0)]
        for index, arm, sign in ends:
            if index == FRAME or arm is None:
                continue
            point = np.array([[1.0, 0.0, -arm[1]], [0.0, 1.0, arm[0]]])  # its acceleration, all but −ω² d
            rows, columns = slice(n + 2 * j, n + 2 * j + 2), slice(3 * index, 3 * index + 3)
            left[rows, columns] = sign * point
            left[columns, rows] = -sign * point.T
            right[rows] += sign * bodies[index].rate ** 2 * arm
    for i, (index, which) in enumerate(slides):
        left[n + m + i, 3 * index + which] = 1.0
        left[3 * index + which, n + m + i] = -1.0
    found = np.linalg.solve(left, right)
    return Found(found[:n].reshape(-1, 3), found[n : n + m].reshape(-1, 2))
