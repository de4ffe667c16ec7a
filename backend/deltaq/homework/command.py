"""`deltaq check answers.csv` and `deltaq export-stack`: homework without a server."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TextIO, TypeVar

from .grading import Sheet, grade, read_answers
from .results import results_csv, summary
from .stack.question import quiz
from .workbook import workbook_of

WIDTH = 30
ANY_SCENE = Sheet()
T = TypeVar("T")


def check_file(
    answers: Path, output: Path, sheet: Sheet = ANY_SCENE, language: str = "en", *, screen: TextIO = sys.stderr
) -> str:
    """Grade the answers of a CSV into `output`; the text is the summary. Raises InputError for a wrong table."""
    table = read_answers(answers.read_bytes())
    marked = dict(_with_progress(grade(table, sheet, language), len(table.rows), screen))
    graded = [marked[index] for index in range(len(table.rows))]
    output.write_bytes(results_csv(graded, table.style))
    return summary(graded, language)


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


def stack_file(scene: str, tasks: Sequence[str], output: Path, language: str) -> int:
    """Write questions for STACK: the named tasks of a built-in scene, all of them if none is named; their number."""
    workbook = workbook_of({"scene": scene})
    wanted = [workbook.task(task) for task in tasks] or workbook.tasks
    output.write_text(quiz(workbook, wanted, language), encoding="utf-8")
    return len(wanted)
