"""One step of an implicit method in positions and momenta."""

from __future__ import annotations

from .compiler import inline
from .implicit_error import error_of, prepare_error
from .implicit_workspace import ImplicitWorkspace, compensated_sum
from .kicked import begin_kicked, invert
from .kicks import prepare_kicks
from .motion import FINE, NEWTON_FAILED, NOT_FINITE, Motion, finish_constrained, rhs
from .newton import GO_ON, assemble, newton, newton_in_symbols
from .phase import Phase, linearize, momenta, velocity
from .stages import ImplicitWeights, Start, midpoint
from .step import judge_size
from .system import block_at

# Of the local tolerance: what may be left of the stages' equations, in a velocity. A step's error estimate does not see
# it, and over all steps it adds up: with a hundredth errors are mostly of it, and no smaller in a finer run of a pair.
UNSOLVED = 2e-4


@inline
def finish(
    motion: Motion, phase: Phase, weights: ImplicitWeights, t: float, h: float, workspace: ImplicitWorkspace
) -> int:
    """The new state from the stages; returns the outcome."""
    stages, ends, n = workspace.stages, workspace.ends, motion.degrees
    count = weights.b.size
    for d in range(n):
        change, impulse = 0.0, 0.0
        for i in range(count):
            change += weights.b[i] * stages.v[i, d]
            impulse += weights.momentum_b[i] * stages.r[i, d]
        ends.new[d] = compensated_sum(ends.old[d], h * change, d, workspace)
        workspace.new_p[d] = compensated_sum(workspace.p[d], h * impulse, n + d, workspace)
        ends.new[n + d] = stages.v[count - 1, d]
        outcome = judge_size(ends.new[d], d, ends.new.size)
        if outcome != FINE:
            return outcome
    if motion.is_powered:
        work = 0.0
        for i in range(count):
            for d in range(n):
                workspace.state[d] = stages.q[i, d]
                workspace.state[n + d] = stages.v[i, d]
            if rhs(motion, t + weights.c[i] * h, workspace.state, workspace.derivative) != FINE:
                return NOT_FINITE
            workspace.powers[i] = workspace.derivative[2 * n]
            work += weights.b[i] * workspace.powers[i]
        ends.new[2 * n] = compensated_sum(ends.old[2 * n], h * work, 2 * n, workspace)
    outcome = velocity(phase, t + h, ends.new[:n], workspace.new_p, ends.new[n : 2 * n], stages.spare[0])
    for d in range(n, ends.new.size if outcome == FINE else n):
        outcome = outcome or judge_size(ends.new[d], d, ends.new.size)
    return outcome


@inline
def finish_momenta(motion: Motion, phase: Phase, t: float, h: float, workspace: ImplicitWorkspace) -> int:
    """The new state brought back onto the constraints, and the momenta there; returns the outcome."""
    ends, n = workspace.ends, motion.degrees
    outcome = finish_constrained(motion, t, h, ends.old, ends.new, ends.old_derivative, ends.new_derivative)
    momenta(phase, t + h, ends.new[:n], ends.new[n : 2 * n], workspace.new_p, workspace.stages.spare[0])
    return outcome


@inline
def differentiate(phase: Phase, weights: ImplicitWeights, t: float, h: float, workspace: ImplicitWorkspace) -> int:
    """The derivatives in the middle of the step, by the first guesses; returns the evaluations made."""
    stages, n = workspace.stages, workspace.p.size
    midpoint(weights, h, workspace.ends.old[:n], stages)
    linearize(phase, t + 0.5 * h, stages.centre[0], stages.centre[1], stages.linear, stages.spare)
    return 1 + 2 * n


@inline
def prepare(weights: ImplicitWeights, h: float, workspace: ImplicitWorkspace) -> int:
    """Decomposes the matrices for steps of size h; NEWTON_FAILED if one is singular."""
    if not assemble(weights, h, workspace.stages):
        return NEWTON_FAILED
    if workspace.kicked.address != 0:
        invert(workspace.stages, workspace.kicked)
    if weights.error.size > 0 and not prepare_error(weights, h, workspace):
        return NEWTON_FAILED
    return FINE


@inline
def attempt_implicit(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    tolerance: float,
    t: float,
    h: float,
    workspace: ImplicitWorkspace,
) -> tuple[int, int, float, float]:
    """Stages, new state and error of one step.

    Returns the outcome, the evaluations made, the ratio of the first two corrections, and the error over what is
    tolerated.
    """
    n, stages, kicks, kicked = workspace.p.size, workspace.stages, workspace.kicks, workspace.kicked
    start, now = Start(workspace.ends.old[:n], workspace.ends.old[n : 2 * n], workspace.p), (t, h, UNSOLVED * tolerance)
    outcome, iterations, slowness = GO_ON, 0, 0.0
    for d in range(n if kicks.right.size > 0 else 0):
        kicks.p[d] = start.p[d]
    if kicked.address != 0:
        begin_kicked(motion, block_at(motion.block), weights, t, h, start, kicked)
        outcome, iterations, slowness = newton_in_symbols(weights, now, start, stages, kicked)
    if outcome == GO_ON:
        outcome = prepare_kicks(motion, weights, t, h, start, stages, kicks) if kicks.right.size > 0 else FINE
        if outcome == FINE:
            outcome, iterations, slowness = newton(motion, phase, weights, now, start, stages, kicks)
    if outcome == FINE:
        outcome = finish(motion, phase, weights, t, h, workspace)
    error = error_of(weights, tolerance, h, workspace) if outcome == FINE and tolerance > 0.0 else 0.0
    if outcome == FINE and error <= 1.0 and motion.finish != 0:
        outcome = finish_momenta(motion, phase, t, h, workspace)
    if outcome != FINE and kicks.right.size > 0:
        for d in range(n):
            workspace.p[d] = kicks.p[d]
    return outcome, weights.b.size * iterations + 1, slowness, error
