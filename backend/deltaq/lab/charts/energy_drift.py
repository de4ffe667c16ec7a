"""Departure of the energy balance against time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..drift import LOST
from .chart import Chart, Result, Trace, axis, chart, curve, name_of
from .words import Say


def charts(result: Result, say: Say) -> list[Chart]:
    """One chart; the legend tells how the departure grows."""
    told = {"step": result["step"], "steps": result["steps"], "tolerance": result["tolerance"], "lost": LOST}
    caption = say("labs.energy-drift.caption", t_end=result["t_end"], **told)
    x_axis = axis(say("labs.axis.t"), log=True)
    y_axis = axis(say("labs.energy-drift.axis"), log=True, dtick=2)
    traces = list(_traces(result, say))
    return [chart("energy-drift", say("labs.energy-drift.title"), caption, traces, xaxis=x_axis, yaxis=y_axis)]


def _traces(result: Result, say: Say) -> Iterator[Trace]:
    for line in result["lines"]:
        name = name_of(line["method"], say)
        label = f"{name}: {_verdict(line, say)}"
        texts = [f"<b>{name}</b><br>{say('labs.hover.t', value=t)}" for t in line.get("t", ())]
        yield curve(label, line.get("t", []), line.get("error", []), line["method"], mode="lines", text=texts)


def _verdict(line: dict[str, Any], say: Say) -> str:
    """What is said of one method: how its error grows, and how large it is."""
    if line["status"] != "ok":
        return say(f"labs.status.{line['status']}")
    told = {"power": line["growth"], "largest": line["largest"], "t": line["lost_at"]}
    return say(f"labs.energy-drift.{line['verdict']}", **told)
