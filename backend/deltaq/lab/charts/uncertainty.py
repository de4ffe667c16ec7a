"""How far a cloud of runs is spread, beside linear propagation; and its quantiles around the nominal motion."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from .chart import INK, PALETTE, Chart, Result, Trace, axis, chart
from .words import Say, called, in_minimal

KEY = "labs.uncertainty"
MOST_BANDS = 4  # coordinates whose quantiles are drawn
ENDED_WELL = frozenset({"ok", "tolerance_missed", "horizon_reached"})
PALE, PALER = 0.30, 0.15
MOST_TICKS = 8.0  # powers of ten at an axis
BEYOND = 10.0  # times the largest spread: linear propagation that says more is not drawn
FURTHER = 1.5  # times the reach of linear propagation: quotients behind tell nothing
HIGHEST = 2.5  # spread over linear spread, on its axis


def charts(result: Result, say: Say) -> list[Chart]:
    """The spreads of all coordinates together, then over the linear ones, then the quantiles of each."""
    bands = [_bands(result, number, say) for number in range(min(len(result["coordinates"]), MOST_BANDS))]
    return [_spreads(result, say), _ratios(result, say), *bands]


def _spreads(result: Result, say: Say) -> Chart:
    traces = [trace for number in range(len(result["coordinates"])) for trace in _spread(result, number, say)]
    decades = _decades(y for trace in traces for y in trace["y"])
    y_axis = axis(say(f"{KEY}.deviation-axis"), log=True, dtick=max(1, round(decades / MOST_TICKS)))
    axes, caption = (
        {"xaxis": axis(say("labs.axis.t")), "yaxis": y_axis},
        in_minimal(" ".join(_told(result, say)), result, say),
    )
    return chart("uncertainty-spread", say(f"{KEY}.spread"), caption, traces, **axes)


def _spread(result: Result, number: int, say: Say) -> Iterator[Trace]:
    """Of one coordinate: the cloud with its interval, linear propagation, the error of integration, and the marks."""
    told, t, color = result["coordinates"][number], result["t"], PALETTE[number % len(PALETTE)]
    symbol = str(called(result, told["coordinate"]))
    yield _filled(t, told["low"], told["high"], color, PALE, symbol, say(f"{KEY}.interval", name=symbol))
    yield _line(t, told["deviation"], color, symbol, say(f"{KEY}.cloud", name=symbol), "solid")
    most = BEYOND * max((one for one in told["high"] if one is not None), default=0.0)
    linear = [one if one is None or one <= most else None for one in told["linear"]]
    yield _line(t, linear, color, symbol, say(f"{KEY}.linear", name=symbol), "dash")
    yield _line(t, told["error"], color, symbol, say(f"{KEY}.error", name=symbol), "dot")
    horizon = told["horizon"]
    places = {"linear-ends": (told["linear_until"], "diamond"), "worthless": (horizon and horizon["t"], "x")}
    for key, (time, mark) in places.items():
        if time is not None:
            name = say(f"{KEY}.{key}", name=symbol)
            yield _mark(time, _at(t, told["deviation"], time), color, symbol, name, mark)


def _decades(numbers: Iterable[float | None]) -> float:
    """How many powers of ten a logarithmic axis has to show."""
    known = [one for one in numbers if one is not None and one > 0.0]
    return math.log10(max(known) / min(known)) if known else 0.0


def _ratios(result: Result, say: Say) -> Chart:
    """The spread of the runs over that of linear propagation, with its interval."""
    t, traces = result["t"][: _count_of_ratios(result)], list[Trace]()
    for number, told in enumerate(result["coordinates"]):
        color, symbol = PALETTE[number % len(PALETTE)], str(called(result, told["coordinate"]))
        rows = [_over(told[name][: len(t)], told["linear"][: len(t)]) for name in ("low", "high", "deviation")]
        traces.append(_filled(t, rows[0], rows[1], color, PALE, symbol, say(f"{KEY}.interval", name=symbol)))
        traces.append(_line(t, rows[2], color, symbol, say(f"{KEY}.cloud", name=symbol), "solid"))
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis(say(f"{KEY}.ratio-axis"), range=[0.0, HIGHEST])}
    return chart("uncertainty-ratio", say(f"{KEY}.ratio"), say(f"{KEY}.ratio-caption"), traces, **axes)


def _count_of_ratios(result: Result) -> int:
    """As many times as linear propagation means something, and some more to see it fail."""
    ends = [told["linear_until"] for told in result["coordinates"]]
    last = result["t"][-1] if None in ends else FURTHER * max(ends)
    return max(2, len([t for t in result["t"] if t <= last]))


def _over(numbers: list[Any], others: list[Any]) -> list[Any]:
    """Quotients, none where one of both is unknown or nothing is to be seen."""
    pairs = zip(numbers, others, strict=True)
    found = [a / b if a is not None and b is not None and b > 0.0 else None for a, b in pairs]
    return [None if one is None or one > 2.0 * HIGHEST else one for one in found]


def _line(t: list[float], y: list[Any], color: str, group: str, name: str, dash: str) -> Trace:
    width = 2.0 if dash == "solid" else 1.6
    line = {"color": color, "dash": dash, "width": width}
    shown = [one if one is None or one > 0.0 else None for one in y]  # no place on a logarithmic axis
    return {"type": "scatter", "mode": "lines", "x": t, "y": shown, "name": name, "line": line, "legendgroup": group}


def _mark(t: float, y: float | None, color: str, group: str, name: str, symbol: str) -> Trace:
    marker = {"color": color, "symbol": symbol, "size": 11.0, "line": {"color": INK, "width": 1.0}}
    trace = {"type": "scatter", "mode": "markers", "x": [t], "y": [y], "name": name, "marker": marker}
    return trace | {"legendgroup": group}


def _filled(
    t: list[float], low: list[Any], high: list[Any], color: str, opacity: float, group: str, name: str
) -> Trace:
    """The area between two curves, as far as both are known and above zero."""
    rows = [(x, a, b) for x, a, b in zip(t, low, high, strict=True) if a is not None and b is not None]
    return {
        "type": "scatter",
        "mode": "lines",
        "x": [x for x, _, _ in rows] + [x for x, _, _ in reversed(rows)],
        "y": [a for _, a, _ in rows] + [b for _, _, b in reversed(rows)],
        "fill": "toself",
        "fillcolor": _pale(color, opacity),
        "line": {"width": 0.0},
        "name": name,
        "hoverinfo": "skip",
        "legendgroup": group,
    }


def _pale(color: str, opacity: float) -> str:
    red, green, blue = (int(color[place : place + 2], 16) for place in (1, 3, 5))
    return f"rgba({red}, {green}, {blue}, {opacity})"


def _at(t: list[float], y: list[Any], time: float) -> float | None:
    """The value next to a time."""
    nearest = min(range(len(t)), key=lambda place: abs(t[place] - time))
    return y[nearest]  # type: ignore[no-any-return]


def _bands(result: Result, number: int, say: Say) -> Chart:
    told, t, color = result["coordinates"][number], result["t"], PALETTE[number % len(PALETTE)]
    symbol, quantiles = str(called(result, told["coordinate"])), told["quantiles"]
    levels = [f"{round(100 * level)} %" for level in result["levels"]]
    traces = [
        _filled(t, quantiles[0], quantiles[4], color, PALER, "", f"{levels[0]} … {levels[4]}"),
        _filled(t, quantiles[1], quantiles[3], color, PALE, "", f"{levels[1]} … {levels[3]}"),
        _curve(t, quantiles[2], color, say(f"{KEY}.median"), "solid"),
        _curve(t, told["reference"], PALETTE[(number + 1) % len(PALETTE)], say(f"{KEY}.nominal"), "dash"),
    ]
    axes = {"xaxis": axis(say("labs.axis.t")), "yaxis": axis(symbol)}
    title, caption = say(f"{KEY}.bands", name=symbol), say(f"{KEY}.bands-caption", name=symbol)
    return chart(f"uncertainty-{told['coordinate']}", title, caption, traces, **axes)


def _curve(t: list[float], y: list[Any], color: str, name: str, dash: str) -> Trace:
    line = {"color": color, "dash": dash, "width": 1.6}
    return {"type": "scatter", "mode": "lines", "x": t, "y": y, "name": name, "line": line}


def _told(result: Result, say: Say) -> Iterator[str]:
    """What was drawn and, of each coordinate, how far what holds."""
    sizes = ", ".join(
        f"{_written(result, name)}: {say(f'{KEY}.size', size=size)}" for name, size in result["tolerances"].items()
    )
    yield say(f"{KEY}.{result['distribution']}", runs=result["runs"], sizes=sizes)
    for told in result["coordinates"]:
        yield from _of_coordinate(result, told, say)
    lost = {one: count for one, count in result["statuses"].items() if one not in ENDED_WELL}
    for status, count in lost.items():
        yield say(f"{KEY}.ended", count=count, status=say(f"labs.status.{status}"))
    if result["t"][-1] < 0.999 * result["t_end"]:
        yield say(f"{KEY}.few", t=result["t"][-1])


def _of_coordinate(result: Result, told: Mapping[str, Any], say: Say) -> Iterator[str]:
    name, end = str(called(result, told["coordinate"])), result["t"][-1]
    start = told["error_from"]
    if start == 0.0:
        yield say(f"{KEY}.numbers-alone", name=name)
        return
    until = told["linear_until"]
    yield say(f"{KEY}.described", name=name, t=end) if until is None else say(f"{KEY}.leaves", name=name, t=until)
    if told["budget"]:
        most = max(told["budget"], key=lambda one: told["budget"][one])
        if len(told["budget"]) > 1:
            percent = round(100 * told["budget"][most])
            yield say(f"{KEY}.budget", percent=percent, quantity=_written(result, most))
    yield _horizon(result, told, name, say)
    if start is not None:
        yield say(f"{KEY}.numbers", name=name, t=start)


def _horizon(result: Result, told: Mapping[str, Any], name: str, say: Say) -> str:
    horizon, percent = told["horizon"], round(100 * result["share"])
    if not told["range"]:
        return say(f"{KEY}.no-range", name=name)
    if horizon is None:
        return say(f"{KEY}.useful", name=name, percent=percent, range=told["range"])
    late = result["t"][-1] if horizon["late"] is None else horizon["late"]
    times = {"t": horizon["t"], "early": horizon["early"], "late": late}
    return say(f"{KEY}.worth-nothing", name=name, percent=percent, range=told["range"], **times)


def _written(result: Result, quantity: str) -> str:
    """φ(0), its rate with a dot, or a parameter."""
    kind, name, *part = quantity.split(".")
    symbol = str(called(result, name))
    if kind == "parameters":
        return symbol
    return f"{symbol[:1]}\u0307{symbol[1:]}(0)" if part == ["rate"] else f"{symbol}(0)"
