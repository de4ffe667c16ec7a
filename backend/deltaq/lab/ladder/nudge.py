"""Nudges: whether what a rung says still holds when all initial values are a millionth off.

A rung may agree with the full motion by symmetry alone: a spring pendulum that hangs straight never swings, whether it
is allowed to or not. A parametric or internal resonance, or an equilibrium that is unstable, makes much of the least
deviation; nothing real keeps it out. So the full model and the rung are run again from values nudged by 10⁻⁶, each
coordinate and rate by its own part of that and in two ways, such that no mode is left out. Both are nudged: that
nearby motions of the full model part from each other, as chaotic ones do, is no fault of the rung. Where the full
motion stands still, the motion after the nudge is all there is to get right.
Source: Landau, Lifshitz, Mechanics, §27 and §29; Nayfeh, Mook, Nonlinear Oscillations, ch. 5 and 6.
"""

from __future__ import annotations

import math

import numpy as np

from ...mechanics.scene import Scene
from ...simulation.problem import Floats
from .centre import starting
from .distance import Yardstick

NUDGE = 1e-6  # radians, and metres of what turns by them; rates by as much over the whole span
MOST = 1e-4  # of the size of the motion: what a nudge may be of one that is small itself
WAYS = 2
GROWS = 100.0  # times the nudge: what a motion makes of it in which nothing grows


def nudged(scene: Scene, full: Yardstick, way: int) -> Scene:
    """The scene with all initial values and rates changed by about 10⁻⁶; `way` is one of WAYS."""
    n = len(scene.free)
    parts = np.array([_part(way * 2 * n + k) for k in range(2 * n)])
    values, rates = parts[:n] * _steps(full), parts[n:] * _steps(full) / full.problem.t_end
    found = {c.name: (c.value + dq, c.rate + dv) for c, dq, dv in zip(scene.free, values, rates, strict=True)}
    return starting(scene, found)


def allowed(before: float, tolerance: float, full: Yardstick) -> float:
    """The error allowed after a nudge, relative to the extent: the tolerance, or what grows only as the nudge does."""
    return max(tolerance, before + GROWS * float(np.max(_steps(full) / full.units)))


def _steps(full: Yardstick) -> Floats:
    """How far each coordinate is nudged."""
    return np.minimum(NUDGE * full.wide_units, MOST * full.units)


def _part(count: int) -> float:
    """Between 1 and 2 in size, of both signs, no two alike: multiples of the golden section, which never repeat."""
    fraction = math.modf((count + 1) * (math.sqrt(5.0) - 1.0) / 2.0)[0]
    return math.copysign(1.0 + fraction, math.cos(math.pi * math.floor((count + 1) * math.sqrt(2.0))))
