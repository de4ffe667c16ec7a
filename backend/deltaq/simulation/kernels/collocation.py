"""Samples inside a step of a stiffly accurate collocation method: from the polynomials through its stages."""

from __future__ import annotations

from .compiler import inline
from .implicit_workspace import ImplicitWorkspace
from .motion import Floats
from .phase import Phase, velocity
from .plan import comes_to
from .stages import ImplicitWeights

NODES = (-0.7745966692414834, 0.0, 0.7745966692414834)  # ±√(3/5)
SHARES = (5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0)


@inline
def lagrange_basis(weights: ImplicitWeights, x: float, i: int) -> float:
    """The value at x of the Lagrange basis polynomial of node cᵢ among the nodes 0, c₁, …"""
    c = weights.c
    part = x / c[i]
    for j in range(c.size):
        if j != i:
            part *= (x - c[j]) / (c[i] - c[j])
    return float(part)


@inline
def integrated_basis(weights: ImplicitWeights, x: float, i: int) -> float:
    """∫₀ˣ of the Lagrange basis polynomial of node cᵢ among c₁, …, by Gauss's rule: exact for up to six nodes."""
    c, total = weights.c, 0.0
    for k in range(3):
        place, part = 0.5 * x * (1.0 + NODES[k]), 1.0
        for j in range(c.size):
            if j != i:
                part *= (place - c[j]) / (c[i] - c[j])
        total += 0.5 * x * SHARES[k] * part
    return float(total)


@inline
def sample_stages(
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float],
    samples: tuple[Floats, Floats],
    first: int,
    workspace: ImplicitWorkspace,
) -> int:
    """Samples number `first` and on, as far as they lie in the step now = (t, h); returns the number of the next one.

    q and p come from the polynomials through the stages, q̇ from p, the work from the integral of the powers there.
    `samples` are the times, shape (samples,), and the states, shape (samples, width), which are written.
    """
    p, stages, ends = workspace.p, workspace.stages, workspace.ends
    t, h = now
    times, out = samples
    n, count, reached = p.size, times.size, t + h
    is_last = comes_to(times[count - 1], reached)
    while first < count and (is_last or times[first] <= reached):
        x = min((times[first] - t) / h, 1.0)
        for d in range(n):
            out[first, d], stages.spare[1, d] = ends.old[d], p[d]
            out[first, n + d] = ends.new[n + d]
        for i in range(weights.c.size):
            part = lagrange_basis(weights, x, i)
            for d in range(n):
                out[first, d] += part * (stages.q[i, d] - ends.old[d])
                stages.spare[1, d] += part * (stages.p[i, d] - p[d])
        velocity(phase, times[first], out[first, :n], stages.spare[1], out[first, n : 2 * n], stages.spare[0])
        for d in range(2 * n, ends.old.size):
            out[first, d] = ends.old[d]
            for i in range(weights.c.size):
                out[first, d] += h * integrated_basis(weights, x, i) * workspace.powers[i]
        first += 1
    return first
