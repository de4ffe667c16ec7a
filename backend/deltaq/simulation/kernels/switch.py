"""Where a force that jumps holds a motion fast: dry friction that has brought a body to rest.

A force jumps where a switching function s(q, q̇, t) changes its sign. If on both sides of s = 0 the motion is driven
back to it, ṡ < 0 where s > 0 and ṡ > 0 where s < 0, no solution leaves it: the equations have none in the classical
sense, and an integrator would jump back and forth for ever.
Source: Filippov, Differential Equations with Discontinuous Righthand Sides, §4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline, subroutine
from .motion import FINE, HELD, Floats, Motion, rhs
from .pointer import call

NUDGE = 1e-6  # of differences
OFF = 1e-7  # how far off s = 0 its rate is looked at, relative to what s comes from; and then a hundredth of that
AHEAD = 1e-3  # of the longest step: so far ahead it is asked whether a step fails because the motion is held


class Switch(NamedTuple):
    """A compiled function whose outputs are the switching functions; `inputs` are those of the motion.

    `inputs` has shape (2n + 1 + parameters,). `before`, `after` and `values` are the functions at the ends of a step
    and elsewhere, shape (functions,). `gradient` is ∂s/∂(q, q̇) of one of them, `middle` the state it is taken at,
    `state` and `rates` another state and its derivative, `here` the derivative at the end of a step: shape (width,).
    `which` and `when`, shape (1,), tell which function holds the motion, −1 for none, and since when.
    """

    address: int
    data: int
    functions: int
    inputs: Floats
    before: Floats
    after: Floats
    values: Floats
    gradient: Floats
    middle: Floats
    state: Floats
    rates: Floats
    here: Floats
    which: NDArray[np.int64]
    when: Floats


def make_switch(addresses: tuple[int, int], count: int, inputs: Floats, width: int) -> Switch:
    """The arrays to watch `count` switching functions of a state with `width` components.

    `inputs` has shape (inputs,).
    """
    before, after, values = np.zeros(count), np.zeros(count), np.zeros(count)
    gradient, middle, state, rates, here = (np.zeros(width) for _ in range(5))
    which, when = np.full(1, -1, dtype=np.int64), np.zeros(1)
    return Switch(*addresses, count, inputs, before, after, values, gradient, middle, state, rates, here, which, when)


@subroutine
def switching_values(switch: Switch, degrees: int, t: float, state: Floats, out: Floats) -> None:
    """The switching functions of a state, shape (≥ 2n,), into `out`, shape (functions,)."""
    for d in range(2 * degrees):
        switch.inputs[d] = state[d]
    switch.inputs[2 * degrees] = t
    call(switch.address, switch.data, out, switch.inputs)


@subroutine
def switching_gradient(switch: Switch, degrees: int, t: float, k: int) -> tuple[float, float]:
    """∂s/∂(q, q̇) of function k at the middle state into `gradient`, by differences; returns its square and ∂s/∂t."""
    square = 0.0
    for d in range(2 * degrees):
        at = switch.middle[d]
        nudge = NUDGE * max(1.0, abs(at))
        switch.middle[d] = at + nudge
        switching_values(switch, degrees, t, switch.middle, switch.values)
        ahead = switch.values[k]
        switch.middle[d] = at - nudge
        switching_values(switch, degrees, t, switch.middle, switch.values)
        switch.middle[d] = at
        switch.gradient[d] = (ahead - switch.values[k]) / (2.0 * nudge)
        square += switch.gradient[d] ** 2
    nudge = NUDGE * max(1.0, abs(t))
    switching_values(switch, degrees, t + nudge, switch.middle, switch.values)
    ahead = switch.values[k]
    switching_values(switch, degrees, t - nudge, switch.middle, switch.values)
    return square, (ahead - switch.values[k]) / (2.0 * nudge)


@subroutine
def switching_rate(motion: Motion, switch: Switch, t: float, off: float, square: float, by_time: float) -> float:
    """ṡ a distance `off` beside s = 0, at the middle state; NaN where it has none."""
    n, total = motion.degrees, by_time
    for d in range(2 * n):
        switch.state[d] = switch.middle[d] + off * switch.gradient[d] / square
    if rhs(motion, t, switch.state, switch.rates) != FINE:
        return np.nan
    for d in range(2 * n):
        total += switch.gradient[d] * switch.rates[d]
    return total


@subroutine
def is_held(motion: Motion, switch: Switch, t: float, k: int, size: float) -> bool:
    """Whether function k holds the motion at the middle state, which is near its zero; `size` is that of s nearby."""
    n = motion.degrees
    square, by_time = switching_gradient(switch, n, t, k)
    if not 0.0 < square < np.inf:
        return False
    switching_values(switch, n, t, switch.middle, switch.values)
    for d in range(2 * n):
        switch.middle[d] -= switch.values[k] * switch.gradient[d] / square
    off = OFF * max(size, 1e-6)
    above = switching_rate(motion, switch, t, off, square, by_time)
    below = switching_rate(motion, switch, t, -off, square, by_time)
    if not (above < 0.0 and below > 0.0):
        return False
    closer = switching_rate(motion, switch, t, 0.01 * off, square, by_time)
    other = switching_rate(motion, switch, t, -0.01 * off, square, by_time)
    return bool(closer < 0.5 * above and other > 0.5 * below)  # a jump stays, a slope shrinks


@subroutine
def find_hold_ahead(motion: Motion, switch: Switch, t: float, reach: float, state: Floats, rates: Floats) -> int:
    """`detect_hold_ahead` where there are switching functions; a call, not a part of every stepping loop.

    `state` and `rates`, its derivative, have shape (width,).
    """
    n = motion.degrees
    switching_values(switch, n, t, state, switch.before)
    for k in range(switch.functions):
        for d in range(2 * n):
            switch.middle[d] = state[d]
        square, speed = switching_gradient(switch, n, t, k)
        for d in range(2 * n):
            speed += switch.gradient[d] * rates[d]
        if square == 0.0 or speed == 0.0 or -switch.before[k] / speed > reach or switch.before[k] * speed > 0.0:
            continue
        wait = -switch.before[k] / speed
        for d in range(n):
            switch.middle[d] = state[d] + wait * (rates[d] + 0.5 * wait * rates[n + d])
            switch.middle[n + d] = state[n + d] + wait * rates[n + d]
        if is_held(motion, switch, t + wait, k, abs(switch.before[k])):
            switch.which[0], switch.when[0] = k, t + wait
            return HELD
    return FINE


@inline
def detect_hold_ahead(motion: Motion, switch: Switch, t: float, reach: float, state: Floats, rates: Floats) -> int:
    """HELD if a function that comes to zero within `reach`, by its rate, holds the motion there, else FINE.

    `state` and `rates`, its derivative, have shape (width,). For the start, and for where a step fails. At a zero, what
    stays there by itself is not held.
    """
    return FINE if switch.functions == 0 else find_hold_ahead(motion, switch, t, reach, state, rates)


@inline
def is_near(switch: Switch) -> bool:
    """Whether a switching function would change its sign within two more steps like the last one.

    Some methods never show that: classical Runge–Kutta steps stay beside a zero that holds them, their stages on both
    sides of it.
    """
    for k in range(switch.functions):
        before, after = switch.before[k], switch.after[k]
        if after * (after + 2.0 * (after - before)) < 0.0:
            return True
    return False


@subroutine
def find_hold_within(
    motion: Motion, switch: Switch, t: float, h: float, is_fixed: int, old: Floats, new: Floats
) -> int:
    """`detect_hold` where there are switching functions; a call, not a part of every stepping loop.

    `old` and `new`, the states at the ends of the step, have shape (width,).
    """
    n, outcome = motion.degrees, FINE
    switching_values(switch, n, t + h, new, switch.after)
    for k in range(switch.functions):
        before, after = switch.before[k], switch.after[k]
        if outcome == FINE and (before * after < 0.0 or (after == 0.0 and before != 0.0)):
            if (
                rhs(motion, t, old, switch.here) == FINE
                and find_hold_ahead(motion, switch, t, 2.0 * h, old, switch.here) == HELD
            ):
                outcome, switch.when[0] = HELD, min(switch.when[0], t + h)
                break
            switching_values(switch, n, t, old, switch.before)
            part = before / (before - after)
            for d in range(2 * n):
                switch.middle[d] = old[d] + part * (new[d] - old[d])
            if is_held(motion, switch, t + part * h, k, abs(before) + abs(after)):
                outcome, switch.which[0], switch.when[0] = HELD, k, t + part * h
    if outcome == FINE and is_fixed != 0 and is_near(switch) and rhs(motion, t + h, new, switch.here) == FINE:
        outcome = find_hold_ahead(motion, switch, t + h, h, new, switch.here)
    for k in range(switch.functions):
        switch.before[k] = switch.after[k]
    return outcome


@inline
def detect_hold(motion: Motion, switch: Switch, t: float, h: float, is_fixed: int, old: Floats, new: Floats) -> int:
    """HELD if a function that changed its sign in the step holds the motion, else FINE.

    `old` and `new`, the states at the ends of the step, have shape (width,). Step control meets every zero closely;
    behind fixed steps it is asked, too, whether the next one would.
    """
    return FINE if switch.functions == 0 else find_hold_within(motion, switch, t, h, is_fixed, old, new)


@inline
def is_held_before(switch: Switch, t: float, outcome: int) -> bool:
    """Whether the motion was held before a time."""
    return bool(outcome == HELD and switch.when[0] <= t)


@inline
def held_or_failed(
    motion: Motion, switch: Switch, t: float, reach: float, state: Floats, rates: Floats, outcome: int
) -> int:
    """HELD if that is why a step failed, else the outcome as it was.

    `state` and `rates`, its derivative, have shape (width,).
    """
    return HELD if detect_hold_ahead(motion, switch, t, reach, state, rates) == HELD else outcome
