"""Points of orbits in a plane, and how far each of them is known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .chart import INK, PALETTE, Chart, Result, Trace, axis, chart
from .words import Say, in_minimal, in_symbols

MOST_SHOWN = 12_000  # points that a picture has room for; of more, every second, third … of each orbit
SIZE, OWN_SIZE, PALE = 3.0, 5.0, 0.35


def charts(result: Result, say: Say) -> list[Chart]:
    """The section, and the errors of its points once they are known."""
    found = [_section(result, say)]
    return [*found, _accuracy(result, say)] if any(orbit["error"] for orbit in result["orbits"]) else found


def _section(result: Result, say: Say) -> Chart:
    x, y = (axis(in_symbols(result, result[name])) for name in ("horizontal", "vertical"))
    caption = in_minimal(" ".join(filter(None, _told(result, say))), result, say)
    return chart(
        "poincare-section", say("labs.poincare-section.section"), caption, _traces(result, say), xaxis=x, yaxis=y
    )


def _traces(result: Result, say: Say) -> Iterator[Trace]:
    stride = max(1, -(-result["points"] // MOST_SHOWN))
    first = True
    for number, orbit in enumerate(result["orbits"]):
        known = _known(orbit)
        yield _points(orbit, number, slice(0, known, stride), _name(orbit, number, say)) | {"showlegend": orbit["own"]}
        if known < len(orbit["t"]):
            name = say("labs.poincare-section.beyond")
            yield _points(orbit, number, slice(known, None, stride), name) | {"opacity": PALE, "showlegend": first}
            first = False


def _known(orbit: Any) -> int:
    """How many of its points come before its horizon."""
    horizon = orbit["horizon"]
    return len(orbit["t"]) if horizon is None else sum(t < 0.9999 * horizon for t in orbit["t"])


def _points(orbit: Any, number: int, shown: slice, name: str) -> Trace:
    own = orbit["own"]
    marker = {"color": INK if own else _color(number), "size": OWN_SIZE if own else SIZE}
    return {
        "type": "scatter",
        "mode": "markers",
        "name": name,
        "x": orbit["x"][shown],
        "y": orbit["y"][shown],
        "marker": marker | ({"symbol": "diamond"} if own else {}),
        "hoverinfo": "x+y+name",
        "meta": {"role": "orbit", "initial": orbit["initial"]},
    }


def _name(orbit: Any, number: int, say: Say) -> str:
    return say("labs.poincare-section.own") if orbit["own"] else say("labs.poincare-section.orbit", number=number)


def _color(number: int) -> str:
    return PALETTE[number % len(PALETTE)]


def _accuracy(result: Result, say: Say) -> Chart:
    traces = []
    for number, orbit in enumerate(result["orbits"]):
        color = INK if orbit["own"] else _color(number)
        line = {"color": color, "width": 2.0 if orbit["own"] else 1.0, "dash": "dot" if orbit["chaotic"] else "solid"}
        points = {"x": orbit["t"], "y": [max(one, 1e-17) for one in orbit["error"]]}
        meta = {"meta": {"role": "orbit", "initial": orbit["initial"]}, "hoverinfo": "x+y+name"}
        traces.append(
            {"type": "scatter", "mode": "lines", "name": _name(orbit, number, say), "line": line} | points | meta
        )
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis(say("labs.poincare-section.error"), log=True, dtick=2)}
    title, caption = say("labs.poincare-section.accuracy"), say("labs.poincare-section.accuracy-caption")
    return chart("poincare-accuracy", title, caption, traces, showlegend=False, **axes)


def _told(result: Result, say: Say) -> Iterator[str]:
    """What was measured, what was left out, and how well it is known, as sentences."""
    key = "labs.poincare-section"
    orbits, told = result["orbits"], {name: result[name] for name in ("points", "energy", "regular")}
    told["plane"] = in_symbols(result, result["plane"])
    direction = say(f"labs.direction-{result['direction']}")
    yield say(f"{key}.{'driven' if result['driven'] else 'kept'}", **told, count=len(orbits), direction=direction)
    for name in ("forbidden", "unsolved", "behind", "missed"):
        if result[name]:
            yield say(f"{key}.{name}", count=result[name])
    if result["sharp"]:
        yield say(f"{key}.known", sharp=result["sharp"])
        if result["kept"] is not None:
            yield say(f"{key}.energy-kept", error=result["kept"])
    chaotic = sum(orbit["chaotic"] is True for orbit in orbits)
    if chaotic:
        yield say(f"{key}.chaotic", count=chaotic)
    if result["regular"] is not None:
        yield say(f"{key}.regular", percent=round(100 * result["regular"]))
    ended = sum(orbit["status"] not in ("ok", "horizon_reached") for orbit in orbits)
    if ended:
        yield say(f"{key}.ended", count=ended)
