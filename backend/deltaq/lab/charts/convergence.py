"""Error against step, with slope triangles."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from .chart import (
    CEILING,
    WITHOUT_RESULT,
    Chart,
    Result,
    Trace,
    axis,
    chart,
    crosses,
    curve,
    grouped,
    joined,
    look,
    name_of,
)
from .words import Say

RANGE = [-15.5, 2.0]


def charts(result: Result, say: Say) -> list[Chart]:
    """One chart; the legend tells the measured slope and the order."""
    reference = result["reference"]
    told = {"methods": joined(reference["methods"], say), "error": reference["error"]}
    caption = say("labs.convergence.caption", t_end=result["t_end"], **told)
    if result["events"]:
        caption = f"{caption} {say('labs.convergence.events')}"
    x_axis = axis(say("labs.axis.step"), log=True)
    y_axis = axis(say("labs.axis.error"), log=True, range=RANGE, dtick=2)
    traces = [*_curves(result, say), *_triangles(result)]
    return [chart("convergence", say("labs.convergence.title"), caption, traces, xaxis=x_axis, yaxis=y_axis)]


def _curves(result: Result, say: Say) -> Iterator[Trace]:
    for method, points in grouped(result["points"]).items():
        good = [point for point in points if point["error"] is not None]
        name, order = name_of(method, say), result["orders"].get(method)
        label = say("labs.convergence.with-order", name=name, measured=order["measured"]) if order else name
        texts = [_hover(name, p["step"], say("labs.hover.error", value=p["error"]), say) for p in good]
        floor = [max(point["error"], 10 ** RANGE[0]) for point in good]
        yield curve(label, [p["step"] for p in good], floor, method, text=texts, hoverinfo="text")
        bad = [point for point in points if point["status"] not in ("ok", "too_slow")]
        if bad:
            yield _failed(bad, method, name, say)


def _hover(name: str, step: float, outcome: str, say: Say) -> str:
    return f"<b>{name}</b><br>{say('labs.hover.step', value=step)}<br>{outcome}"


def _failed(bad: list[Mapping[str, Any]], method: str, name: str, say: Say) -> Trace:
    steps = [point["step"] for point in bad]
    texts = [_hover(name, p["step"], say(f"labs.status.{p['status']}"), say) for p in bad]
    return crosses(steps, [CEILING] * len(bad), texts, method, say, meta=WITHOUT_RESULT)


def _triangles(result: Result) -> Iterator[Trace]:
    """One for each order: over a factor of 4 in h, a factor of 4^p in the error, below the curve that shows it best."""
    seen = set()
    for method, points in grouped(result["points"]).items():
        order = result["orders"].get(method)
        good = [p for p in points if p["error"] is not None and 1e-12 < p["error"] < 1e-2]
        if order is None or order["theory"] in seen or len(good) < 3:
            continue
        seen.add(order["theory"])
        yield _triangle(good[len(good) // 2], order["theory"], look(method)["color"])


def _triangle(point: Mapping[str, Any], order: int, color: str) -> Trace:
    x, y = point["step"], 0.35 * point["error"]
    left, low = x / 3.0, y / 3.0**order
    if low < 1e-15:
        left, low = x / 2.0, y / 2.0**order
    return {
        "type": "scatter",
        "mode": "lines+text",
        "x": [left, x, x, left],
        "y": [low, y, low, low],
        "text": ["", f" {order}" if math.isfinite(low) else "", "", ""],
        "textposition": "bottom right",
        "line": {"color": color, "width": 1},
        "hoverinfo": "skip",
        "showlegend": False,
        "fill": "toself",
        "opacity": 0.6,
    }
