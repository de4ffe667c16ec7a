"""Constraints from outside of the kernels: the memory they work in, and samples brought back onto them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .kernels import system as kernel
from .kernels.linear import Indices
from .kernels.projection import settle_samples
from .problem import Floats, Problem


@dataclass(frozen=True)
class Reactions:
    """At samples: `multipliers` are λ, shape (samples, m), `gaps` the largest |g|, shape (samples,)."""

    multipliers: Floats
    gaps: Floats

    def first(self, count: int) -> Reactions:
        """Those at the first samples."""
        return Reactions(self.multipliers[:count], self.gaps[:count])


def block(problem: Problem, *, is_long: bool = True, with_phase: bool = False, tells_end: bool = True) -> Floats:
    """The memory of a model with constraints, which its functions are given: shape (size,).

    It holds addresses of machine code that lives as long as the model. `tells_end`: whether the derivative at the end
    of a step is asked for when its state is projected.
    """
    model = problem.model
    n, m = problem.degrees, len(model.layout.multipliers)
    motion = model.thorough if is_long else model.motion
    solution = model.solution(is_long=is_long) if problem.rank == m else None
    phase = model.phase.function if with_phase else None
    outputs = 0 if phase is None else phase.outputs
    size = kernel.block_size(n, m, motion.inputs, motion.outputs, outputs)
    memory = np.zeros(size)
    head = memory.view(np.int64)
    head[: kernel.PHASE_OUTPUTS + 1] = (
        size,
        n,
        m,
        model.layout.holonomic,
        model.layout.is_powered,
        problem.rank,
        motion.inputs,
        motion.outputs,
        outputs,
    )
    head[kernel.MOTION], head[kernel.MOTION_DATA] = motion.addresses
    gaps = model.thorough_gaps if is_long else model.gaps
    if gaps is not None:
        head[kernel.GAPS], head[kernel.GAPS_DATA] = gaps.addresses
    if solution is not None:
        head[kernel.SOLVED], head[kernel.SOLVED_DATA] = solution.motion.addresses
        head[kernel.PROJECTED], head[kernel.PROJECTED_DATA] = solution.projected.addresses
    if phase is not None:
        head[kernel.PHASE], head[kernel.PHASE_DATA] = phase.addresses
    head[kernel.TELLS_END] = tells_end
    first = kernel.HEAD + 2 * m
    head[kernel.HEAD : kernel.HEAD + m] = np.arange(m)
    memory[first + 2 * n + 1 : first + motion.inputs] = problem.parameters
    memory[-1] = 1.0  # the conditioning
    return memory


def solved_in(memory: Floats) -> tuple[int, int] | None:
    """The addresses of the motion solved for in symbols and of its data, where there are any.

    `memory` has shape (size,).
    """
    head = _integers(memory)
    return (int(head[kernel.SOLVED]), int(head[kernel.SOLVED_DATA])) if head[kernel.SOLVED] else None


def is_locked(memory: Floats) -> bool:
    """Whether the model has no accelerations because its constraints lost their independence.

    `memory` has shape (size,).
    """
    return bool(_integers(memory)[kernel.LOCKS])


def pivot_of(memory: Floats) -> float:
    """The smallest pivot of M and of AM⁻¹Aᵀ met, relative to its diagonal entry; `memory` has shape (size,)."""
    return float(memory[-1])


def settled(problem: Problem, times: Floats, states: Floats) -> tuple[Floats, Reactions]:
    """States brought back onto the constraints as far as they are good, and the reactions there.

    `times` has shape (samples,), `states` shape (samples, width).
    """
    memory, found = block(problem, is_long=problem.model.is_thorough), np.array(states)
    reactions = Reactions(np.zeros((len(times), len(problem.model.layout.multipliers))), np.zeros(len(times)))
    place = memory.ctypes.data
    good = settle_samples(place, np.ascontiguousarray(times), found, reactions.multipliers, reactions.gaps)
    return found[:good], reactions.first(good)


def _integers(memory: Floats) -> Indices:
    """The same memory as integers: shape (size,)."""
    return memory.view(np.int64)
