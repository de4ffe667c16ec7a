"""What a scene settles to over a parameter, branches of periodic motions, and how deviations from them grow."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Any

from .chart import INK, PALETTE, Chart, Result, Trace, axis, chart
from .words import Say, called, in_symbols

KEY = "labs.bifurcation"
MOST_TOLD = 4  # bifurcations of a kind that the caption names
MOST_SHOWN = 16_000  # points of both sweeps that a picture has room for
UP, DOWN = PALETTE[0], PALETTE[1]
WAYS = {"up": (UP, "triangle-up"), "down": (DOWN, "triangle-down")}
KINDS = {
    "period-doubling": ("diamond", PALETTE[2]),
    "saddle-node": ("circle", PALETTE[3]),
    "branching": ("square", PALETTE[4]),
    "torus": ("hexagon", PALETTE[6]),
}
SMALL, LARGE = 4.0, 11.0
JUMP = math.pi  # an angle that changes by more from point to point has turned round


def charts(result: Result, say: Say) -> list[Chart]:
    """The diagram, and the multipliers once there are branches."""
    found = [_diagram(result, say)]
    return [*found, _growth(result, say)] if result["branches"] else found


def _diagram(result: Result, say: Say) -> Chart:
    traces = [*_sweeps(result, say), *_branches(result, say), *_marks(result, say, "seen")]
    across = called(result, result["parameter"])
    axes = {"xaxis": axis(across), "yaxis": axis(in_symbols(result, result["vertical"]))}
    return chart("bifurcation", say(f"{KEY}.diagram"), " ".join(_told(result, say)), traces, **axes)


def _sweeps(result: Result, say: Say) -> Iterator[Trace]:
    stride = max(1, -(-result["points"] // MOST_SHOWN))
    for part, (color, symbol) in WAYS.items():
        pairs = [(visit["value"], one) for visit in result[part] for one in _shown(visit, stride)]
        yield {
            "type": "scatter",
            "mode": "markers",
            "name": say(f"{KEY}.{part}"),
            "x": [x for x, _ in pairs],
            "y": [y for _, y in pairs],
            "marker": {"color": color, "size": SMALL, "symbol": symbol},
            "hoverinfo": "x+y+name",
            "meta": {"role": "sweep", "part": part, "x": result["parameter"]},
        }


def _shown(visit: Any, stride: int) -> Sequence[float]:
    """What is drawn of a visit: of a motion that repeats all that it is seen with."""
    seen: Sequence[float] = visit["seen"]
    return seen if visit["folds"] else seen[::stride]


def _branches(result: Result, say: Say) -> Iterator[Trace]:
    first = {True: True, False: True}
    for number, branch in enumerate(result["branches"]):
        for stable, motions in _stretches(branch["motions"]):
            xs, ys = _lines(motions)
            yield {
                "type": "scatter",
                "mode": "lines",
                "name": say(f"{KEY}.{'stable' if stable else 'unstable'}"),
                "x": xs,
                "y": ys,
                "line": {"color": INK, "width": 1.6 if stable else 1.0, "dash": "solid" if stable else "dot"},
                "hoverinfo": "x+y+name",
                "legendgroup": "stable" if stable else "unstable",
                "showlegend": first[stable],
                "meta": {"role": "branch", "part": str(number), "x": result["parameter"]},
            }
            first[stable] = False


def _stretches(motions: Sequence[Any]) -> Iterator[tuple[bool, list[Any]]]:
    """Neighbours that are all stable or all unstable; each stretch begins where the one before ends."""
    before: list[Any] = []
    for stable, some in groupby(motions, key=lambda one: bool(one["stable"])):
        found = [*before, *some]
        yield stable, found
        before = found[-1:]


def _lines(motions: Sequence[Any]) -> tuple[list[float | None], list[float | None]]:
    """A line for each of the values that are seen of a motion, one behind the other, with gaps between them."""
    xs: list[float | None] = []
    ys: list[float | None] = []
    for place in range(max(len(one["seen"]) for one in motions)):
        last: float | None = None
        for one in motions:
            seen = one["seen"][place] if place < len(one["seen"]) else None
            if seen is None or (last is not None and abs(seen - last) > JUMP):
                xs.append(None)
                ys.append(None)
            if seen is not None:
                xs.append(one["value"])
                ys.append(seen)
            last = seen
        xs.append(None)
        ys.append(None)
    return xs, ys


def _marks(result: Result, say: Say, what: str) -> Iterator[Trace]:
    """The bifurcations, each kind with a symbol of its own."""
    for kind, (symbol, color) in KINDS.items():
        some = [one for one in result["bifurcations"] if one["kind"] == kind]
        pairs = [(one, y) for one in some for y in (one["seen"] if what == "seen" else [1.0])]
        if not pairs:
            continue
        yield {
            "type": "scatter",
            "mode": "markers",
            "name": say(f"{KEY}.{kind}"),
            "x": [one["value"] for one, _ in pairs],
            "y": [y for _, y in pairs],
            "text": [_hover(result, one, say) for one, _ in pairs],
            "hoverinfo": "text",
            "marker": {"symbol": symbol, "size": LARGE, "color": color, "line": {"width": 1.0, "color": INK}},
            "meta": {"role": "bifurcation", "part": kind, "x": result["parameter"]},
        }


def _hover(result: Result, one: Any, say: Say) -> str:
    name, kind = called(result, result["parameter"]), say(f"{KEY}." + one["kind"])
    return f"{kind}: {name} = {_digits(one['value'], 9, say)}"


def _digits(number: float, digits: int, say: Say) -> str:
    """A number with more digits than texts usually have, in the language's own way."""
    return f"{number:.{digits}g}".replace(".", say(f"{KEY}.decimal"))


def _growth(result: Result, say: Say) -> Chart:
    traces: list[Trace] = []
    for number, branch in enumerate(result["branches"]):
        motions = branch["motions"]
        traces.append(
            {
                "type": "scatter",
                "mode": "lines",
                "name": say(f"{KEY}.folds", count=branch["folds"]),
                "x": [one["value"] for one in motions],
                "y": [max(one["growth"], 1e-12) for one in motions],
                "line": {"color": PALETTE[number % len(PALETTE)], "width": 1.6},
                "hoverinfo": "x+y+name",
                "meta": {"role": "branch", "part": str(number), "x": result["parameter"]},
            }
        )
    traces += _marks(result, say, "growth")
    axes = {
        "xaxis": axis(called(result, result["parameter"])),
        "yaxis": axis(say(f"{KEY}.growth"), log=True),
    }
    return chart("multipliers", say(f"{KEY}.multipliers"), say(f"{KEY}.multipliers-caption"), traces, **axes)


def _told(result: Result, say: Say) -> Iterator[str]:
    """What was looked at, where both sweeps differ, what was found, and what did not stay, as sentences."""
    name = called(result, result["parameter"])
    told = {"count": len(result["up"]), "points": result["points"], "parameter": name}
    if result["plane"]:
        direction = say(f"labs.direction-{result['direction']}")
        yield say(f"{KEY}.by-plane", plane=in_symbols(result, result["plane"]), direction=direction, **told)
    else:
        yield say(f"{KEY}.by-period", **told)
    for span in result["hysteresis"]:
        ends = {key: _digits(one, 6, say) for key, one in span.items()}
        yield say(f"{KEY}.hysteresis", parameter=name, **ends)
    visits = [*result["up"], *result["down"]]
    yield from _ended(visits, say)
    open_ended = sum(visit["status"] == "ok" and not visit["folds"] for visit in visits)
    if open_ended:
        yield say(f"{KEY}.unsettled", count=open_ended)
    for kind in KINDS:
        some = [one for one in result["bifurcations"] if one["kind"] == kind]
        # twins of a symmetric scene have the same values: each is told once
        found = list(dict.fromkeys(f"{_digits(one['value'], 8, say)} ({one['folds']})" for one in some))
        places = "; ".join(found[:MOST_TOLD])
        if found:
            yield say(f"{KEY}.at", kind=say(f"{KEY}.{kind}"), parameter=name, places=places)
        if len(found) > MOST_TOLD:
            yield say(f"{KEY}.more", count=len(found) - MOST_TOLD)
    if result["feigenbaum"]:
        yield say(f"{KEY}.feigenbaum", quotients="; ".join(_digits(one, 4, say) for one in result["feigenbaum"]))
    if not result["complete"]:
        yield say(f"{KEY}.incomplete", count=len(result["branches"]))


def _ended(visits: Iterable[Any], say: Say) -> Iterator[str]:
    """Values at which no motion stays: by their number, and from where to where."""
    gone = sorted(visit["value"] for visit in visits if visit["status"] != "ok")
    if gone:
        yield say(f"{KEY}.ended", count=len(gone), start=gone[0], end=gone[-1])
