"""Tables of answers: results, summary, assignments, and what is said of tables that are wrong."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from pathlib import Path

import pytest

from deltaq.cli import main
from deltaq.errors import InputError
from deltaq.homework.assignment import load_assignment, read_assignment
from deltaq.homework.command import check_file
from deltaq.homework.grading import grade, read_answers
from deltaq.homework.results import Graded, results_csv, summary
from deltaq.homework.slips import KINDS
from deltaq.homework.table import Row
from deltaq.narration.catalog import keys, text

TABLE = """student;scene;task;answer;syntax
ada;pendulum;kinetic-energy;m*l^2*dot(phi)^2/2;
emmy;pendulum;kinetic-energy;m*l^2*dot(phi)^2;plain
max;pendulum;kinetic-energy;\\frac{1}{2} m\\ell^2\\dot\\varphi^2;latex
zoe;pendulum;lagrange;1;
"""


def rows_of(content: str) -> Sequence[Row]:
    return read_answers(content.encode()).rows


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_rows_are_graded_and_one_spoils_no_other() -> None:
    graded = list(grade(rows_of(TABLE), None, "en"))
    assert [each.outcome for each in graded] == ["correct", "wrong", "correct", "invalid"]
    assert [each.misconception for each in graded] == ["", "half-in-kinetic-energy", "", ""]
    assert [(each.points, each.of) for each in graded[:2]] == [(2.0, 2.0), (0.0, 2.0)]
    assert "lagrangian" in graded[3].feedback


def test_summary_counts_misconceptions_by_task() -> None:
    told = summary(grade(rows_of(TABLE), None, "en"), "en")
    assert "pendulum  kinetic-energy: 2/3 right" in told
    title = text("en", "homework.misconceptions.half-in-kinetic-energy.title")
    assert any(line.strip().startswith(f"{title}  █") for line in told.splitlines())
    assert any(line.strip().startswith("not readable  █") for line in told.splitlines())


@pytest.mark.parametrize("language", ["en", "de"])
def test_every_mistake_has_a_name_in_the_summary(language: str) -> None:
    kinds = [*keys(language, "homework.misconceptions"), *(f"slip:{kind}" for kind in KINDS), ""]
    rows = [Graded("", "pendulum", "t", "wrong", kind, 0.0, 1.0, "", "", "") for kind in kinds]
    assert len(summary(rows, language).splitlines()) == 1 + len(kinds)


def test_results_hold_no_formulas_of_spreadsheets() -> None:
    content = "student,scene,task,answer\n=HYPERLINK(1),pendulum,kinetic-energy,+m\n"
    (_, row) = results_csv(grade(rows_of(content), None, "en")).decode().splitlines()
    assert row.startswith("'=HYPERLINK(1),")
    assert row.endswith(",'+m")


def test_results_are_written_as_the_answers_were(tmp_path: Path) -> None:
    """A spreadsheet set to German: semicolons, commas in numbers, and umlauts in an encoding of its own."""
    answers, results = tmp_path / "answers.csv", tmp_path / "results.csv"
    header, row = "student;scene;task;answer", "Jürgen;pendulum;kinetic-energy;m*l^2*dot(phi)^2/2"
    answers.write_bytes(f"{header}\r\n{row}\r\n;;;\r\n".encode("cp1252"))
    check_file(answers, results, language="de")
    mark, (_, row) = results.read_bytes()[:3], results.read_text(encoding="utf-8-sig").splitlines()
    assert mark == b"\xef\xbb\xbf"
    formula = r"\frac{1}{2} m \ell^{2} \dot{\varphi}^{2}"
    assert row == f"Jürgen;pendulum;kinetic-energy;correct;;2;2;{formula};Richtig.;m*l^2*dot(phi)^2/2"


def test_a_cell_too_many_is_told() -> None:
    """A comma inside an answer without quotes: half of the answer must not be graded for the whole."""
    content = "scene,task,answer,syntax\npendulum,kinetic-energy,9{,}81 m,latex\n"
    (graded,) = grade(rows_of(content), None, "en")
    told = "This row has more cells than the header: “latex” belongs to no column."
    assert (graded.outcome, graded.answer) == ("invalid", "9{")
    assert graded.feedback == f"{told} An answer that contains a separator must stand in quotes."


@pytest.mark.parametrize(
    ("content", "code"),
    [
        pytest.param("", "answers-column", id="nothing"),
        pytest.param("a,b\n1,2\n", "answers-column", id="other columns"),
        pytest.param("task\nx\n", "answers-column", id="no answers"),
        pytest.param("task,answer\n,\n", "answers-none", id="no rows"),
    ],
)
def test_table_without_its_columns(content: str, code: str) -> None:
    with pytest.raises(InputError) as caught:
        read_answers(content.encode())
    assert [problem.code for problem in caught.value.problems] == [code]


def test_command_writes_results_and_shows_progress(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answers = tmp_path / "answers.csv"
    answers.write_text(TABLE, encoding="utf-8-sig")
    screen = Terminal()
    check_file(answers, tmp_path / "out.csv", screen=screen)
    assert screen.getvalue().endswith("4/4\n")
    assert main(["check", str(answers), "--lang", "de"]) == 0
    assert "2/3 richtig" in capsys.readouterr().out
    rows = (tmp_path / "answers-results.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 5


def test_command_says_what_is_wrong(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answers = tmp_path / "answers.csv"
    answers.write_text("a,b\n", encoding="utf-8")
    assert main(["check", str(answers)]) == 2
    assert capsys.readouterr().err == "deltaq: The table has no column “task”. It has: a, b.\n"
    assert main(["check", str(tmp_path / "missing.csv")]) == 2
    assert main(["export-stack", "pendulun", "--output", str(tmp_path / "x.xml")]) == 2
    assert main(["export-stack", "pendulum", "equation:phi", "--output", str(tmp_path / "x.xml")]) == 0
    assert (tmp_path / "x.xml").read_text(encoding="utf-8").count("<question ") == 1


SHEET = """
format = 1
title = { de = "Blatt 1", en = "Sheet 1" }
individual = true
[[tasks]]
scene = "pendulum"
task = "equation:phi"
points = 5
[[tasks]]
scene = "base-pendulum"
guides = [{ coordinate = "y", value = "0.1*sin(3*t)" }]
task = "kinetic-energy"
"""


def test_assignment_names_tasks_by_number_and_counts_their_points(tmp_path: Path) -> None:
    path = tmp_path / "sheet.toml"
    path.write_text(SHEET, encoding="utf-8-sig")
    sheet = load_assignment(path)
    rows = [{"student": "ada", "task": "1", "answer": "ddot(phi) = -g/l*sin(phi)"}, {"task": "3", "answer": "1"}]
    graded = list(grade(rows, sheet, "en"))
    assert [(each.outcome, each.points, each.of) for each in graded] == [("correct", 5.0, 5.0), ("invalid", 0.0, 0.0)]
    assert [task.points for task in sheet.tasks] == [5.0, None]


@pytest.mark.parametrize(
    ("document", "problems"),
    [
        pytest.param([], [("", "request-not-object")], id="list"),
        pytest.param({"format": 1}, [("/tasks", "assignment-no-task")], id="no task"),
        pytest.param(
            {"format": 2, "tasks": [{}], "ex/tra": 1, "follow_through": 3},
            [
                ("/format", "assignment-format"),
                ("/ex~1tra", "unknown-field"),
                ("/follow_through", "assignment-share"),
                ("/tasks/0/scene", "missing-field"),
                ("/tasks/0/task", "missing-field"),
            ],
            id="several at once",
        ),
        *(
            pytest.param(
                {"format": 1, "tasks": [{"scene": "pendulum", "task": "lagrangian", "points": points}]},
                [("/tasks/0/points", "request-not-number")],
                id=f"points {name}",
            )
            for name, points in (("no number", "3"), ("not finite", math.nan), ("beyond all numbers", 10**400))
        ),
        pytest.param(
            {"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:psi"}]},
            [("/tasks/0/task", "unknown-task")],
            id="unknown task",
        ),
        pytest.param(
            {"format": 1, "tasks": [{"scene": "none", "task": "lagrangian"}]},
            [("/tasks/0/scene", "unknown-scene")],
            id="unknown scene",
        ),
    ],
)
def test_wrong_assignment(document: object, problems: list[tuple[str, str]]) -> None:
    with pytest.raises(InputError) as caught:
        read_assignment(document)
    assert [(problem.pointer, problem.code) for problem in caught.value.problems] == problems


@pytest.mark.parametrize("content", [b"tasks = [", '# "Blätter"'.encode("cp1252")], ids=["syntax", "encoding"])
def test_assignment_that_is_no_toml(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "sheet.toml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        load_assignment(path)
    assert [problem.code for problem in caught.value.problems] == ["assignment-syntax"]


WORKING = """student,task,answer,line
ada,2,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,2
emmy,2,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,1
ada,1,m*l^2*dot(phi)^2,1
ada,2,2*l*ddot(phi) + g*sin(phi) = 0,3
ada,9,1,4
"""
TWO_TASKS = {
    "format": 1,
    "follow_through": 0.25,
    "tasks": [
        {"scene": "pendulum", "task": "kinetic-energy", "points": 2},
        {"scene": "pendulum", "task": "equation:phi", "points": 4},
    ],
}


def test_rows_of_a_student_are_a_working_in_the_order_of_their_lines() -> None:
    graded = list(grade(rows_of(WORKING), read_assignment(TWO_TASKS), "en"))
    assert [(each.student, each.outcome, each.points) for each in graded] == [
        ("ada", "follow_through", 1.0),
        ("emmy", "wrong", 0.0),
        ("ada", "wrong", 0.0),
        ("ada", "follow_through", 0.0),  # the task has earned its points already
        ("ada", "invalid", 0.0),
    ]


def test_without_the_column_every_row_stands_alone() -> None:
    rows = [{key: value for key, value in row.items() if key != "line"} for row in rows_of(WORKING)]
    outcomes = [each.outcome for each in grade(rows, read_assignment(TWO_TASKS), "en")]
    assert outcomes == ["wrong", "wrong", "wrong", "wrong", "invalid"]
