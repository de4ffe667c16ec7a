"""Chaos: what may be asked."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from ..bounds import APART, CHAOS_LONGEST, CHAOS_SPAN, FLIP_POINTS, SHORTEST, USUAL_FLIPS
from ..base import examples
from ..experiment import ExperimentRequest


class ChaosRequest(ExperimentRequest):
    """Twin runs, Lyapunov exponent, and the horizon of prediction against the tolerance."""

    experiment: ClassVar[str] = "chaos"

    t_end: float = Field(CHAOS_SPAN, ge=SHORTEST, le=CHAOS_LONGEST, description="seconds of motion")
    apart: float | None = Field(None, ge=APART[0], le=APART[1], description="how far the twins are apart at first")
    map: bool = Field(default=False, description="whether to map the times at which angles turn over")
    count: int = Field(USUAL_FLIPS, ge=FLIP_POINTS[0], le=FLIP_POINTS[1], description="points on a side of the map")

    model_config = examples({"scene": "double-pendulum", "t_end": 10.0})
