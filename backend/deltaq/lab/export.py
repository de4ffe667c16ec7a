"""Charts as files: a standalone page, and a table of their numbers."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from html import escape
from importlib import import_module
from itertools import zip_longest
from typing import Any

from ..mechanics.user_text import as_cell
from .charts.chart import WITHOUT_RESULT, Chart

_PAGE = """<!doctype html>
<html lang="{lang}"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title><style>
body {{ font: 16px/1.45 system-ui, sans-serif; color: #222; max-width: 60rem; margin: 2rem auto; padding: 0 1rem }}
figure {{ margin: 0 0 2.5rem }} figcaption {{ color: #555; font-size: .9em }}
</style></head><body>{figures}</body></html>
"""


def page(charts: Sequence[Chart], lang: str) -> str:
    """A page that needs nothing else: Plotly is in it."""
    to_html = import_module("plotly.io").to_html
    figures = [_figure(one, to_html, with_library=index == 0) for index, one in enumerate(charts)]
    return _PAGE.format(lang=lang, title=escape(charts[0]["title"] if charts else "δq"), figures="".join(figures))


def _figure(chart: Chart, to_html: Any, *, with_library: bool) -> str:
    figure = {"data": chart["data"], "layout": {**chart["layout"], "height": 520}}
    drawn = to_html(figure, include_plotlyjs=with_library, full_html=False, validate=False)
    title, subject, caption = (escape(chart[part]) for part in ("title", "subject", "caption"))
    return f"<h2>{title}</h2><p>{subject}</p><figure>{drawn}<figcaption>{caption}</figcaption></figure>"


def table(charts: Sequence[Chart]) -> str:
    """All curves in one CSV: chart, curve, x, y; a map has z as well.

    A run without a result has no y: that of its mark is only where the mark stands. What has no name helps to read a
    chart and is not told.
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["chart", "curve", "x", "y", "z"])
    for chart in charts:
        for trace in chart["data"]:
            if "name" in trace or "z" in trace:
                writer.writerows([chart["id"], as_cell(trace.get("name", "")), *row] for row in _rows(trace))
    return out.getvalue()


def _rows(trace: dict[str, Any]) -> Iterator[tuple[Any, ...]]:
    if trace.get("meta") == WITHOUT_RESULT:
        yield from ((x, "", "") for x in trace["x"])
    elif "z" in trace:
        for y, row in zip(trace["y"], trace["z"], strict=True):
            yield from ((x, y, z) for x, z in zip(trace["x"], row, strict=True))
    else:
        yield from ((x, y, "") for x, y in zip_longest(trace["x"], trace["y"]) if y is not None)
