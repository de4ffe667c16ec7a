"""Twins, Lyapunov exponent, horizon and flips."""

from __future__ import annotations

import math
from typing import Any

from .chart import PALETTE, Chart, Result, Trace, axis, chart
from .words import Say, called, in_minimal

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
    if _is_chaotic(result):
        rate = result["exponent"]["last"]
        until = min(told["t"][-1], math.log(1.0 / result["apart"]) / rate)
        ends = [result["apart"], result["apart"] * math.exp(rate * until)]
        traces.append(_line([0.0, until], ends, 1, "e<sup>λt</sup>") | {"line": {"color": PALETTE[1], "dash": "dash"}})
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis(say("labs.chaos.distance-axis"), log=True)}
    caption = in_minimal(say("labs.chaos.twins-caption", apart=result["apart"]), result, say)
    return chart("chaos-twins", say("labs.chaos.twins"), caption, traces, **axes)


def _is_chaotic(result: Result) -> bool:
    return bool(result.get("exponent", {}).get("verdict") == "chaotic")


def _exponent(result: Result, say: Say) -> Chart:
    told = result["exponent"]
    traces = [_line(told["t"], told["values"], 2, "λ(t)"), *_band(told, say)]
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis("λ / s⁻¹", rangemode="tozero")}
    caption = " ".join(filter(None, (_verdict(told, say), _measure(told, say), _second(told, say))))
    if "horizon" in result and not _can_be_drawn(result, "horizon"):
        caption += " " + say("labs.chaos.no-horizon")
    if result.get("map", {}).get("missing") == "constraints":
        caption += " " + say("labs.chaos.no-map")
    return chart("chaos-exponent", say("labs.chaos.exponent"), caption, traces, showlegend=False, **axes)


def _band(told: Result, say: Say) -> list[Trace]:
    """The interval over all of the time that it is measured in."""
    if not told["t"]:
        return []
    start, end, (low, high) = told["t"][0], told["t"][-1], told["interval"]
    fill = {"fill": "toself", "fillcolor": "rgba(0, 158, 115, 0.18)", "line": {"width": 0}, "hoverinfo": "skip"}
    corners = [start, end, end, start, start], [low, low, high, high, low]
    return [_line(*corners, 2, say("labs.chaos.interval", confidence=_percent(told))) | fill]


def _percent(told: Result) -> int:
    return round(100 * float(told["confidence"]))


def _verdict(told: Result, say: Say) -> str:
    """What is said of the motion; nothing while it is measured."""
    match told.get("verdict"):
        case None:
            return ""
        case "chaotic":
            return say("labs.chaos.verdict.chaotic")
        case "regular" if told["interval"][1] < 0.0:
            return say("labs.chaos.verdict.shrinks")
        case "regular":
            return say("labs.chaos.verdict.regular", power=told["growth"]["power"]["power"])
    return say(f"labs.chaos.undecided.{told['reason']}", t=told["span"], status=say(f"labs.status.{told['status']}"))


def _measure(told: Result, say: Say) -> str:
    if told["last"] is None:
        return ""
    low, high = told["interval"]
    numbers = {"last": told["last"], "low": low, "high": high, "confidence": _percent(told)}
    return say("labs.chaos.exponent-caption", transient=told["transient"], until=told["span"], **numbers)


def _second(told: Result, say: Say) -> str:
    value = told.get("second_indicator", {}).get("value")
    return "" if value is None else say("labs.chaos.zero-one", k=round(value, 2) + 0.0)


def _horizon(result: Result, say: Say) -> Chart:
    told = result["horizon"]
    x, y = [p["tolerance"] for p in told["points"]], [p["t"] for p in told["points"]]
    marks = {"color": PALETTE[0], "size": 9}
    traces: list[Trace] = [{"type": "scatter", "mode": "markers", "x": x, "y": y, "marker": marks, "name": ""}]
    if told["per_digit"] is not None and _is_chaotic(result):
        mean = sum(-math.log10(t) for t in x) / len(x)
        fitted = [sum(y) / len(y) + told["per_digit"] * (-math.log10(t) - mean) for t in x]
        traces.append(_line(x, fitted, 1, ""))
    axes = {
        "xaxis": axis(say("labs.axis.tolerance"), log=True, autorange="reversed"),
        "yaxis": axis(say("labs.chaos.horizon-axis"), rangemode="tozero"),
    }
    caption = say("labs.chaos.horizon-caption") + " " + _gain(result, say)
    return chart("chaos-horizon", say("labs.chaos.horizon"), caption, traces, showlegend=False, **axes)


def _gain(result: Result, say: Say) -> str:
    """What a digit buys; so many seconds only where the motion is chaotic."""
    told, measured = result.get("exponent", {}), result["horizon"]["per_digit"]
    if not _is_chaotic(result):
        return say(f"labs.chaos.gain.{told.get('verdict', 'undecided')}")
    low, high = (math.log(10.0) / rate for rate in reversed(told["interval"]))
    theory = {"theory": math.log(10.0) / told["last"], "low": low, "high": high}
    if measured is None:
        return say("labs.chaos.gain.theory", **theory)
    return say("labs.chaos.gain.chaotic", measured=measured, **theory)


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
