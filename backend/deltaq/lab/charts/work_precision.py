"""Error against time and against right-hand sides."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from ...simulation.library import method_ids
from .chart import (
    CEILING,
    FAILED,
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
from .words import Say, written_date

STORY = ("stormer-verlet", "rk4", "radau-5", "dop853", "taylor")  # what is seen at first, where there are many
FEW = 6  # methods that are all seen at once
BARS = "40"  # the opacity of bars, as the last two digits of a colour: points stand out
RANGE = [-15.5, 2.0]  # decades of the error


def charts(result: Result, say: Say) -> list[Chart]:
    """Two charts: by time, and by right-hand sides."""
    reference, machine = result["reference"], result["machine"]
    told = {
        "t_end": result["t_end"],
        "methods": joined(reference["methods"], say),
        "error": reference["error"],
        "repeats": result["repeats"],
        "date": written_date(result["taken"]["date"]),
        "load": result["taken"]["load"],
        **machine,
    }
    return [
        _one(result, say, "time", axis(say("labs.axis.seconds"), log=True), _by_time(result, told, say)),
        _one(
            result,
            say,
            "evaluations",
            axis(say("labs.axis.evaluations"), log=True),
            say("labs.work-precision.by-evaluations", **told),
        ),
    ]


def _by_time(result: Result, told: dict[str, Any], say: Say) -> str:
    """The caption, with what code took that was compiled for a run alone."""
    caption = say("labs.work-precision.by-time", **told)
    if result["events"]:
        caption = f"{caption} {say('labs.work-precision.events')}"
    if result["peers_left_out"]:
        caption = f"{caption} {say('labs.work-precision.peers-left-out')}"
    prepared = {point["method"]: point["preparation"] for point in result["points"] if point.get("preparation")}
    parts = (say("labs.work-precision.prepared", name=name_of(m, say), seconds=s) for m, s in prepared.items())
    return " ".join((caption, *parts))


def _one(result: Result, say: Say, x: str, x_axis: dict[str, Any], caption: str) -> Chart:
    traces = list(_traces(result, say, x))
    y_axis = axis(say("labs.axis.error"), log=True, range=RANGE, dtick=2)
    title = say(f"labs.work-precision.title-{x}")
    if any(trace.get("visible") for trace in traces):
        caption = f"{caption} {say('labs.work-precision.others')}"
    return chart(f"work-precision-{x}", title, caption, traces, xaxis=x_axis, yaxis=y_axis)


def _traces(result: Result, say: Say, x: str) -> Iterator[Trace]:
    shown = _shown(result)
    least = min((point[x] for point in result["points"] if point[x] > 0), default=1e-6)
    groups = grouped(result["points"])
    for method, points in sorted(groups.items(), key=lambda item: item[0] not in shown):
        good = [point for point in points if point["error"] is not None and point[x] > 0]
        name, order = name_of(method, say), result["orders"].get(method)
        label = name if order is None else say("labs.work-precision.with-slope", name=name, slope=order)
        texts = [_hover(point, name, say) for point in good]
        floor = [max(point["error"], 10 ** RANGE[0]) for point in good]
        more = _spread(good, look(method)["color"]) if x == "time" else {}
        seen = {} if method in shown else {"visible": "legendonly"}
        yield curve(label, [p[x] for p in good], floor, method, text=texts, hoverinfo="text", **more, **seen)
        yield from (trace | seen for trace in _failures(points, method, x, least, say))


def _shown(result: Result) -> set[str]:
    """The methods that are seen at first: of many those that tell the story, and all peers, who were asked for."""
    methods = set(grouped(result["points"]))
    own = {method for method in methods if method in method_ids()}
    story = own & set(STORY)
    return methods if len(own) <= FEW or len(story) < len(STORY) - 2 else story | (methods - own)


def _spread(points: list[Mapping[str, Any]], color: str) -> Trace:
    """The fastest and slowest of the repeated runs, as pale bars."""
    up = [p["times"][-1] - p["time"] if p["times"] else 0.0 for p in points]
    down = [p["time"] - p["times"][0] if p["times"] else 0.0 for p in points]
    return {
        "error_x": {
            "type": "data",
            "symmetric": False,
            "array": up,
            "arrayminus": down,
            "color": color + BARS,
            "thickness": 1,
            "width": 0,
        }
    }


def _failures(points: list[Mapping[str, Any]], method: str, x: str, least: float, say: Say) -> Iterator[Trace]:
    """Runs that have no error: crosses at the top; what is too slow: an arrow at the last run before.

    What failed before anything was counted stands at the `least` of what was.
    """
    name = name_of(method, say)
    bad = [point for point in points if point["error"] is None and point["status"] != "too_slow"]
    slow = [(a, b) for a, b in pairwise(points) if b["status"] == "too_slow"]
    places = [(point[x] or least, CEILING, point) for point in bad]
    places += [(1.6 * (a[x] or least), a["error"] or CEILING, b) for a, b in slow]
    if not places:
        return
    trace = crosses(
        [x for x, _, _ in places],
        [y for _, y, _ in places],
        [_hover(point, name, say) for _, _, point in places],
        method,
        say,
        meta=WITHOUT_RESULT,
    )
    symbols = ["triangle-right" if point["status"] == "too_slow" else FAILED for _, _, point in places]
    yield trace | {"marker": trace["marker"] | {"symbol": symbols}}


def _hover(point: Mapping[str, Any], name: str, say: Say) -> str:
    kind = "tolerance" if "tolerance" in point else "step"
    lines = [
        f"<b>{name}</b>",
        say(f"labs.hover.{kind}", value=point[kind]),
        say("labs.hover.error", value=point["error"]),
    ]
    if point["status"] != "ok":
        lines.append(say(f"labs.status.{point['status']}"))
    if point["evaluations"]:
        lines.append(say("labs.hover.cost", evaluations=point["evaluations"], milliseconds=1e3 * point["time"]))
    if point.get("preparation"):
        lines.append(say("labs.hover.preparation", seconds=point["preparation"]))
    return "<br>".join(lines)
