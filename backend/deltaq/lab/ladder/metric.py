"""What distances are made of: the angles among the coordinates, the particles."""

from __future__ import annotations

import numpy as np

from ...language.floats import evaluate
from ...mechanics.bodies.particle import Particle
from ...mechanics.scene import Scene
from ...simulation.problem import Problem

DEGREE = np.pi / 180.0


def radians(scene: Scene, problem: Problem) -> tuple[float, ...]:
    """How many radians each free coordinate's unit has; 0 for what is no angle."""
    pairs = zip(scene.free, problem.angular, strict=True)
    return tuple((DEGREE if each.unit in ("°", "deg") else 1.0) if angular else 0.0 for each, angular in pairs)


def particles(scene: Scene) -> dict[str, float]:
    """The masses of the bodies by name where all of them are particles, else nothing."""
    if not all(isinstance(body, Particle) for body in scene.bodies):
        return {}
    values = scene.parameter_values
    return {body.name: evaluate(body.mass.tree, values) for body in scene.bodies if isinstance(body, Particle)}
