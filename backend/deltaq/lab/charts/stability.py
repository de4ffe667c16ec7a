"""Regions of stability with the scene's hλ in them, and what stiffness costs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .chart import Chart, Result, Trace, axis, chart, crosses, curve, grouped, name_of
from .words import Say, called, in_minimal


def charts(result: Result, say: Say) -> list[Chart]:
    """The regions; and, where a stiffness can be varied, right-hand sides against it."""
    found = [_regions(result, say)]
    return [*found, _stiffness(result, say)] if result["series"] else found


def _regions(result: Result, say: Say) -> Chart:
    x_axis = axis("Re hλ", range=[-6.0, 2.0], zeroline=True, zerolinecolor="#888888")
    y_axis = axis("Im hλ", range=[-4.0, 4.0], zeroline=True, zerolinecolor="#888888", scaleanchor="x")
    traces = [trace for row in result["methods"] for trace in _region(row, say)]
    traces.append(_eigenvalues(result, say))
    caption = say("labs.stability.caption", count=len(result["eigenvalues"]))
    caption = in_minimal(caption, result, say)
    return chart("stability-regions", say("labs.stability.title"), caption, traces, xaxis=x_axis, yaxis=y_axis)


def _region(row: dict[str, Any], say: Say) -> Iterator[Trace]:
    """The boundary as one trace, its lines parted by gaps."""
    x: list[float | None] = []
    y: list[float | None] = []
    for line in row["region"]:
        x += [*(point[0] for point in line), None]
        y += [*(point[1] for point in line), None]
    name = name_of(row["method"], say)
    yield curve(name, x, y, row["method"], mode="lines", hoverinfo="name", visible=_at_first(row["method"]))


def _at_first(method: str) -> bool | str:
    """Fourteen regions at once cover each other; a click on the legend shows the rest."""
    shown = {"explicit-euler", "heun", "rk4", "dormand-prince-54", "stormer-verlet"}
    return True if method in shown else "legendonly"


def _eigenvalues(result: Result, say: Say) -> Trace:
    """At h = 1 s; the page moves them along with its slider."""
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "hλ",
        "x": [z[0] for z in result["eigenvalues"]],
        "y": [z[1] for z in result["eigenvalues"]],
        "marker": {"symbol": "cross", "size": 11, "color": "#222222"},
        "meta": {"role": "eigenvalues"},
        "text": [say("labs.stability.eigenvalue", re=z[0], im=z[1]) for z in result["eigenvalues"]],
        "hoverinfo": "text",
    }


def _stiffness(result: Result, say: Say) -> Chart:
    traces = [trace for method, rows in grouped(result["series"]).items() for trace in _cost(method, rows, say)]
    x_axis = axis(say("labs.stability.factor", parameter=called(result, result["stiffness"])), log=True)
    y_axis = axis(say("labs.axis.evaluations"), log=True)
    caption = say("labs.stability.stiff-caption", parameter=called(result, result["stiffness"]), t_end=result["t_end"])
    return chart("stability-stiffness", say("labs.stability.stiff-title"), caption, traces, xaxis=x_axis, yaxis=y_axis)


def _cost(method: str, rows: list[Any], say: Say) -> Iterator[Trace]:
    name, good = name_of(method, say), [row for row in rows if row["status"] == "ok"]
    texts = [_hover(name, row, say) for row in good]
    yield curve(
        name, [r["factor"] for r in good], [r["evaluations"] for r in good], method, text=texts, hoverinfo="text"
    )
    bad = [row for row in rows if row["status"] != "ok"]
    if bad:
        places = [row["factor"] for row in bad], [max(row["evaluations"], 1) for row in bad]
        yield crosses(*places, [_hover(name, row, say) for row in bad], method, say)


def _hover(name: str, row: dict[str, Any], say: Say) -> str:
    lines = [
        f"<b>{name}</b>",
        say("labs.hover.factor", value=row["factor"]),
        say("labs.hover.error", value=row["error"]),
        say("labs.hover.cost", evaluations=row["evaluations"], milliseconds=1e3 * row["time"]),
    ]
    return "<br>".join([*lines, say(f"labs.status.{row['status']}")] if row["status"] != "ok" else lines)
