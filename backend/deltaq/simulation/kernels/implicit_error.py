"""The error estimate of an implicit step, filtered so that it does not mistake stiffness for inaccuracy.

Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.8.
"""

from __future__ import annotations

import numpy as np

from .compiler import inline
from .implicit_workspace import ImplicitWorkspace
from .linear import decompose, substitute
from .stages import ImplicitWeights


@inline
def prepare_error(weights: ImplicitWeights, h: float, workspace: ImplicitWorkspace) -> bool:
    """Decomposes M + hγ₀(A − D) − h²γ₀²K, which filters the error estimate; False if it is singular."""
    g, m = h * weights.error[0], workspace.stages.linear
    n = workspace.p.size
    for k in range(n):
        for d in range(n):
            entry = m.mass[k, d] + g * (m.shift[k, d] - m.damping[k, d]) - g * g * m.stiffness[k, d]
            workspace.error_matrix[k, d] = entry
    return decompose(workspace.error_matrix, workspace.error_pivots)


@inline
def error_of(weights: ImplicitWeights, tolerance: float, h: float, workspace: ImplicitWorkspace) -> float:
    """(1 − hγ₀J)⁻¹ (hγ₀ f(y₀) + Σ eᵢ (Yᵢ − y₀)) over what is tolerated, root mean square; 1 is just good enough.

    Source: Hairer, Wanner II, IV.8.
    """
    n, g = workspace.p.size, h * weights.error[0]
    stages, m = workspace.stages, workspace.stages.linear
    for d in range(n):
        workspace.error[d], workspace.error[n + d] = g * workspace.ends.old[n + d], g * workspace.rate[d]
        for i in range(stages.q.shape[0]):
            workspace.error[d] += weights.error[1 + i] * (stages.q[i, d] - workspace.ends.old[d])
            workspace.error[n + d] += weights.error[1 + i] * (stages.p[i, d] - workspace.p[d])
    for k in range(n):
        for d in range(n):
            workspace.error[n + k] -= (m.shift[k, d] - g * m.stiffness[k, d]) * workspace.error[d]
    substitute(workspace.error_matrix, workspace.error_pivots, workspace.error[n : 2 * n])
    total = 0.0
    for d in range(n):
        workspace.error[d] += g * workspace.error[n + d]
    for d in range(2 * n):
        scale = tolerance * max(1.0, abs(workspace.ends.old[d]), abs(workspace.ends.new[d]))
        total += (workspace.error[d] / scale) ** 2
    return float(np.sqrt(total / (2 * n)))
