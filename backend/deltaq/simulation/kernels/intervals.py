"""A tape in interval arithmetic: between which bounds every operation stays, and how much each can change q̈.

Forward, each operation gets an interval that holds its values for all inputs in a box; backward, a bound of
|∂q̈/∂(operation)| over the box. Rounding is not directed outward: the bounds judge steps, they prove no digits.
Sources: Moore, Kearfott, Cloud, Introduction to Interval Analysis, ch. 5; Griewank, Walther, Evaluating
Derivatives, 2nd ed., §3.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.tape import (
    ADD,
    ARCCOSINE,
    ARCSINE,
    ARCTANGENT,
    ARCTANGENT_2,
    AREA_COSINE,
    AREA_SINE,
    AREA_TANGENT,
    CHOICE,
    CONSTANT,
    COSINE,
    EXPONENTIAL,
    HYPERBOLIC_COSINE,
    HYPERBOLIC_SINE,
    HYPERBOLIC_TANGENT,
    INPUT,
    LOGARITHM,
    MULTIPLY,
    NEGATIVE,
    NOT_NEGATIVE,
    NOT_POSITIVE,
    POSITIVE,
    POWER,
    SINE,
    TANGENT,
)
from .compiler import inline, kernel, subroutine
from .motion import Floats
from .pointer import checkpoint

Indices = NDArray[np.int64]


class TapeArrays(NamedTuple):
    """A tape (see `model.tape`): `codes`, operands `a`, `b`, `c` and `constants` have shape (operations,).

    `outputs`, shape (outputs,), are the places of the results among the operations. The last `watched` of them are
    values of events: they count only where they may fall to zero. What moves them alone may swing 1/`share` times as
    far as what moves forces, for a step is looked at in more places for events than for forces.
    """

    codes: Indices
    a: Indices
    b: Indices
    c: Indices
    constants: Floats
    outputs: Indices
    watched: int = 0
    share: float = 1.0


class Ranges(NamedTuple):
    """Bounds of the inputs and of every operation, and of what each operation can do to q̈.

    `inputs_low` and `inputs_high` have shape (inputs,); `low`, `high` and `influence`, a bound of |∂q̈/∂(operation)|,
    shape (operations,); `seeds`, shape (outputs,), bounds |∂q̈/∂output|. A condition is 1 where it holds throughout the
    box, 0 where it nowhere does.
    """

    inputs_low: Floats
    inputs_high: Floats
    low: Floats
    high: Floats
    influence: Floats
    seeds: Floats


@inline
def product(x: float, y: float) -> float:
    """x y, zero if one of them is: 0 · ∞ bounds nothing from a constant zero."""
    return 0.0 if x == 0.0 or y == 0.0 else x * y


@inline
def magnitude(low: float, high: float) -> float:
    """The largest |x|."""
    return max(abs(low), abs(high))


@inline
def mignitude(low: float, high: float) -> float:
    """The least |x|."""
    return 0.0 if low <= 0.0 <= high else min(abs(low), abs(high))


@inline
def sine_range(low: float, high: float) -> tuple[float, float]:
    """Bounds of sin x."""
    if not high - low < 2.0 * np.pi or abs(low) > 1e12:
        return -1.0, 1.0
    first, last = np.sin(low), np.sin(high)
    crest = np.ceil((low - 0.5 * np.pi) / (2.0 * np.pi)) * 2.0 * np.pi + 0.5 * np.pi
    trough = np.ceil((low + 0.5 * np.pi) / (2.0 * np.pi)) * 2.0 * np.pi - 0.5 * np.pi
    return (-1.0 if trough <= high else min(first, last)), (1.0 if crest <= high else max(first, last))


@inline
def power_range(low: float, high: float, exponent: float) -> tuple[float, float]:
    """Bounds of x^p for a constant p; without a real value somewhere there are none."""
    whole = exponent == np.floor(exponent)
    if (not whole and low < 0.0) or (exponent < 0.0 and low <= 0.0 <= high):
        if not whole and high > 0.0 and exponent > 0.0:
            return 0.0, high**exponent
        return -np.inf, np.inf
    first, last = low**exponent, high**exponent
    even = whole and exponent % 2.0 == 0.0
    least = 0.0 if even and low <= 0.0 <= high else min(first, last)
    return least, max(first, last)


@inline
def tangent_range(low: float, high: float) -> tuple[float, float]:
    """Bounds of tan x, none where a pole lies between."""
    pole = np.ceil((low - 0.5 * np.pi) / np.pi) * np.pi + 0.5 * np.pi
    return (-np.inf, np.inf) if not high - low < np.pi or pole <= high else (np.tan(low), np.tan(high))


@inline
def angle_range(y_low: float, y_high: float, x_low: float, x_high: float) -> tuple[float, float]:
    """Bounds of atan2(y, x); none but ±π where the cut or the origin lies between."""
    if x_low <= 0.0 and y_low <= 0.0 <= y_high:
        return -np.pi, np.pi
    first, second = np.arctan2(y_low, x_low), np.arctan2(y_low, x_high)
    third, fourth = np.arctan2(y_high, x_low), np.arctan2(y_high, x_high)
    return min(first, second, third, fourth), max(first, second, third, fourth)


@inline
def elementary_range(code: int, low: float, high: float) -> tuple[float, float]:
    """Bounds of a function of one variable that is monotonic where it is real (cosh excepted)."""
    if code == EXPONENTIAL:
        return np.exp(low), np.exp(high)
    if code == LOGARITHM:
        return (np.log(low) if low > 0.0 else -np.inf), (np.log(high) if high > 0.0 else np.inf)
    if code == ARCTANGENT:
        return np.arctan(low), np.arctan(high)
    if code == HYPERBOLIC_TANGENT:
        return np.tanh(low), np.tanh(high)
    if code == HYPERBOLIC_SINE:
        return np.sinh(low), np.sinh(high)
    if code == HYPERBOLIC_COSINE:
        return np.cosh(mignitude(low, high)), np.cosh(magnitude(low, high))
    if code == AREA_SINE:
        return np.arcsinh(low), np.arcsinh(high)
    if code == AREA_COSINE:
        return np.arccosh(max(low, 1.0)), np.arccosh(max(high, 1.0))
    if code == AREA_TANGENT:
        return (np.arctanh(low) if low > -1.0 else -np.inf), (np.arctanh(high) if high < 1.0 else np.inf)
    if code == ARCSINE:
        return np.arcsin(max(low, -1.0)), np.arcsin(min(high, 1.0))
    return np.arccos(min(high, 1.0)), np.arccos(max(low, -1.0))  # ARCCOSINE


@inline
def operation_range(tape: TapeArrays, ranges: Ranges, i: int) -> tuple[float, float]:
    """Bounds of operation i from those of its operands."""
    code, low, high = tape.codes[i], ranges.low, ranges.high
    if code == INPUT:
        return ranges.inputs_low[tape.a[i]], ranges.inputs_high[tape.a[i]]
    if code == CONSTANT:
        return tape.constants[i], tape.constants[i]
    a, b = tape.a[i], tape.b[i]
    if code == ADD:
        return low[a] + low[b], high[a] + high[b]
    if code == MULTIPLY:
        if a == b:
            least = mignitude(low[a], high[a])
            most = magnitude(low[a], high[a])
            return least * least, most * most
        first, second = product(low[a], low[b]), product(low[a], high[b])
        third, fourth = product(high[a], low[b]), product(high[a], high[b])
        return min(first, second, third, fourth), max(first, second, third, fourth)
    if code == POWER:
        return power_range(low[a], high[a], tape.constants[i])
    if code == SINE:
        return sine_range(low[a], high[a])
    if code == COSINE:
        return sine_range(low[a] + 0.5 * np.pi, high[a] + 0.5 * np.pi)
    if code == TANGENT:
        return tangent_range(low[a], high[a])
    if code == POSITIVE:
        return (1.0 if low[a] > 0.0 else 0.0), (1.0 if high[a] > 0.0 else 0.0)
    if code == NOT_NEGATIVE:
        return (1.0 if low[a] >= 0.0 else 0.0), (1.0 if high[a] >= 0.0 else 0.0)
    if code == NEGATIVE:
        return (1.0 if high[a] < 0.0 else 0.0), (1.0 if low[a] < 0.0 else 0.0)
    if code == NOT_POSITIVE:
        return (1.0 if high[a] <= 0.0 else 0.0), (1.0 if low[a] <= 0.0 else 0.0)
    if code == CHOICE:
        c = tape.c[i]
        if low[a] == 1.0:
            return low[b], high[b]
        if high[a] == 0.0:
            return low[c], high[c]
        return min(low[b], low[c]), max(high[b], high[c])
    if code == ARCTANGENT_2:
        return angle_range(low[a], high[a], low[b], high[b])
    return elementary_range(code, low[a], high[a])


@kernel
def propagate_bounds(tape: TapeArrays, ranges: Ranges) -> None:
    """Bounds of every operation over the box of inputs, in the order of the tape; infinite where it has no value."""
    for i in range(tape.codes.size):
        low, high = operation_range(tape, ranges, i)
        ranges.low[i] = -np.inf if np.isnan(low) else low
        ranges.high[i] = np.inf if np.isnan(high) else high


@inline
def derivative_bound(
    code: int, exponent: float, low: float, high: float, result_low: float, result_high: float
) -> float:
    """A bound of |f′| over an interval of the argument, f a function of one variable."""
    least, most = mignitude(low, high), magnitude(low, high)
    if code in (SINE, COSINE):
        first, last = sine_range(
            low + (0.5 * np.pi if code == SINE else 0.0), high + (0.5 * np.pi if code == SINE else 0.0)
        )
        return magnitude(first, last)
    if code == POWER:
        if exponent >= 1.0:
            return float(abs(exponent) * most ** (exponent - 1.0))
        return abs(exponent) * least ** (exponent - 1.0) if least > 0.0 else np.inf
    if code == EXPONENTIAL:
        return result_high
    if code == LOGARITHM:
        return 1.0 / low if low > 0.0 else np.inf
    if code == TANGENT:
        return float(1.0 + magnitude(result_low, result_high) ** 2)
    if code == ARCTANGENT:
        return 1.0 / (1.0 + least * least)
    if code == HYPERBOLIC_SINE:
        return float(np.cosh(most))
    if code == HYPERBOLIC_COSINE:
        return float(np.sinh(most))
    if code == HYPERBOLIC_TANGENT:
        return float(1.0 / np.cosh(least) ** 2)
    if code == AREA_SINE:
        return float(1.0 / np.sqrt(1.0 + least * least))
    if code == AREA_COSINE:
        return float(1.0 / np.sqrt(low * low - 1.0)) if low > 1.0 else np.inf
    if code == AREA_TANGENT:
        return 1.0 / (1.0 - most * most) if most < 1.0 else np.inf
    return float(1.0 / np.sqrt(1.0 - most * most)) if most < 1.0 else np.inf  # ARCSINE, ARCCOSINE


@subroutine
def propagate_influence(tape: TapeArrays, ranges: Ranges, counted: int) -> None:
    """Bounds of the influence of every operation on q̈, from the seeds backward (`propagate_bounds` comes first).

    So many outputs count: all, or those of forces alone.
    """
    influence, low, high = ranges.influence, ranges.low, ranges.high
    influence[:] = 0.0
    of_forces = tape.outputs.size - tape.watched
    for k in range(counted):
        if k < of_forces or not low[tape.outputs[k]] > 0.0:
            influence[tape.outputs[k]] += ranges.seeds[k]
    for i in range(tape.codes.size - 1, -1, -1):
        weight, code = influence[i], tape.codes[i]
        a, b = tape.a[i], tape.b[i]
        if weight == 0.0 or code in (INPUT, CONSTANT) or POSITIVE <= code <= NOT_POSITIVE:
            continue
        if code == ADD:
            influence[a] += weight
            influence[b] += weight
        elif code == MULTIPLY:
            influence[a] += product(weight, magnitude(low[b], high[b]))
            influence[b] += product(weight, magnitude(low[a], high[a]))
        elif code == CHOICE:
            if high[a] == 1.0:
                influence[b] += weight
            if low[a] == 0.0:
                influence[tape.c[i]] += weight
        elif code == ARCTANGENT_2:
            nearest = mignitude(low[a], high[a]) ** 2 + mignitude(low[b], high[b]) ** 2
            steepest = 1.0 / np.sqrt(nearest) if nearest > 0.0 else np.inf
            influence[a] += product(weight, steepest)
            influence[b] += product(weight, steepest)
        else:
            influence[a] += product(weight, derivative_bound(code, tape.constants[i], low[a], high[a], low[i], high[i]))


@inline
def swing_of(tape: TapeArrays, ranges: Ranges, i: int) -> float:
    """How far the argument of operation i moves over the box, in the unit in which its value changes its course."""
    code, a = tape.codes[i], tape.a[i]
    if code in (INPUT, CONSTANT, ADD, MULTIPLY) or POSITIVE <= code <= CHOICE:
        return 0.0
    width = ranges.high[a] - ranges.low[a]
    if code == ARCTANGENT_2:
        width = max(width, ranges.high[tape.b[i]] - ranges.low[tape.b[i]])
    if code == TANGENT and not ranges.high[i] - ranges.low[i] < np.inf:
        return np.inf
    return product(width, swing_per_width(tape, ranges, i))


@inline
def swing_per_width(tape: TapeArrays, ranges: Ranges, i: int) -> float:
    """The swing of operation i over how far its argument moves, at most: 1 over the unit in which it changes.

    Radians for waves, the argument itself for exponentials, its distance from the singularity for roots, reciprocals
    and logarithms. Polynomials change their course nowhere.
    """
    code, a, low, high = tape.codes[i], tape.a[i], ranges.low, ranges.high
    if code in (INPUT, CONSTANT, ADD, MULTIPLY) or POSITIVE <= code <= CHOICE:
        return 0.0
    least, most, unit = mignitude(low[a], high[a]), magnitude(low[a], high[a]), 1.0
    if code == POWER:
        exponent = tape.constants[i]
        if exponent >= 0.0 and exponent == np.floor(exponent):
            return 0.0
        unit = least
    elif code == LOGARITHM:
        unit = low[a]
    elif code in (ARCTANGENT, AREA_SINE):
        unit = np.sqrt(1.0 + least * least)
    elif code in (ARCSINE, ARCCOSINE, AREA_TANGENT):
        unit = 1.0 - most
    elif code == AREA_COSINE:
        unit = low[a] - 1.0
    elif code == ARCTANGENT_2:
        b = tape.b[i]
        unit = np.sqrt(least * least + mignitude(low[b], high[b]) ** 2)
    return 1.0 / unit if unit > 0.0 else np.inf


@inline
def is_relevant(ranges: Ranges, i: int, threshold: float) -> bool:
    """Whether what operation i does within the box can change q̈ by more than the threshold."""
    width = ranges.high[i] - ranges.low[i]
    return bool(width > 0.0 and product(ranges.influence[i], width) > threshold)


@subroutine
def swing_and_choice(tape: TapeArrays, ranges: Ranges, threshold: float, counted: int) -> tuple[float, bool]:
    """The largest swing of an operation that is relevant for so many outputs, over a box whose bounds are known.

    And whether a relevant choice is undecided in it.
    """
    propagate_influence(tape, ranges, counted)
    largest, is_undecided = 0.0, False
    for i in range(tape.codes.size):
        if ranges.influence[i] == 0.0 or not is_relevant(ranges, i, threshold):
            continue
        if tape.codes[i] == CHOICE:
            condition = tape.a[i]
            is_undecided = is_undecided or ranges.low[condition] != ranges.high[condition]
        else:
            largest = max(largest, swing_of(tape, ranges, i))
    return largest, is_undecided


@subroutine
def largest_swing(tape: TapeArrays, ranges: Ranges, threshold: float) -> tuple[float, bool]:
    """The largest swing of a relevant operation over the box, and whether a relevant choice is undecided in it.

    That of what moves events alone is told in the measure of forces.
    """
    checkpoint()
    propagate_bounds(tape, ranges)
    count = tape.outputs.size
    of_forces, is_undecided = swing_and_choice(tape, ranges, threshold, count - tape.watched)
    if tape.watched == 0:
        return of_forces, is_undecided
    largest, is_undecided = swing_and_choice(tape, ranges, threshold, count)  # last, for what is relevant is asked for
    return max(of_forces, tape.share * largest), is_undecided
