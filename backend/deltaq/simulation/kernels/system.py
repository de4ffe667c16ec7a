"""The memory of a motion with constraints: one block of numbers, in which a run reads and writes all that it needs.

Functions that machine code calls by their address are given one more address, that of the block.
"""

from __future__ import annotations

from typing import NamedTuple

from .compiler import inline
from .linear import Indices
from .motion import Floats
from .pointer import doubles_at, integers_at

# The integers that a block begins with.
SIZE, DEGREES, COUNT, HOLONOMIC, POWERED, RANK, INPUTS, OUTPUTS, PHASE_OUTPUTS = 0, 1, 2, 3, 4, 5, 6, 7, 8
MOTION, MOTION_DATA, GAPS, GAPS_DATA, PHASE, PHASE_DATA, LOCKS, IS_UNDER_WAY = 9, 10, 11, 12, 13, 14, 15, 16
TELLS_END, SOLVED, SOLVED_DATA, PROJECTED, PROJECTED_DATA = 17, 18, 19, 20, 21
PLACED, PLACED_DATA, LANDED, LANDED_DATA, TURNS, HEAD = 22, 23, 24, 25, 26, 27
SIGNS = 3  # that tell whether a solution in symbols holds


class System(NamedTuple):
    """A model with constraints, m of them, and the arrays it is solved in; `head` are the integers of its block.

    `inputs` has shape (2n + 1 + parameters,), and `before` stands behind it; `outputs` and `phase` receive what the
    compiled functions say.
    `responses`, shape (m n,), are the rows of AM⁻¹; `schur`, shape (m m,), is the Schur complement AM⁻¹Aᵀ scaled to a
    unit diagonal by `scales`, shape (m,), and factored, `order` the order of its rows; `gap_schur` and `gap_order` are
    the same of the holonomic ones. `multipliers`, shape (m,), are λ, `accelerations`, shape (n,), is q̈, `right`, shape
    (m,), a right side.
    `gaps`, shape (2 m,), are g and w; `before`, shape (m n,), is A where the step began, `minor`, shape (m m,), room
    for a determinant. `projected`, shape (2n,), `rows`, shape (m n,), `signs`, shape (2 + SIGNS,), and `squares`,
    shape (m,), are what `Solved.projected`, `placed` or `landed` says; `sizes`, shape (m,), keeps the largest squares.
    `conditioning`, shape (1,), keeps the smallest pivot met, relative to its diagonal entry.
    """

    head: Indices
    order: Indices
    gap_order: Indices
    inputs: Floats
    outputs: Floats
    phase: Floats
    responses: Floats
    schur: Floats
    gap_schur: Floats
    scales: Floats
    multipliers: Floats
    accelerations: Floats
    right: Floats
    gaps: Floats
    before: Floats
    minor: Floats
    projected: Floats
    rows: Floats
    signs: Floats
    squares: Floats
    sizes: Floats
    placed: Floats
    conditioning: Floats


@inline
def block_at(data: int) -> System:
    """The system whose block is at an address."""
    head = integers_at(data, HEAD)
    n, m = head[DEGREES], head[COUNT]
    order, gap_order = integers_at(data + 8 * HEAD, m), integers_at(data + 8 * (HEAD + m), m)
    inputs = data + 8 * (HEAD + 2 * m)
    before = inputs + 8 * head[INPUTS]
    outputs = before + 8 * m * n
    phase = outputs + 8 * head[OUTPUTS]
    responses = phase + 8 * head[PHASE_OUTPUTS]
    schur = responses + 8 * m * n
    gap_schur = schur + 8 * m * m
    minor = gap_schur + 8 * m * m
    scales = minor + 8 * m * m
    multipliers = scales + 8 * m
    right = multipliers + 8 * m
    gaps = right + 8 * m
    accelerations = gaps + 16 * m
    projected = accelerations + 8 * n
    rows = projected + 16 * n
    signs = rows + 8 * m * n
    squares = signs + 8 * (2 + SIGNS)
    sizes = squares + 8 * m
    placed = sizes + 8 * m
    conditioning = placed + 8 * (n + m * n)
    return System(
        head,
        order,
        gap_order,
        doubles_at(inputs, head[INPUTS]),
        doubles_at(outputs, head[OUTPUTS]),
        doubles_at(phase, head[PHASE_OUTPUTS]),
        doubles_at(responses, m * n),
        doubles_at(schur, m * m),
        doubles_at(gap_schur, m * m),
        doubles_at(scales, m),
        doubles_at(multipliers, m),
        doubles_at(accelerations, n),
        doubles_at(right, m),
        doubles_at(gaps, 2 * m),
        doubles_at(before, m * n),
        doubles_at(minor, m * m),
        doubles_at(projected, 2 * n),
        doubles_at(rows, m * n),
        doubles_at(signs, 2 + SIGNS),
        doubles_at(squares, m),
        doubles_at(sizes, m),
        doubles_at(placed, n + m * n),
        doubles_at(conditioning, 1),
    )


def block_size(n: int, m: int, inputs: int, outputs: int, phase: int) -> int:
    """How many numbers a block takes."""
    return HEAD + 2 * m + inputs + outputs + phase + 4 * m * n + 3 * m * m + 7 * m + 4 * n + SIGNS + 3


@inline
def place_of_rows(system: System) -> int:
    """Where A begins in the outputs; γ and b follow it."""
    n = system.head[DEGREES]
    return int(n * (n + 1) // 2 + n + (n + 1 if system.head[POWERED] else 0))


@inline
def take_inputs(system: System, given: int) -> None:
    """Copies q, q̇ and t from an address; the parameters are there."""
    count = 2 * system.head[DEGREES] + 1
    inputs = doubles_at(given, count)
    for i in range(count):
        system.inputs[i] = inputs[i]
