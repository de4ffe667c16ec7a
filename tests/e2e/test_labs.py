"""The labs, in a real browser: charts grow, sliders answer, maps lead to motions, and a run can be stopped."""

from __future__ import annotations

import json
import re

import pytest
from playwright.sync_api import Route, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import until_equal

pytestmark = pytest.mark.e2e


def opened(lecture: Lecture, query: str, lang: str = "en") -> Lecture:
    lecture.page.goto(f"{lecture.address}labs?{query}&lang={lang}")
    lecture.page.locator("form.question button.main:enabled").wait_for()
    return lecture


def measured(lecture: Lecture) -> Lecture:
    lecture.page.locator("form.question button.main").click()
    lecture.page.locator("p.files").wait_for()
    return lecture


def test_work_and_precision_answers_while_the_wish_is_dragged(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=work-precision&scene=pendulum&t=2")).page
    page.locator("figure .main-svg").nth(1).wait_for(state="attached")
    answer = page.locator("output[for=tolerance]")
    expect(answer).to_have_text(re.compile(r"^\s*For an error of 1\.0·10⁻⁶ take .+: .+ ms \("))
    before = answer.inner_text()
    page.locator("#tolerance").focus()
    page.keyboard.press("End")
    expect(answer).not_to_have_text(before)


def test_the_menu_comes_from_the_server(lecture: Lecture) -> None:
    page = opened(lecture, "lab=alchemy&scene=pendulum").page
    words = page.request.get(f"{lecture.address}api/v1/catalogs/en?sections=labs").json()["labs"]["experiments"]
    expect(page.locator(".kinds a")).to_have_text([words[name]["title"] for name in words])
    expect(page.locator(".kinds [aria-current=page]")).to_have_text(words["work-precision"]["title"])
    expect(page).to_have_url(re.compile("lab=work-precision"))


def test_another_language_tells_the_same_figures(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=work-precision&scene=pendulum&t=3")).page
    expect(page.locator("output[for=tolerance]")).to_contain_text(" ms")
    said = page.locator("output[for=tolerance]").inner_text()
    time = re.search(r": (\S+)\xa0?\s?ms", said)
    assert time is not None
    page.locator(".segments [lang=de]").click()
    answer = page.locator("output[for=tolerance]")
    expect(answer).not_to_have_text(said)
    expect(page.locator("figure figcaption").first).to_contain_text("Bewegung")
    expect(answer).to_contain_text(time[1].replace(".", ","))


def test_a_run_is_stopped_and_keeps_what_was_measured(lecture: Lecture) -> None:
    page = opened(lecture, "lab=work-precision&scene=triple-pendulum&t=60&peers=1").page
    page.locator("form.question button.main").click()
    page.locator("figure .main-svg").first.wait_for()
    page.get_by_role("button", name="Stop").click()
    expect(page.locator(".progress")).to_contain_text("what was measured stays")
    expect(page.locator("figure").first).to_be_visible()
    expect(page.get_by_role("button", name="Measure", exact=True)).to_be_enabled()


def test_a_run_that_fails_on_the_way_keeps_what_was_measured(lecture: Lecture) -> None:
    """The service's own answer, whose end is replaced by the problem that a deadline is."""
    problem = {"type": "/problems/too-large", "title": "Too large", "status": 504, "detail": "Stopped.", "problems": []}

    def cut(route: Route) -> None:
        answer = route.fetch()
        parts, _, _ = answer.text().partition("event: result")
        route.fulfill(response=answer, body=f"{parts}event: problem\ndata: {json.dumps(problem)}\n\n")

    page = opened(lecture, "lab=convergence&scene=pendulum").page
    page.route("**/experiments/convergence", cut)
    page.locator("form.question button.main").click()
    expect(page.locator(".measured .failure")).to_contain_text("Stopped.")
    expect(page.locator(".measured .failure")).to_contain_text("what was measured stays")
    expect(page.locator("figure").first).to_be_visible()


def test_the_step_of_failure_is_told_and_played(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=stability&scene=two-mass-oscillator&t=2")).page
    row = page.locator(".failures tbody tr", has_text="Classical Runge–Kutta")
    expect(row.locator("td").nth(3)).to_have_text(re.compile(r"^−?[\d.]+ %$"))
    expect(page.locator(".failures tbody tr", has_text="Gauss, order 6").locator("td").nth(1)).to_have_text("never")
    row.get_by_role("button", name="play").click()
    expect(page.locator(".motion .drawing path").first).to_be_attached()
    expect(page.locator(".motion h2")).to_contain_text("Classical Runge–Kutta with h = ")


def test_a_place_on_the_map_is_simulated(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=stability-map&scene=kapitza&x=omega:20:100&y=y0:0.02:0.15")).page
    expect(page.locator("figcaption")).to_contain_text("200 × 200 points")
    page.locator("[data-chart='stability-map'] .nsewdrag").click(position={"x": 200, "y": 100})
    expect(page.locator(".motion .drawing path").first).to_be_attached()
    expect(page.locator(".motion h2")).to_contain_text(re.compile(r"Motion at omega = \d+"))


def test_a_map_is_read_and_opened_by_keyboard(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=stability-map&scene=kapitza&x=omega:20:100&y=y0:0.02:0.15")).page
    page.locator("[data-chart='stability-map'] .canvas").focus()
    for key in ("ArrowUp", "Shift+ArrowRight"):
        page.keyboard.press(key)
    told = page.locator("[data-chart='stability-map'] .cursor")
    expect(told).to_have_text(re.compile(r"^omega = 64\.\d, y0 = 0\.08\d+: lg \|μ\| = "))
    page.locator("[data-chart='stability-map'] .hoverlayer .hovertext").wait_for()
    page.keyboard.press("Enter")
    expect(page.locator(".motion h2")).to_contain_text(re.compile(r"Motion at omega = 64"))


def test_the_least_rung_is_named_and_opened_as_a_scene(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=fidelity&scene=spherical-pendulum&t=4")).page
    expect(page.locator(".verdict")).to_contain_text("The least rung within an error of 1.0 %")
    page.locator("tr.least").get_by_role("button", name="open").click()
    page.wait_for_url(re.compile(r"/scene\?.*#"))
    lecture.steps.first.wait_for()


def test_what_multipliers_cost_is_charted_beside_minimal_coordinates(lecture: Lecture) -> None:
    page = measured(opened(lecture, "lab=fidelity&scene=cartesian-pendulum&t=2")).page
    expect(page.locator("tr.least th")).to_have_text("minimal coordinates")
    expect(page.locator("figure[data-chart=fidelity-alike] figcaption")).to_contain_text("in minimal coordinates")
    expect(page.locator(".verdict").last).to_contain_text("Both move alike: they differ by")
    ratio = page.locator("table", has_text="Time of one step").locator("tbody tr").first.locator("td").last
    expect(ratio).to_have_text(re.compile(r"^[\d.]+$"))


def test_bad_values_are_told_and_nothing_is_lost(lecture: Lecture) -> None:
    page = opened(lecture, "lab=stability-map&scene=pendulum").page
    page.locator("form.question button.main").click()
    expect(page.locator(".failure")).to_contain_text("Nothing here depends on the time")
    expect(page.locator("form.question select").first).to_have_value("pendulum")
    lecture.complaints.clear()


def test_what_the_service_refuses_is_told_with_its_field(lecture: Lecture) -> None:
    page = opened(lecture, "lab=basins&scene=pendulum").page
    page.get_by_label("To the right", exact=True).fill("sinn(phi)")
    page.locator("form.question button.main").click()
    expect(page.locator(".failure li")).to_have_text(
        ["To the right: There is no quantity “sinn(phi)” in this scene; there are phi, dot(phi)."]
    )
    lecture.complaints.clear()


# Neither term is a force: two mistakes at one place.
MISTAKEN = {
    "format": 1, "id": "own", "coordinates": [{"name": "x", "value": 1, "unit": "m"}],
    "parameters": [{"name": "m", "value": 1, "unit": "kg"}],
    "bodies": [{"name": "p", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
    "loads": [{"kind": "force", "at": "p", "force": ["-m*x - m*dot(x)", "0"]}],
}  # fmt: skip
TOLD = [
    "/loads/0/force/0 “-m*x” has the unit kg m; kg m s⁻² is needed here.",
    "/loads/0/force/0 “- m*dot(x)” has the unit kg m s⁻¹; kg m s⁻² is needed here.",
]


@pytest.mark.parametrize("place", ["labs?lab=basins&scene=own", "scene?scene=own"])
def test_mistakes_of_ones_own_scene_are_told_once_with_their_places(sources: Lecture, place: str) -> None:
    page = sources.page
    page.goto(f"{sources.address}scene?scene=pendulum&lang=en")
    fragment = page.evaluate("scene => import('/model/own.js').then(own => own.fragmentOf(scene))", MISTAKEN)
    page.goto(f"{sources.address}{place}&lang=en{fragment}")
    if place.startswith("labs"):
        page.locator("form.question button.main:enabled").click()
    failure = page.locator("main .failure", has=page.get_by_text("Edit this scene"))
    expect(failure.locator("li")).to_have_text(TOLD)
    expect(failure.locator("p")).to_have_count(0)
    failure.get_by_text("Edit this scene").click()
    expect(page.locator(".editor [aria-invalid=true], .editor .wrong").first).to_be_visible()
    sources.complaints.clear()


@pytest.mark.one_in(2)
@pytest.mark.parametrize("lang", ["de", "en"])
def test_a_phone_shows_all_of_it(lecture: Lecture, lang: str) -> None:
    lecture.page.set_viewport_size({"width": 360, "height": 740})
    page = measured(opened(lecture, "lab=convergence&scene=pendulum&t=1", lang)).page
    until_equal(page, lambda: page.evaluate("document.documentElement.scrollWidth"), 360)
    canvas = page.locator(".canvas").first.bounding_box()
    assert canvas is not None
    assert canvas["x"] + canvas["width"] <= 360
    expect(page).to_have_url(re.compile("lab=convergence.*scene=pendulum.*t=1"))


def test_a_point_of_a_section_leads_to_its_orbit(lecture: Lecture) -> None:
    """The link of the table and that of the motion, which a click on a point plays, begin as the orbit does."""
    page = measured(opened(lecture, "lab=poincare-section&scene=coupled-pendulums&t=40&grid=3&crossings=8")).page
    point = page.locator("figure[data-chart=poincare-section] .points path").first
    point.wait_for()
    point.click(force=True)
    link = page.locator(".motion h2 a")
    expect(link).to_have_attribute("href", re.compile("scene=coupled-pendulums.*set=phi1:"))
    page.locator("summary", has_text="Orbits (").click()
    rows = page.locator(".failures tbody tr a")
    assert link.get_attribute("href") in {row.get_attribute("href") for row in rows.all()}
    rows.first.click()
    expect(page).to_have_url(re.compile(r"/scene\?.*set="))
    page.locator("main .katex").first.wait_for()


def test_a_bifurcation_opens_its_motion(lecture: Lecture) -> None:
    """The table has the doubling of the driven pendulum; what it opens begins there, at that value of the parameter."""
    small = "sweep=gamma:1.06:1.07&settle=20&shown=4&folds=1"
    page = measured(opened(lecture, f"lab=bifurcation&scene=driven-pendulum&{small}")).page
    row = page.locator(".failures tbody tr").first
    expect(row).to_contain_text("Period doubling")
    expect(row).to_contain_text("1.06637")
    page.locator("figure[data-chart=bifurcation] .points path").first.click(force=True)
    expect(page.locator(".motion h2 a")).to_have_attribute("href", re.compile("scene=driven-pendulum.*gamma:1.0"))
    row.get_by_role("link").click()
    expect(page).to_have_url(re.compile(r"/scene\?.*gamma:1\.06637"))
    page.locator("main .katex").first.wait_for()
