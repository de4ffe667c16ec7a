"""The library's four-bar in its one freedom: no constraint, no multiplier, and nothing that δq derives or integrates.

The crank's angle φ₁ gives those of coupler and rocker, where two circles meet, and their derivatives by φ₁ from the
closed loop; then J(φ₁) φ̈₁ + ½ J′(φ₁) φ̇₁² + V′(φ₁) = 0. The crank is the shortest bar and turns all round (Grashof).
Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, ch. 2; SciPy's DOP853 follows it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Floats = NDArray[np.float64]
A, B, C, GROUND, LINE_DENSITY, GRAVITY = 0.3, 0.9, 0.6, 0.9, 1.0, 9.81  # the scene's parameters
FINEST = 1e-13  # relative and absolute, of each step


def followed(crank: float, rate: float, times: Floats, longest: float = 0.02) -> Floats:
    """φ₁, φ₂, φ₃ and their rates at the times, shape (samples, 6), from where the crank is and how fast it turns.

    No step is longer than `longest`, in seconds.
    """

    def bent(_: float, state: Floats) -> list[float]:
        inertia, slope, pull, *_ = _terms()(*_angles(state[0]))
        return [state[1], -(0.5 * slope * state[1] ** 2 + pull) / inertia]

    span = (float(times[0]), float(times[-1]))
    found = solve_ivp(bent, span, [crank, rate], "DOP853", times, rtol=FINEST, atol=FINEST, max_step=longest)
    assert found.success
    angles = [_angles(angle) for angle in found.y[0]]
    slopes = np.array([[1.0, *_terms()(*each)[3:]] for each in angles])
    return np.hstack([angles, slopes * found.y[1][:, None]])


def _angles(crank: float) -> tuple[float, float, float]:
    """All three, the joint above the line from crank pin to right bearing."""
    pin = A * np.array([np.cos(crank), np.sin(crank)])
    across = np.array([GROUND, 0.0]) - pin
    length = float(np.hypot(*across))
    coupler = np.arctan2(across[1], across[0]) + np.arccos((B**2 + length**2 - C**2) / (2.0 * B * length))
    joint = pin + B * np.array([np.cos(coupler), np.sin(coupler)])
    return crank, float(coupler), float(np.arctan2(joint[1], joint[0] - GROUND))


@cache
def _terms() -> Callable[..., tuple[float, ...]]:
    """J, J′, V′, φ₂′ and φ₃′ as a function of the three angles."""
    one, two, three = sp.symbols("one two three")
    of_two = A * sp.sin(three - one) / (B * sp.sin(two - three))
    of_three = A * sp.sin(two - one) / (C * sp.sin(two - three))

    def along(of: sp.Expr) -> sp.Expr:
        return sp.diff(of, one) + of_two * sp.diff(of, two) + of_three * sp.diff(of, three)

    middle = (A * sp.cos(one) + B * sp.cos(two) / 2, A * sp.sin(one) + B * sp.sin(two) / 2)
    speed = sum(along(each) ** 2 for each in middle)
    inertia = A**3 / 3 + B * speed + B**3 / 12 * of_two**2 + C**3 / 3 * of_three**2
    height = A**2 / 2 * sp.sin(one) + B * middle[1] + C**2 / 2 * sp.sin(three)
    terms = [LINE_DENSITY * each for each in (inertia, along(inertia), GRAVITY * along(height))]
    return sp.lambdify((one, two, three), [*terms, of_two, of_three], "math", cse=True)
