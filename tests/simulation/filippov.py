"""Filippov's rule by SciPy: y' = f(t, y, σ), where σ = sign w(t, y), and along w = 0 the σ that keeps it there.

One event after the other: w comes to zero, or σ leaves [−1, 1]. f is linear in σ and w is linear in y.
Source: Filippov, Differential Equations with Discontinuous Righthand Sides, §4.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Floats = NDArray[np.float64]
EXACT = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14, "dense_output": True}
LATER = 1e-9  # s behind an event, by which w is off zero again or σ off its bound


@dataclass
class Filippov:
    """The field f(t, y, σ), w = slopes · y − b(t) with its rate b'(t), and what has happened so far."""

    field_of: Callable[[float, Floats, float], Floats]
    slopes: Floats
    offset: Callable[[float], float]
    offset_rate: Callable[[float], float]
    events: list[tuple[str, float]] = field(default_factory=list)
    pieces: list[tuple[float, Callable[[float], Floats]]] = field(default_factory=list)

    def w(self, t: float, y: Floats) -> float:
        return float(self.slopes @ y) - self.offset(t)

    def rate(self, t: float, y: Floats, sigma: float) -> float:
        return float(self.slopes @ self.field_of(t, y, sigma)) - self.offset_rate(t)

    def between(self, t: float, y: Floats) -> float:
        """The σ for which w stays."""
        above, below = self.rate(t, y, 1.0), self.rate(t, y, -1.0)
        return (above + below) / (below - above)

    def follow(self, y: Floats, t_end: float) -> Callable[[float], Floats]:
        """The motion from t = 0 as a function of the time."""
        t, sigma = 0.0, math.copysign(1.0, self.w(0.0, y))
        slides = False
        while t < t_end:
            t, y = self._stretch(t, y, None if slides else sigma, t_end)
            if t >= t_end:
                break
            if slides:
                sigma = math.copysign(1.0, self.between(t, y))
                self.events.append(("leave", t))
                slides = False
            else:
                slides = self.rate(t, y, 1.0) < 0.0 < self.rate(t, y, -1.0)
                self.events += [("slide", t)] if slides else []
                sigma = -sigma
        return self._at

    def _stretch(self, t: float, y: Floats, sigma: float | None, t_end: float) -> tuple[float, Floats]:
        """The motion on one side, or (None) along w = 0, up to where that ends."""

        def slope(at: float, state: Floats) -> Floats:
            return self.field_of(at, state, self.between(at, state) if sigma is None else sigma)

        def ends(at: float, state: Floats) -> float:
            if at < t + LATER:
                return 1.0
            return 1.0 - abs(self.between(at, state)) if sigma is None else sigma * self.w(at, state)

        ends.terminal, ends.direction = True, -1  # type: ignore[attr-defined]
        found = solve_ivp(slope, (t, t_end), y, events=ends, max_step=0.02, **EXACT)
        self.pieces.append((t, found.sol))
        return float(found.t[-1]), found.y[:, -1]

    def _at(self, t: float) -> Floats:
        return next(piece for start, piece in reversed(self.pieces) if start <= t)(t)
