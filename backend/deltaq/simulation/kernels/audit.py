"""Steps that a method cannot have seen through: an audit of the path that a run took.

Between the ends of its steps a run is taken for the cubic through q and q̇ there (Hermite), which stays in the hull of
its Bernstein coefficients, widened by what the jumps of its second derivative at the ends say of its error. Over the
box of a step the model's operations are bounded by intervals. A step in which the argument of a relevant operation
swings further than a method's stages can follow is halved in thought; where quarters are still too long, the run was
blind there, and no comparison with another run of its kind can tell.
Source of the hull: Farin, Curves and Surfaces for CAGD, 5th ed., §5.1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...model.tape import CHOICE
from .compiler import inner, kernel
from .intervals import Places, Program, Ranges, bound, is_relevant, largest_swing
from .motion import Floats

GROUP = 256  # steps that are looked at together first
LARGEST = 1e300  # stands for ∞, so that it can be compared with itself
HALVINGS = 8  # of one step, at most
MOST_PARTS = 50_000  # looked at in one audit; steps that are left then count as blind
DEEPEST = 64  # entries of the list of parts still to be looked at
SHRINKS = 0.8  # of the swing of the whole, at most, that a half must have for halving to be of use
JOINED = 4.0  # neighbouring steps whose needs differ by less share the smaller


class Path(NamedTuple):
    """The ends of steps: times, q and q̇ (one row each), and how far q̈ of the cubic jumps there."""

    times: Floats
    q: Floats
    v: Floats
    jumps: Floats


class Rules(NamedTuple):
    """Swings up to `limit` are followed; what changes q̈ by less than `threshold` does not matter.

    A recorded step may stand for `stride` steps of the run.
    """

    limit: float
    threshold: float
    stride: float


class Blind(NamedTuple):
    """Stretches found blind, from `starts` to `ends`, with the largest step that would see; `found[0]` of them."""

    starts: Floats
    ends: Floats
    steps: Floats
    found: Places


class Parts(NamedTuple):
    """Room for the audit: parts of a step still to be looked at, with the swing of what they are halves of.

    `looked[0]` counts all parts looked at. `flips` and `truths` have a place for each operation: how the ends of a part
    differ in it, and whether it matters.
    """

    starts: Floats
    sizes: Floats
    swings: Floats
    looked: Places
    flips: Places
    truths: Floats


@inner
def box_of_part(path: Path, i: int, x: float, size: float, ranges: Ranges) -> None:
    """The inputs' bounds over the part from x of the given size (of the whole step, 1) of step i."""
    n, t, h = path.q.shape[1], path.times[i], path.times[i + 1] - path.times[i]
    for d in range(n):
        q0, q1, v0, v1 = path.q[i, d], path.q[i + 1, d], h * path.v[i, d], h * path.v[i + 1, d]
        c2, c3 = 3.0 * (q1 - q0) - 2.0 * v0 - v1, v0 + v1 - 2.0 * (q1 - q0)
        y = x + size
        first, last = q0 + x * (v0 + x * (c2 + x * c3)), q0 + y * (v0 + y * (c2 + y * c3))
        slope, end = v0 + x * (2.0 * c2 + 3.0 * x * c3), v0 + y * (2.0 * c2 + 3.0 * y * c3)
        one, two = first + size * slope / 3.0, last - size * end / 3.0
        middle = 3.0 * (two - one) / size
        jump = max(path.jumps[i, d], path.jumps[i + 1, d])
        wide, fast = jump * h * h / 16.0, jump * h / 4.0
        low, high = min(first, last, one, two) - wide, max(first, last, one, two) + wide
        slowest, fastest = min(slope, middle, end) / h - fast, max(slope, middle, end) / h + fast
        ranges.inputs_low[d], ranges.inputs_high[d] = low, high
        ranges.inputs_low[n + d], ranges.inputs_high[n + d] = slowest, fastest
    ranges.inputs_low[2 * n], ranges.inputs_high[2 * n] = t + x * h, t + (x + size) * h


@inner
def box_of_group(path: Path, first: int, count: int, ranges: Ranges, spare: Floats) -> None:
    """The inputs' bounds over some steps: the union of theirs; `spare` has room for two rows."""
    width = 2 * path.q.shape[1] + 1
    for k in range(first, first + count):
        box_of_part(path, k, 0.0, 1.0, ranges)
        for d in range(width):
            spare[0, d] = ranges.inputs_low[d] if k == first else min(spare[0, d], ranges.inputs_low[d])
            spare[1, d] = ranges.inputs_high[d] if k == first else max(spare[1, d], ranges.inputs_high[d])
    for d in range(width):
        ranges.inputs_low[d], ranges.inputs_high[d] = spare[0, d], spare[1, d]


@inner
def note_flips(program: Program, ranges: Ranges, rules: Rules, parts: Parts) -> None:
    """Counts the conditions that relevant choices hang on and that differ at the two ends of the box of a short part.

    The bounds of the whole part come first: they say which choices are undecided and matter.
    """
    for i in range(program.codes.size):
        condition = program.a[i]
        undecided = program.codes[i] == CHOICE and ranges.low[condition] != ranges.high[condition]
        parts.truths[i] = 1.0 if undecided and is_relevant(ranges, i, rules.threshold) else 0.0


@inner
def count_flips(program: Program, ranges: Ranges, parts: Parts, sign: float) -> None:
    """Adds, for the arguments of the conditions noted, their sign at one end of a part times `sign`."""
    bound(program, ranges)
    for i in range(program.codes.size):
        if parts.truths[i] != 0.0:
            argument = program.a[program.a[i]]
            value = ranges.low[argument]
            parts.flips[argument] += int(sign) if value > 0.0 else 0


@inner
def look(program: Program, ranges: Ranges, path: Path, i: int, rules: Rules, parts: Parts) -> tuple[float, int]:
    """The largest part of step i that is seen through (1 for the whole), and how often a switch happens within it."""
    finest_of_use = 1.0 / (64.0 * rules.stride)
    parts.starts[0], parts.sizes[0], parts.swings[0] = 0.0, 1.0, np.inf
    if parts.looked[0] > MOST_PARTS:
        return 0.25, 0
    left, finest, switches = 1, 1.0, 0
    while left > 0:
        left -= 1
        parts.looked[0] += 1
        x, size, before = parts.starts[left], parts.sizes[left], parts.swings[left]
        box_of_part(path, i, x, size, ranges)
        swing, undecided = largest_swing(program, ranges, rules.threshold)
        swing = min(LARGEST, swing)
        is_small = size <= 0.5**HALVINGS / rules.stride
        if swing <= rules.limit and (not undecided or is_small):
            if undecided:
                switches += flips_within(program, ranges, path, i, x, size, rules, parts)
            continue
        finest = min(finest, 0.5 * size) if swing > rules.limit else finest
        gains_nothing = size < 1.0 and swing > SHRINKS * before  # what widens the path rules, or a pole
        if is_small or left + 2 > DEEPEST or (not undecided and (gains_nothing or finest <= finest_of_use)):
            continue
        for half in (1.0, 0.0):
            parts.starts[left], parts.sizes[left] = x + 0.5 * half * size, 0.5 * size
            parts.swings[left] = swing
            left += 1
    return finest * rules.stride, switches


@inner
def flips_within(
    program: Program, ranges: Ranges, path: Path, i: int, x: float, size: float, rules: Rules, parts: Parts
) -> int:
    """How many relevant conditions change over a part."""
    n, found = path.q.shape[1], 0
    note_flips(program, ranges, rules, parts)
    for k in range(program.codes.size):
        parts.flips[k] = 0
    for sign in (1.0, -1.0):
        at = x if sign > 0.0 else x + size
        box_of_part(path, i, at, 1e-9, ranges)
        for d in range(2 * n + 1):
            middle = 0.5 * (ranges.inputs_low[d] + ranges.inputs_high[d])
            ranges.inputs_low[d], ranges.inputs_high[d] = middle, middle
        count_flips(program, ranges, parts, sign)
    for k in range(program.codes.size):
        found += 1 if parts.flips[k] != 0 else 0
    return found


@inner
def note(blind: Blind, start: float, end: float, step: float) -> None:
    """A blind stretch is added, or joined to the one before where they touch and need much the same."""
    count = blind.found[0]
    if count > 0:
        last = count - 1
        touches = start <= blind.ends[last] * (1.0 + 1e-12)
        alike = blind.steps[last] < JOINED * step and step < JOINED * blind.steps[last]
        if (touches and alike) or count == blind.starts.size:
            blind.ends[last], blind.steps[last] = end, min(blind.steps[last], step)
            return
    blind.starts[count], blind.ends[count], blind.steps[count] = start, end, step
    blind.found[0] = count + 1


@kernel
def inspect(
    program: Program, ranges: Ranges, path: Path, seeds: Floats, rules: Rules, parts: Parts, spare: Floats, blind: Blind
) -> None:
    """Finds the blind steps of a path; seeds[k] are those of the k-th group of steps."""
    total = path.times.size - 1
    for group in range(seeds.shape[0]):
        for k in range(ranges.seeds.size):
            ranges.seeds[k] = seeds[group, k]
        first, last = group * GROUP, min((group + 1) * GROUP, total)
        count = last - first
        while first < last:
            count = min(count, last - first)
            box_of_group(path, first, count, ranges, spare)
            swing, undecided = largest_swing(program, ranges, rules.threshold)
            if swing <= rules.limit and not undecided:
                first += count
                count *= 2
            elif count > 1:
                count = (count + 1) // 2
            else:
                h = path.times[first + 1] - path.times[first]
                if h > 1e-13 * abs(path.times[first + 1]):
                    seen, switches = look(program, ranges, path, first, rules, parts)
                    if seen <= 0.25 or switches > 1:
                        needed = min(seen, 0.25)
                        note(blind, path.times[first], path.times[first + 1], needed * h / rules.stride)
                first += 1


@kernel
def survey_times(
    program: Program,
    ranges: Ranges,
    place: int,
    starts: Floats,
    ends: Floats,
    threshold: float,
    swings: Floats,
    jumps: Places,
) -> None:
    """For each interval of time, all else as it is bounded: the largest swing, and whether a switch may lie in it.

    `place` is that of the time among the inputs.
    """
    for k in range(starts.size):
        ranges.inputs_low[place], ranges.inputs_high[place] = starts[k], ends[k]
        swings[k], undecided = largest_swing(program, ranges, threshold)
        jumps[k] = 1 if undecided else 0
