"""A chart as plain data for Plotly: traces and layout, with a title and a caption that says what was measured.

Charts are drawn dark on light; the page puts its own colours over them. Colours are those of Okabe and Ito, which
people with any colour vision can tell apart; symbols and dashes say the same once more.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ...simulation.library import method_ids
from ..peers import PEERS, title_of
from .words import Say

Chart = dict[str, Any]
Trace = dict[str, Any]
Result = Mapping[str, Any]

INK, GRID = "#222222", "#dddddd"
PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b5b95", "#7f7f00")
# One for each method, by rising order; the five of the story (`work_precision`) have those that differ most.
METHODS = (
    *("#8c564b", "#b8860b", "#7f7f00", "#56b4e9", "#a0522d", "#009e73", "#6b5b95", "#008b8b"),
    *("#c71585", "#e69f00", "#4682b4", "#d55e00", "#808000", "#0072b2", "#cc79a7", "#5f9e00"),
)
PEER_COLORS = ("#999999", "#666666", "#8a9ba8", "#a89984", "#7d6b7d", "#333333")
SYMBOLS = ("circle", "square", "diamond", "triangle-up", "triangle-down", "pentagon", "star", "hexagon")
DASHES = ("solid", "dash", "dot")
FAILED = "x-thin-open"
CEILING = 30.0  # the error at which runs without one are marked
WITHOUT_RESULT = {"role": "without-result"}  # the `meta` of marks that stand somewhere only to be seen


def chart(identifier: str, title: str, caption: str, traces: Iterable[Trace], **layout: Any) -> Chart:
    """A chart with the common look; `layout` is put over it."""
    return {"id": identifier, "title": title, "caption": caption, "data": list(traces), "layout": _base() | layout}


def _base() -> dict[str, Any]:
    return {
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": INK},
        "paper_bgcolor": "#ffffff",
        "plot_bgcolor": "#ffffff",
        "margin": {"l": 72, "r": 16, "t": 16, "b": 56},
        "hovermode": "closest",
        "legend": {"x": 1.02, "y": 1, "xanchor": "left", "yanchor": "top", "font": {"size": 12}, "tracegroupgap": 0},
    }


def axis(title: str, *, log: bool = False, **more: Any) -> dict[str, Any]:
    """An axis with its quantity and unit."""
    base = {
        "title": {"text": title, "standoff": 8},
        "gridcolor": GRID,
        "linecolor": INK,
        "mirror": True,
        "showline": True,
        "ticks": "outside",
        "zeroline": False,
        "exponentformat": "power",
        "automargin": True,
    }
    return base | ({"type": "log", "dtick": 1} if log else {}) | more


def look(name: str) -> dict[str, Any]:
    """Colour, symbol and dash of a method, the same in every chart and no other's; others (peers) are nearly grey."""
    known = method_ids()
    if name not in known:
        place = PEERS.index(name)
        return {"color": PEER_COLORS[place], "symbol": f"{SYMBOLS[place]}-open", "dash": "dash"}
    turn, place = divmod(known.index(name), len(SYMBOLS))
    color = METHODS[known.index(name) % len(METHODS)]
    return {"color": color, "symbol": SYMBOLS[(place + 3 * turn) % len(SYMBOLS)], "dash": DASHES[turn]}


def name_of(method: str, say: Say) -> str:
    """The method's title; a peer's own name."""
    return say(f"methods.{method}.title") if method in method_ids() else title_of(method)


def curve(name: str, x: Sequence[Any], y: Sequence[Any], method: str, **more: Any) -> Trace:
    """A line with marks in the look of a method."""
    style = look(method)
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": name,
        "x": list(x),
        "y": list(y),
        "line": {"color": style["color"], "dash": style["dash"], "width": 1.6},
        "marker": {"color": style["color"], "symbol": style["symbol"], "size": 7},
        "legendgroup": method,
    } | more


def crosses(x: Sequence[Any], y: Sequence[Any], texts: Sequence[str], method: str, say: Say, **more: Any) -> Trace:
    """Marks of runs of a method that gave no result."""
    color = look(method)["color"]
    return {
        "type": "scatter",
        "mode": "markers",
        "x": list(x),
        "y": list(y),
        "text": list(texts),
        "hoverinfo": "text",
        "marker": {"symbol": FAILED, "size": 9, "color": color, "line": {"width": 1.6, "color": color}},
        "legendgroup": method,
        "showlegend": False,
        "name": say("labs.hover.without-result", name=name_of(method, say)),
    } | more


def joined(methods: Iterable[str], say: Say) -> str:
    """The names of several methods."""
    return ", ".join(name_of(method, say) for method in methods)


def grouped(points: Iterable[Mapping[str, Any]]) -> dict[str, list[Mapping[str, Any]]]:
    """Points by method, in their order."""
    groups: dict[str, list[Mapping[str, Any]]] = {}
    for point in points:
        groups.setdefault(point["method"], []).append(point)
    return groups
