"""How the answers of a class earn their points: decided here alone, for the shell, the API and the page.

- A task earns its points once. Of several answers of one person to one task the best counts, in whatever values, and
  the same right answer a second time adds nothing.
- Where the table has a column `line`, the rows of one person on one scene with a number there are a working, read in
  the order of these numbers; rows of the same number in the order of the table. What follows correctly from a wrong
  line earns the share that the assignment sets for it, half if none does; less where the mistake made it easier.
- Of a wrong answer of several parts (components, equations, frequencies) the right parts earn their share.
- A line follows from the last readable answer to each task before it. So a mistake that has been corrected carries
  nothing any more, and a wrong answer that is written again earns nothing.
- A row without a number in `line` follows from nothing, and nothing follows from it.
- Persons are told apart by the column `id`, where that is empty by `student`, without spaces around the name. A row
  that leaves both empty is nobody else's; a table that has `line` and no `student` is the working of one person.
- What was handed in at another `time` is another working. Late answers, and those beyond the attempts that are allowed,
  are marked and count by the rule of the assignment (`attempts`).
- What cannot be marked (no such task, a wrong cell) earns nothing and spoils no other row.

No SymPy here, so that the process that serves the page may keep the book while workers judge the rows.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

from ..contract.assignment import FOLLOW_THROUGH, SIMPLIFIED, USUAL, Aspect
from ..contract.base import SceneWithChanges
from ..contract.check import RowQuestion, WrittenAnswer, WrittenLine
from ..contract.reading import made_of, plain_data
from ..contract.verdict import RowVerdict
from ..language.parser import Syntax
from ..narration.prose import words
from ..vocabulary import Outcome
from .results import Graded
from .table import Style

MOST_STANDING = 24  # wrong lines that a later one is looked at beside: the latest of them
MISTAKEN = ("wrong", "follow_through")  # outcomes of lines that others may follow from

CHANGES = set(SceneWithChanges.model_fields)
T = TypeVar("T")
Document = dict[str, Any]
Working = tuple[str, str, str | None, str]  # person, scene, whose values, and when it was handed in


def standing_after(standing: Mapping[str, T], task: str, outcome: str, answer: Callable[[], T]) -> dict[str, T]:
    """The wrong answers that later lines may follow from, after one more line: by task, the latest last."""
    if outcome in MISTAKEN:
        return {name: one for name, one in standing.items() if name != task} | {task: answer()}
    if outcome == "correct":
        return {name: one for name, one in standing.items() if name != task}
    return dict(standing)


@dataclass(frozen=True)
class Shares:
    """What follows from a wrong line earns of its points, and how much of that where the mistake made it easier."""

    follow_through: float = FOLLOW_THROUGH
    simplified: float = SIMPLIFIED


def earned_share(outcome: str, remark: str, partial: float, shares: Shares) -> float:
    """The share of its points that an answer earns by itself: 1 if right; if wrong, `partial` for its right parts."""
    if outcome == "follow_through":
        easier = {"repeated": 0.0, "simplified": shares.simplified}.get(remark, 1.0)
        return shares.follow_through * easier
    return 1.0 if outcome == "correct" else partial if outcome == "wrong" else 0.0


@dataclass(frozen=True)
class Target:
    """A task that rows answer: what requests say of its scene, its id and title, and what it counts."""

    reference: SceneWithChanges
    scene: str
    task: str
    title: str
    of: float

    @cached_property
    def working(self) -> str:
        """Tasks of the same scene with the same changes may stand in one working."""
        return content_of(self.reference)


@dataclass(frozen=True)
class Row:
    """An answer in the table. `number` counts as a spreadsheet does, the header being row 1.

    `person` is whose answers it counts with, None if nobody's. `target` is the number of its task in the plan, None if
    it has none; `refused` says why it cannot be marked, and `column` where that is. `time` is when it was handed in,
    `file` in which file; `counts` is the share of its points that counts.
    """

    number: int
    student: str
    scene: str
    task: str
    answer: str
    syntax: Syntax = "plain"
    person: str | None = None
    target: int | None = None
    seed: str | None = None
    line: float | None = None
    refused: str = ""
    column: str = ""
    id: str = ""
    time: str = ""
    file: str = ""
    attempt: int = 0
    late: bool = False
    counts: float = 1.0


@dataclass(frozen=True)
class Refused:
    """A file that could not be taken, and why."""

    file: str
    why: str


@dataclass(frozen=True)
class Plan:
    """A table that has been read: its tasks, its rows, the share for what follows from a wrong line, and how it was
    written. `of` is what all tasks of the assignment count together, None where there is no assignment; `simplified` is
    how much of the share is earned where the mistake made it easier; `vary` is what differs from student to student.
    `dated` says whether it matters when and how often something was handed in, `title` what the assignment is called,
    `refused` which files could not be taken.
    """

    targets: tuple[Target, ...]
    rows: tuple[Row, ...]
    share: float = FOLLOW_THROUGH
    of: float | None = None
    style: Style = Style()
    simplified: float = SIMPLIFIED
    dated: bool = False
    title: str = ""
    refused: tuple[Refused, ...] = ()
    vary: tuple[Aspect, ...] = USUAL

    @classmethod
    def read(cls, document: Mapping[str, Any]) -> Plan:
        """The plan of a `document`, which has crossed a border as JSON."""
        return made_of(document, cls)

    @property
    def document(self) -> Document:
        """All of it as plain data."""
        found: Document = plain_data(self)
        return found

    @property
    def order(self) -> list[int]:
        """The rows as they are marked: working by working, each in the order of its lines."""
        first: dict[object, int] = {}
        for index in range(len(self.rows)):
            first.setdefault(self._together(index), index)
        return sorted(range(len(self.rows)), key=lambda n: (first[self._together(n)], self.rows[n].line or 0.0, n))

    def _together(self, index: int) -> object:
        return self.working_of(self.rows[index]) or index

    def working_of(self, row: Row) -> Working | None:
        """What names the working that a row is a line of; None if it stands alone."""
        if row.line is None or row.person is None or row.target is None or row.refused:
            return None
        return row.person, self.targets[row.target].working, row.seed, row.time


class Gradebook:
    """The points and the standing wrong answers of everybody, row by row in the order of the plan."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._shares = Shares(plan.share, plan.simplified)
        self._earned: dict[tuple[str, str, str], float] = {}
        self._standing: dict[Working, dict[str, WrittenLine]] = {}

    def question(self, row: Row) -> RowQuestion | None:
        """What is to be asked about a row (`grading.row_verdict`); None if it is refused."""
        if row.refused or row.target is None:
            return None
        target, working = self._plan.targets[row.target], self._plan.working_of(row)
        standing = self._standing.get(working, {}) if working else {}
        line = _line(target, row)
        return RowQuestion(
            **dict(target.reference),
            seed=row.seed or None,
            vary=self._plan.vary,
            task=line.task,
            answer=line.answer,
            standing=tuple(standing.values())[-MOST_STANDING:],
        )

    def enter(self, row: Row, verdict: RowVerdict) -> Graded:
        """The row with its verdict and its points."""
        target = None if row.target is None else self._plan.targets[row.target]
        of = target.of if target else 0.0
        worth = of * row.counts * earned_share(verdict.outcome, verdict.remark, verdict.share, self._shares)
        points = self._gained(row, target, worth) if target else 0.0
        self._note(row, target, verdict.outcome)
        return Graded(
            student=row.student,
            scene=target.scene if target else row.scene,
            task=target.task if target else row.task,
            points=points,
            of=of,
            answer=row.answer,
            title=target.title if target else words(row.task),  # what a student wrote is no markup
            row=row.number,
            column=row.column,
            person=row.person,
            target=row.target,
            outcome=verdict.outcome,
            misconception=verdict.misconception,
            mistake=verdict.mistake,
            understood_as=verdict.understood_as,
            feedback=verdict.feedback,
            id=row.id,
            time=row.time,
            file=row.file,
            attempt=row.attempt,
            late=row.late,
            counts=row.counts,
            worth=worth if target else 0.0,
        )

    def refuse(self, row: Row) -> Graded:
        """A row that cannot be marked, with what is told of it."""
        return self.enter(row, refusal(row.refused))

    def _gained(self, row: Row, target: Target, worth: float) -> float:
        """What an answer adds to the best one before it."""
        if row.person is None:
            return worth
        key = (row.person, target.working, target.task)
        before = self._earned.get(key, 0.0)
        self._earned[key] = max(before, worth)
        return max(0.0, worth - before)

    def _note(self, row: Row, target: Target | None, outcome: str) -> None:
        working = self._plan.working_of(row)
        if working and target:
            standing = self._standing.get(working, {})
            self._standing[working] = standing_after(standing, target.task, outcome, lambda: _line(target, row))


def refusal(told: str, outcome: Outcome = "invalid") -> RowVerdict:
    """The verdict on a row that cannot be marked: a sentence, and no more."""
    return RowVerdict(outcome=outcome, feedback=told)


def in_order(plan: Plan, graded: Mapping[int, Graded]) -> list[Graded]:
    """The marked rows in the order of the table."""
    return [graded[index] for index in range(len(plan.rows))]


def _line(target: Target, row: Row) -> WrittenLine:
    return WrittenLine(task=target.task, answer=WrittenAnswer(syntax=row.syntax, value=row.answer))


def content_of(asked: SceneWithChanges) -> str:
    """The scene with its changes, and nothing else that was asked, as a text: the same for the same."""
    return json.dumps(asked.model_dump(include=CHANGES), sort_keys=True)


def marked(plan: Plan, verdict_on: Callable[[RowQuestion], RowVerdict]) -> Iterator[tuple[int, Graded]]:
    """Every row with its place in the table, in the order in which they are marked."""
    book = Gradebook(plan)
    for index in plan.order:
        row = plan.rows[index]
        question = book.question(row)
        yield index, book.enter(row, verdict_on(question)) if question else book.refuse(row)
