"""Homework in a real browser: answers written in both notations, checked, led on, kept, and marked."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE, at_rest, until_equal

pytestmark = pytest.mark.e2e
FALLING = "m*l^2*ddot(phi) = m*g*l*sin(phi)"
RIGHT = "l*ddot(phi) + g*sin(phi) = 0"


def _open(lecture: Lecture, query: str = "scene=pendulum&task=equation:phi&lang=en") -> Page:
    """The page with its task, and the field for formulas if there is one."""
    lecture.page.goto(f"{lecture.address}homework?{query}")
    lecture.page.locator(".question h2, .whole, .classroom").first.wait_for()
    return lecture.page


def _answer_as_text(page: Page, *parts: str) -> None:
    page.get_by_role("group", name=re.compile("Notation|Schreibweise")).get_by_role("button", name="Text").click()
    expect(page.locator("textarea.entry")).to_have_count(len(parts))
    for field, part in zip(page.locator("textarea.entry").all(), parts, strict=True):
        field.fill(part)


def _math_field(page: Page) -> Locator:
    field = page.locator("math-field").first
    field.wait_for()
    field.click()
    page.wait_for_function(TAKES_LETTERS, arg=field.element_handle())
    return field


# It says that it has the focus before the browser gives it, and knows its shortcuts one frame after it has come.
TAKES_LETTERS = """field => document.activeElement === field && field.shadowRoot.activeElement !== null
    && field.menuItems.length === 0"""

LONG = (
    "1/2 (m1+m2) l1^2 phi1'^2 + 1/2 m2 l2^2 phi2'^2 - m2 l1 l2 phi1' phi2' cos(phi1-phi2) "
    "+ (m1+m2) g l1 cos phi1 + m2 g l2 cos phi2"
)
PARTED = """() => {
    const [right, yours] = ['right', 'yours'].map((one) => document.querySelector(`.drawing.${one} path.bob`));
    return right && yours && right.getAttribute('transform') !== yours.getAttribute('transform');
}"""


def _check(page: Page, outcome: str) -> Locator:
    page.locator(".answering button.main").click()
    card = page.locator(f".verdict-card[data-outcome={outcome}]:not(.stale)")
    card.wait_for()
    return card


def test_wrong_diagnosed_corrected_correct(lecture: Lecture) -> None:
    page = _open(lecture)
    _answer_as_text(page, FALLING)
    expect(page.locator(".understood-as .katex")).to_be_visible()
    expect(_check(page, "wrong")).to_contain_text("Sign of the weight")
    page.get_by_role("button", name="Hint 1 of 3").click()
    expect(page.locator(".hints li")).to_have_count(1)
    page.locator("textarea.entry").fill(RIGHT)
    expect(page.locator(".verdict-card")).to_contain_text("changed since")
    _check(page, "correct")
    expect(page.locator(".task[aria-current]")).to_have_attribute("data-status", "solved")
    expect(page.locator(".total")).to_contain_text("3 of 26 points")


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("typed", "latex"),
    [
        ("1/2(M+m)x'^2+1", r"\frac12\left(M+m\right)\dot{x}^2+1"),
        ("1/(2m)", r"\frac{1}{\left(2m\right)}"),
        ("x'^2/2", r"\frac{\dot{x}^2}{2}"),
        ("xdot/2 + 1", r"\frac{\dot{x}}{2}+1"),
        ("sqrt x'^2/2", r"\sqrt{\frac{\dot{x}^2}{2}}"),
    ],
)
def test_a_number_below_the_line_is_complete(lecture: Lecture, typed: str, latex: str) -> None:
    page = _open(lecture, "scene=cart-pendulum&task=kinetic-energy&lang=en")
    field = _math_field(page)
    page.keyboard.type(typed, delay=30)
    until_equal(page, lambda: field.evaluate("field => field.getValue('latex-without-placeholders')"), latex)


def test_another_reading_is_a_click_away(lecture: Lecture) -> None:
    page = _open(lecture, "scene=pendulum&task=potential-energy&lang=en")
    _answer_as_text(page, "m g l sin^2 phi/2")
    other = page.get_by_role("group", name="Can also be read as").get_by_role("button")
    expect(other).to_have_count(1)
    other.click()
    expect(page.locator("textarea.entry")).to_have_value("m*g*l*sin(phi/2)^2")
    expect(other).to_have_count(0)
    _check(page, "wrong")


def test_components_by_name_in_the_first_field(lecture: Lecture) -> None:
    page = _open(lecture, "scene=pendulum&task=position:bob&lang=en")
    _answer_as_text(page, "x = l sin phi, y = l cos phi", "")
    _check(page, "correct")


def test_a_formula_is_typed_and_keyed(lecture: Lecture) -> None:
    page = _open(lecture)
    _math_field(page)
    page.keyboard.type("l phi'' = -g ", delay=30)
    page.get_by_role("button", name="sin(|)").click()
    page.keyboard.type("phi", delay=30)
    expect(page.locator(".understood-as .katex")).to_be_visible()
    page.keyboard.press("Enter")
    page.locator(".verdict-card[data-outcome=correct]").wait_for()
    page.get_by_role("button", name="Text", exact=True).click()
    expect(page.locator("textarea.entry")).to_have_value("l*ddot(phi) = -g*sin(phi)")
    expect(page.locator(".verdict-card.stale")).to_have_count(0)


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("task", "typed"),
    [
        pytest.param("kinetic-energy", "T = 1/2 m (l phi' )^2", id="fraction, bracket, exponent"),
        pytest.param("equation:phi", "phi'' = - g/l sinphi", id="out of a fraction"),
        pytest.param("eigenfrequencies", "omega = sqrt g/l", id="into a root"),
    ],
)
def test_blanks_between_factors_do_no_harm(lecture: Lecture, task: str, typed: str) -> None:
    page = _open(lecture, f"scene=pendulum&task={task}&lang=en")
    _math_field(page)
    page.keyboard.type(typed, delay=30)
    _check(page, "correct")


def test_a_bracket_is_never_left_alone(lecture: Lecture) -> None:
    page = _open(lecture)
    field = _math_field(page)
    field.evaluate(r"field => field.insert('m\\sin\\left(x\\right)', { focus: true, selectionMode: 'after' })")
    for presses, left in [(0, r"m\sin\left(x\right)"), (1, r"m\sin\left(x\right)"), (2, r"m\sin"), (2, "")]:
        for _ in range(presses):
            field.evaluate("field => field.executeCommand('deleteBackward')")  # as the keys on the screen do
            page.wait_for_timeout(100)
        expect(field).to_have_js_property("value", left)


def test_back_leads_to_the_task_before(lecture: Lecture) -> None:
    page = _open(lecture)
    _answer_as_text(page, RIGHT)
    page.locator(".task").nth(2).click()
    expect(page).to_have_url(re.compile("task=virtual-work"))
    page.go_back()
    expect(page).to_have_url(re.compile("task=equation:phi"))
    expect(page.locator("textarea.entry")).to_have_value(RIGHT)
    page.locator("h1 select").select_option("atwood")
    expect(page.locator(".question h2")).to_contain_text("Position")
    page.go_back()
    expect(page.locator("textarea.entry")).to_have_value(RIGHT)


def test_reload_and_language_keep_everything(lecture: Lecture) -> None:
    page = _open(lecture)
    _answer_as_text(page, FALLING)
    _check(page, "wrong")
    page.get_by_role("button", name="Hint 1 of 3").click()
    page.reload()
    expect(page.locator("textarea.entry")).to_have_value(FALLING)
    expect(page.locator(".verdict-card[data-outcome=wrong]")).to_be_visible()
    page.locator(".segments [lang=de]").click()
    expect(page.locator(".verdict-card")).to_contain_text("Vorzeichen der Gewichtskraft")
    expect(page.locator("textarea.entry")).to_have_value(FALLING)
    expect(page.locator(".hints li")).to_have_count(1)
    expect(page).to_have_url(re.compile("lang=de"))


def test_nothing_typed_is_lost_without_a_server(lecture: Lecture) -> None:
    page = _open(lecture)
    page.context.set_offline(True)
    _answer_as_text(page, RIGHT)
    page.locator(".answering button.main").click()
    expect(page.locator(".answering [role=alert]")).to_contain_text("safe in this browser")
    page.context.set_offline(False)
    page.reload()
    expect(page.locator("textarea.entry")).to_have_value(RIGHT)
    lecture.complaints.clear()  # the browser reports that it was offline


def test_each_component_has_its_own_verdict_and_a_mistake_its_place(lecture: Lecture) -> None:
    page = _open(lecture, "scene=pendulum&task=position:bob&lang=de")
    _answer_as_text(page, "l*sin(phi)", "l*sin(phi)")
    _check(page, "wrong")
    assert [part.get_attribute("data-outcome") for part in page.locator(".part").all()] == ["correct", "wrong"]
    page.locator("textarea.entry").nth(1).fill("l*cos(psi)")
    expect(page.locator(".complaints mark")).to_have_text("psi")
    expect(page.locator("textarea.entry").nth(1)).to_have_attribute("aria-invalid", "true")
    page.locator("textarea.entry").nth(1).fill("")
    page.locator(".answering button.main").click()
    expect(page.locator(".notice-line")).to_have_text("Es fehlt noch ein Teil der Antwort.")


def test_both_motions_are_shown_and_the_solution_leads_to_its_step(lecture: Lecture) -> None:
    page = _open(lecture)
    _answer_as_text(page, FALLING)
    _check(page, "wrong")
    page.get_by_role("button", name="Show both motions").click()
    expect(page.locator(".motions .apart")).to_contain_text("The motions part at")
    page.wait_for_function(PARTED)
    desk = page.viewport_size
    page.set_viewport_size({"width": 360, "height": 740})
    expect(page.locator(".drawing.yours")).to_have_css(
        "background-color", "rgba(0, 0, 0, 0)"
    )  # it lies above the right one
    page.set_viewport_size(desk or {"width": 1366, "height": 768})
    page.get_by_role("button", name="Show the solution").click()
    page.get_by_role("link", name="See this step").click()
    expect(page.locator("[data-step='equation:phi'][aria-current]")).to_be_visible()


def test_a_working_is_marked_line_by_line(lecture: Lecture) -> None:
    page = _open(lecture, "scene=pendulum&side=working&lang=en")
    for number, (task, text) in enumerate(
        [("Kinetic energy", "m*l^2*dot(phi)^2"), ("Equation of motion", "2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0")]
    ):
        page.get_by_role("button", name="Line", exact=True).click()
        line = page.locator(".line").nth(number)
        line.locator("option", has_text=task).first.wait_for(state="attached")
        line.locator("select").select_option(line.locator("option", has_text=task).first.get_attribute("value"))
        line.locator("math-field, textarea").first.wait_for()
        if line.get_by_role("button", name="as text").count():
            line.get_by_role("button", name="as text").click()
        line.locator("textarea").fill(text)
    page.get_by_role("button", name="Check the working").click()
    expect(page.locator(".line.first-wrong")).to_contain_text("The first mistake is here")
    outcomes = [line.get_attribute("data-outcome") for line in page.locator(".line").all()]
    assert outcomes == ["wrong", "follow_through"]
    expect(page.locator(".acts .score")).to_have_text("1.5 of 5 points")
    page.reload()
    expect(page.locator(".line textarea").first).to_have_value("m*l^2*dot(phi)^2")


def test_an_assignment_is_opened_from_a_file_and_by_its_link(lecture: Lecture, tmp_path: Path) -> None:
    page = _open(lecture)
    sheet = {
        "format": 1,
        "title": {"en": "Sheet 3", "de": "Blatt 3"},
        "individual": True,
        "tasks": [
            {"scene": "pendulum", "task": "lagrangian", "points": 4},
            {"scene": "atwood", "task": "kinetic-energy", "points": 2},
        ],
    }
    file = tmp_path / "sheet.json"
    file.write_text(json.dumps(sheet), encoding="utf-8")
    page.locator(".files-of-work input").set_input_files(file)
    expect(page.locator("h1")).to_have_text("Sheet 3")
    expect(page.locator(".task")).to_have_count(2)
    expect(page.locator(".total")).to_contain_text("0 of 6 points")
    expect(page.locator(".own .asks")).to_contain_text("enter your name")
    page.locator(".seed input").fill("ada")
    page.locator(".seed input").press("Enter")
    expect(page.locator(".own .asks")).to_have_count(0)
    page.locator(".task").nth(1).click()
    expect(page).to_have_url(re.compile("task=2&seed=ada#a="))
    page.goto("about:blank")
    page.go_back()
    expect(page.locator(".task[aria-current]")).to_have_text(re.compile("Kinetic energy"))


TABLE = """student,scene,task,answer,syntax,line
ada,pendulum,kinetic-energy,m*l^2*dot(phi)^2,plain,1
ada,pendulum,equation:phi,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,plain,2
emmy,pendulum,equation:phi,\\ddot\\varphi = -\\frac{g}{\\ell}\\sin\\varphi,latex,1
max,pendulum,equation:phi,l*ddot(phi) = g*sin(phi),plain,1
xen,pendulum,nonsense,1,plain,1
"""


def test_the_answers_of_a_class_are_graded_and_their_mistakes_counted(lecture: Lecture, tmp_path: Path) -> None:
    page = _open(lecture, "scene=pendulum&side=class&lang=en")
    file = tmp_path / "class.csv"
    file.write_text(TABLE, encoding="utf-8")
    page.locator(".classroom input[type=file]").set_input_files(file)
    expect(page.locator(".grading")).to_contain_text("5 of 5")
    equation = page.locator(".chart", has_text="Equation of motion")
    expect(equation).to_contain_text("1 of 3 right")
    expect(equation.locator(".mistakes tr")).to_have_text([re.compile("Sign of the weight")])
    with page.expect_download() as download:
        page.get_by_role("button", name="Save results").click()
    rows = download.value.path().read_text(encoding="utf-8").splitlines()
    assert [row.split(",")[3:7] for row in rows[1:]] == [
        ["wrong", "half-in-kinetic-energy", "0", "2"],
        ["follow_through", "", "1.5", "3"],
        ["correct", "", "3", "3"],
        ["wrong", "gravity-sign", "0", "3"],
        ["invalid", "", "0", "0"],
    ]


def test_the_tasks_of_a_scene_are_questions_for_moodle(lecture: Lecture) -> None:
    page = _open(lecture, "scene=pendulum&side=class&lang=en")
    page.locator(".task").first.wait_for()
    count = page.locator(".task").count()
    with page.expect_download() as questions:
        page.get_by_role("button", name="Questions for Moodle").click()
    quiz = questions.value.path().read_text(encoding="utf-8")
    left_out = re.findall("STACK cannot judge such answers: (.*?)-->", quiz)[0].split(",")
    assert quiz.count('type="stack"') == count - len(left_out) > 10


def test_a_sheet_is_picked_answered_handed_in_and_marked(lecture: Lecture, tmp_path: Path) -> None:
    """From the list of tasks to the points for Moodle and Canvas, by keyboard where it matters, without an editor."""
    page = _open(lecture, "scene=pendulum&side=sheet&lang=en")
    page.get_by_label("Title").fill("Sheet 1")
    for task in ("Kinetic energy", "Equation of motion"):
        page.locator(".catalogue li", has_text=task).first.get_by_role("button").press("Enter")
    page.get_by_label("Points of task 2").fill("6")
    page.get_by_label("Attempts that count").fill("2")
    page.get_by_label("Move task 2 up").press("Enter")
    link = page.get_by_label("Link for the class").input_value()
    page.goto("about:blank")
    page.goto(link)  # as a student
    expect(page.locator(".task")).to_have_text([re.compile("Equation of motion"), re.compile("Kinetic energy")])
    expect(page.locator(".total")).to_contain_text("0 of 8 points")
    _answer_as_text(page, RIGHT)
    page.get_by_role("button", name="Hand in").click()
    expect(page.get_by_role("button", name="Save file to hand in")).to_be_disabled()
    page.get_by_label("Your name").fill("Zoë, Müller")
    page.get_by_label("Number, login").fill("=77")
    with page.expect_download() as handed:
        page.get_by_role("button", name="Save file to hand in").click()
    first = json.loads(handed.value.path().read_text(encoding="utf-8"))
    other = {**first, "student": "Ada", "id": "5", "answers": [{"task": 1, "syntax": "plain", "value": FALLING}]}
    files = {
        "a": first,
        "b": other,
        "c": {**first, "sheet": "AAAA-AAAA"},
        "d": "<script>document.title = 'run'</script>",
    }
    for name, content in files.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    page.get_by_role("button", name="Class table").click()
    page.locator(".classroom input[type=file]").set_input_files([tmp_path / f"{name}.json" for name in files])
    expect(page.locator(".refusals li")).to_have_text([re.compile("c.json.+AAAA-AAAA"), re.compile("d.json")])
    expect(page.locator(".roster tbody tr")).to_have_text(
        [re.compile(r"Ada.*0 / 8", re.DOTALL), re.compile(r"Zoë, Müller.*6 / 8", re.DOTALL)]
    )
    page.get_by_label("Search").first.fill("zoë")
    expect(page.locator(".roster tbody tr")).to_have_count(1)
    page.locator(".mistakes button", has_text="Sign of the weight").first.click()
    expect(page.locator(".all-results tbody tr")).to_have_text([re.compile("Ada.*b.json", re.DOTALL)])
    with page.expect_download() as canvas:
        page.get_by_role("button", name="Points for Canvas").click()
    assert canvas.value.path().read_text(encoding="utf-8").splitlines()[2:] == [
        "\"Zoë, Müller\",,'=77,'=77,,6",
        "Ada,,5,5,,0",
    ]


OWN = {
    "format": 1,
    "id": "slider",
    "title": {"en": "Slider", "de": "Gleiter"},
    "coordinates": [{"name": "x", "unit": "m", "value": 1.0}],
    "parameters": [{"name": "m", "unit": "kg", "value": 1.0}, {"name": "k", "unit": "N/m", "value": 4.0}],
    "bodies": [{"name": "mass", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
    "loads": [{"kind": "potential", "name": "elastic", "energy": "k*x^2/2"}],
}


def test_a_scene_that_the_address_brings_along_has_tasks_too(sources: Lecture) -> None:
    page = _open(sources)
    fragment = page.evaluate("scene => import('/model/own.js').then(own => own.fragmentOf(scene))", OWN)
    page.goto("about:blank")
    page.goto(f"{sources.address}homework?lang=en&task=equation:x{fragment}")
    expect(page.locator("h1")).to_contain_text("Slider")
    _answer_as_text(page, "m*ddot(x) + k*x = 0")
    _check(page, "correct")
    page.get_by_role("button", name="Show the solution").click()
    page.get_by_role("link", name="See this step").click()
    expect(page.locator("[data-step='equation:x'][aria-current]")).to_be_visible()


def test_one_comes_from_a_scene_to_its_tasks(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}scene?scene=atwood&lang=en")
    lecture.steps.first.wait_for()
    if not page.locator(".places").is_visible():
        page.locator(".top .menu").click()
    page.locator(".places").get_by_role("link", name="Homework").click()
    expect(page.locator("h1 option:checked")).to_have_text("Atwood’s machine")
    expect(page.locator(".task").first).to_be_visible()


@pytest.mark.parametrize("language", ["de", "en"])
def test_on_a_phone(lecture: Lecture, language: str) -> None:
    lecture.page.set_viewport_size({"width": 360, "height": 740})
    page = _open(lecture, f"scene=elastic-pendulum&task=equations&lang={language}")
    page.locator(".drawing.right path.bob").wait_for(state="attached")
    _answer_as_text(page, "ddot(y) = 0", "ddot(phi) = 0")
    _check(page, "wrong")
    assert page.evaluate("document.documentElement.scrollWidth") == 360
    assert page.locator(".katex-error, .untypeset").count() == 0
    expect(page.locator(".verdict-card")).to_be_in_viewport()


def test_with_a_finger_the_keys_of_the_task_come_up_below_the_field(browser: Browser, server: str) -> None:
    context = browser.new_context(viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True)
    context.set_default_timeout(PATIENCE)
    lecture = Lecture(context.new_page(), server)
    page = _open(lecture)
    field = page.locator("math-field")
    field.wait_for()
    field.tap()
    caps = page.locator(".MLK__rows .MLK__keycap:visible")
    caps.first.wait_for()
    page.wait_for_timeout(600)
    caps.nth(2).tap()
    expect(page.locator(".understood-as .katex").first).to_be_visible()
    until_equal(page, lambda: field.evaluate("field => field.value"), r"\ddot{\varphi}")
    expect(field).to_be_in_viewport()
    caps.filter(has_text=re.compile(r"^\W*a\W*2\W*$")).tap()
    assert field.evaluate("field => field.value") == r"\ddot{\varphi}^2"
    page.set_viewport_size({"width": 740, "height": 360})  # held across, the field is still seen above the keys
    page.wait_for_timeout(600)
    field.tap()
    page.wait_for_timeout(600)
    keys, written = page.locator(".MLK__rows").first.bounding_box(), field.bounding_box()
    assert keys
    assert written
    assert written["y"] + written["height"] <= keys["y"]
    assert lecture.complaints == []
    context.close()


REFUSING = """for (const kind of ["localStorage", "sessionStorage"])
    Object.defineProperty(window, kind, {get() { throw new DOMException("", "SecurityError"); }});"""


@pytest.mark.parametrize(
    ("path", "opened"),
    [
        pytest.param("homework?scene=pendulum&lang=en", ".question h2", id="homework"),
        pytest.param("labs?lang=en", ".invitation", id="labs"),
        pytest.param("scene?scene=pendulum&lang=en&view=lecture", ".slide .step", id="lecture"),
        pytest.param("presenter?with=abcdef&lang=en", "main.presenter", id="presenter"),
        pytest.param("scene?scene=own&lang=en", "form.form", id="editor"),
    ],
)
def test_a_page_opens_where_the_browser_refuses_to_keep_anything(lecture: Lecture, path: str, opened: str) -> None:
    lecture.page.add_init_script(REFUSING)
    lecture.page.goto(lecture.address + path)
    lecture.page.locator(opened).first.wait_for()


def test_what_is_typed_and_not_kept_is_said_to_be_so(lecture: Lecture) -> None:
    lecture.page.add_init_script(REFUSING)
    page = _open(lecture)
    _answer_as_text(page, RIGHT)
    expect(page.locator(".answering .wrong")).to_contain_text("keep")


def test_a_long_answer_and_its_verdict_fit_on_a_phone(lecture: Lecture) -> None:
    page = _open(lecture, "scene=double-pendulum&task=lagrangian&lang=de")
    page.set_viewport_size({"width": 360, "height": 780})
    _answer_as_text(page, LONG)
    _check(page, "wrong")
    expect(page.locator(".marked .slip").first).to_be_visible()
    wide = "all => all.filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.className)"
    assert page.locator("main, .question, .answering, .verdict-card, .keypad").evaluate_all(wide) == []


def _orders(page: Page) -> str:
    """The letters of the blocks in order, and those left out."""
    return "".join(one.get_attribute("data-block") or "" for one in page.locator(".ordering .block").all())


def _marked_block(page: Page, mark: str) -> str | None:
    return page.locator(f".ordering .block[data-mark={mark}]").get_attribute("data-block")


def test_blocks_are_put_in_order_by_keys_by_buttons_and_by_hand(lecture: Lecture) -> None:
    page = _open(lecture, "scene=pendulum&task=order-lagrangian&lang=en")
    _check_untouched(page)
    before = _orders(page)
    page.get_by_role("button", name=re.compile("^Move down – a:")).click()
    page.keyboard.press("Alt+ArrowDown")  # at once: the block has not lost the focus by being moved
    expect(page.locator("#announcer")).to_have_text(re.compile(r"^a: .*: now number 3 of 9$"))
    expect(page.get_by_role("button", name=re.compile("^Move down – a:"))).to_be_focused()
    assert _orders(page) == before[1:3] + before[0] + before[3:]
    _check(page, "wrong")
    assert page.locator(".verdict-card").inner_text().count(f"({_marked_block(page, 'wrong')})") == 1
    page.reload()
    page.locator(".ordering .block").first.wait_for()
    assert _orders(page)[:3] == before[1:3] + before[0]
    _drag(page, before[0], before[1])
    assert _orders(page) == before
    _put_right(page, lecture.address)
    _check(page, "correct")
    expect(page.locator(".ordering[data-outcome=correct]")).to_be_visible()


def _check_untouched(page: Page) -> None:
    page.locator(".answering button.main").click()
    expect(page.locator(".notice-line").first).to_contain_text("Nothing has been moved yet")


def _drag(page: Page, block: str, onto: str) -> None:
    """By its grip to the upper edge of another one."""
    grip = page.locator(f"[data-block={block}] .grip")
    grip.scroll_into_view_if_needed()
    grip.hover()
    page.mouse.down()
    target = page.locator(f"[data-block={onto}]")
    for _ in range(3):  # what is hidden comes into view on the way
        box = at_rest(target)
        page.mouse.move(box["x"] + 20, box["y"] + 4, steps=3)
    expect(target).to_have_attribute("data-drop", "before")
    page.mouse.up()


def _put_right(page: Page, address: str) -> None:
    """As the server would have it: what does not belong is left out, and each block moved up to its place."""
    answer = page.request.post(
        f"{address}api/v1/tasks/solution", data={"scene": "pendulum", "task": "order-lagrangian"}
    )
    right = "".join(answer.json()["plain"])
    (wrong,) = set(_orders(page)) - set(right)
    for _ in range(len(right) + 1 - _orders(page).index(wrong)):
        page.locator(f"[data-block={wrong}] [data-move=down]").click()
    for place, letter in enumerate(right):
        for _ in range(_orders(page).index(letter) - place):
            page.locator(f"[data-block={letter}] [data-move=up]").click()
    assert _orders(page) == right + wrong
