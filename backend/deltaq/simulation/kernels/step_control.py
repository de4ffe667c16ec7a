"""How large the next step is: PI control.

Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4, and II, IV.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline, runtime_int
from .motion import FINE, ROUNDING, STIFF, Floats, Motion, rhs
from .plan import Plan
from .step import Workspace

MANY = 1000  # steps held back by stability, after which it is asked whether the end can be reached
SAFETY, LARGEST_GROWTH, LARGEST_SHRINK = 0.9, 6.0, 0.2


class Control(NamedTuple):
    """How to choose steps: `tolerance` 0 means the fixed steps of the plan.

    `largest_step` bounds adaptive ones on the whole span; the plan may bound them further. `stability` is how far an
    explicit method of so many `stages` is stable on the negative real axis.
    """

    tolerance: float
    largest_step: float
    error_order: float
    memory: float
    step_limit: int
    stages: int
    stability: float
    plan: Plan


@inline
def error_norm(error: Floats, tolerance: float, h: float, degrees: int, workspace: Workspace) -> float:
    """The estimated error of the step over what is tolerated (root mean square); 1 is just good enough.

    `error` has shape (estimates, s + 1). Two estimates are joined as in DOP853: e₅² / √(e₅² + e₃²/100).
    """
    fine, coarse = 0.0, 0.0
    for d in range(2 * degrees):
        weight = 1.0 / (tolerance * max(1.0, abs(workspace.old[d]), abs(workspace.new[d])))
        first, second = 0.0, 0.0
        for j in range(error.shape[1]):
            first += error[0, j] * workspace.derivatives[j, d]
            if error.shape[0] > 1:
                second += error[1, j] * workspace.derivatives[j, d]
        fine += (first * weight) ** 2
        coarse += (second * weight) ** 2
    joined = fine + 0.01 * coarse if error.shape[0] > 1 else fine
    return h * fine / np.sqrt(joined * 2 * degrees) if joined > 0.0 else 0.0


@inline
def first_step(motion: Motion, control: Control, t: float, workspace: Workspace) -> float:
    """A first step size: an Euler step tells how the right-hand side changes.

    Source: Hairer, Nørsett, Wanner I, II.4.
    """
    width = 2 * motion.degrees
    size, speed, bend = 0.0, 0.0, 0.0
    for d in range(width):
        scale = control.tolerance * max(1.0, abs(workspace.old[d]))
        size += (workspace.old[d] / scale) ** 2
        speed += (workspace.derivatives[0, d] / scale) ** 2
    h = 0.01 * np.sqrt(size / speed) if size > 0.0 and speed > 0.0 else 1e-6
    h = min(h, control.largest_step)
    for d in range(workspace.old.size):
        workspace.stage[d] = workspace.old[d] + h * workspace.derivatives[0, d]
    if rhs(motion, t + h, workspace.stage, workspace.derivatives[1]) != FINE:
        return 0.01 * h
    for d in range(width):
        scale = control.tolerance * max(1.0, abs(workspace.old[d]))
        bend += ((workspace.derivatives[1, d] - workspace.derivatives[0, d]) / scale) ** 2
    steepest = np.sqrt(max(speed, bend / (h * h)) / width)
    wanted = (0.01 / steepest) ** (1.0 / control.error_order) if steepest > 0.0 else 100.0 * h
    return max(min(100.0 * h, wanted, control.largest_step), 1e-12 * control.largest_step)


@inline
def log_error(error: float) -> float:
    """The logarithm of an error, which PI control reckons with; hardly any error counts like 1e-10."""
    return float(np.log(max(error, 1e-10)))


@inline
def controlled_step(control: Control, h: float, now: float, before: float, growth: float) -> float:
    """PI control: the next step after an accepted one, by the logarithms of this error and the one before.

    It is at most `growth` times h.
    """
    power = 1.0 / control.error_order - 0.75 * control.memory
    factor = SAFETY * np.exp(control.memory * before - power * now)
    return float(min(h * min(max(factor, LARGEST_SHRINK), growth), control.largest_step))


@inline
def reduced_step(control: Control, h: float, error: float) -> float:
    """The step to try again with; `error` is NaN if a stage failed."""
    if not error < np.inf:
        return 0.1 * h
    return float(h * max(SAFETY * error ** (-1.0 / control.error_order), LARGEST_SHRINK))


@inline
def is_resolvable(control: Control, t: float, h: float) -> bool:
    """Whether t and t + h are different times in double precision, with some digits to spare."""
    return h > 16.0 * ROUNDING * max(abs(t), 1e-3 * control.largest_step)


@inline
def is_stability_limited(control: Control, h: float, degrees: int, workspace: Workspace) -> bool:
    """Whether stability, not accuracy, limits the step: h times the size of the Jacobian is at its bound.

    The size is |Δf|/|Δy| between the last stage and the new state (Hairer, Wanner II, IV.2).
    """
    bend, distance, end = 0.0, 0.0, control.stages
    for d in range(2 * degrees):
        bend += (workspace.derivatives[end, d] - workspace.derivatives[end - 1, d]) ** 2
        distance += (workspace.new[d] - workspace.stage[d]) ** 2
    return bool(distance > 0.0 and h * h * bend > control.stability**2 * distance)


@inline
def detect_stiffness(
    control: Control, stability_limited: int, steps: int, left: float, h: float, degrees: int, workspace: Workspace
) -> tuple[int, int]:
    """How many steps stability has limited, and STIFF if so many that the end cannot be reached, else FINE."""
    if control.tolerance == 0.0:
        return runtime_int(0), FINE
    stability_limited = (
        stability_limited + 1
        if is_stability_limited(control, h, degrees, workspace)
        else max(stability_limited - 10, 0)
    )
    return stability_limited, STIFF if stability_limited >= MANY and steps + left / h > control.step_limit else FINE
