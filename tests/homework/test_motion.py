"""The motion of an answer: a scene whose equations of motion are exactly those of the student."""

from __future__ import annotations

import pytest

from deltaq.errors import ExpressionError
from deltaq.homework.equality import equations
from deltaq.homework.motion import moved_scene
from deltaq.homework.reading import read
from deltaq.homework.statement import model_answer
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.writing import write_scene

G = "m*g*l*sin(phi)"
CASES = [
    pytest.param("pendulum", "equation:phi", "l*ddot(phi) = g*sin(phi)", ["l*ddot(phi) - g*sin(phi)"], id="sign"),
    pytest.param("pendulum", "kinetic-energy", "m*l^2*dot(phi)^2", [f"2*m*l^2*ddot(phi) + {G}"], id="from an energy"),
    pytest.param("pendulum", "lagrangian", "m*l^2*dot(phi)^2/2", ["ddot(phi)"], id="from the Lagrange function"),
    pytest.param("guided-pendulum", "equation:phi", "ddot(phi) = 0", ["ddot(phi)"], id="guided"),
    pytest.param(
        "cart-pendulum",
        "equation:phi",
        "ddot(phi) = -phi",
        ["(M + m)*ddot(x) + m*l*cos(phi)*ddot(phi) - m*l*sin(phi)*dot(phi)^2", "ddot(phi) + phi"],
        id="the other equation is the right one",
    ),
    pytest.param(
        "double-pendulum",
        "equations",
        "ddot(phi1) = -phi1; ddot(phi2) = -phi2",
        ["ddot(phi1) + phi1", "ddot(phi2) + phi2"],
        id="a set",
    ),
]


@pytest.mark.parametrize(("scene", "task", "answer", "expected"), CASES)
def test_the_scene_moves_as_the_answer_says(scene: str, task: str, answer: str, expected: list[str]) -> None:
    workbook = workbook_of({"scene": scene})
    moved = Workbook(read_scene(moved_scene(workbook, workbook.task(task), answer, "plain")))
    solution = moved.solution
    own = moved.task(f"equation:{solution.free[0]}")
    given = tuple(part for text in expected for part in read(own, solution, f"{text} = 0", "plain").parts)
    assert equations.same(given, tuple(map(solution.equation, solution.free)), solution).equal


def test_a_wrong_force_needs_no_elimination_however_many_freedoms_there_are() -> None:
    workbook = workbook_of({"scene": "chain-pendulum"})
    task = workbook.task("equation:phi4")
    right = model_answer(task, workbook)["plain"][0]
    loads = moved_scene(workbook, task, f"2*({right.removesuffix(' = 0')}) + m*g = 0", "plain")["loads"]
    assert [load["moment"] for load in loads[-1:]] == ["-m*g/2"]
    with pytest.raises(ExpressionError) as caught:
        moved_scene(workbook, task, "ddot(phi4) = 0", "plain")
    assert [problem.code for problem in caught.value.problems] == ["motion-too-large"]


def test_a_right_answer_needs_no_force() -> None:
    workbook = workbook_of({"scene": "pendulum"})
    moved = moved_scene(workbook, workbook.task("equation:phi"), "ddot(phi) = -g/l*sin(phi)", "plain")
    assert moved["loads"] == write_scene(workbook.scene)["loads"]


@pytest.mark.parametrize(
    ("task", "answer", "code"),
    [
        pytest.param("equation:phi", "sin(phi) = 0", "motion-not-solvable", id="no acceleration"),
        pytest.param("equation:phi", "ddot(phi)^2 = 1", "motion-not-solvable", id="not linear in it"),
        pytest.param("kinetic-energy", "0", "motion-not-solvable", id="no inertia"),
        pytest.param("equation:phi", "ddot(phi) = foo", "unknown-name", id="not to be read"),
        pytest.param("position:bob", "[l, 0]", "motion-not-asked", id="no motion follows"),
    ],
)
def test_what_determines_no_motion(task: str, answer: str, code: str) -> None:
    workbook = workbook_of({"scene": "pendulum"})
    with pytest.raises(ExpressionError) as caught:
        moved_scene(workbook, workbook.task(task), answer, "plain")
    assert [problem.code for problem in caught.value.problems] == [code]
