"""The map of basins with their attractors, and how many starts are uncertain at each distance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .chart import INK, PALETTE, Chart, Result, Trace, axis, chart
from .words import Say, in_symbols

KEY = "labs.basins"
LIGHT = ("#56b4e9", "#e69f00", "#2fb38a", "#d99bc0", "#0072b2", "#d55e00", "#8f83ad", "#a5a52f")
NOWHERE = "#9a9a9a"
SATURATED = 0.5  # parts that are larger are not fitted


def charts(result: Result, say: Say) -> list[Chart]:
    """The map, and the uncertain starts once they are looked at."""
    found = [_map(result, say)]
    return [*found, _boundary(result, say)] if any(one["uncertain"] for one in result["neighbourhoods"]) else found


def _map(result: Result, say: Say) -> Chart:
    x, y, count = result["x"], result["y"], len(result["attractors"])
    across, up = (in_symbols(result, side["quantity"]) for side in (x, y))
    heat = {
        "type": "heatmap",
        "x": x["values"],
        "y": y["values"],
        "z": [[None if one is None else one + 1 for one in row] for row in result["basins"]],
        "zmin": -0.5,
        "zmax": count + 0.5,
        "colorscale": _steps([NOWHERE, *(_color(number) for number in range(count))]),
        "showscale": False,
        "hovertemplate": f"{across} = %{{x:.4g}}<br>{up} = %{{y:.4g}}<br>%{{z}}<extra></extra>",
        "meta": {"role": "basins", "x": x["quantity"], "y": y["quantity"]},
    }
    marks = [trace for number in range(count) for trace in _marks(result, number, say)]
    anchor = "x" if x["values"] == y["values"] else None  # alike sides are drawn alike
    axes = {"xaxis": axis(across, constrain="domain"), "yaxis": axis(up, constrain="domain", scaleanchor=anchor)}
    caption = " ".join(_told(result, say))
    return chart("basins", say(f"{KEY}.map"), caption, [heat, *marks], showlegend=True, **axes)


def _color(number: int) -> str:
    return LIGHT[number % len(LIGHT)]


def _steps(colors: list[str]) -> list[tuple[float, str]]:
    """A scale without transitions: one colour for each number."""
    count = len(colors)
    return [(place / count, color) for number, color in enumerate(colors) for place in (number, number + 1)]


def _marks(result: Result, number: int, say: Say) -> Iterator[Trace]:
    """An attractor by its place, a limit cycle by its orbit: a line with a border, to be seen on its own colour."""
    orbit = result["attractors"][number].get("orbit")
    if not orbit:
        yield _mark(result, number, say)
        return
    columns = [_column(orbit, result[side]["quantity"]) for side in ("x", "y")]
    x, y = _broken([[*one, one[0]] for one in columns])
    border = {"type": "scatter", "mode": "lines", "x": x, "y": y, "showlegend": False, "hoverinfo": "skip"}
    yield border | {"line": {"color": INK, "width": 4.5}}
    name = say(f"{KEY}.number", number=number + 1, percent=100.0 * result["attractors"][number]["share"])
    line = {"color": _color(number), "width": 2.0}
    yield {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": name, "line": line}


def _column(orbit: Any, quantity: str) -> list[float]:
    is_rate = quantity.startswith("dot(")
    one = orbit[quantity[4:-1] if is_rate else quantity]
    return list(one["rates" if is_rate else "values"])


def _broken(columns: list[list[float]]) -> list[list[float | None]]:
    """Columns of points, with a gap where an angle begins anew: there a line would go across the map.

    Neighbours of an orbit are near each other; what is half of the column apart has gone round.
    """
    widths = [max(one) - min(one) for one in columns]
    gaps = [
        place
        for place in range(1, len(columns[0]))
        if any(abs(one[place] - one[place - 1]) > 0.5 * width > 0.0 for one, width in zip(columns, widths, strict=True))
    ]
    return [
        [each for place, value in enumerate(one) for each in ((None, value) if place in gaps else (value,))]
        for one in columns
    ]


def _mark(result: Result, number: int, say: Say) -> Trace:
    """An attractor, by its place on the map or, if that is elsewhere, in the legend alone."""
    found = result["attractors"][number]
    place = [_component(found["state"], result[side]["quantity"]) for side in ("x", "y")]
    sides = [result[side]["values"] for side in ("x", "y")]
    is_in = all(side[0] <= one <= side[-1] for one, side in zip(place, sides, strict=True))
    x, y = place if is_in else (None, None)
    marker = {"color": _color(number), "symbol": "circle", "size": 12.0, "line": {"color": INK, "width": 2.0}}
    name = say(f"{KEY}.number", number=number + 1, percent=100.0 * found["share"])
    return {"type": "scatter", "mode": "markers", "x": [x], "y": [y], "name": name, "marker": marker}


def _component(state: Any, quantity: str) -> float:
    is_rate = quantity.startswith("dot(")
    one = state[quantity[4:-1] if is_rate else quantity]
    return float(one["rate" if is_rate else "value"])


def _boundary(result: Result, say: Say) -> Chart:
    rows = [one for one in result["neighbourhoods"] if one["uncertain"]]
    x, y = [one["distance"] for one in rows], [one["uncertain"] for one in rows]
    marker = {"color": PALETTE[0], "size": 9.0}
    traces: list[Trace] = [{"type": "scatter", "mode": "markers", "x": x, "y": y, "marker": marker, "name": "f(ε)"}]
    found = result["boundary"]
    if found:
        middle = next((place for place, one in enumerate(y) if one <= SATURATED), len(y) - 1)
        x = x[middle:]
        fitted = [y[middle] * (one / x[0]) ** found["exponent"] for one in x]
        line = {"color": PALETTE[1], "width": 1.6, "dash": "dash"}
        traces.append(
            {
                "type": "scatter",
                "mode": "lines",
                "x": x,
                "y": fitted,
                "line": line,
                "name": say(f"{KEY}.fitted", exponent=found["exponent"]),
            }
        )
    axes = {"xaxis": axis(say(f"{KEY}.distance"), log=True), "yaxis": axis(say(f"{KEY}.uncertain"), log=True)}
    caption = say(f"{KEY}.boundary-caption")
    return chart("basins-boundary", say(f"{KEY}.boundary"), caption, traces, **axes)


def _told(result: Result, say: Say) -> Iterator[str]:
    """What was found, and how well."""
    count = f"{len(result['x']['values'])} × {len(result['y']['values'])}"
    yield say(f"{KEY}.starts", count=count, attractors=len(result["attractors"]))
    for number, one in enumerate(result["attractors"]):
        low, high = (100.0 * end for end in one["interval"])
        place = ", ".join(
            f"{in_symbols(result, name)} = {say(f'{KEY}.size', size=at['value'])}" for name, at in one["state"].items()
        )
        key = "cycle" if one.get("orbit") else "periodic" if one["period"] else "rest"
        yield say(
            f"{KEY}.{key}",
            number=number + 1,
            place=place,
            percent=100.0 * one["share"],
            low=low,
            high=high,
            period=one["period"],
        )
    for key in ("unsettled", "unsure"):
        if result[key]:
            yield say(f"{KEY}.{key}", percent=100.0 * result[key])
    found = result["boundary"]
    if found:
        low, high = found["interval"]
        yield say(f"{KEY}.dimension", dimension=found["dimension"], low=low, high=high)
        yield say(f"{KEY}.{'fractal' if low > 1.0 else 'smooth'}")
        if low > 1.0 and not result["driven"]:
            yield say(f"{KEY}.slim")
    elif result["neighbourhoods"]:
        yield say(f"{KEY}.no-dimension")
