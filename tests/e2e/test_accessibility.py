"""Every page against WCAG 2.2 AA as far as axe-core sees it: in the dark, then the contrast in the light.

Labels are a matter of the language, which changes from page to page: both have the same words, as another test sees to.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e

TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
# Formulas on keys are symbols, not labels that could be spoken: understanding WCAG 2.5.3, "mathematical formulas".
# Handles of places are for keys alone and let every pointer through, which takes the nearest place: WCAG 2.5.8 is about
# targets of pointers, and axe-core does not ask whether they are any.
SYMBOLS = {"label-content-name-mismatch": ".key-cap", "target-size": ".handle"}
AXE = """async ([type, values, symbols]) => {
    const { violations } = await axe.run(document, { runOnly: { type, values } });
    const reached = (one) => getComputedStyle(one).pointerEvents !== 'none';
    const excused = (id, target) => [...document.querySelectorAll(target)].some(
        (one) => symbols[id] && one.matches(symbols[id]) && !(id === 'target-size' && reached(one)));
    return violations.flatMap(({ id, nodes }) => nodes
        .filter(({ target }) => !excused(id, target[0]))
        .map(({ target, failureSummary }) => `${id} at ${target.join(' ')}: ${failureSummary}`));
}"""


def nothing(page: Page) -> None:
    """The page as it opens."""


def pressing(key: str) -> Callable[[Page], None]:
    return lambda page: page.keyboard.press(key)


def turn(page: Page) -> None:
    """Space, turned by keys: the drawing has the focus."""
    page.locator(".drawing").hover()
    drawing = page.locator(".drawing[tabindex='0'][role=group][aria-label]")
    drawing.focus()
    before = page.locator(".drawing path.steel").first.get_attribute("d")
    drawing.press("ArrowLeft")
    expect(page.locator(".drawing path.steel").first).not_to_have_attribute("d", before or "")
    drawing.press("Home")
    expect(page.locator(".drawing path.steel").first).to_have_attribute("d", before or "")


def measure(page: Page) -> None:
    page.locator("form.question button.main").click()
    page.locator("p.files").wait_for()


def share(page: Page) -> None:
    page.locator(".tools .tool").nth(1).click()
    expect(page.locator("dialog.share")).to_be_visible()


def share_proof(page: Page) -> None:
    page.locator(".tools .tool").first.click()
    expect(page.locator("dialog.share")).to_be_visible()


def send(page: Page) -> None:
    page.locator(".trial button.main").click()
    expect(page.locator(".answer pre")).to_be_visible()


def answer(page: Page) -> None:
    """A wrong answer with its verdict, a hint, both motions and the solution."""
    page.locator(".answer-head .segments button").nth(1).click()
    page.locator("textarea.entry").fill("l*ddot(phi) = g*sin(phi)")
    page.locator(".answering button.main").click()
    page.locator(".verdict-card .acts button").click()
    page.locator(".answering .acts .quiet").click()
    page.locator(".solving button, .worked").first.click()
    expect(page.locator(".motions")).to_be_visible()
    expect(page.locator(".worked")).to_be_visible()


def unfold(page: Page) -> None:
    """A stop with notes and a poll."""
    page.locator("[data-at=more]").nth(2).click()
    expect(page.locator(".poll-editor")).to_be_visible()


def pick(page: Page) -> None:
    """A sheet of one task, with its address and the code for phones."""
    page.locator(".catalogue button").first.click()
    page.locator(".link-of-sheet summary").click()
    expect(page.locator(".qr")).to_be_visible()


def mark_class(page: Page) -> None:
    """Answers in a table, one of them wrong, one late, and the list of all."""
    page.locator(".classroom input[type=file]").set_input_files(
        {"name": "class.csv", "mimeType": "text/csv", "buffer": CLASS.encode()}
    )
    page.locator(".mistakes button").first.click()
    expect(page.locator(".all-results tbody tr")).to_have_count(1)


def miss(page: Page) -> None:
    """A mistake, which will come back: the list of what does has an entry."""
    page.locator(".answer-head .segments button").last.click()
    page.locator("textarea.entry").fill("m*s'^2")
    page.locator(".answering button.main").click()
    page.locator(".lessons li").wait_for()


def hand_in(page: Page) -> None:
    """What is there to be handed in on a sheet with a deadline."""
    sheet = {"format": 1, "deadline": "2099-01-01", "tasks": [{"scene": "pendulum", "task": "equation:phi"}]}
    page.locator(".files-of-work input").set_input_files(
        {"name": "sheet.json", "mimeType": "application/json", "buffer": json.dumps(sheet).encode()}
    )
    page.locator("#handin-name").fill("Ada")
    expect(page.locator(".to-hand-in .katex")).to_be_visible()


CLASS = "student,id,scene,task,answer,time\n" + "".join(
    f"ada,7,pendulum,kinetic-energy,{answer},2026-11-30T12:0{n}Z\n"
    for n, answer in enumerate(["m*l^2*dot(phi)^2", "m*l^2*dot(phi)^2/2"])
)
SCENE = "scene?scene=elastic-pendulum&step=generalized-forces"
SPACE = "scene?scene=heavy-top&step=lagrangian"
# Where, what must be there before it is looked at, and what is done first.
PLACES = [
    pytest.param("?", ".hero path.bob", nothing, id="start page"),
    pytest.param(f"{SCENE}&n=0", ".plots.ready", nothing, id="scene"),
    pytest.param(f"{SPACE}&view=lecture&beside=plots&at=1", ".slide .katex", turn, id="lecture mode"),
    pytest.param("scene?scene=pendulum&edit=form", ".editor .field .katex", nothing, id="editor"),
    pytest.param("embed?scene=pendulum", ".steps .katex", nothing, id="frame"),
    pytest.param("embed/proof?", ".steps .katex", nothing, id="proof in a frame"),
    pytest.param("handout?scene=pendulum", ".paper .katex", nothing, id="handout"),
    pytest.param("presenter?x=1", ".presenter .notice", nothing, id="presenter without lecture"),
    pytest.param("variations?", ".steps .katex", nothing, id="variations"),
    pytest.param("proof?", ".steps .katex", nothing, id="proof"),
    pytest.param("proof?view=lecture", ".slide .katex", nothing, id="proof in lecture mode"),
    pytest.param("handout?proof=dalembert-lagrange", ".paper .katex", nothing, id="handout of the proof"),
    pytest.param("labs?", "main", nothing, id="labs"),
    pytest.param("labs?lab=convergence&scene=pendulum&t=1", "button.main:enabled", measure, id="labs, measured"),
    pytest.param(
        "labs?lab=poincare-section&scene=coupled-pendulums&t=9&grid=2&crossings=3",
        "button.main:enabled",
        measure,
        id="labs, a section",
    ),
    pytest.param(
        "labs?lab=stability&scene=two-mass-oscillator&t=1", "button.main:enabled", measure, id="labs, a table"
    ),
    pytest.param("lecture?shipped=1", ".stop", unfold, id="outline of a lecture"),
    pytest.param("lecture?shipped=1&give=9", ".hall .poll", nothing, id="hall"),
    pytest.param("homework?", "main .katex", nothing, id="homework"),
    pytest.param("homework?scene=pendulum&task=equation:phi", ".question h2", answer, id="homework, answered"),
    pytest.param("homework?scene=pendulum&side=class", ".classroom .pick", mark_class, id="homework of a class"),
    pytest.param("homework?scene=pendulum&side=sheet", ".catalogue .katex", pick, id="homework, a sheet in the making"),
    pytest.param("homework?scene=pendulum&side=handin", ".files-of-work input", hand_in, id="homework, handed in"),
    pytest.param(
        "homework?side=practice&series=ada&level=1&number=3", ".question .of-system", miss, id="homework, practice"
    ),
    pytest.param("docs?", ".calls article", nothing, id="reference"),
    pytest.param("help?", ".guide article", nothing, id="help"),
    pytest.param("docs/try?", ".trial textarea", send, id="trial of the API"),
    pytest.param(
        "scene?scene=chaplygin-sleigh&view=lecture&step=augmented-system&at=1",
        ".slide[data-filled] .katex",
        nothing,
        id="linear system in lecture mode",
    ),
    pytest.param("problems/invalid-request?", ".top ~ .problem pre", nothing, id="problem"),
]
DIALOGS = [
    pytest.param(SCENE, ".steps .katex", pressing("?"), id="help"),
    pytest.param(SCENE, ".steps .katex", pressing("o"), id="overview"),
    pytest.param(SCENE, ".steps .katex", pressing("g"), id="jump"),
    pytest.param(SCENE, ".steps .katex", share, id="share"),
    pytest.param("proof?x=1", ".steps .katex", share_proof, id="share the proof"),
]


@pytest.fixture(scope="module")
def axe(root: Path) -> str:
    """The source of axe-core, which the build fetches with the tools of the front end."""
    return (root / "frontend" / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")


def violations(page: Page, axe: str) -> list[Any]:
    """What axe finds on the page at rest: contrast means nothing while something fades in."""
    page.emulate_media(reduced_motion="reduce")
    page.evaluate(axe)
    found: list[Any] = page.evaluate(AXE, ["tag", TAGS, SYMBOLS])
    return found


def violations_in_both_themes(page: Page, axe: str) -> list[Any]:
    """What axe finds, and what of the contrast when the theme is the other one."""
    found = violations(page, axe)
    page.evaluate("document.documentElement.dataset.theme = 'light'")
    contrast: list[Any] = page.evaluate(AXE, ["rule", ["color-contrast"], SYMBOLS])
    return found + contrast


def opened(lecture: Lecture, place: str, ready: str, language: str) -> Page:
    page = lecture.page
    page.emulate_media(reduced_motion="reduce")
    page.goto(f"{lecture.address}{place}&lang={language}&theme=dark")
    page.locator(ready).first.wait_for(state="attached")
    return page


def by_turns(places: list[Any]) -> list[Any]:
    """The places, one in German, the next in English."""
    languages = itertools.cycle(("de", "en"))
    return [pytest.param(*place.values, lang, id=place.id) for place, lang in zip(places, languages, strict=False)]


@pytest.mark.one_in(8)
@pytest.mark.parametrize(("place", "ready", "first", "language"), by_turns(PLACES))
def test_page(
    lecture: Lecture,
    axe: str,
    place: str,
    ready: str,
    first: Callable[[Page], None],
    language: str,
) -> None:
    page = opened(lecture, place, ready, language)
    first(page)
    assert page.locator("html").get_attribute("lang") == language
    assert violations_in_both_themes(page, axe) == []


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("place", "ready", "first", "language"), by_turns(DIALOGS))
def test_dialog(
    lecture: Lecture, axe: str, place: str, ready: str, first: Callable[[Page], None], language: str
) -> None:
    page = opened(lecture, place, ready, language)
    first(page)
    expect(page.locator("dialog[open]")).to_be_visible()
    assert violations_in_both_themes(page, axe) == []


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    "place", ["?", "scene?scene=elastic-pendulum&view=", "homework?", "homework?side=sheet", "labs?"]
)
def test_phone(lecture: Lecture, axe: str, place: str) -> None:
    page = lecture.page
    page.set_viewport_size({"width": 360, "height": 740})
    page.goto(f"{lecture.address}{place}&lang=de")
    page.locator("main").wait_for()
    page.wait_for_load_state("networkidle")
    assert violations(page, axe) == []


def test_the_page_at_a_lost_address(lecture: Lecture, axe: str) -> None:
    """With the link to the page that was meant, in the dark and in the light."""
    page = opened(lecture, "scenne?x=1", ".problem article a", "en")
    assert violations_in_both_themes(page, axe) == []
    lecture.complaints[:] = [one for one in lecture.complaints if "404" not in one]


def test_the_projector_theme_has_contrast(lecture: Lecture, axe: str) -> None:
    lecture.open("?scene=elastic-pendulum&lang=en&theme=projector&step=virtual-work")
    assert violations(lecture.page, axe) == []


def test_a_presenter_that_leads_a_lecture(lecture: Lecture, axe: str) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}scene?scene=pendulum&lang=en&view=lecture&theme=dark")
    page.locator(".slide .katex").first.wait_for()
    with page.context.expect_page() as opened:
        page.keyboard.press("s")
    opened.value.locator(".now .katex").first.wait_for()
    assert violations(opened.value, axe) == []


def test_the_motion_is_told_in_words_and_anew_when_it_changes(lecture: Lecture) -> None:
    lecture.open("?scene=pendulum&lang=en")
    told = lecture.page.locator("#motion[role=status]")
    expect(told).to_contain_text("phi swings between")
    expect(told).to_contain_text("the energy stays the same")
    before = told.text_content() or ""
    slider = lecture.page.locator("[data-slider=parameter-l-value] .decimal")
    slider.fill("0.5")
    slider.press("Tab")
    expect(told).not_to_have_text(before)


def test_axe_finds_what_is_wrong(lecture: Lecture, axe: str) -> None:
    """A page with a known fault: the test above is able to fail."""
    page = lecture.page
    page.goto(f"{lecture.address}?lang=en")
    page.locator("main").wait_for()
    page.evaluate("document.querySelector('main').insertAdjacentHTML('beforeend', '<button></button>')")
    assert [found.split(" at ")[0] for found in violations(page, axe)] == ["button-name"]
