"""Tables of answers: results, summary, assignments, and what is said of tables that are wrong."""

from __future__ import annotations

import io
import re
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import pytest

from deltaq.cli import main
from deltaq.commands import check
from deltaq.contract.check import TableRequest
from deltaq.contract.table import COLUMNS
from deltaq.errors import InputError
from deltaq.homework.assignment import load_assignment, read_assignment
from deltaq.homework.command import check_file
from deltaq.homework.grading import MOST_ROWS, Sheet, grade, plan_of, read_answers
from deltaq.homework.results import Graded, results_csv, summary, totals
from deltaq.narration.catalog import keys, text
from deltaq.vocabulary import SlipKind

TABLE = """student;scene;task;answer;syntax
ada;pendulum;kinetic-energy;m*l^2*dot(phi)^2/2;
emmy;pendulum;kinetic-energy;m*l^2*dot(phi)^2;plain
max;pendulum;kinetic-energy;\\frac{1}{2} m\\ell^2\\dot\\varphi^2;latex
zoe;pendulum;lagrange;1;
"""


def graded_rows(content: str, assignment: object = None, language: str = "en", scene: object = "") -> list[Graded]:
    """The rows of a table as the shell marks them, in the order of the table."""
    sheet = Sheet(None if assignment is None else read_assignment(assignment), scene)
    found = dict(grade(plan_of(read_answers(content.encode()), sheet, language), language))
    return [found[index] for index in range(len(found))]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_rows_are_graded_and_one_spoils_no_other() -> None:
    graded = graded_rows(TABLE)
    assert [each.outcome for each in graded] == ["correct", "wrong", "correct", "invalid"]
    assert [each.misconception for each in graded] == ["", "half-in-kinetic-energy", "", ""]
    assert [(each.points, each.of) for each in graded[:2]] == [(2.0, 2.0), (0.0, 2.0)]
    assert "lagrangian" in graded[3].feedback


def test_summary_counts_misconceptions_by_task() -> None:
    told = summary(graded_rows(TABLE), "en")
    assert "pendulum  kinetic-energy: 2/3 right" in told
    title = text("en", "homework.misconceptions.half-in-kinetic-energy.title")
    assert any(line.strip().startswith(f"{title}  █") for line in told.splitlines())
    assert any(line.strip().startswith("not readable  █") for line in told.splitlines())


@pytest.mark.parametrize("language", ["en", "de"])
def test_every_mistake_has_a_name_in_the_summary(language: str) -> None:
    kinds = [*keys(language, "homework.misconceptions"), *(f"slip:{kind}" for kind in get_args(SlipKind)), ""]
    wrong = graded_rows(TABLE)[1]
    rows = [replace(wrong, misconception=kind, mistake="") for kind in kinds]
    assert len(summary(rows, language).splitlines()) == 1 + len(kinds)


def test_results_hold_no_formulas_of_spreadsheets() -> None:
    content = "student,scene,task,answer\n=HYPERLINK(1),pendulum,kinetic-energy,+m\n"
    (_, row) = results_csv(graded_rows(content)).decode().splitlines()
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
    (graded,) = graded_rows(content)
    told = "This row has more cells than the header: “latex” belongs to no column."
    assert (graded.outcome, graded.answer) == ("invalid", "9{")
    assert graded.feedback == f"{told} An answer that contains a separator must stand in quotes."


@pytest.mark.parametrize(
    ("content", "code", "parameters"),
    [
        pytest.param("", "answers-column", {"name": "task", "known": ""}, id="nothing"),
        pytest.param("a,b\n1,2\n", "answers-column", {"name": "task", "known": "a, b"}, id="other columns"),
        pytest.param("task\nx\n", "answers-column", {"name": "answer", "known": "task"}, id="no answers"),
        pytest.param("task,answer\n,\n", "answers-none", {}, id="no rows"),
        pytest.param(
            "line,task,answer,Line,Answer\n1,2,3,4,5\n", "answers-column-twice", {"name": "answer"}, id="columns twice"
        ),
        pytest.param(
            "task,answer\n" + "1,2\n" * (MOST_ROWS + 1),
            "answers-many",
            {"count": 20_001, "most": 20_000},
            id="too many rows",
        ),
        pytest.param('task,answer\n1,"2\n3,4\n', "answers-quote", {"row": 2}, id="a quote that is never closed"),
        pytest.param(f"task,answer\n1,{'x' * 200_000}\n", "answers-cell", {"row": 2}, id="a cell beyond all bounds"),
    ],
)
def test_a_table_that_cannot_be_marked(content: str, code: str, parameters: dict[str, object]) -> None:
    with pytest.raises(InputError) as caught:
        read_answers(content.encode())
    assert [(problem.code, dict(problem.parameters)) for problem in caught.value.problems] == [(code, parameters)]


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
    table = read_answers(b"student,task,answer\nada,1,ddot(phi) = -g/l*sin(phi)\n,3,1\n")
    graded = [each for _, each in grade(plan_of(table, Sheet(sheet), "en"), "en")]
    assert [(each.outcome, each.points, each.of) for each in graded] == [("correct", 5.0, 5.0), ("invalid", 0.0, 0.0)]
    assert [task.points for task in sheet.tasks] == [5.0, None]


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
    graded = graded_rows(WORKING, TWO_TASKS)
    assert [(each.student, each.outcome, each.points) for each in graded] == [
        ("ada", "follow_through", 1.0),
        ("emmy", "wrong", 0.0),
        ("ada", "wrong", 0.0),
        ("ada", "follow_through", 0.0),  # the task has earned its points already
        ("ada", "invalid", 0.0),
    ]


def test_without_the_column_nothing_follows() -> None:
    content = "\n".join(line.rsplit(",", 1)[0] for line in WORKING.splitlines())
    assert [each.outcome for each in graded_rows(content, TWO_TASKS)] == ["wrong", "wrong", "wrong", "wrong", "invalid"]


# Answers to the pendulum's tasks (2 and 3 points): right, wrong in T, and what follows from that T.
T, DOUBLE_T = "m*l^2*dot(phi)^2/2", "m*l^2*dot(phi)^2"
RIGHT, FROM_T = "m*l^2*ddot(phi) + m*g*l*sin(phi) = 0", "2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0"
KINETIC, EQUATION = "kinetic-energy", "equation:phi"
Lines = list[tuple[str, str, str]]  # student, task, answer; the line is the number in the list


def earned(rows: Lines, *, lines: str = "", students: bool = True) -> list[float]:
    """The points of the rows; `lines` is what stands in the column of this name, if there is one."""
    header = ["scene,task,answer", *(["student"] if students else []), *(["line"] if lines else [])]
    numbers = lines.split("|") if lines else [""] * len(rows)
    written = [
        ",".join(["pendulum", task, answer, *([student] if students else []), *([number] if lines else [])])
        for (student, task, answer), number in zip(rows, numbers, strict=True)
    ]
    return [each.points for each in graded_rows("\n".join([",".join(header), *written]))]


CORRECTED: Lines = [("ada", KINETIC, DOUBLE_T), ("ada", KINETIC, T), ("ada", EQUATION, FROM_T)]
TWICE: Lines = [("ada", KINETIC, T), ("ada", KINETIC, DOUBLE_T), ("ada", KINETIC, f"{T} + 0")]
AGAIN: Lines = [("ada", KINETIC, DOUBLE_T), ("ada", KINETIC, f"{DOUBLE_T} + 0")]
NAMELESS: Lines = [("", KINETIC, T), ("", KINETIC, T)]
FOLLOWS: Lines = [("ada", KINETIC, DOUBLE_T), ("ada", EQUATION, FROM_T), ("ada", EQUATION, RIGHT)]


@pytest.mark.parametrize(
    ("rows", "more", "points"),
    [
        pytest.param(CORRECTED, {"lines": "1|2|3"}, [0, 2, 0], id="what was corrected carries nothing"),
        pytest.param(CORRECTED, {"lines": "1|3|2"}, [0, 2, 1.5], id="what follows before it is corrected"),
        pytest.param(CORRECTED, {"lines": "1|1|1"}, [0, 2, 0], id="the same number: the order of the table"),
        pytest.param(CORRECTED, {"lines": "1|2|"}, [0, 2, 0], id="a row without a number follows from nothing"),
        pytest.param(FOLLOWS, {"lines": "|2|3"}, [0, 0, 3], id="from a row without a number nothing follows"),
        pytest.param(FOLLOWS, {"lines": "1|2|3"}, [0, 1.5, 1.5], id="the better answer adds what is missing"),
        pytest.param(AGAIN, {"lines": "1|2"}, [0, 0], id="a wrong answer written again earns nothing"),
        pytest.param(TWICE, {}, [2, 0, 0], id="twice right counts once"),
        pytest.param(TWICE, {"lines": "1|2|3"}, [2, 0, 0], id="twice right in a working counts once"),
        pytest.param(TWICE, {"lines": "||"}, [2, 0, 0], id="twice right without numbers counts once"),
        pytest.param(NAMELESS, {}, [2, 2], id="rows without a name are of different persons"),
        pytest.param(NAMELESS, {"lines": "1|2"}, [2, 2], id="rows without a name are no working"),
        pytest.param(NAMELESS, {"students": False}, [2, 2], id="no column student: of different persons"),
        pytest.param(CORRECTED, {"lines": "1|3|2", "students": False}, [0, 2, 1.5], id="lines alone: one working"),
        pytest.param(
            [("Zoë ", KINETIC, T), (" Zoe\u0308", KINETIC, T)], {}, [2, 0], id="a name with spaces, and decomposed"
        ),
    ],
)
def test_how_points_are_earned(rows: Lines, more: dict[str, Any], points: list[float]) -> None:
    assert earned(rows, **more) == points


def test_a_task_in_other_values_is_the_same_task() -> None:
    content = f"student,scene,task,answer,seed\nada,pendulum,{KINETIC},{T},a\nada,pendulum,{KINETIC},{T},b\n"
    assert [each.points for each in graded_rows(content)] == [2.0, 0.0]


TWO_PENDULUMS = {
    "format": 1,
    "tasks": [
        {"scene": "pendulum", "task": KINETIC, "points": 2},
        {"scene": "elastic-pendulum", "task": KINETIC, "points": 4},
    ],
}


def test_a_task_of_several_scenes_is_named_by_its_number_or_with_its_scene() -> None:
    content = f"student,scene,task,answer\nada,,{KINETIC},{T}\nada,pendulum,{KINETIC},{T}\nbob,,1,{T}\n"
    found = graded_rows(content, TWO_PENDULUMS)
    assert [(each.outcome, each.points, each.of, each.column) for each in found] == [
        ("invalid", 0.0, 0.0, "task"),
        ("correct", 2.0, 2.0, ""),
        ("correct", 2.0, 2.0, ""),
    ]
    assert "1 (pendulum), 2 (elastic-pendulum)" in found[0].feedback


@pytest.mark.parametrize(
    ("row", "column", "of"),
    [
        pytest.param("pendulum,nonsense,1,,", "task", 0, id="task"),
        pytest.param("swing,kinetic-energy,1,,", "scene", 0, id="scene"),
        pytest.param("pendulum,kinetic-energy,1,word,", "syntax", 2, id="syntax"),
        pytest.param("pendulum,kinetic-energy,1,,first", "line", 2, id="line"),
        pytest.param("pendulum,kinetic-energy,1,,nan", "line", 2, id="no number at all"),
        pytest.param("pendulum,kinetic-energy,1,,,x", "answer", 2, id="a cell too many"),
    ],
)
def test_a_row_that_makes_no_sense_is_told_at_its_place(row: str, column: str, of: float) -> None:
    content = f"scene,task,answer,syntax,line\n\npendulum,kinetic-energy,{T},,\n{row}\n"
    good, bad = graded_rows(content)
    assert (good.row, good.column, good.outcome) == (3, "", "correct")
    assert (bad.row, bad.column, bad.outcome, bad.points, bad.of) == (4, column, "invalid", 0.0, of)


def test_a_row_that_names_no_scene_is_of_the_scene_around() -> None:
    (found,) = graded_rows(f"task,answer\n{KINETIC},{T}\n", scene="pendulum")
    assert (found.scene, found.outcome) == ("pendulum", "correct")


def test_totals_by_task_and_by_student() -> None:
    content = f"student,task,answer\nada,1,{T}\nada,2,{FROM_T}\nbob,1,{DOUBLE_T}\nbob,1,{T}\nada,1,{T}\n"
    told = totals(graded_rows(content, TWO_TASKS), 6.0, "en")
    names = ("outcome", "points", "last", "attempts")
    assert [
        (
            one["student"],
            one["points"],
            one["of"],
            [each and tuple(each[name] for name in names) for each in one["answers"]],
        )
        for one in told["students"]
    ] == [
        ("ada", 2.0, 6.0, [("correct", 2.0, "correct", 1), ("wrong", 0.0, "wrong", 1)]),
        ("bob", 2.0, 6.0, [("correct", 2.0, "correct", 2), None]),
    ]
    assert (told["points"], told["of"]) == (4.0, 12.0)
    first, second = told["tasks"]
    assert (first["count"], first["outcomes"]) == (4, {"correct": 3, "wrong": 1})
    assert first["mistakes"] == [
        {"outcome": "wrong", "mistake": "Factor of the kinetic energy", "count": 1, "students": ["bob"]}
    ]
    assert second["outcomes"] == {"wrong": 1}


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_wrong_answer_that_says_nothing_has_a_name(language: str) -> None:
    found = graded_rows(f"scene,task,answer\npendulum,{EQUATION},0 = 0\n", language=language)
    assert found[0].misconception == "degenerate"
    assert text(language, "homework.summary.remarks.degenerate") in summary(found, language)


HEAD = "student,scene,task,answer\n"


def test_a_table_may_be_so_long() -> None:
    row = "ada,pendulum,equation:phi,0\n"
    assert len(read_answers((HEAD + row * 20_000).encode()).rows) == 20_000


@pytest.mark.parametrize("individual", [False, True])
def test_everybody_has_the_same_values_unless_the_assignment_says_otherwise(individual: bool) -> None:
    """√(g/l) at the scene's values, for g = 9.81 and l = 1."""
    sheet = {"format": 1, "individual": individual, "tasks": [{"scene": "pendulum", "task": "eigenfrequencies"}]}
    (graded,) = graded_rows("student,task,answer\nada,1,3.13209\n", sheet)
    assert (graded.outcome == "correct") is not individual


@pytest.mark.parametrize(
    ("column", "shown"), [pytest.param("line", 20, id="line"), pytest.param("syntax", 20, id="syntax")]
)
def test_an_endless_cell_is_shown_by_its_beginning(column: str, shown: int) -> None:
    (graded,) = graded_rows(f"{HEAD.strip()},{column}\nada,pendulum,equation:phi,0,{'z' * 60}\n")
    assert "z" * shown in graded.feedback
    assert "z" * (shown + 1) not in graded.feedback


def test_every_column_is_named_where_tables_are_asked_for() -> None:
    asked = str(TableRequest.model_fields["table"].description), check.DESCRIPTION
    assert [name for name in COLUMNS for text in asked if not re.search(rf"\b{name}\b", text)] == []
