"""Constraints from outside of the kernels: the memory they work in, and samples brought back onto them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..model.model import Model
from .kernels import system as kernel
from .kernels.linear import Indices
from .kernels.projection import settle_samples
from .method import Method, Partitioned, Tableau
from .problem import Floats, Problem


@dataclass(frozen=True)
class Reactions:
    """At samples: `multipliers` are λ, shape (samples, m), `gaps` the largest |g|, shape (samples,)."""

    multipliers: Floats
    gaps: Floats

    def first(self, count: int) -> Reactions:
        """Those at the first samples."""
        return Reactions(self.multipliers[:count], self.gaps[:count])


class Finish(Enum):
    """What is asked for when the state at the end of a step is projected: that alone, or its derivative as well.

    Where a step is little more than its end, both are LANDED, by code of their own in long runs.
    """

    STATE = "state"
    DERIVATIVE = "derivative"
    LANDED = "landed"

    @classmethod
    def of(cls, method: Method) -> Finish:
        """What a method asks for."""
        if not isinstance(method.scheme, Partitioned):
            is_short = isinstance(method.scheme, Tableau) and method.is_explicit and method.scheme.stages == 1
            return cls.LANDED if is_short else cls.DERIVATIVE
        return cls.STATE


def block(problem: Problem, *, is_long: bool = True, with_phase: bool = False, finish: Finish | None = None) -> Floats:
    """The memory of a model with constraints, which its functions are given: shape (size,).

    It holds addresses of machine code that lives as long as the model; `finish` is None where no steps are finished.
    """
    model = problem.model
    n, m = problem.degrees, len(model.layout.multipliers)
    motion = model.thorough if is_long else model.motion
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
    if finish is not None and problem.rank == m:
        _take_solution(head, model, finish, is_long=is_long)
    if phase is not None:
        head[kernel.PHASE], head[kernel.PHASE_DATA] = phase.addresses
    first = kernel.HEAD + 2 * m
    head[kernel.HEAD : kernel.HEAD + m] = np.arange(m)
    memory[first + 2 * n + 1 : first + motion.inputs] = problem.parameters
    memory[-1] = 1.0  # the conditioning
    return memory


def _take_solution(head: Indices, model: Model, finish: Finish, *, is_long: bool) -> None:
    """The addresses of what is solved for in symbols, if it is; `head` has shape (size,).

    A step that lands needs no other code for long runs: it reads accelerations where a run begins, and no more.
    """
    lands = finish is Finish.LANDED and is_long
    solution = model.solution(is_long=is_long and not lands)
    head[kernel.TELLS_END] = finish is not Finish.STATE
    if solution is None:
        return
    head[kernel.SOLVED], head[kernel.SOLVED_DATA] = solution.motion.addresses
    landing = model.solution(is_long=True) if lands else None
    if landing is None:
        head[kernel.PROJECTED], head[kernel.PROJECTED_DATA] = solution.projected.addresses
        return
    head[kernel.LANDED], head[kernel.LANDED_DATA] = landing.landed.addresses
    if landing.placed is not None:
        head[kernel.PLACED], head[kernel.PLACED_DATA] = landing.placed.addresses


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


def seems_turned(memory: Floats) -> bool:
    """Whether the constraints looked turned round at the ends of a step that was taken; `memory` has shape (size,)."""
    return bool(_integers(memory)[kernel.TURNS])


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
