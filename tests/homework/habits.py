"""Reads the tables of answers in students' habits: those judged by hand, and those that must never be accepted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from deltaq.homework.checking import check
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import workbook_of
from deltaq.language.parser import Syntax

TABLE = Path(__file__).with_name("habits.txt")
ADVERSARIAL = Path(__file__).with_name("adversarial.txt")
SYNTAXES: dict[str, Syntax] = {"plain": "plain", "latex": "latex"}


@dataclass(frozen=True)
class Habit:
    """One answer; `right` was decided by hand before the reader was written."""

    scene: str
    task: str
    syntax: Syntax
    answer: str
    right: bool = False
    held_out: bool = False

    def verdict(self) -> Verdict:
        """What the checker says of it."""
        workbook = workbook_of({"scene": self.scene})
        return check(workbook, workbook.task(self.task), self.answer, self.syntax)


def habits() -> Iterator[Habit]:
    """All rows of the table of habits."""
    for scene, task, row in _rows(TABLE):
        half, verdict, syntax, answer = row.split(" | ", 3)
        text = answer.replace("⏎", "\n")
        yield Habit(scene, task, SYNTAXES[syntax], text, right=verdict == "+", held_out=half == "h")


def adversarial() -> Iterator[Habit]:
    """All rows of the table of wrong answers that a generous reader might make right."""
    for scene, task, row in _rows(ADVERSARIAL):
        syntax, answer = row.split(" | ", 1)
        yield Habit(scene, task, SYNTAXES[syntax], answer)


def _rows(table: Path) -> Iterator[tuple[str, str, str]]:
    scene = task = ""
    for line in table.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            scene, task = line[1:].split("] ")
        elif line and not line.startswith("#"):
            yield scene, task, line
