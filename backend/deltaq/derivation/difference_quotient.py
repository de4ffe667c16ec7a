"""Difference quotients in double precision: (g(h) − g(0))/h and (g(h) − g(−h))/2h against g′(0).

Truncation shrinks as h (one-sided) or h² (central), rounding grows as u|g|/h with u = 2⁻⁵³. They balance at
h = 2√(u|g/g″|) and h = (3u|g/g‴|)^(1/3). What a quotient would be without rounding is computed in ball arithmetic.
Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.14; Press et al., Numerical Recipes, §5.7.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from flint import arb, ctx

from .verification import BITS

UNIT = 2.0**-53
PER_DECADE, DECADES = 4, 16
SIZES = tuple(10.0 ** (-k / PER_DECADE) for k in range(PER_DECADE * DECADES + 1))
STEP = arb(2) ** -60


@dataclass(frozen=True)
class Line:
    """g(h) = f(x + h v) in doubles and in balls."""

    rounded: Callable[[float], float]
    exact: Callable[[arb], arb]


@dataclass(frozen=True)
class Quotients:
    """One kind of quotient for all sizes of h, with its error and the two parts of it; NaN where g is not defined."""

    quotient: tuple[float, ...]
    truncation: tuple[float, ...]
    rounding: tuple[float, ...]
    error: tuple[float, ...]
    predicted: float

    @property
    def best(self) -> int | None:
        """Where the error is smallest: beyond, it stops improving."""
        finite = [i for i, error in enumerate(self.error) if math.isfinite(error)]
        return min(finite, key=lambda i: abs(self.error[i]), default=None)


@dataclass(frozen=True)
class Comparison:
    """Value and derivative at h = 0, and the quotients by name."""

    value: float
    derivative: float
    quotients: Mapping[str, Quotients]


def compare(line: Line) -> Comparison:
    """Both quotients of g for h from 1 down to 10⁻¹⁶."""
    with ctx.workprec(BITS):
        derivative, second, third = _derivatives(line.exact)
        value = line.exact(arb(0))
        one_sided = 2 * math.sqrt(_ratio(value, second))
        central = (3 * _ratio(value, third)) ** (1 / 3)
        quotients = {
            "one_sided": _quotients(line, derivative, 0.0, one_sided),
            "central": _quotients(line, derivative, -1.0, central),
        }
        return Comparison(float(value), float(derivative), quotients)


def _derivatives(g: Callable[[arb], arb]) -> tuple[arb, arb, arb]:
    """g′, g″ and g‴ at 0 by central differences of 512 bits."""
    far, ahead, here, behind, away = (g(k * STEP) for k in (2, 1, 0, -1, -2))
    first = (8 * (ahead - behind) - (far - away)) / (12 * STEP)
    return first, (ahead - 2 * here + behind) / STEP**2, (far - 2 * ahead + 2 * behind - away) / (2 * STEP**3)


def _ratio(value: arb, derivative: arb) -> float:
    """u |g/g⁽ⁿ⁾|; NaN where there is no balance to be had."""
    size, slope = abs(float(value)), abs(float(derivative))
    return UNIT * size / slope if slope > UNIT * size else math.nan


def _quotients(line: Line, derivative: arb, back: float, predicted: float) -> Quotients:
    """From x + h v to x (back = 0) or to x − h v (back = −1)."""
    rows = [_row(line, derivative, h, back) for h in SIZES]
    quotient, truncation, rounding, error = zip(*rows, strict=True)
    return Quotients(quotient, truncation, rounding, error, predicted)


def _row(line: Line, derivative: arb, h: float, back: float) -> tuple[float, float, float, float]:
    rounded = (line.rounded(h) - line.rounded(back * h)) / ((1 - back) * h)
    exact = (line.exact(arb(h)) - line.exact(arb(back * h))) / ((1 - arb(back)) * arb(h))
    if not math.isfinite(rounded):
        return math.nan, float(exact - derivative), math.nan, math.nan
    return rounded, float(exact - derivative), float(arb(rounded) - exact), float(arb(rounded) - derivative)
