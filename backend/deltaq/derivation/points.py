"""Points at which formulas are evaluated, and the curves through them along which they are differentiated."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from flint import arb

from ..language.spelling import spell_rate

Point = Mapping[str, arb]  # values of names, `dot(name)`, `ddot(name)`, `delta(name)` and `d(name)`

STEP = arb(2) ** -128


def central_difference(function: Callable[[arb], arb]) -> arb:
    """f′(0) as (f(h) − f(−h))/2h; the relative error is about h² = 2⁻²⁵⁶."""
    return (function(STEP) - function(-STEP)) / (2 * STEP)


def along_motion(point: Point, h: arb) -> Point:
    """Where the system is a time h later: q + q̇h + q̈h²/2, and its rates."""
    moved = {"t": point["t"] + h}
    for name in point:
        speed, acceleration = point.get(spell_rate(name, 1)), point.get(spell_rate(name, 2))
        if speed is not None and acceleration is not None:
            moved[name] = point[name] + speed * h + acceleration * h * h / 2
            moved[spell_rate(name, 1)] = speed + acceleration * h
    return {**point, **moved}


def varied(point: Point, h: arb) -> Point:
    """The neighbouring configuration q + h δq at the same time."""
    return shifted(point, {name: h * point[f"delta({name})"] for name in point if f"delta({name})" in point})


def shifted(point: Point, shifts: Mapping[str, arb]) -> Point:
    return {**point, **{name: point[name] + shift for name, shift in shifts.items()}}
