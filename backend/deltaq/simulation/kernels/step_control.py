"""How large the next step is: PI control.

Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4, and II, IV.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner, variable
from .motion import FINE, ROUNDING, STIFF, Floats, Motion, slope
from .plan import Plan
from .step import Room

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


@inner
def error_norm(error: Floats, tolerance: float, h: float, degrees: int, room: Room) -> float:
    """The estimated error of the step over what is tolerated (root mean square); 1 is just good enough.

    With two estimates they are joined as in DOP853: e₅² / √(e₅² + e₃²/100).
    """
    fine, coarse = 0.0, 0.0
    for d in range(2 * degrees):
        weight = 1.0 / (tolerance * max(1.0, abs(room.old[d]), abs(room.new[d])))
        first, second = 0.0, 0.0
        for j in range(error.shape[1]):
            first += error[0, j] * room.slopes[j, d]
            if error.shape[0] > 1:
                second += error[1, j] * room.slopes[j, d]
        fine += (first * weight) ** 2
        coarse += (second * weight) ** 2
    joined = fine + 0.01 * coarse if error.shape[0] > 1 else fine
    return h * fine / np.sqrt(joined * 2 * degrees) if joined > 0.0 else 0.0


@inner
def first_step(motion: Motion, control: Control, t: float, room: Room) -> float:
    """A first step size (Hairer, Nørsett, Wanner I, II.4): an Euler step tells how the slope changes."""
    width = 2 * motion.degrees
    size, speed, bend = 0.0, 0.0, 0.0
    for d in range(width):
        scale = control.tolerance * max(1.0, abs(room.old[d]))
        size += (room.old[d] / scale) ** 2
        speed += (room.slopes[0, d] / scale) ** 2
    h = 0.01 * np.sqrt(size / speed) if size > 0.0 and speed > 0.0 else 1e-6
    h = min(h, control.largest_step)
    for d in range(room.old.size):
        room.stage[d] = room.old[d] + h * room.slopes[0, d]
    if slope(motion, t + h, room.stage, room.slopes[1]) != FINE:
        return 0.01 * h
    for d in range(width):
        scale = control.tolerance * max(1.0, abs(room.old[d]))
        bend += ((room.slopes[1, d] - room.slopes[0, d]) / scale) ** 2
    steepest = np.sqrt(max(speed, bend / (h * h)) / width)
    wanted = (0.01 / steepest) ** (1.0 / control.error_order) if steepest > 0.0 else 100.0 * h
    return max(min(100.0 * h, wanted, control.largest_step), 1e-12 * control.largest_step)


@inner
def level(error: float) -> float:
    """The logarithm of an error, which PI control reckons with; hardly any error counts like 1e-10."""
    return float(np.log(max(error, 1e-10)))


@inner
def grown(control: Control, h: float, now: float, before: float, growth: float) -> float:
    """The next step after an accepted one, by the levels of this error and the one before; at most `growth` times h."""
    power = 1.0 / control.error_order - 0.75 * control.memory
    factor = SAFETY * np.exp(control.memory * before - power * now)
    return float(min(h * min(max(factor, LARGEST_SHRINK), growth), control.largest_step))


@inner
def shrunk(control: Control, h: float, error: float) -> float:
    """The step to try again with; `error` is NaN if a stage failed."""
    if not error < np.inf:
        return 0.1 * h
    return float(h * max(SAFETY * error ** (-1.0 / control.error_order), LARGEST_SHRINK))


@inner
def tells_apart(control: Control, t: float, h: float) -> bool:
    """Whether t and t + h are different times in double precision, with some digits to spare."""
    return h > 16.0 * ROUNDING * max(abs(t), 1e-3 * control.largest_step)


@inner
def is_held_back(control: Control, h: float, degrees: int, room: Room) -> bool:
    """Whether stability, not accuracy, limits the step: h times the size of the Jacobian is at its bound.

    The size is that of slope over distance between the last stage and the new state (Hairer, Wanner II, IV.2).
    """
    bend, distance, end = 0.0, 0.0, control.stages
    for d in range(2 * degrees):
        bend += (room.slopes[end, d] - room.slopes[end - 1, d]) ** 2
        distance += (room.new[d] - room.stage[d]) ** 2
    return bool(distance > 0.0 and h * h * bend > control.stability**2 * distance)


@inner
def patience(
    control: Control, held_back: int, steps: int, left: float, h: float, degrees: int, room: Room
) -> tuple[int, int]:
    """How many steps were held back by stability, and STIFF if so many that the end cannot be reached."""
    if control.tolerance == 0.0:
        return variable(0), FINE
    held_back = held_back + 1 if is_held_back(control, h, degrees, room) else max(held_back - 10, 0)
    return held_back, STIFF if held_back >= MANY and steps + left / h > control.step_limit else FINE
