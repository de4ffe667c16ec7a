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
MOTION, MOTION_DATA, GAPS, GAPS_DATA, PHASE, PHASE_DATA, LOCKS, IS_UNDER_WAY, IS_KICKED, KICKS, HEAD = (
    9,
    10,
    11,
    12,
    13,
    14,
    15,
    16,
    17,
    18,
    19,
)

KICKED = -1  # an outcome that ends nothing: the step is to be made again, with other momenta at its start


class System(NamedTuple):
    """A model with constraints, m of them, and the arrays it is solved in; `head` are the integers of its block.

    `inputs` has shape (2n + 1 + parameters,), `outputs` and `phase` receive what the compiled functions say.
    `responses`, shape (m n,), are the rows of AM⁻¹; `share`, shape (m m,), is AM⁻¹Aᵀ scaled to a unit diagonal by
    `scales`, shape (m,), and factored, `order` the order of its rows; `of_gaps` and `gap_order` the same of the
    holonomic ones. `multipliers`, shape (m,), are λ, `bends`, shape (n,), is q̈, `right`, shape (m,), a right side.
    `gaps`, shape (2 m,), are g and w; `before`, shape (m n,), is A where the step began, `minor`, shape (m m,), room
    for a determinant. `conditioning`, shape (1,), keeps the smallest pivot met, relative to its diagonal entry.
    """

    head: Indices
    order: Indices
    gap_order: Indices
    inputs: Floats
    outputs: Floats
    phase: Floats
    responses: Floats
    share: Floats
    of_gaps: Floats
    scales: Floats
    multipliers: Floats
    bends: Floats
    right: Floats
    gaps: Floats
    before: Floats
    minor: Floats
    conditioning: Floats


@inline
def open_system(head: Indices, memory: Floats) -> System:
    """The parts of a block, given as its integers and as its numbers; both have shape (size,)."""
    n, m = head[DEGREES], head[COUNT]
    first = HEAD
    order, gap_order = head[first : first + m], head[first + m : first + 2 * m]
    first += 2 * m
    inputs = memory[first : first + head[INPUTS]]
    first += head[INPUTS]
    outputs = memory[first : first + head[OUTPUTS]]
    first += head[OUTPUTS]
    phase = memory[first : first + head[PHASE_OUTPUTS]]
    first += head[PHASE_OUTPUTS]
    responses, before = memory[first : first + m * n], memory[first + m * n : first + 2 * m * n]
    first += 2 * m * n
    square = m * m
    share, of_gaps = memory[first : first + square], memory[first + square : first + 2 * square]
    minor = memory[first + 2 * square : first + 3 * square]
    first += 3 * square
    scales, multipliers = memory[first : first + m], memory[first + m : first + 2 * m]
    right, gaps = memory[first + 2 * m : first + 3 * m], memory[first + 3 * m : first + 5 * m]
    first += 5 * m
    bends, conditioning = memory[first : first + n], memory[first + n : first + n + 1]
    return System(
        head,
        order,
        gap_order,
        inputs,
        outputs,
        phase,
        responses,
        share,
        of_gaps,
        scales,
        multipliers,
        bends,
        right,
        gaps,
        before,
        minor,
        conditioning,
    )


def block_size(n: int, m: int, inputs: int, outputs: int, phase: int) -> int:
    """How many numbers a block takes."""
    return HEAD + 2 * m + inputs + outputs + phase + 2 * m * n + 3 * m * m + 5 * m + n + 1


@inline
def place_of_rows(system: System) -> int:
    """Where A begins in the outputs; γ and b follow it."""
    n = system.head[DEGREES]
    return int(n * (n + 1) // 2 + n + (n + 1 if system.head[POWERED] else 0))


@inline
def block_at(data: int) -> System:
    """The system whose block is at an address."""
    size = integers_at(data, 1)[SIZE]
    return open_system(integers_at(data, size), doubles_at(data, size))


@inline
def take_inputs(system: System, given: int) -> None:
    """Copies q, q̇ and t from an address; the parameters are there."""
    count = 2 * system.head[DEGREES] + 1
    inputs = doubles_at(given, count)
    for i in range(count):
        system.inputs[i] = inputs[i]
