"""The error estimate of an implicit step, filtered so that it does not mistake stiffness for inaccuracy.

Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.8.
"""

from __future__ import annotations

import numpy as np

from .compiler import inner
from .implicit_room import ImplicitRoom
from .linear import decompose, substitute
from .stages import ImplicitWeights


@inner
def prepare_error(weights: ImplicitWeights, h: float, room: ImplicitRoom) -> bool:
    """M + hγ₀(A − D) − h²γ₀²K, decomposed: what filters the error estimate."""
    g, m = h * weights.error[0], room.stages.linear
    n = room.p.size
    for k in range(n):
        for d in range(n):
            entry = m.mass[k, d] + g * (m.shift[k, d] - m.damping[k, d]) - g * g * m.stiffness[k, d]
            room.error_matrix[k, d] = entry
    return decompose(room.error_matrix, room.error_places)


@inner
def error_of(weights: ImplicitWeights, tolerance: float, h: float, room: ImplicitRoom) -> float:
    """(1 − hγ₀J)⁻¹ (hγ₀ f(y₀) + Σ eᵢ (Yᵢ − y₀)) over what is tolerated, root mean square (Hairer, Wanner II, IV.8)."""
    n, g = room.p.size, h * weights.error[0]
    stages, m = room.stages, room.stages.linear
    for d in range(n):
        room.error[d], room.error[n + d] = g * room.ends.old[n + d], g * room.rate[d]
        for i in range(stages.q.shape[0]):
            room.error[d] += weights.error[1 + i] * (stages.q[i, d] - room.ends.old[d])
            room.error[n + d] += weights.error[1 + i] * (stages.p[i, d] - room.p[d])
    for k in range(n):
        for d in range(n):
            room.error[n + k] -= (m.shift[k, d] - g * m.stiffness[k, d]) * room.error[d]
    substitute(room.error_matrix, room.error_places, room.error[n : 2 * n])
    total = 0.0
    for d in range(n):
        room.error[d] += g * room.error[n + d]
    for d in range(2 * n):
        scale = tolerance * max(1.0, abs(room.ends.old[d]), abs(room.ends.new[d]))
        total += (room.error[d] / scale) ** 2
    return float(np.sqrt(total / (2 * n)))
