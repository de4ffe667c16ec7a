"""Charts: figures for Plotly.js, as far as δq makes use of what Plotly knows.

Members mean what they mean there (https://plotly.com/javascript/reference); one that is left out has Plotly's default.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .base import Answer

Numbers = tuple[float | None, ...]


class Begin(Answer):
    """Value and rate of a coordinate where a motion began."""

    value: float
    rate: float


class LineStyle(Answer):
    """How a line, or the border of a symbol, is drawn."""

    color: str | None = None
    dash: str | None = Field(None, examples=["dash"])
    width: float | None = None


class MarkerStyle(Answer):
    """How symbols are drawn; a list has one entry for each of them."""

    color: str | None = None
    symbol: str | tuple[str, ...] | None = Field(None, examples=["circle"])
    size: float | None = None
    line: LineStyle | None = Field(None, description="the border")


class AxisTitle(Answer):
    """A text beside an axis or a scale of colours."""

    text: str
    standoff: float | None = Field(None, description="from the axis, in pixels")
    side: str | None = None


class ColorBar(Answer):
    """The scale beside a map."""

    title: AxisTitle
    thickness: float
    outlinewidth: float


class ErrorBars(Answer):
    """From each point on, up and down."""

    type: Literal["data"]
    symmetric: bool
    array: tuple[float, ...]
    arrayminus: tuple[float, ...]
    color: str | None = Field(None, description="with two more digits for its opacity", examples=["#0072b240"])
    thickness: float
    width: float


class TraceMeaning(Answer):
    """What a trace shows that its look does not tell."""

    role: str = Field(
        description="eigenvalues, map, flips, basins, orbit, sweep, branch, or without-result", examples=["eigenvalues"]
    )
    x: str | None = Field(None, description="of a map: whose values stand on its axis")
    y: str | None = Field(None, description="likewise")
    initial: dict[str, Begin] | None = Field(None, description="of an orbit: where it begins, by coordinate")
    part: str | None = Field(None, description="of a sweep: up or down; of a branch: its number")


class Trace(Answer):
    """A curve, symbols, or a map over x and y."""

    type: Literal["scatter", "heatmap"]
    mode: str | None = Field(None, examples=["lines+markers"])
    name: str | None = Field(None, description="in the legend")
    x: Numbers
    y: Numbers = Field(description="null parts a curve")
    z: tuple[Numbers, ...] | None = Field(None, description="of a map, by rows of equal y")
    zmin: float | None = None
    zmax: float | None = None
    colorscale: tuple[tuple[float, str], ...] | None = None
    colorbar: ColorBar | None = None
    showscale: bool | None = Field(None, description="whether its scale stands beside a map")
    text: tuple[str, ...] | None = None
    textposition: str | None = None
    hoverinfo: str | None = None
    hovertemplate: str | None = None
    line: LineStyle | None = None
    marker: MarkerStyle | None = None
    error_x: ErrorBars | None = None
    fill: str | None = None
    fillcolor: str | None = None
    opacity: float | None = None
    visible: bool | str | None = Field(None, description="legendonly: after a click on its name in the legend")
    showlegend: bool | None = None
    legendgroup: str | None = None
    meta: TraceMeaning | None = None


class Axis(Answer):
    """An axis with its quantity and unit."""

    title: AxisTitle
    type: Literal["log"] | None = Field(None, description="else linear")
    range: tuple[float, float] | None = Field(None, description="of a logarithmic axis in decades")
    rangemode: str | None = None
    autorange: str | None = None
    dtick: float | str | None = None
    constrain: str | None = None
    scaleanchor: str | None = None
    gridcolor: str
    linecolor: str
    mirror: bool
    showline: bool
    ticks: str
    zeroline: bool
    zerolinecolor: str | None = None
    exponentformat: str
    automargin: bool


class Font(Answer):
    """Letters, in pixels."""

    family: str | None = None
    size: float
    color: str | None = None


class Margin(Answer):
    """Around the axes, in pixels."""

    l: float
    r: float
    t: float
    b: float


class Legend(Answer):
    """Where the names of the curves stand."""

    x: float
    y: float
    xanchor: str
    yanchor: str
    font: Font
    tracegroupgap: float


class Layout(Answer):
    """All but the curves."""

    font: Font
    paper_bgcolor: str
    plot_bgcolor: str
    margin: Margin
    hovermode: str
    legend: Legend
    showlegend: bool | None = None
    xaxis: Axis
    yaxis: Axis


class Chart(Answer):
    """A figure for Plotly, with what it shows and how that was measured."""

    id: str
    title: str
    subject: str = Field(description="scene and values")
    caption: str
    data: tuple[Trace, ...]
    layout: Layout
