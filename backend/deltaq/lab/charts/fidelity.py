"""Rungs and methods, speed against accuracy; and how the error of each rung grows with the amplitude."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from .chart import INK, PALETTE, SYMBOLS, Chart, Result, Trace, axis, chart, curve, grouped, name_of
from .words import Say, called

RANGE = [-10.5, 1.0]


def charts(result: Result, say: Say) -> list[Chart]:
    """Cost against error, where any is known; error against amplitude, where there are several."""
    titles = {rung["id"]: title_of(rung, result, say) for rung in result["rungs"]}
    found = (
        [_cost(result, titles, say)] if result["points"] or any("error" in one for one in result["measured"]) else []
    )
    found += [_amplitude(result, titles, say)] if result["growth"] else []
    return found + ([_alike(result, say), _multipliers(result, say)] if result["multipliers"] else [])


def title_of(rung: Mapping[str, Any], result: Result, say: Say) -> str:
    """What is left out, in words."""
    return ", ".join(_left_out(part, result, say) for part in rung["parts"]) or say("ladder.kinds.full.title")


def _left_out(part: Mapping[str, Any], result: Result, say: Say) -> str:
    named = {key: called(result, name) for key, name in part["parameters"].items()}
    return say(f"ladder.kinds.{part['kind']}.title", **named)


def _cost(result: Result, titles: Mapping[str, str], say: Say) -> Chart:
    traces = [*_methods(result, say), *_rungs(result, titles, say)]
    x_axis = axis(say("labs.axis.seconds"), log=True)
    y_axis = axis(say("labs.fidelity.error"), log=True, range=RANGE, dtick=2)
    told = {"repeats": result["repeats"], "t_end": result["t_end"], **result["machine"]}
    caption = say("labs.fidelity.cost-caption", **told) + " " + say("ladder.norm")
    return chart("fidelity-cost", say("labs.fidelity.cost"), caption, traces, xaxis=x_axis, yaxis=y_axis)


def _rungs(result: Result, titles: Mapping[str, str], say: Say) -> Iterator[Trace]:
    """One mark for each rung; the least that meets the tolerance is ringed, one that survives no nudge is hollow."""
    order = [rung["id"] for rung in result["rungs"]]
    degrees = {rung["id"]: rung["degrees"] for rung in result["rungs"]}
    for one in result["measured"]:
        if "time" not in one or "error" not in one:
            continue
        place = order.index(one["rung"])
        is_least = one["rung"] == result["least"]
        yield {
            "type": "scatter",
            "mode": "markers",
            "name": titles[one["rung"]],
            "x": [one["time"][0]],
            "y": [max(one["error"], 10 ** RANGE[0])],
            "text": [_hover(one, titles[one["rung"]], degrees[one["rung"]], say)],
            "hoverinfo": "text",
            "marker": {
                "color": PALETTE[place % len(PALETTE)],
                "symbol": SYMBOLS[place % len(SYMBOLS)] + ("" if one.get("survives", True) else "-open"),
                "size": 15,
                "line": {"width": 3 if is_least else 0.5, "color": INK},
            },
        }


def _hover(one: Mapping[str, Any], title: str, degrees: int, say: Say) -> str:
    cost = say("labs.hover.cost", evaluations=one["evaluations"], milliseconds=1e3 * one["time"][0])
    count = say("labs.fidelity.hover", degrees=degrees, operations=one["operations"]["total"])
    found = f"<b>{title}</b><br>{count}<br>{say('labs.hover.error', value=one['error'])}<br>{cost}"
    return found if one.get("survives", True) else f"{found}<br>{say('labs.fidelity.fragile-mark')}"


def _methods(result: Result, say: Say) -> Iterator[Trace]:
    for method, points in grouped(result["points"]).items():
        good = [point for point in points if point["error"] is not None and point["time"] > 0]
        name = say("labs.fidelity.method", name=name_of(method, say))
        errors = [max(point["error"], 10 ** RANGE[0]) for point in good]
        yield curve(
            name, [p["time"] for p in good], errors, method, opacity=0.6, marker={"size": 4, "color": "#888888"}
        )


def _amplitude(result: Result, titles: Mapping[str, str], say: Say) -> Chart:
    order = [rung["id"] for rung in result["rungs"]]
    traces = [_growth(one, result["amplitudes"], titles, order.index(one["rung"]), say) for one in result["growth"]]
    x_axis = axis(say("labs.fidelity.amplitude"), log=True, dtick="D2")
    y_axis = axis(say("labs.fidelity.error"), log=True)
    caption = say("ladder.amplitude")
    return chart("fidelity-amplitude", say("labs.fidelity.growth"), caption, traces, xaxis=x_axis, yaxis=y_axis)


def _growth(one: Mapping[str, Any], amplitudes: list[float], titles: Mapping[str, str], place: int, say: Say) -> Trace:
    name = titles[one["rung"]]
    label = name if one["slope"] is None else say("labs.work-precision.with-slope", name=name, slope=one["slope"])
    color = PALETTE[place % len(PALETTE)]
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": label,
        "x": amplitudes,
        "y": [value or None for value in one["relative"]],
        "line": {"color": color, "width": 1.6},
        "marker": {"color": color, "symbol": SYMBOLS[place % len(SYMBOLS)], "size": 8},
    }


def _alike(result: Result, say: Say) -> Chart:
    """Both formulations over time: how far apart they are and by the estimate, how far constraints are missed, λ."""
    found = result["multipliers"]
    curves = [("apart", found["apart"], "solid"), ("estimate", found["estimate"], "dash"), ("gap", found["gap"], "dot")]
    traces = [_over(found["t"], y, say(f"labs.fidelity.multipliers.{key}"), 0, dash) for key, y, dash in curves]
    for number, name in enumerate(found["errors"], 1):
        told = {"name": called(result, name)}
        error, estimate = (say(f"labs.fidelity.multipliers.{key}", **told) for key in ("error", "error-estimate"))
        traces.append(_over(found["t"], found["errors"][name], error, number, "solid"))
        traces.append(_over(found["t"], found["estimates"][name], estimate, number, "dash"))
    y_axis = axis(say("labs.fidelity.multipliers.difference"), log=True, dtick=2)
    caption = say("labs.fidelity.multipliers.alike-caption")
    return chart(
        "fidelity-alike",
        say("labs.fidelity.multipliers.alike"),
        caption,
        traces,
        xaxis=axis(say("labs.axis.t")),
        yaxis=y_axis,
    )


def _over(t: list[float], y: list[float], name: str, place: int, dash: str) -> Trace:
    color = PALETTE[place % len(PALETTE)]
    line = {"color": color, "dash": dash, "width": 1.6}
    return {"type": "scatter", "mode": "lines", "name": name, "x": t, "y": [v or None for v in y], "line": line}


def _multipliers(result: Result, say: Say) -> Chart:
    """Speed against accuracy with multipliers and without."""
    traces = [_run(*group, "kept", say) for group in grouped(result["points"]).items()]
    traces += [_run(*group, "minimal", say) for group in grouped(result["minimal"]).items()]
    x_axis = axis(say("labs.axis.seconds"), log=True)
    y_axis = axis(say("labs.fidelity.error"), log=True, range=RANGE, dtick=2)
    caption = say("labs.fidelity.multipliers.cost-caption", repeats=result["repeats"], t_end=result["t_end"])
    title = say("labs.fidelity.multipliers.cost")
    return chart("fidelity-multipliers", title, caption, traces, xaxis=x_axis, yaxis=y_axis)


def _run(method: str, points: list[Mapping[str, Any]], formulation: str, say: Say) -> Trace:
    good = [point for point in points if point["error"] is not None and point["time"] > 0]
    name = say(f"labs.fidelity.multipliers.{formulation}", name=name_of(method, say))
    errors = [max(point["error"], 10 ** RANGE[0]) for point in good]
    style = curve(name, [point["time"] for point in good], errors, method)
    return style | {"line": style["line"] | {"dash": "solid" if formulation == "kept" else "dot"}}
