"""Which rung is the least: within the tolerance to the end, and the simplest of those that survive a nudge."""

from __future__ import annotations

from ...mechanics.document import read_scene
from ...model.linear_laws import is_linear
from .distance import Yardstick
from .findings import Deviation, Measured, Rung

WHOLE = 0.99  # of the full motion, which a rung must last for
ALIKE = 1e-2  # of the tolerance: errors below that are none


def least(rungs: list[Rung], measured: list[Measured], tolerance: float) -> str | None:
    """The simplest of the rungs that survive, the full model among them; None where its motion is not known."""
    good = [
        (_complexity(rung, each.deviation, tolerance), place)
        for place, (rung, each) in enumerate(zip(rungs, measured, strict=True))
        if each.survives and each.deviation is not None
    ]
    return rungs[min(good)[1]].id if good and measured[0].survives else None


def _complexity(rung: Rung, deviation: Deviation, tolerance: float) -> tuple[int, bool, bool, float]:
    """What a model asks for: degrees of freedom, nonlinear equations, nothing left out; then its error.

    Operations do not count: an expression is longer or shorter by where coordinates begin. Errors far below the
    tolerance are alike; among those the shorter chain comes first.
    """
    scene = None if rung.scene is None else read_scene(rung.scene)
    is_nonlinear = scene is None or bool(scene.constraints) or not is_linear(scene)
    return rung.degrees, is_nonlinear, not rung.parts, max(deviation.relative or 0.0, ALIKE * tolerance)


def lasts(until: float, end: float) -> bool:
    """Whether a comparison until `until` covers the full motion, which ends at `end` (seconds)."""
    return until >= WHOLE * end


def is_within(deviation: Deviation | None, tolerance: float, full: Yardstick) -> bool:
    """Whether a rung is within the tolerance to the end; where the full motion rests, only a rung that rests is."""
    if deviation is None or not full.end > 0.0 or not lasts(deviation.until, full.end):
        return False
    if deviation.relative is None:
        return deviation.largest <= deviation.floor * full.size
    return deviation.relative <= tolerance
