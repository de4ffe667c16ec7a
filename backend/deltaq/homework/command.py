"""`deltaq check answers.csv` and `deltaq export-stack`: homework without a server."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TextIO, TypeVar

from ..contract.assignment import AssignmentDocument
from ..narration.catalog import text
from .gradebook import Plan
from .grading import Sheet, grade, plan_of, read_class
from .handins import LARGEST, HandIns, handed_in
from .platforms import canvas_csv, moodle_csv
from .results import Graded, results_csv, summary, totals
from .stack.question import Asked, asked_in, left_out, quiz, sheet_quiz
from .workbook import workbook_of

WIDTH = 30
ANY_SCENE = Sheet()
T = TypeVar("T")


def check_file(
    answers: Path, output: Path, sheet: Sheet = ANY_SCENE, language: str = "en", *, screen: TextIO = sys.stderr
) -> str:
    """Grade answers into `output`: a CSV, a zip or a folder of what was handed in, or one such file. The text is the
    summary, and which files could not be taken. For an assignment the points are written beside `output` as Moodle and
    Canvas import them. Raises InputError for a wrong table.
    """
    found = _read(answers, sheet, language)
    plan = plan_of(found.table, sheet, language, found.refused)
    marked = dict(_with_progress(grade(plan, language), len(plan.rows), screen))
    graded = [marked[index] for index in range(len(plan.rows))]
    output.write_bytes(results_csv(graded, plan.style, dated=plan.dated))
    _write_points(plan, graded, output, language)
    told = [f"{one.file}: {one.why}" for one in plan.refused]
    return "\n".join([summary(graded, language), *told])


def _read(answers: Path, sheet: Sheet, language: str) -> HandIns:
    if answers.is_dir():
        files = sorted(one for one in answers.rglob("*") if one.is_file())
        return handed_in(
            [(str(one.relative_to(answers)), _beginning(one)) for one in files], sheet.assignment, language
        )
    if answers.suffix == ".json":
        return handed_in([(answers.name, _beginning(answers))], sheet.assignment, language)
    return read_class(answers.read_bytes(), sheet, language)


def _beginning(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(LARGEST + 1)


def _write_points(plan: Plan, graded: Sequence[Graded], output: Path, language: str) -> None:
    if plan.of is None:
        return
    found, title = totals(graded, plan.of, language), plan.title or text(language, "homework.platforms.title")
    output.with_name(f"{output.stem}-moodle.csv").write_bytes(moodle_csv(found, title, language))
    output.with_name(f"{output.stem}-canvas.csv").write_bytes(canvas_csv(found, plan.of, title))


def _with_progress(graded: Iterable[T], total: int, screen: TextIO) -> Iterator[T]:
    """The rows, a bar on the screen growing with them if it is a terminal."""
    shown = screen.isatty()
    for done, each in enumerate(graded, 1):
        if shown:
            filled = WIDTH * done // total
            screen.write(f"\r[{'#' * filled}{'.' * (WIDTH - filled)}] {done}/{total}")
            screen.flush()
        yield each
    if shown and total:
        screen.write("\n")


def stack_sheet(sheet: AssignmentDocument, output: Path, language: str) -> tuple[int, list[str]]:
    """Write the questions of an assignment for STACK as one file; how many, and the names of those it cannot judge."""
    output.write_text(sheet_quiz(sheet, language), encoding="utf-8")
    told = left_out(asked_in(sheet))
    return len(sheet.tasks) - len(told), told


def stack_file(scene: str, tasks: Sequence[str], output: Path, language: str) -> tuple[int, list[str]]:
    """Write questions for STACK: the named tasks of a built-in scene, all of them if none is named.

    Returns how many there are, and the names of those that STACK cannot judge.
    """
    workbook = workbook_of({"scene": scene})
    wanted = [workbook.task(task) for task in tasks] or workbook.tasks
    output.write_text(quiz(workbook, wanted, language), encoding="utf-8")
    told = left_out(Asked(workbook, task) for task in wanted)
    return len(wanted) - len(told), told
