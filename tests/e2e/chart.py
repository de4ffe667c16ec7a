"""Makes the README's chart of speed against accuracy, as the lab measures and draws it: `python -m tests.e2e.chart`.

It writes .github/chart-light.svg and .github/chart-dark.svg; SciPy's integrators run over the same compiled model.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.e2e.browser import started

from deltaq.lab.experiment import drawn
from deltaq.lab.library import get_experiment
from deltaq.narration.catalog import text

ROOT = Path(__file__).parents[2]
PLOTLY = ROOT / "frontend/vendor/plotly.js-basic-dist-min/plotly-basic.min.js"
METHODS = ["dop853", "dormand-prince-54", "rk4", "radau-5", "gauss-6", "variational-midpoint"]
PEERS = {"scipy-DOP853", "scipy-Radau"}  # of all that take part
QUESTION = {"scene": "double-pendulum", "t_end": 10.0, "methods": METHODS, "peers": True, "lang": "en"}
INKS = {"light": ("#222222", "#d8d8d4"), "dark": ("#e8e8e4", "#44474c")}  # of text, of the grid
SIZE = {"width": 900, "height": 480}
DRAW = """([data, layout, size]) => Plotly.newPlot(document.body.appendChild(document.createElement("div")), data,
  layout).then((div) => Plotly.toImage(div, { format: "svg", ...size })).then((address) =>
  decodeURIComponent(address.slice(address.indexOf(",") + 1)))"""


def measured() -> dict[str, Any]:
    """Error against time, as a figure of Plotly."""
    experiment = get_experiment("work-precision")
    *_, last = experiment.run(QUESTION)
    chart = drawn(experiment, last.result, text, "en")[0]
    shown = {*METHODS, *PEERS}
    traces = [{**trace, "error_x": {"visible": False}} for trace in chart["data"] if trace["legendgroup"] in shown]
    return {**chart, "data": traces}


def layout_of(chart: dict[str, Any], ink: str, grid: str) -> dict[str, Any]:
    """The layout for a page of any colour: no ground of its own."""
    axes = {name: {**chart["layout"][name], "gridcolor": grid, "linecolor": ink} for name in ("xaxis", "yaxis")}
    ground = {"paper_bgcolor": "rgba(0,0,0,0)", "plot_bgcolor": "rgba(0,0,0,0)"}
    words = {"font": {"family": "Arial, sans-serif", "size": 14, "color": ink}}
    return chart["layout"] | axes | ground | words | SIZE | {"legend": {"font": {"size": 14}}}


def main() -> None:
    """Measure, draw for both grounds, write."""
    chart = measured()
    with started() as browser:
        for name, inks in INKS.items():
            page = browser.new_page(viewport=SIZE)
            page.add_script_tag(path=PLOTLY)
            svg = page.evaluate(DRAW, [chart["data"], layout_of(chart, *inks), SIZE])
            (ROOT / f".github/chart-{name}.svg").write_text(svg, encoding="utf-8")
    print(chart["subject"], chart["caption"], sep="\n")


if __name__ == "__main__":
    main()
