"""What Maxima says of the exported questions: the tests exported with them hold, and grades are as δq's own."""

from __future__ import annotations

from functools import cache
from xml.etree import ElementTree as ET

import pytest
from tests.homework.maxima_runner import MAXIMA, run
from tests.homework.stack_against_checks import Compared, compared, in_language

from deltaq.contract.assignment import AssignmentDocument
from deltaq.homework.stack.question import left_out, quiz, sheet_quiz
from deltaq.homework.workbook import workbook_of

pytestmark = pytest.mark.skipif(MAXIMA is None, reason="NO MAXIMA, SO QUESTIONS FOR STACK ARE NOT RUN")

ASKED = {  # a task of each form
    "pendulum": ("equation:phi", "conserved:1"),
    "double-pendulum": ("position:lower", "eigenfrequencies"),
    "cart-pendulum": ("equations", "kinetic-energy"),
}
KNOWN = {"a component too many"}  # δq drops a third component that is zero; a list of three is none of two


def questions(scene: str, language: str) -> list[ET.Element]:
    book = workbook_of({"scene": scene})
    tasks = [book.task(task) for task in ASKED[scene]]
    return ET.fromstring(quiz(book, tasks, language)).findall("question")


@pytest.mark.parametrize("language", ["en", "de"])
def test_the_tests_of_every_node_hold(language: str) -> None:
    asked = [question for scene in ASKED for question in questions(scene, language)]
    tests = [question.findall("qtest") for question in asked]
    typed = [[in_language(t.findtext("testinput/value") or "", language) for t in each] for each in tests]
    graded = run(list(zip(asked, typed, strict=True)))
    for question, each, found in zip(asked, tests, graded, strict=True):
        expected = [(t.findtext("expected/expectedscore"), t.findtext("expected/expectedanswernote")) for t in each]
        assert [(f"{one.score:.3f}", one.note) for one in found] == expected
        met = {one.note for one in found}
        assert {node.findtext("trueanswernote") for node in question.findall("prt/node")} <= met
        assert {one.score for one in found} >= {0.0, 1.0}


@cache
def grades(scene: str) -> tuple[Compared, ...]:
    book = workbook_of({"scene": scene})
    return tuple(compared(scene, [book.task(task) for task in ASKED[scene]]))


@pytest.mark.parametrize("scene", ASKED)
def test_grades_are_those_of_the_check(scene: str) -> None:
    found = [each for each in grades(scene) if each.form.how not in KNOWN]
    assert sum(each.outcome == "correct" for each in found) >= 20
    assert sum(each.outcome == "wrong" for each in found) >= 10
    assert [(each.task, each.form) for each in found if not each.alike] == []


def test_a_whole_assignment_is_one_file() -> None:
    tasks = [
        {"scene": "pendulum", "task": "equation:phi", "points": 7},
        {"scene": "cart-pendulum", "task": "equations"},
    ]
    tasks.append({"scene": "pendulum", "task": "stability:1"})
    sheet = AssignmentDocument.model_validate({"format": 1, "title": "Sheet 3/4", "tasks": tasks})
    root = ET.fromstring(sheet_quiz(sheet, "en"))
    category, *asked = root.findall("question")
    assert category.findtext("category/text") == "$course$/top/Sheet 3//4"
    assert [question.get("type") for question in asked] == ["stack", "stack"]
    assert asked[0].findtext("defaultgrade") == "7"


def test_symbols_are_listed_without_the_answer() -> None:
    """All symbols of the scene, whether the answer has them or not."""
    book = workbook_of({"scene": "double-pendulum"})
    task = book.task("momentum:phi1")
    (question,) = ET.fromstring(quiz(book, [task], "en")).findall("question")
    told = question.findtext("questiontext/text") or ""
    assert left_out([task]) == []
    for name in ("m1", "m2", "l1", "l2", "g", "phi1", "phi2"):
        assert f">{name}<" in told, name
