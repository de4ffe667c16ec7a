"""What the gallery shows: every page, in every state that somebody meets."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Page

import deltaq.scenes

LABS = (
    "work-precision",
    "convergence",
    "energy-drift",
    "stability",
    "chaos",
    "poincare-section",
    "uncertainty",
    "bifurcation",
    "basins",
    "fidelity",
)
CLASS = """student,scene,task,answer,syntax,line
ada,pendulum,kinetic-energy,m*l^2*dot(phi)^2,plain,1
ada,pendulum,equation:phi,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,plain,2
emmy,pendulum,equation:phi,l*ddot(phi) + g*sin(phi) = 0,plain,1
max,pendulum,equation:phi,l*ddot(phi) = g*sin(phi),plain,1
"""

# What is done before a picture is taken, on the page; another page than this one may come of it.
Act = Callable[[Page], Page | None]


def nothing(_: Page) -> None:
    """The page as it opens."""


@dataclass(frozen=True)
class Place:
    """A page, what must be there before it is taken, and what is done first."""

    name: str
    address: str
    ready: str = "main"
    first: Act = nothing
    full: bool = False  # the whole length of the page
    seldom: bool = False  # one of many alike: taken in a few views only


def key(*names: str) -> Act:
    def press(page: Page) -> None:
        for name in names:
            page.keyboard.press(name)

    return press


def click(selector: str, shown: str) -> Act:
    def press(page: Page) -> None:
        page.locator(selector).first.dispatch_event("click")
        page.locator(shown).first.wait_for()

    return press


def answer(formula: str) -> Act:
    """An answer with its verdict."""

    def give(page: Page) -> None:
        page.locator(".answer-head .segments button").nth(1).click()
        page.locator("textarea.entry").fill(formula)
        page.locator(".answering button.main").click()
        page.locator(".verdict-card").wait_for()

    return give


def answer_and_watch(page: Page) -> None:
    """A wrong answer with the motion it would mean."""
    answer("l*ddot(phi) = g*sin(phi)")(page)
    page.locator(".verdict-card .acts button").first.click()
    page.locator(".motions").wait_for()


def write(page: Page) -> None:
    """The field for formulas with its keys: below it, or at the foot of the screen."""
    page.locator("math-field").first.wait_for()
    page.locator("math-field").first.click()


def grade(page: Page) -> None:
    """The results of a class."""
    table = {"name": "class.csv", "mimeType": "text/csv", "buffer": CLASS.encode()}
    page.locator(".classroom input[type=file]").set_input_files([table])  # type: ignore[list-item]
    page.locator(".classroom .chart").nth(1).wait_for()


def present(page: Page) -> Page:
    """The window of the presenter beside the lecture."""
    with page.expect_popup() as opened:
        page.keyboard.press("s")
    opened.value.locator(".presenter .now .katex").first.wait_for()
    opened.value.set_viewport_size(page.viewport_size or {"width": 1366, "height": 768})
    return opened.value


ANSWERS = re.compile(r"/api/v1/(?!catalogs)")


def waiting(page: Page) -> None:
    """Opened anew, with a server that takes its time."""
    page.route(ANSWERS, lambda _: None)
    page.reload(wait_until="commit")


def broken(page: Page) -> None:
    """Opened anew, with a server that cannot be reached."""
    page.route(ANSWERS, lambda route: route.abort())
    page.reload(wait_until="commit")


def speechless(page: Page) -> None:
    """Opened anew, before the texts have come."""
    page.route("**/api/v1/**", lambda _: None)
    page.reload(wait_until="commit")


SCENE = "scene?scene=elastic-pendulum"
HALL = f"{SCENE}&view=lecture"
BOB = ".drawing path.bob"
STEPS = ".steps .katex"
SLIDE = ".slide .katex"
QUESTION = ".question h2"
EQUATION = "homework?scene=pendulum&task=equation:phi"

LECTURE = (
    Place("start", "?", ".hero path.bob"),
    Place("start-whole", "?", ".hero path.bob", full=True),
    Place("start-speechless", "?", ".hero", speechless, seldom=True),
    Place("scene", f"{SCENE}&step=virtual-displacement:bob", BOB),
    Place("scene-chapter", f"{SCENE}&step=work-of-force:weight", BOB),
    Place("scene-plots", f"{SCENE}&panel=plots&step=generalized-forces", ".js-plotly-plot"),
    Place("scene-values", f"{SCENE}&panel=values", BOB),
    Place("scene-varied", f"{SCENE}&vary=on&panel=values&step=virtual-work", BOB),
    Place("scene-runs", "scene?scene=double-pendulum&with=phase&panel=plots&step=equation:phi2", BOB),
    Place("scene-why", f"{SCENE}&step=virtual-displacement:bob&why=virtual-displacement:bob", BOB),
    Place("scene-long", "scene?scene=triple-pendulum&step=equation:phi1", BOB),
    Place("scene-hamilton", f"{SCENE}&formulation=hamilton&step=equation:phi", BOB, seldom=True),
    Place("scene-unknown", "scene?scene=nothing", ".failure"),
    Place("scene-waiting", SCENE, "main", waiting),
    Place("scene-broken", SCENE, "main", broken),
    Place("scene-overview", f"{SCENE}&step=virtual-work", BOB, key("o")),
    Place("scene-jump", f"{SCENE}&step=virtual-work", STEPS, key("g"), seldom=True),
    Place("scene-help", f"{SCENE}&step=virtual-work", BOB, key("?")),
    Place("scene-share", f"{SCENE}&step=virtual-work", BOB, click(".tools .tool:nth-of-type(2)", "dialog.share")),
    Place("editor", "scene?scene=pendulum&edit=form", ".editor .field .katex"),
    Place("editor-text", "scene?scene=pendulum&edit=toml", ".editor .toml", seldom=True),
    Place("lecture", f"{HALL}&step=virtual-displacement:bob&part=2", SLIDE),
    Place("lecture-first", HALL, SLIDE),
    Place("lecture-long", "scene?scene=triple-pendulum&view=lecture&step=equation:phi1", SLIDE),
    Place("lecture-plots", f"{HALL}&step=lagrangian&beside=plots", SLIDE),
    Place("lecture-overview", f"{HALL}&step=virtual-work", SLIDE, key("o")),
    Place("lecture-black", f"{HALL}&step=virtual-work", SLIDE, key("b"), seldom=True),
    Place("presenter", "presenter?x=1", ".notice", seldom=True),
    Place("presenter-leading", f"{HALL}&step=virtual-displacement:bob", SLIDE, present),
    Place("outline", "lecture?shipped=1", ".stop", click("[data-at=more] >> nth=2", ".poll-editor"), full=True),
    Place("outline-empty", "lecture?", ".empty", seldom=True),
    Place("hall", "lecture?shipped=1&give=7", "iframe.front"),
    Place("hall-poll", "lecture?shipped=1&give=9", ".hall .poll"),
    Place("proof", "proof?step=general-product-rule", STEPS),
    Place("proof-lecture", "proof?view=lecture&step=general-product-rule", SLIDE),
    Place("handout", "handout?scene=elastic-pendulum", ".paper path.bob"),
    Place("embed", "embed?scene=elastic-pendulum&step=virtual-displacement:bob", BOB),
    Place("embed-proof", "embed/proof?step=general-product-rule", STEPS),
)
PRACTICE = (
    Place("variations", "variations?", STEPS, full=True),
    Place("variations-length", "variations?kind=integral&expression=sqrt(1+%2B+dot(x)^2)", STEPS, full=True),
    Place("variations-wrong", "variations?expression=x^2%2Bsinn(x)", ".failure, [role=alert]", full=True, seldom=True),
    Place("labs", "labs?", ".question button.main"),
    *(
        Place(f"labs-{lab}", f"labs?lab={lab}", "main", click("button.main:enabled", "p.files"), full=True)
        for lab in LABS
    ),
    Place("labs-map", "labs?lab=stability-map", "main", click("button.main:enabled", "p.files"), full=True),
    Place("labs-broken", "labs?lab=convergence", "button.main:enabled", broken, seldom=True),
    Place("homework", "homework?", "main .katex"),
    Place("homework-task", EQUATION, QUESTION),
    Place("homework-keys", "homework?scene=elastic-pendulum&task=equations", QUESTION, write),
    Place("homework-right", EQUATION, QUESTION, answer("l*ddot(phi) + g*sin(phi) = 0"), full=True),
    Place("homework-wrong", EQUATION, QUESTION, answer_and_watch, full=True),
    Place("homework-invalid", EQUATION, QUESTION, answer("l*ddot(psi) + = 0"), full=True, seldom=True),
    Place("homework-practice", "homework?side=practice&series=ada&level=1&number=3", QUESTION, full=True),
    Place("homework-class", "homework?scene=pendulum&side=class", ".classroom .pick"),
    Place("homework-results", "homework?scene=pendulum&side=class", ".classroom .pick", grade, full=True),
    Place("homework-broken", "homework?scene=pendulum", QUESTION, broken, seldom=True),
    Place("help", "help?", ".guide article", full=True),
    Place("docs", "docs?", ".calls article"),
    Place("docs-whole", "docs?", ".calls article", full=True, seldom=True),
    Place("problem", "problems/invalid-request?", ".top ~ .problem pre", full=True),
    Place("docs-try", "docs/try?", ".trial textarea", click("button.main", ".answer pre")),
)
SCENES = sorted(file.stem for file in Path(deltaq.scenes.__path__[0]).glob("*.toml"))
FIGURES = tuple(
    Place(f"figure-{scene}", f"scene?scene={scene}", ".drawing svg path", seldom=True)
    for scene in [*SCENES, "chain-pendulum&n=5"]
)
PLACES = (*LECTURE, *PRACTICE, *FIGURES)
