"""Twins, Lyapunov exponent, horizon and flips."""

from __future__ import annotations

import math
from typing import Any

from .chart import PALETTE, Chart, Result, Trace, axis, chart
from .words import Say, called

SCALE = [[0.0, "#fde725"], [0.35, "#35b779"], [0.7, "#31688e"], [1.0, "#440154"]]


def charts(result: Result, say: Say) -> list[Chart]:
    """What there is so far."""
    makers = {"twins": _twins, "exponent": _exponent, "horizon": _horizon, "map": _map}
    return [make(result, say) for part, make in makers.items() if _can_be_drawn(result, part)]


def _can_be_drawn(result: Result, part: str) -> bool:
    return part in result and "missing" not in result[part] and (part != "horizon" or bool(result[part]["points"]))


def _line(x: list[float], y: list[float], color: int, name: str, **more: Any) -> Trace:
    line = {"color": PALETTE[color], "width": 1.6}
    return {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": name, "line": line} | more


def _twins(result: Result, say: Say) -> Chart:
    told = result["twins"]
    traces = [_line(told["t"], [max(d, 1e-16) for d in told["distance"]], 0, say("labs.chaos.distance"))]
    rate = result.get("exponent", {}).get("last", 0.0)
    if rate > 0.0:
        until = min(told["t"][-1], math.log(1.0 / result["apart"]) / rate)
        ends = [result["apart"], result["apart"] * math.exp(rate * until)]
        traces.append(_line([0.0, until], ends, 1, "e<sup>λt</sup>") | {"line": {"color": PALETTE[1], "dash": "dash"}})
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis(say("labs.chaos.distance-axis"), log=True)}
    caption = say("labs.chaos.twins-caption", apart=result["apart"])
    return chart("chaos-twins", say("labs.chaos.twins"), caption, traces, **axes)


def _exponent(result: Result, say: Say) -> Chart:
    told = result["exponent"]
    traces = [_line(told["t"], told["values"], 2, "λ(t)")]
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis("λ / s⁻¹", rangemode="tozero")}
    caption = say("labs.chaos.exponent-caption", last=told["last"], spread=told["spread"])
    if "horizon" in result and not _can_be_drawn(result, "horizon"):
        caption += " " + say("labs.chaos.no-horizon")
    return chart("chaos-exponent", say("labs.chaos.exponent"), caption, traces, showlegend=False, **axes)


def _horizon(result: Result, say: Say) -> Chart:
    told = result["horizon"]
    x, y = [p["tolerance"] for p in told["points"]], [p["t"] for p in told["points"]]
    marks = {"color": PALETTE[0], "size": 9}
    traces: list[Trace] = [{"type": "scatter", "mode": "markers", "x": x, "y": y, "marker": marks, "name": ""}]
    if told["per_digit"] is not None:
        mean = sum(-math.log10(t) for t in x) / len(x)
        fitted = [sum(y) / len(y) + told["per_digit"] * (-math.log10(t) - mean) for t in x]
        traces.append(_line(x, fitted, 1, ""))
    rate = result.get("exponent", {}).get("last", 0.0)
    theory = math.log(10.0) / rate if rate > 1e-3 else None
    caption = say("labs.chaos.horizon-caption", measured=told["per_digit"], theory=theory)
    axes = {
        "xaxis": axis(say("labs.axis.tolerance"), log=True, autorange="reversed"),
        "yaxis": axis(say("labs.chaos.horizon-axis"), rangemode="tozero"),
    }
    return chart("chaos-horizon", say("labs.chaos.horizon"), caption, traces, showlegend=False, **axes)


def _map(result: Result, say: Say) -> Chart:
    told = result["map"]
    x, y = told["x"], told["y"]
    across, up = called(result, x["coordinate"]), called(result, y["coordinate"])
    heat = {
        "type": "heatmap",
        "x": x["values"],
        "y": y["values"],
        "z": [[None if t is None or t < 0 else t for t in row] for row in told["times"]],
        "zmin": 0.0,
        "zmax": told["t_end"],
        "colorscale": SCALE,
        "colorbar": {"title": {"text": "t / s", "side": "right"}, "thickness": 12, "outlinewidth": 0},
        "hovertemplate": f"{across} = %{{x:.3f}}<br>{up} = %{{y:.3f}}<br>t = %{{z:.2f}} s<extra></extra>",
        "meta": {"role": "flips", "x": x["coordinate"], "y": y["coordinate"]},
    }
    axes = {
        "xaxis": axis(f"{across}(0) / rad", constrain="domain"),
        "yaxis": axis(f"{up}(0) / rad", scaleanchor="x", constrain="domain"),
    }
    caption = say("labs.chaos.map-caption", t_end=told["t_end"], count=len(x["values"]))
    return chart("chaos-map", say("labs.chaos.map"), caption, [heat], **axes)
