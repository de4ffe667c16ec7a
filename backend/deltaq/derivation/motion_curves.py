"""The given functions and directions as curves over the time, to be drawn: x(t) and v(t) at equal distances."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp
from flint import arb, ctx

from .domain import Instant, Interval
from .functional import Functional
from .functional_values import Motion
from .program import number

SAMPLES = 97
BITS = 53


@dataclass(frozen=True)
class Curves:
    """Values at the times `t`, NaN where there is none; `at` is the instant that is looked at, None for an integral."""

    t: tuple[float, ...]
    functions: Mapping[str, tuple[float, ...]]
    directions: Mapping[str, tuple[float, ...]]
    at: float | None


def curves_of(functional: Functional, motion: Motion, time: float) -> Curves:
    """Over the interval of an integral, else over a span that has the instant inside."""
    with ctx.workprec(BITS):
        (lower, upper), at = _span(functional, motion, time)
        times = tuple(lower + (upper - lower) * (k / (SAMPLES - 1)) for k in range(SAMPLES))
        functions, directions = (
            _sampled(part, functional, motion, times) for part in (motion.functions, motion.directions)
        )
        return Curves(times, functions, directions, at)


def _span(functional: Functional, motion: Motion, time: float) -> tuple[tuple[float, float], float | None]:
    point = {name: arb(value) for name, value in motion.parameters.items()}
    match functional.domain:
        case Interval():
            bounds = functional.interval
            return (float(number(bounds.lower, point)), float(number(bounds.upper, point))), None
        case Instant(node):
            time = float(number(functional.expression(node), point))
    far = math.copysign(min(2 * abs(time), sys.float_info.max), time)
    return ((min(0.0, far), max(0.0, far)) if time else (0.0, 1.0)), time


def _sampled(
    part: Mapping[str, sp.Expr], functional: Functional, motion: Motion, times: tuple[float, ...]
) -> Mapping[str, tuple[float, ...]]:
    point = {name: arb(value) for name, value in motion.parameters.items()}
    return {x: tuple(_value(part[x], {**point, "t": arb(t)}) for t in times) for x in functional.functions}


def _value(expression: sp.Expr, point: Mapping[str, arb]) -> float:
    value = float(number(expression, point))
    return value if math.isfinite(value) else math.nan
