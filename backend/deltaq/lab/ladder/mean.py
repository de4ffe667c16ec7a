"""Means over time of what guides and explicit time dependence bring in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import SceneError
from ...mechanics.scene import Scene
from ...mechanics.soundness import expressions
from ...simulation.problem import Floats
from ..period import period

COUNT, LONG = 4096, 100.0  # spans, where there is no period


@dataclass(frozen=True)
class Mean:
    """Moments in seconds and the weights of a mean, which add up to one: shape (moments,) each as `times`, `weights`.

    There is a single moment where nothing depends on the time.
    """

    times: Floats
    weights: Floats

    @classmethod
    def of(cls, scene: Scene, span: float) -> Mean:
        """Evenly over a period; where there is none, over a long time with weights that fade at both ends (Hann).

        A mean with such weights over T misses that of an oscillation ω by about 1/(ωT)³ only.
        Source: Harris, Proc. IEEE 66 (1978) 51–83.
        """
        if not any("t" in field.expression.names for field in expressions(scene)):
            return cls(np.zeros(1), np.ones(1))
        phases = (np.arange(COUNT) + 0.5) / COUNT
        try:
            return cls(period(scene) * phases, np.full(COUNT, 1.0 / COUNT))
        except SceneError:  # it depends on the time in another way
            return cls(LONG * span * phases, (1.0 - np.cos(2.0 * np.pi * phases)) / COUNT)
