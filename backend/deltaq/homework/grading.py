"""A table of answers → a table of verdicts: reading the table, judging one row, and both in one process.

How the rows earn their points, and which follow from which, is told and decided in `gradebook`.
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

from ..contract.assignment import LONGEST_TIME, USUAL, AssignedTaskDocument, AssignmentDocument, instant
from ..contract.base import SceneWithChanges
from ..contract.check import RowQuestion
from ..contract.reading import read as read_request
from ..contract.table import COLUMNS, NEEDED, TableRow
from ..contract.verdict import RowVerdict
from ..errors import InputError, Problem, RequestError, UnknownNameError
from ..language.parser import Syntax
from ..mechanics.user_text import in_language, translated
from ..narration.catalog import language_of, message
from .assignment import resolved, scene_of
from .attempts import counted
from .feedback import verdict_document
from .gradebook import Document, Plan, Refused, Row, Shares, Target, marked, refusal
from .handins import HandIns, archived, handed_in, is_archive
from .results import Graded, named
from .statement import task_document
from .table import BEYOND, Table, read_table
from .verdict import Verdict
from .workbook import Workbook, workbook_asked_about, workbook_asked_by
from .working import check_following, line_of, parts_of

SYNTAXES: Mapping[str, Syntax] = {"": "plain", "plain": "plain", "latex": "latex"}
HANDED_IN = {"id", "time", "file"}  # columns that say when and by whom something was handed in
NUMBER = re.compile(r"-?[0-9]{1,9}([.,][0-9]{1,9})?")
MOST_ROWS = 20_000


def read_answers(data: bytes) -> Table:
    """The table of a file with the columns of a TableRow, the first two at least.

    Raises RequestError with the column or the row that is wrong.
    """
    table = read_table(data)
    missing = [name for name in NEEDED if name not in table.header]
    if missing:
        raise RequestError(Problem("answers-column", parameters={"name": missing[0], "known": ", ".join(table.header)}))
    twice = [name for name in COLUMNS if table.header.count(name) > 1]
    if twice:
        raise RequestError(Problem("answers-column-twice", parameters={"name": twice[0]}))
    if not table.rows:
        raise RequestError(Problem("answers-none"))
    return _bounded(table)


def _bounded(table: Table) -> Table:
    if len(table.rows) > MOST_ROWS:
        raise RequestError(Problem("answers-many", parameters={"count": len(table.rows), "most": MOST_ROWS}))
    return table


def read_class(data: bytes, sheet: Sheet, language: str) -> HandIns:
    """The answers of a class: a table, or a zip of what was handed in. Raises RequestError with what is wrong."""
    if not is_archive(data):
        return HandIns(read_answers(data), ())
    found = handed_in(archived(data), sheet.assignment, language)
    _bounded(found.table)
    return found


def grade(plan: Plan, language: str) -> Iterator[tuple[int, Graded]]:
    """Every row with its place in the table, as it is marked: in this process, without bounds of time.

    What many students wrote is judged once.
    """
    known: dict[str, RowVerdict] = {}

    def verdict_on(question: RowQuestion) -> RowVerdict:
        asked = question.model_dump() | {"lang": language}
        key = json.dumps(asked)
        if key not in known:
            known[key] = RowVerdict.model_validate(row_verdict(asked))
        return known[key]

    return marked(plan, verdict_on)


# --- a table as a plan -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Sheet:
    """What the rows may answer: the tasks of an assignment; without one those of any scene, and of `scene` where a row
    names none (an id, or a document).
    """

    assignment: AssignmentDocument | None = None
    scene: object = ""


class WrongCell(Exception):
    """A row that cannot be marked, and in which column that is."""

    def __init__(self, column: str, error: InputError) -> None:
        super().__init__(column, error)
        self.column = column
        self.error = error


def plan_of(table: Table, sheet: Sheet, language: str, refused: tuple[Refused, ...] = ()) -> Plan:
    """The rows with the tasks that they answer; what is wrong with a row is told in it, and spoils no other."""
    tasks = _Tasks(sheet, language)
    rows = tuple(
        _row(number, cells, tasks, table.header) for number, cells in zip(table.numbers, table.rows, strict=True)
    )
    asked = sheet.assignment
    shares = Shares() if asked is None else Shares(asked.follow_through, asked.simplified)
    return Plan(
        tuple(tasks.targets),
        counted(rows, tasks.targets, asked),
        shares.follow_through,
        tasks.points,
        table.style,
        shares.simplified,
        vary=USUAL if asked is None else asked.vary,
        dated=bool(HANDED_IN & set(table.header)) or (asked is not None and bool(asked.deadline or asked.attempts)),
        title=in_language(translated(asked.title), language).line if asked else "",
        refused=refused,
    )


def _row(number: int, cells: Mapping[str, str], tasks: _Tasks, header: Sequence[str]) -> Row:
    """The row as a question, as far as it goes until something is wrong."""
    given = TableRow(**{name: cells[name] for name in COLUMNS if name in cells})
    row = Row(
        number,
        given.student,
        given.scene,
        given.task,
        given.answer,
        person=_person(given.id.strip() or given.student, header),
        id=given.id.strip(),
        file=given.file,
    )
    try:
        target = tasks.number(given.task.strip(), given.scene.strip())
        row = replace(row, target=target, seed=_seed(given, tasks.sheet))
        if BEYOND in cells:
            raise _wrong("answer", "answers-cells", beyond=cells[BEYOND][:40])
        return replace(row, syntax=_syntax(given), line=_line_number(given), time=_time(given))
    except WrongCell as wrong:
        return replace(row, refused=_told(wrong.error, tasks.language), column=wrong.column)


def _person(student: str, header: Sequence[str]) -> str | None:
    """Who counts as the same: names without the spaces around them, however their accents are encoded."""
    name = unicodedata.normalize("NFC", student.strip())
    return name or ("" if "student" not in header and "line" in header else None)


def _seed(row: TableRow, sheet: Sheet) -> str | None:
    """Whose values: those of the column `seed`, or of the name where everybody has their own."""
    own = row.student.strip() if sheet.assignment and sheet.assignment.individual else ""
    return row.seed.strip() or own or None


def _syntax(row: TableRow) -> Syntax:
    wanted = row.syntax.strip().lower()
    if wanted not in SYNTAXES:
        raise _wrong("syntax", "answers-syntax", name=wanted[:20])
    return SYNTAXES[wanted]


def _line_number(row: TableRow) -> float | None:
    """The place in the working; None for an empty cell, or where there is no such column."""
    written = row.line.strip()
    if written and not NUMBER.fullmatch(written):
        raise _wrong("line", "answers-line", name=written[:20])
    return float(written.replace(",", ".")) if written else None


def _time(row: TableRow) -> str:
    """When it was handed in; empty if that is not told."""
    written = row.time.strip()
    try:
        if len(written) > LONGEST_TIME:
            raise ValueError
        if written:
            instant(written)
    except (ValueError, OverflowError):
        raise _wrong("time", "answers-time", name=written[:LONGEST_TIME]) from None
    return written


def _wrong(column: str, code: str, **parameters: str) -> WrongCell:
    return WrongCell(column, RequestError(Problem(code, parameters=parameters)))


def _told(error: InputError, language: str) -> str:
    return " ".join(message(language, problem) for problem in error.problems)


class _Tasks:
    """The tasks that the rows of a table answer, each resolved once; what there is not, is found missing once."""

    def __init__(self, sheet: Sheet, language: str) -> None:
        self.sheet = sheet
        self.language = language
        assigned = sheet.assignment.tasks if sheet.assignment else ()
        self.targets = [self._assigned(task) for task in assigned]
        self._found: dict[tuple[str, str], int | WrongCell] = {}

    @property
    def points(self) -> float | None:
        """What a person can earn on the assignment; a task that stands on it twice is earned once."""
        if self.sheet.assignment is None:
            return None
        worth: dict[tuple[str, str], float] = {}
        for target in self.targets:
            key = (target.working, target.task)
            worth[key] = max(target.of, worth.get(key, target.of))
        return sum(worth.values())

    def number(self, task: str, scene: str) -> int:
        """The number of the task that a row names. Raises WrongCell."""
        key = (task, scene)
        if key not in self._found:
            self._found[key] = self._numbered(task, scene)
        found = self._found[key]
        if isinstance(found, WrongCell):
            raise found
        return found

    def _numbered(self, task: str, scene: str) -> int | WrongCell:
        try:
            return self._of_scene(task, scene) if self.sheet.assignment is None else self._of_assignment(task, scene)
        except WrongCell as wrong:
            return wrong

    def _of_scene(self, task: str, scene: str) -> int:
        try:
            reference = read_request(SceneWithChanges, {"scene": scene or self.sheet.scene})
            workbook = workbook_asked_about(reference)
        except InputError as error:
            raise WrongCell("scene", error) from None
        try:
            found = workbook.task(task)
        except InputError as error:
            raise WrongCell("task", error) from None
        title = str(task_document(found, workbook, self.language)["title"])
        target = Target(reference, workbook.scene.id, task, title, found.quantity.points)
        self.targets.append(target)
        return len(self.targets) - 1

    def _of_assignment(self, task: str, scene: str) -> int:
        """By its number on the assignment, else by its id, and its scene where several scenes have such a task."""
        if re.fullmatch(r"[0-9]{1,4}", task) and 1 <= int(task) <= len(self.targets):
            return int(task) - 1
        called = [n for n, target in enumerate(self.targets) if target.task == task]
        there = [n for n in called if self.targets[n].scene == scene] or called
        if not there:
            known = ", ".join(target.task for target in self.targets)
            raise WrongCell(
                "task", UnknownNameError(Problem("unknown-task", parameters={"name": task[:64], "known": known}))
            )
        if len({self.targets[n].working for n in there}) > 1:
            known = ", ".join(f"{n + 1} ({self.targets[n].scene})" for n in there)
            raise _wrong("task", "answers-which", name=task, known=known)
        return there[0]

    def _assigned(self, assigned: AssignedTaskDocument) -> Target:
        workbook, task = resolved(assigned, None)
        title = str(task_document(task, workbook, self.language)["title"])
        of = task.quantity.points if assigned.points is None else assigned.points
        return Target(scene_of(assigned), workbook.scene.id, task.id, title, of)


# --- one row ---------------------------------------------------------------------------------------------------------


def row_verdict(question: Mapping[str, object]) -> Document:
    """The fields of a RowQuestion → those of a RowVerdict.

    What cannot be asked of the scene in these values is told, too: it spoils no other row.
    """
    asked = read_request(RowQuestion, question)
    language = language_of(asked.lang)
    line = line_of(asked, language)
    try:
        workbook = workbook_asked_by(asked)
        standing = [line_of(one, language) for one in asked.standing]
        wrong = {one.task: parts_of(workbook, one) for one in standing}
        verdict = check_following(workbook, workbook.task(line.task), line, wrong)
    except InputError as error:
        return refusal(_told(error, language)).model_dump()
    return _row_verdict(verdict, workbook, language).model_dump()


def _row_verdict(verdict: Verdict, workbook: Workbook, language: str) -> RowVerdict:
    told = verdict_document(verdict, workbook.scene, language)
    titles = [one["title"] for one in cast("Sequence[Mapping[str, str]]", told["misconceptions"])]
    mistake = _mistake(verdict)
    return RowVerdict(
        outcome=verdict.outcome,
        remark=verdict.remark,
        misconception=mistake,
        mistake=titles[0] if titles else named(mistake, language) if mistake else "",
        understood_as=verdict.understood_as,
        feedback=told["feedback"],
        share=verdict.partial,
    )


def _mistake(verdict: Verdict) -> str:
    """Its id: a misconception, a slip by its kind, or in which sense the answer is wrong."""
    if verdict.misconceptions:
        return verdict.misconceptions[0]
    return f"slip:{verdict.slip.kind}" if verdict.slip else verdict.remark if verdict.outcome == "wrong" else ""
