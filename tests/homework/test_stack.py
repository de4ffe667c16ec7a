"""The export for STACK has the structure of the questions that STACK exports, and its Maxima says what is meant."""

from __future__ import annotations

import json
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from deltaq.cli import main
from deltaq.errors import RequestError
from deltaq.homework.stack.maxima import maxima, maxima_name
from deltaq.homework.stack.question import quiz
from deltaq.homework.workbook import Workbook, workbook_of

# Elements of a question, an input and a node, in the order in which STACK writes them.
QUESTION = [
    "name",
    "questiontext",
    "generalfeedback",
    "defaultgrade",
    "penalty",
    "hidden",
    "idnumber",
    "stackversion",
    "questionvariables",
    "specificfeedback",
    "questionnote",
    "questiondescription",
    "questionsimplify",
    "assumepositive",
    "assumereal",
    "decimals",
    "scientificnotation",
    "multiplicationsign",
    "sqrtsign",
    "complexno",
    "inversetrig",
    "logicsymbol",
    "matrixparens",
    "variantsselectionseed",
    "input",
    "prt",
]
INPUT = [
    "name",
    "type",
    "tans",
    "boxsize",
    "strictsyntax",
    "insertstars",
    "syntaxhint",
    "syntaxattribute",
    "forbidwords",
    "allowwords",
    "forbidfloat",
    "requirelowestterms",
    "checkanswertype",
    "mustverify",
    "showvalidation",
    "options",
]
BRANCH = ["scoremode", "score", "penalty", "nextnode", "answernote", "feedback"]
NODE = ["name", "description", "answertest", "sans", "tans", "testoptions", "quiet"]
NODE += [f"{branch}{name}" for branch in ("true", "false") for name in BRANCH]
TREE = ["name", "value", "autosimplify", "feedbackstyle", "feedbackvariables"]
# Words, sets of positions, other integrals, orders.
NOT_COMPARED = ("equilibria", "stability", "symmetry", "steady-motion", "order-lagrangian", "order-equation")
SCENES = ["pendulum", "elastic-pendulum", "guided-pendulum"]


@pytest.fixture(scope="module", params=SCENES)
def exported(request: pytest.FixtureRequest) -> tuple[Workbook, list[ET.Element]]:
    workbook = workbook_of({"scene": request.param})
    root = ET.fromstring(quiz(workbook, workbook.tasks, "de"))
    assert root.tag == "quiz"
    return workbook, list(root)


def tags(element: ET.Element) -> list[str]:
    return [child.tag for child in element]


def content(element: ET.Element, path: str) -> str:
    return element.findtext(path) or ""


@pytest.mark.one_in(2)
def test_every_task_is_a_question_with_the_documented_elements(exported: tuple[Workbook, list]) -> None:
    workbook, questions = exported
    assert [content(question, "questionnote/text").split(", ")[1] for question in questions] == [
        task.id for task in workbook.tasks if task.quantity.kind not in NOT_COMPARED
    ]
    for question in questions:
        assert question.attrib == {"type": "stack"}
        tests = question.findall("qtest")
        assert tags(question) == QUESTION + ["qtest"] * len(tests)
        tried = {content(test, "expected/expectedanswernote") for test in tests}
        nodes = [node for node in question.findall("prt/node") if content(node, "description") != "partly"]
        assert tried >= {content(node, "trueanswernote") for node in nodes}
        assert tags(question.find("input")) == INPUT
        assert {"[[input:ans1]]", "[[validation:ans1]]"} <= set(
            re.findall(r"\[\[\w+:\w+\]\]", content(question, "questiontext/text"))
        )
        assert "[[feedback:prt1]]" in content(question, "specificfeedback/text")


def test_trees_are_connected_and_score_the_right_answer_only(exported: tuple[Workbook, list]) -> None:
    for question in exported[1]:
        tree = question.find("prt")
        nodes = tree.findall("node")
        assert tags(tree) == TREE + ["node"] * len(nodes)
        for number, node in enumerate(nodes):
            assert tags(node) == NODE
            assert content(node, "name") == str(number)
            following = -1 if number == len(nodes) - 1 else number + 1
            assert (content(node, "truenextnode"), content(node, "falsenextnode")) == ("-1", str(following))
        right = [content(node, "description") for node in nodes if content(node, "truescore") == "1"]
        assert right == ["correct"]
        notes = [content(node, name) for node in nodes for name in ("trueanswernote", "falseanswernote")]
        assert len(set(notes)) == len(notes)


def test_misconceptions_have_feedback_of_their_own(exported: tuple[Workbook, list]) -> None:
    for question in exported[1]:
        nodes = question.findall("prt/node")
        told = [content(node, "truefeedback/text") for node in nodes]
        assert all(told)
        assert "$" not in "".join(told)
    kinds = {content(node, "description") for question in exported[1] for node in question.findall("prt/node")}
    assert len(kinds) > 10


def test_maxima_is_balanced_and_knows_no_dots(exported: tuple[Workbook, list]) -> None:
    for question in exported[1]:
        texts = [node.text or "" for node in question.iter() if node.tag in ("sans", "tans")]
        for text in [*texts, content(question, "questionvariables/text")]:
            assert all(text.count(a) == text.count(b) for a, b in ("()", "[]", "{}"))
            assert "dot(" not in text
            assert "delta(" not in text


@pytest.mark.parametrize(
    ("name", "written"),
    [("phi", "phi"), ("dot(phi)", "phi_dot"), ("ddot(q)", "q_ddot"), ("delta(y)", "delta_y"), ("lambda", "lam")],
)
def test_names_that_can_be_typed(name: str, written: str) -> None:
    assert maxima_name(name) == written


def test_maxima_of_an_expression() -> None:
    workbook = workbook_of({"scene": "pendulum"})
    (energy,) = workbook.shown(workbook.task("kinetic-energy"))
    assert maxima(energy) == "l^2*m*phi_dot^2/2"


def test_what_stack_cannot_judge_is_named_in_the_export() -> None:
    workbook = workbook_of({"scene": "conical-pendulum"})
    text = quiz(workbook, workbook.tasks, "en")
    (comment,) = re.findall("<!--(.*?)-->", text)
    left_out = [task.id for task in workbook.tasks if task.quantity.kind in NOT_COMPARED]
    orders = ["order-lagrangian", "order-equation:theta"]
    assert left_out == ["equilibria", "stability:1", "stability:2", "steady-motion:psi", *orders]
    assert all(task in comment for task in left_out)
    assert text.count("<question ") == len(workbook.tasks) - len(left_out)


def test_an_export_of_nothing_that_stack_can_judge_is_refused() -> None:
    workbook = workbook_of({"scene": "pendulum"})
    with pytest.raises(RequestError) as caught:
        quiz(workbook, [workbook.task("equilibria"), workbook.task("stability:1")], "en")
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer) == ("stack-none", "/tasks")
    assert problem.parameters["tasks"] == "equilibria, stability:1"


def test_names_hold_no_tex(exported: tuple[Workbook, list]) -> None:
    for question in exported[1]:
        assert not re.search(r"[\\${}^_]", content(question, "name/text"))
    assert set("φ₂") & set("".join(content(question, "name/text") for question in exported[1]))


def test_what_can_be_typed_says_nothing_of_the_answer(exported: tuple[Workbook, list]) -> None:
    """All questions about a scene name the same coordinates, rates, accelerations and parameters."""
    workbook, questions = exported
    solution = workbook.solution
    kinds = (solution.q, solution.rate, solution.acceleration)
    named = {maxima_name(kind(q).name) for kind in kinds for q in solution.coordinates}
    named |= {maxima_name(parameter.name) for parameter in workbook.scene.parameters}
    for question in questions:
        told = content(question, "questiontext/text")
        listed = set(re.findall(r"<code>(\w+)</code>", told))
        assert listed >= named
        allowed = content(question, "input/allowwords").split(",")
        assert set(allowed) == {name for name in listed if len(name) > 2}
        for name in listed:
            assert f"texput({name}, " in content(question, "questionvariables/text")
        assert r"\dot{" in told


def test_the_decimal_sign_is_that_of_the_language() -> None:
    workbook = workbook_of({"scene": "two-mass-oscillator"})
    for language, sign, example in (("de", ",", "{a; b}"), ("en", ".", "{a, b}")):
        (question,) = ET.fromstring(quiz(workbook, [workbook.task("eigenfrequencies")], language))
        assert content(question, "decimals") == sign
        shown = re.sub(r"&#(\d+);", lambda found: chr(int(found[1])), content(question, "questiontext/text"))
        assert example in shown


SHEET = {
    "format": 1,
    "title": "Blatt 3/4: $x$",
    "tasks": [
        {"scene": "pendulum", "task": "equation:phi", "points": 5},
        {"scene": "pendulum", "task": "stability:1"},
        {"scene": "two-mass-oscillator", "task": "eigenfrequencies"},
    ],
}


def test_a_whole_assignment_is_one_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, output = tmp_path / "sheet.json", tmp_path / "sheet.xml"
    source.write_text(json.dumps(SHEET), encoding="utf-8")
    main(["export-stack", "--assignment", str(source), "--output", str(output), "--lang", "de"])
    category, *questions = ET.parse(output).getroot()
    assert (category.attrib, content(category, "category/text")) == ({"type": "category"}, "$course$/top/Blatt 3//4: x")
    told = [(content(question, "questionnote/text"), content(question, "defaultgrade")) for question in questions]
    assert told == [("pendulum, equation:phi", "5"), ("two-mass-oscillator, eigenfrequencies", "2")]
    first, second = capsys.readouterr().out.splitlines()
    assert first == f"2 → {output}"
    assert second.endswith(": stability:1")
