"""A table of answers → a table of verdicts, and which misconceptions come up how often in which task."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from ..errors import InputError, Problem, RequestError
from ..language.parser import Syntax
from ..narration.catalog import message, text
from .assignment import AssignedTask, Assignment
from .checking import check
from .feedback import verdict_document
from .verdict import Verdict
from .workbook import workbook_of

NEEDED = ("task", "answer")
RESULT = ("student", "scene", "task", "outcome", "misconception", "points", "of", "understood_as", "feedback")
BAR = 30
SYNTAXES: Mapping[str, Syntax] = {"": "plain", "plain": "plain", "latex": "latex"}


@dataclass(frozen=True)
class Graded:
    """One row of the results."""

    student: str
    scene: str
    task: str
    outcome: str
    misconception: str
    points: float
    of: float
    understood_as: str
    feedback: str

    def row(self) -> list[object]:
        return [getattr(self, name) for name in RESULT]


def read_answers(content: str) -> list[dict[str, str]]:
    """The rows of a CSV with a header: `task` and `answer`, and `student`, `scene`, `syntax`, `seed` where wanted."""
    first = content.splitlines()[0] if content.strip() else ""
    separator = max(",;\t", key=first.count)
    reader = csv.DictReader(io.StringIO(content), delimiter=separator)
    header = [name.strip().lower() for name in reader.fieldnames or ()]
    missing = [name for name in NEEDED if name not in header]
    if missing:
        raise RequestError(Problem("answers-column", parameters={"name": missing[0], "known": ", ".join(header)}))
    return [dict(zip(header, (str(v or "") for v in row.values()), strict=False)) for row in reader]


def grade(rows: Iterable[Mapping[str, str]], assignment: Assignment | None, language: str) -> Iterator[Graded]:
    """Every row graded; one that names no scene or task says so and spoils no other."""
    for row in rows:
        try:
            yield _graded(row, assignment, language)
        except InputError as error:
            told = " ".join(message(language, problem) for problem in error.problems)
            fields = (row.get("student", ""), row.get("scene", ""), row["task"])
            yield Graded(*fields, "invalid", "", 0.0, 0.0, "", told)


def _graded(row: Mapping[str, str], assignment: Assignment | None, language: str) -> Graded:
    student, number = row.get("student", ""), row["task"].strip()
    seed, points = row.get("seed") or None, None
    if assignment is None:
        scene: Mapping[str, object] = {"scene": row.get("scene", "").strip()}
        identifier = number
    else:
        assigned = _assigned(assignment, number)
        scene, identifier, points = assigned.scene, assigned.task, assigned.points
        seed = (seed or student) if assignment.individual else seed
    workbook = workbook_of({**scene, "seed": seed})
    task = workbook.task(identifier)
    verdict = check(workbook, task, row["answer"], _syntax(row))
    told = verdict_document(verdict, workbook.scene, language)
    worth = task.quantity.points if points is None else points
    gained = worth if verdict.outcome == "correct" else 0.0
    mistake = _mistake(verdict)
    shown = (verdict.outcome, mistake, gained, worth, verdict.understood_as, str(told["feedback"]))
    return Graded(student, workbook.scene.id, task.id, *shown)


def _assigned(assignment: Assignment, number: str) -> AssignedTask:
    """The task by its number in the assignment, or by its id."""
    if number.isdecimal() and 1 <= int(number) <= len(assignment.tasks):
        return assignment.tasks[int(number) - 1]
    found = next((each for each in assignment.tasks if each.task == number), None)
    if found is None:
        known = ", ".join(each.task for each in assignment.tasks)
        raise RequestError(Problem("unknown-task", parameters={"name": number[:64], "known": known}))
    return found


def _syntax(row: Mapping[str, str]) -> Syntax:
    wanted = row.get("syntax", "").strip().lower()
    if wanted not in SYNTAXES:
        raise RequestError(Problem("answers-syntax", parameters={"name": wanted[:20]}))
    return SYNTAXES[wanted]


def _mistake(verdict: Verdict) -> str:
    if verdict.misconceptions:
        return verdict.misconceptions[0]
    return f"slip:{verdict.slip.kind}" if verdict.slip else verdict.remark if verdict.outcome == "wrong" else ""


def results_csv(graded: Iterable[Graded]) -> str:
    """The results as CSV. A cell that a spreadsheet would take for a formula is quoted."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(RESULT)
    writer.writerows([_harmless(cell) for cell in each.row()] for each in graded)
    return out.getvalue()


def _harmless(cell: object) -> object:
    return f"'{cell}" if isinstance(cell, str) and cell[:1] in ("=", "+", "-", "@", "\t", "\r") else cell


def summary(graded: Iterable[Graded], language: str) -> str:
    """By task: how many answers were right, and a bar for every mistake."""
    rows = list(graded)
    lines: list[str] = []
    for scene, task in dict.fromkeys((each.scene, each.task) for each in rows):
        own = [each for each in rows if (each.scene, each.task) == (scene, task)]
        right = sum(each.outcome == "correct" for each in own)
        lines.append(f"{scene}  {task}: {right}/{len(own)} {text(language, 'homework.summary.correct')}")
        counts = Counter(
            each.misconception or text(language, "homework.summary.other") for each in own if _failed(each)
        )
        widest = max((len(name) for name in counts), default=0)
        for name, count in counts.most_common():
            lines.append(f"  {name:<{widest}}  {'█' * max(1, round(BAR * count / len(own)))} {count}")
    return "\n".join(lines)


def _failed(each: Graded) -> bool:
    return each.outcome in ("wrong", "invalid", "undecided")
