"""The graded table as CSV, and totals by task and person with the most frequent mistakes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf
from operator import attrgetter
from typing import Any

from ..narration.catalog import keys, text
from ..narration.prose import plain
from .table import Style

RESULT = ("student", "scene", "task", "outcome", "misconception", "points", "of", "understood_as", "feedback", "answer")
HANDED_IN = ("id", "time", "attempt", "counts", "file")  # what follows where it matters when something was handed in
TASK = ("target", "scene", "task")  # what rows that answer the same task have in common
OUTCOMES = ("correct", "follow_through", "undecided", "wrong", "invalid")  # the best first
FAILED = ("wrong", "invalid", "undecided")
BAR = 30
PLAIN = Style()
Document = dict[str, Any]


@dataclass(frozen=True)
class Graded:
    """One row of the results.

    Beside what stands in the CSV: the title of the task, the mistake in words ("" if it has no name), the row in the
    table and the column in which it is wrong ("" if it is not), whose answers it counts with, and the number of its
    task in the plan; when it was handed in, which attempt it is, what share of its points counts, and what it is worth
    by itself.
    """

    student: str
    scene: str
    task: str
    outcome: str
    misconception: str
    points: float
    of: float
    understood_as: str
    feedback: str
    answer: str
    title: str
    mistake: str
    row: int
    column: str
    person: str | None
    target: int | None
    id: str
    time: str
    file: str
    attempt: int
    late: bool
    counts: float
    worth: float

    def cells(self, names: Iterable[str] = RESULT) -> list[object]:
        """What the CSV says of it."""
        return [getattr(self, name) for name in names]


def results_csv(graded: Iterable[Graded], style: Style = PLAIN, *, dated: bool = False) -> bytes:
    """The results as a file of CSV; `dated` ones say when each answer was handed in, and how much it counts."""
    names = (*RESULT, *HANDED_IN) if dated else RESULT
    return style.written(names, (each.cells(names) for each in graded))


def totals(graded: Sequence[Graded], of: float | None, language: str) -> Document:
    """{points, of, mistakes, tasks: [{scene, task, title, of, count, outcomes, mistakes}], students: [{student, id,
    points, of, late, beyond, answers}]}.

    `of` is what a person can earn; where it is None, that is the sum over the tasks that the person answered. `answers`
    has for each of the tasks {outcome, points} of a student's best answer, {last, last_points} of the last attempt, the
    number of `attempts` and how many were `late`; or None. `beyond` are answers beyond the attempts that are allowed.
    """
    groups = _grouped(graded, *TASK)
    by_task = groups if of is None else {key: groups[key] for key in sorted(groups, key=_place)}
    by_person = {name: rows for name, rows in _grouped(graded, "person").items() if name is not None}
    people = [_student(name, rows, of, by_task) for name, rows in by_person.items()]
    alone = sum(each.of for each in graded if each.person is None)
    return {
        "points": sum(each.points for each in graded),
        "of": sum(each["of"] for each in people) + alone,
        "mistakes": _mistakes(graded, language),
        "tasks": [_task(rows, language) for rows in by_task.values()],
        "students": [each for each in people if each["student"]],
    }


def _place(task: tuple[int | None, str, str]) -> float:
    """Tasks in the order of the assignment, then what is none of them."""
    return inf if task[0] is None else task[0]


def _grouped(graded: Iterable[Graded], *names: str) -> dict[Any, list[Graded]]:
    """The rows that agree in some fields, in their order."""
    groups: dict[Any, list[Graded]] = {}
    of = attrgetter(*names)
    for each in graded:
        groups.setdefault(of(each), []).append(each)
    return groups


def _student(name: str, rows: Sequence[Graded], of: float | None, tasks: Iterable[object]) -> Document:
    answered = _grouped(rows, *TASK)
    worth = sum(max(each.of for each in some) for some in answered.values()) if of is None else of
    answers = [_best(answered[task]) if task in answered else None for task in tasks]
    identity = next((each.id for each in rows if each.id), "")
    return {
        "student": next((each.student.strip() for each in rows if each.student.strip()), name) if identity else name,
        "id": identity,
        "points": sum(each.points for each in rows),
        "of": worth,
        "late": sum(each.late for each in rows),
        "beyond": sum(each.counts == 0.0 and not each.late for each in rows),
        "answers": answers,
    }


def _best(rows: Sequence[Graded]) -> Document:
    """What a student earned with several answers to one task, the outcome of the best that counts, and the last."""
    counting = [each for each in rows if each.counts > 0.0] or rows
    outcome = min((each.outcome for each in counting), key=OUTCOMES.index)
    last = max(enumerate(rows), key=lambda one: (one[1].attempt, one[0]))[1]
    return {
        "outcome": outcome,
        "points": sum(each.points for each in rows),
        "last": last.outcome,
        "last_points": last.worth,
        "attempts": len({each.attempt for each in rows}),
        "late": sum(each.late for each in rows),
    }


def _task(rows: Sequence[Graded], language: str) -> Document:
    first = rows[0]
    return {
        "scene": first.scene,
        "task": first.task,
        "title": first.title,
        "of": max(each.of for each in rows),
        "count": len(rows),
        "outcomes": dict(Counter(each.outcome for each in rows)),
        "mistakes": _mistakes(rows, language),
    }


def _mistakes(rows: Iterable[Graded], language: str) -> list[Document]:
    """What went wrong in one task, the most frequent first, with those who made it."""
    found: dict[tuple[str, str], list[Graded]] = {}
    for each in rows:
        if each.outcome in FAILED:
            found.setdefault((each.outcome, mistake_of(each, language)), []).append(each)
    return [
        {
            "outcome": outcome,
            "mistake": mistake,
            "count": len(some),
            "students": list(dict.fromkeys(each.student for each in some if each.student)),
        }
        for (outcome, mistake), some in sorted(found.items(), key=lambda one: -len(one[1]))
    ]


def mistake_of(each: Graded, language: str) -> str:
    """The mistake in words; misconceptions have titles, slips (`slip:sign`) kinds, the rest is told by its outcome."""
    if each.outcome in ("invalid", "undecided"):
        return text(language, f"homework.summary.{each.outcome}")
    if each.mistake or not each.misconception:
        return each.mistake or text(language, "homework.summary.other")
    return named(each.misconception, language)


def named(misconception: str, language: str) -> str:
    """The title of a misconception, a slip or a remark by its id."""
    _, is_slip, kind = misconception.partition("slip:")
    if is_slip:
        return text(language, f"homework.summary.slips.{kind}")
    if misconception in keys(language, "homework.summary.remarks"):
        return text(language, f"homework.summary.remarks.{misconception}")
    return text(language, f"homework.misconceptions.{misconception}.title")


def summary(graded: Iterable[Graded], language: str) -> str:
    """By task: how many answers were right, and a bar for every mistake."""
    lines: list[str] = []
    for each in totals(list(graded), None, language)["tasks"]:
        right = f"{each['outcomes'].get('correct', 0)}/{each['count']} {text(language, 'homework.summary.correct')}"
        lines.append(f"{each['scene']}  {each['task']}: {right}")
        lines += _bars([(plain(one["mistake"]), one["count"]) for one in each["mistakes"]], each["count"])
    return "\n".join(lines)


def _bars(counts: Sequence[tuple[str, int]], of: int) -> list[str]:
    widest = len(max((name for name, _ in counts), key=len, default=""))
    return [f"  {name:<{widest}}  {'█' * max(1, round(BAR * count / of))} {count}" for name, count in counts]
