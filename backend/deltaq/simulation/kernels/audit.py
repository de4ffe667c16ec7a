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
from .compiler import inline, kernel
from .intervals import Indices, Ranges, TapeArrays, is_relevant, largest_swing, propagate_bounds
from .motion import Floats

GROUP = 256  # steps that are looked at together first
LARGEST = 1e300  # stands for ∞, so that it can be compared with itself
HALVINGS = 8  # of one step, at most
MOST_PARTS = 50_000  # looked at in one audit; steps that are left then count as blind
DEEPEST = 64  # entries of the list of parts still to be looked at
SHRINKS = 0.8  # of the swing of the whole, at most, that a half must have for halving to be of use
JOINED = 4.0  # neighbouring steps whose needs differ by less share the smaller


class Path(NamedTuple):
    """The ends of N steps. `times` has shape (N + 1,); `q` and `v`, which is q̇, have shape (N + 1, n).

    `jumps`, shape (N + 1, n), is how far q̈ of the cubic polynomials jumps there.
    """

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
    """Stretches found blind: from `starts` to `ends`, `steps` the largest step that would see what happens.

    `found[0]`, shape (1,), says how many; the others have shape (MOST_STRETCHES,), of which so many are filled.
    """

    starts: Floats
    ends: Floats
    steps: Floats
    found: Indices


class AuditWorkspace(NamedTuple):
    """Parts of a step still to be examined, with the swing of what they are halves of.

    `starts`, `sizes` and `swings` have shape (DEEPEST,). `looked[0]`, shape (1,), counts all parts examined. `flips`
    and `truths`, shape (operations,), say how the ends of a part differ in each operation, and whether it matters.
    """

    starts: Floats
    sizes: Floats
    swings: Floats
    looked: Indices
    flips: Indices
    truths: Floats


@inline
def box_of_part(path: Path, i: int, x: float, size: float, ranges: Ranges) -> None:
    """The inputs' bounds over the part from x of the given size (of the whole step, 1) of step i, into `ranges`."""
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


@inline
def box_of_group(path: Path, first: int, count: int, ranges: Ranges, spare: Floats) -> None:
    """The inputs' bounds over some steps, the union of theirs, into `ranges`; `spare` has shape (2, 2n + 1)."""
    width = 2 * path.q.shape[1] + 1
    for k in range(first, first + count):
        box_of_part(path, k, 0.0, 1.0, ranges)
        for d in range(width):
            spare[0, d] = ranges.inputs_low[d] if k == first else min(spare[0, d], ranges.inputs_low[d])
            spare[1, d] = ranges.inputs_high[d] if k == first else max(spare[1, d], ranges.inputs_high[d])
    for d in range(width):
        ranges.inputs_low[d], ranges.inputs_high[d] = spare[0, d], spare[1, d]


@inline
def note_flips(tape: TapeArrays, ranges: Ranges, rules: Rules, workspace: AuditWorkspace) -> None:
    """Counts the conditions that relevant choices hang on and that differ at the two ends of the box of a short part.

    The bounds of the whole part come first: they say which choices are undecided and matter.
    """
    for i in range(tape.codes.size):
        condition = tape.a[i]
        undecided = tape.codes[i] == CHOICE and ranges.low[condition] != ranges.high[condition]
        workspace.truths[i] = 1.0 if undecided and is_relevant(ranges, i, rules.threshold) else 0.0


@inline
def count_flips(tape: TapeArrays, ranges: Ranges, workspace: AuditWorkspace, sign: float) -> None:
    """Adds, for the arguments of the conditions noted, their sign at one end of a part times `sign`."""
    propagate_bounds(tape, ranges)
    for i in range(tape.codes.size):
        if workspace.truths[i] != 0.0:
            argument = tape.a[tape.a[i]]
            value = ranges.low[argument]
            workspace.flips[argument] += int(sign) if value > 0.0 else 0


@inline
def inspect_step(
    tape: TapeArrays, ranges: Ranges, path: Path, i: int, rules: Rules, workspace: AuditWorkspace
) -> tuple[float, int]:
    """The largest part of step i that is seen through (1 for the whole), and how often a switch happens within it."""
    finest_of_use = 1.0 / (64.0 * rules.stride)
    workspace.starts[0], workspace.sizes[0], workspace.swings[0] = 0.0, 1.0, np.inf
    if workspace.looked[0] > MOST_PARTS:
        return 0.25, 0
    left, finest, switches = 1, 1.0, 0
    while left > 0:
        left -= 1
        workspace.looked[0] += 1
        x, size, before = workspace.starts[left], workspace.sizes[left], workspace.swings[left]
        box_of_part(path, i, x, size, ranges)
        swing, undecided = largest_swing(tape, ranges, rules.threshold)
        swing = min(LARGEST, swing)
        is_small = size <= 0.5**HALVINGS / rules.stride
        if swing <= rules.limit and (not undecided or is_small):
            if undecided:
                switches += flips_within(tape, ranges, path, i, x, size, rules, workspace)
            continue
        finest = min(finest, 0.5 * size) if swing > rules.limit else finest
        gains_nothing = size < 1.0 and swing > SHRINKS * before  # what widens the path rules, or a pole
        if is_small or left + 2 > DEEPEST or (not undecided and (gains_nothing or finest <= finest_of_use)):
            continue
        for half in (1.0, 0.0):
            workspace.starts[left], workspace.sizes[left] = x + 0.5 * half * size, 0.5 * size
            workspace.swings[left] = swing
            left += 1
    return finest * rules.stride, switches


@inline
def flips_within(
    tape: TapeArrays, ranges: Ranges, path: Path, i: int, x: float, size: float, rules: Rules, workspace: AuditWorkspace
) -> int:
    """How many relevant conditions change over a part."""
    n, found = path.q.shape[1], 0
    note_flips(tape, ranges, rules, workspace)
    for k in range(tape.codes.size):
        workspace.flips[k] = 0
    for sign in (1.0, -1.0):
        at = x if sign > 0.0 else x + size
        box_of_part(path, i, at, 1e-9, ranges)
        for d in range(2 * n + 1):
            middle = 0.5 * (ranges.inputs_low[d] + ranges.inputs_high[d])
            ranges.inputs_low[d], ranges.inputs_high[d] = middle, middle
        count_flips(tape, ranges, workspace, sign)
    for k in range(tape.codes.size):
        found += 1 if workspace.flips[k] != 0 else 0
    return found


@inline
def record_blind(blind: Blind, start: float, end: float, step: float) -> None:
    """Adds a blind stretch, or joins it to the one before where they touch and need much the same step."""
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
    tape: TapeArrays,
    ranges: Ranges,
    path: Path,
    seeds: Floats,
    rules: Rules,
    workspace: AuditWorkspace,
    spare: Floats,
    blind: Blind,
) -> None:
    """Finds the blind steps of a path; `blind` receives them.

    `seeds` has shape (groups, outputs of the tape): its row k bounds |∂q̈/∂output| over the k-th GROUP of steps.
    `spare` has shape (2, 2n + 1), or more of both.
    """
    total = path.times.size - 1
    for group in range(seeds.shape[0]):
        for k in range(ranges.seeds.size):
            ranges.seeds[k] = seeds[group, k]
        first, last = group * GROUP, min((group + 1) * GROUP, total)
        count = last - first
        while first < last:
            count = min(count, last - first)
            box_of_group(path, first, count, ranges, spare)
            swing, undecided = largest_swing(tape, ranges, rules.threshold)
            if swing <= rules.limit and not undecided:
                first += count
                count *= 2
            elif count > 1:
                count = (count + 1) // 2
            else:
                h = path.times[first + 1] - path.times[first]
                if h > 1e-13 * abs(path.times[first + 1]):
                    seen, switches = inspect_step(tape, ranges, path, first, rules, workspace)
                    if seen <= 0.25 or switches > 1:
                        needed = min(seen, 0.25)
                        record_blind(blind, path.times[first], path.times[first + 1], needed * h / rules.stride)
                first += 1


@kernel
def survey_times(
    tape: TapeArrays,
    ranges: Ranges,
    place: int,
    starts: Floats,
    ends: Floats,
    threshold: float,
    swings: Floats,
    jumps: Indices,
) -> None:
    """For each interval of time, all else as it is bounded: the largest swing, and whether a switch may lie in it.

    `starts`, `ends`, `swings` (written) and `jumps` (written, 1 for a switch) have shape (intervals,); `place` is that
    of the time among the inputs.
    """
    for k in range(starts.size):
        ranges.inputs_low[place], ranges.inputs_high[place] = starts[k], ends[k]
        swings[k], undecided = largest_swing(tape, ranges, threshold)
        jumps[k] = 1 if undecided else 0
