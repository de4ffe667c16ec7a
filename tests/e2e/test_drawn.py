"""What is on the screen is what was computed; and what was not, is told."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import until

pytestmark = pytest.mark.e2e

# Wilberforce pendulum with equal frequencies of bounce and twist, from rest at z₀: the sum and difference of two modes.
MASS, INERTIA, STIFFNESS, COUPLING, START = 0.5, 1e-4, 5.0, 0.02, 0.1
SPLIT = COUPLING / 2 / math.sqrt(MASS * INERTIA)
FAST, SLOW = (math.sqrt(STIFFNESS / MASS + sign * SPLIT) for sign in (1, -1))
TWIST = math.sqrt(MASS / INERTIA) * START / 2


def twist(t: float) -> float:
    return TWIST * (math.cos(FAST * t) - math.cos(SLOW * t))


def twist_rate(t: float) -> float:
    return -TWIST * (FAST * math.sin(FAST * t) - SLOW * math.sin(SLOW * t))


# The portrait of a coordinate as it stands in the page: its curve, the numbers on its axes, and the present state.
PORTRAIT = """name => {
    const svg = document.querySelector('.phase svg');
    const number = text => Number(text.textContent.replace('−', '-').replace(',', '.'));
    const axis = (anchor, along) => [...svg.querySelectorAll(`text[text-anchor=${anchor}]`)]
        .map(text => [number(text), along(text.previousElementSibling.getAttribute('d'))]);
    const state = new DOMMatrix(getComputedStyle(document.querySelector(`.phase .state.${name}`)).transform);
    return {
        d: svg.querySelector(`.curve.${name}`).getAttribute('d'),
        rows: axis('end', d => Number(d.match(/^M\\S+ (\\S+)H/)[1])),
        lefts: axis('end', d => Number(d.match(/^M(\\S+) /)[1])),
        state: [state.e, state.f],
    };
}"""


def test_the_portrait_on_the_screen_ends_where_the_closed_form_does(lecture: Lecture) -> None:
    """Its last point is read off the numbers on its axis, and the dot of the last moment stands on it."""
    page = lecture.page
    page.emulate_media(reduced_motion="reduce")
    lecture.page.goto(f"{lecture.address}scene?scene=wilberforce&lang=en&with=phase&at=10")
    page.locator(".phase path.curve.q-1").wait_for(state="attached")
    drawn = until(page, lambda: page.evaluate(PORTRAIT, "q-1"), lambda found: rate_at_end(found) < -15)
    assert rate_at_end(drawn) == pytest.approx(twist_rate(10), abs=0.1)
    assert math.dist(drawn["state"], last_corner(drawn["d"])) < 0.5


def last_corner(path: str) -> tuple[float, float]:
    x, y = path.rsplit("L", maxsplit=1)[-1].split(" ")
    return float(x), float(y)


def rate_at_end(drawn: dict[str, Any]) -> float:
    """By the numbers of the last portrait's own axis."""
    left = max(left for _, left in drawn["lefts"])
    rows = [row for row, (_, at) in zip(drawn["rows"], drawn["lefts"], strict=True) if at == left]
    (low, bottom), (high, top) = rows[0], rows[-1]
    return float(low + (last_corner(drawn["d"])[1] - bottom) / (top - bottom) * (high - low))


# Corners of a curve in the second row of the plots, from the path that Plotly drew, in time and value; and pixels per
# unit of both.
CURVE = """name => {
    const { xaxis, yaxis2: y } = document.querySelector('.plots .canvas')._fullLayout;
    const path = document.querySelector(`.plots .trace.${name} .js-line`);
    const corners = path.getAttribute('d').slice(1).split('L').map(pair => pair.split(',').map(Number));
    return { corners: corners.map(([a, b]) => [xaxis.p2c(a), y.p2c(b)]), scale: [Math.abs(xaxis._m), Math.abs(y._m)] };
}"""


def test_a_plotted_curve_is_the_motion_between_its_corners_too(lecture: Lecture) -> None:
    """The polyline on the screen against the closed form: half a pixel, at corners and between them."""
    page = lecture.page
    page.emulate_media(reduced_motion="reduce")
    lecture.page.goto(f"{lecture.address}scene?scene=wilberforce&lang=en")
    page.locator(".plots.ready .trace.q-1").wait_for(state="attached")
    expect(page.locator(".status.busy")).to_have_count(0)
    found = page.evaluate(CURVE, "q-1")
    corners = found["corners"]
    assert [corners[0][0], corners[-1][0]] == pytest.approx([0, 10], abs=0.01)
    assert max(off_the_curve(*pair, found["scale"]) for pair in pairwise(corners)) < 0.5


def off_the_curve(a: list[float], b: list[float], scale: list[float]) -> float:
    """Pixels between a chord and the closed form, at right angles to the chord."""
    across = math.atan2((b[1] - a[1]) * scale[1], (b[0] - a[0]) * scale[0])
    parts = [0.0, 0.25, 0.5, 0.75, 1.0]
    off = [twist(a[0] + s * (b[0] - a[0])) - (a[1] + s * (b[1] - a[1])) for s in parts]
    return max(map(abs, off)) * scale[1] * math.cos(across)


def answered_otherwise(page: Page, change: Callable[[dict[str, Any]], None]) -> None:
    """Motions come with another outcome, as from a service that knows more statuses than the page."""

    def answer(route: Route) -> None:
        found = route.fetch().json()
        change(found)
        route.fulfill(body=json.dumps(found), content_type="application/json")

    page.route("**/api/v1/simulations", answer)


def unheard(found: dict[str, Any]) -> None:
    found.update(status="unheard_of", reason="Nobody knows.", remedy="Ask again.", trusted_until=4.0)


def test_a_status_that_is_new_is_told_with_its_remedy_and_the_good_part(lecture: Lecture) -> None:
    """Below the plots; in a lecture, where there is no report, over the drawing."""
    page = lecture.page
    page.emulate_media(reduced_motion="reduce")
    answered_otherwise(page, unheard)
    lecture.open("?scene=pendulum&lang=en")
    expect(page.locator(".warning")).to_have_text(re.compile("Nobody knows.*Ask again."))
    expect(page.locator(".doubt")).to_be_hidden()
    page.locator(".plots.ready").wait_for()
    expect(page.locator(".plots .trace.q-0 .js-line").first).to_be_attached()
    beyond, plots = page.locator(".beyond").bounding_box(), page.locator(".plots").bounding_box()
    assert beyond is not None
    assert plots is not None
    assert (beyond["x"] - plots["x"]) / plots["width"] == pytest.approx(0.45, abs=0.05)
    page.goto(f"{lecture.address}scene?scene=pendulum&lang=en&view=lecture")
    expect(page.locator(".doubt")).to_be_visible()
    expect(page.locator(".doubt")).to_have_text("Nobody knows.")


def nothing(found: dict[str, Any]) -> None:
    unheard(found)
    found["t"] = []
    for part in ("coordinates", "rates", "positions", "loads"):
        found[part] = {name: [] for name in found[part]}
    found["energy"] |= {key: [] for key in ("kinetic", "potential", "power", "work", "balance")}
    found["error"]["estimate"] = []


def test_a_motion_without_a_sample_is_told_in_its_place(lecture: Lecture) -> None:
    answered_otherwise(lecture.page, nothing)
    lecture.page.goto(f"{lecture.address}scene?scene=pendulum&lang=en&with=phase,bars,paths")
    expect(lecture.page.locator(".drawing .failure")).to_contain_text("Nobody knows.")
    expect(lecture.page.locator(".drawing .failure")).to_contain_text("Ask again.")
