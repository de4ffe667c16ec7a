"""Departure of the energy balance against time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .chart import Chart, Result, Trace, axis, chart, curve, name_of
from .words import Say

LOST = 0.3  # a departure this large leaves nothing of the energy's balance


def charts(result: Result, say: Say) -> list[Chart]:
    """One chart; the legend tells how the departure grows."""
    told = {"step": result["step"], "steps": result["steps"], "tolerance": result["tolerance"]}
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
    if line["status"] != "ok":
        return say(f"labs.status.{line['status']}")
    if max(line["error"], default=0.0) > LOST:
        return say("labs.energy-drift.lost")
    growth = line["growth"]
    if growth is None:
        return say("labs.energy-drift.rounding")
    return say(f"labs.energy-drift.{_kind(growth)}", power=growth)


def _kind(growth: float) -> str:
    if growth < 0.2:
        return "bounded"
    return "linear" if 0.8 <= growth <= 1.25 else "grows"
