"""The largest Floquet multiplier over a plane of two parameters."""

from __future__ import annotations

import math

from .chart import Chart, Result, axis, chart
from .words import Say, called, in_minimal

SCALE = [[0.0, "#f4f1de"], [1e-6, "#fde0c5"], [0.25, "#f2a25c"], [0.6, "#c8452f"], [1.0, "#5a0f24"]]
LARGEST = 1.0  # decades of |μ| that the colours tell apart


def charts(result: Result, say: Say) -> list[Chart]:
    """One map: light is stable, dark grows fast, blank has no periodic motion nearby."""
    x, y = result["x"], result["y"]
    across, up = called(result, x["parameter"]), called(result, y["parameter"])
    heat = {
        "type": "heatmap",
        "x": x["values"],
        "y": y["values"],
        "z": [[_shade(one) for one in row] for row in result["growth"]],
        "zmin": 0.0,
        "zmax": LARGEST,
        "colorscale": SCALE,
        "colorbar": {"title": {"text": "lg |μ|", "side": "right"}, "thickness": 12, "outlinewidth": 0},
        "hovertemplate": f"{across} = %{{x:.4g}}<br>{up} = %{{y:.4g}}<br>lg |μ| = %{{z:.3f}}<extra></extra>",
        "meta": {"role": "map", "x": x["parameter"], "y": y["parameter"]},
    }
    count, percent = f"{len(x['values'])} × {len(y['values'])}", f"{100 * result['stable']:.0f}"
    caption = say("labs.stability-map.caption", count=count, seconds=result["time"], percent=percent)
    caption = in_minimal(caption, result, say)
    axes = {"xaxis": axis(across), "yaxis": axis(up)}
    return [chart("stability-map", say("labs.stability-map.title"), caption, [heat], **axes)]


def _shade(growth: float | None) -> float | None:
    """Decades of |μ| above 1; what is stable but for rounding is 0."""
    if growth is None:
        return None
    return 0.0 if growth <= 1.0 + 1e-6 else round(math.log10(growth), 4)
