"""What Maxima says of the exported questions: the tests exported with them hold, and grades are as δq's own.

All forms of all tasks of all scenes by hand: `python -m tests.homework.stack_against_checks`.
"""

from __future__ import annotations

from xml.etree import ElementTree as ET

import pytest
from tests.homework.maxima_runner import MAXIMA, run
from tests.homework.stack_against_checks import compared

from deltaq.homework.stack.question import quiz
from deltaq.homework.workbook import workbook_of

pytestmark = pytest.mark.skipif(MAXIMA is None, reason="NO MAXIMA (Debian: maxima), SO QUESTIONS FOR STACK ARE NOT RUN")

ASKED = [  # a task of each form and of each kind of equality
    ("cart-pendulum", "position:cart"),
    ("pendulum", "potential-energy"),
    ("pendulum", "lagrangian"),
    ("pendulum", "conserved:1"),
    ("spherical-pendulum", "equation:theta"),
    ("two-mass-oscillator", "equations"),
    ("two-mass-oscillator", "eigenfrequencies"),
    ("pendulum-with-moment", "eigenfrequencies"),
]
FEW = 3


def exported(language: str) -> list[ET.Element]:
    found: list[ET.Element] = []
    for scene, task in ASKED:
        book = workbook_of({"scene": scene})
        found += ET.fromstring(quiz(book, [book.task(task)], language))
    return found


def test_the_tests_of_every_node_hold() -> None:
    """STACK reads tests in Maxima's syntax where students type decimal commas, too."""
    asked = exported("de")
    tests = [question.findall("qtest") for question in asked]
    typed = [[test.findtext("testinput/value") or "" for test in each] for each in tests]
    graded = run(list(zip(asked, typed, strict=True)))
    for question, each, found in zip(asked, tests, graded, strict=True):
        told = ("expectedscore", "expectedanswernote", "expectedpenalty")
        expected = [tuple(test.findtext(f"expected/{name}") for name in told) for test in each]
        assert [(f"{one.score:.3f}", one.note, one.penalty) for one in found] == expected
        met = {one.note for one in found}
        assert {node.findtext("trueanswernote") for node in question.findall("prt/node")} <= met
        assert {one.score for one in found} >= {0.0, 1.0}


@pytest.mark.parametrize(("scene", "task"), ASKED)
def test_grades_are_those_of_the_check(scene: str, task: str) -> None:
    book = workbook_of({"scene": scene})
    found = list(compared(scene, [book.task(task)], right_ones=FEW, wrong_ones=FEW))
    assert sum(each.outcome == "correct" for each in found) >= FEW
    assert sum(each.outcome == "wrong" for each in found) >= FEW
    assert [each for each in found if not each.alike] == []
