"""A table of answers → a table of verdicts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

from ..errors import InputError, Problem, RequestError
from ..language.parser import Syntax
from ..narration.catalog import message
from .assignment import AssignedTask, Assignment
from .feedback import verdict_document
from .results import Graded
from .table import BEYOND, Table, read_table
from .verdict import Verdict
from .workbook import Workbook, workbook_of
from .working import Line, Marked, Scheme, mark

NEEDED = ("task", "answer")
SYNTAXES: Mapping[str, Syntax] = {"": "plain", "plain": "plain", "latex": "latex"}


def read_answers(data: bytes) -> Table:
    """The table of a file: `task`, `answer`; where wanted `student`, `scene`, `syntax`, `seed`, `line`."""
    table = read_table(data)
    missing = [name for name in NEEDED if name not in table.header]
    if missing:
        raise RequestError(Problem("answers-column", parameters={"name": missing[0], "known": ", ".join(table.header)}))
    if not table.rows:
        raise RequestError(Problem("answers-none"))
    return table


def grade(rows: Iterable[Mapping[str, str]], assignment: Assignment | None, language: str) -> Iterator[Graded]:
    """Every row graded, in order; one that names no scene or task says so and spoils no other.

    In a table with a column `line`, the rows of a student on a scene are a working: what follows from a wrong line is
    told, and a task earns its points once.
    """
    table = list(rows)
    posed = [_attempted(row, assignment, language) for row in table]
    share = Scheme.follow_through if assignment is None else assignment.follow_through
    done: dict[int, Graded] = {}
    for index, what in enumerate(posed):
        if isinstance(what, Graded):
            yield what
            continue
        if index not in done:
            members = _working(what, posed, table) if "line" in table[index] else [index]
            graded = _marked([cast("Posed", posed[i]) for i in members], share, language)
            done.update(zip(members, graded, strict=True))
        yield done.pop(index)


@dataclass(frozen=True)
class Posed:
    """A row as a question: who answers which task of which scene, and what it counts (None: as usual)."""

    student: str
    scene: Mapping[str, object]
    seed: str | None
    line: Line
    points: float | None = None

    def same_working(self, other: Posed) -> bool:
        return (self.student, self.scene, self.seed) == (other.student, other.scene, other.seed)


def _attempted(row: Mapping[str, str], assignment: Assignment | None, language: str) -> Posed | Graded:
    try:
        return _posed(row, assignment)
    except InputError as error:
        of = (row.get("student", ""), row.get("scene", ""), row["task"])
        return _refused(of, row["answer"], error, language)


def _posed(row: Mapping[str, str], assignment: Assignment | None) -> Posed:
    if BEYOND in row:
        raise RequestError(Problem("answers-cells", parameters={"beyond": row[BEYOND][:40]}))
    student, number, seed = row.get("student", ""), row["task"].strip(), row.get("seed") or None
    if assignment is None:
        return Posed(student, {"scene": row.get("scene", "").strip()}, seed, Line(number, row["answer"], _syntax(row)))
    assigned = _assigned(assignment, number)
    seed = (seed or student) if assignment.individual else seed
    return Posed(student, assigned.scene, seed, Line(assigned.task, row["answer"], _syntax(row)), assigned.points)


def _working(of: Posed, posed: Sequence[Posed | Graded], table: Sequence[Mapping[str, str]]) -> list[int]:
    """The rows of one student on one scene, in the order of their lines."""
    members = [index for index, other in enumerate(posed) if isinstance(other, Posed) and of.same_working(other)]
    return sorted(members, key=lambda index: _number(table[index]))


def _number(row: Mapping[str, str]) -> float:
    """Which line of the working a row is; what is no number comes first."""
    try:
        return float(row["line"])
    except ValueError:
        return 0.0


def _refused(of: tuple[str, str, str], answer: str, error: InputError, language: str) -> Graded:
    """What cannot be checked: `of` says by whom, of which scene, which task."""
    told = " ".join(message(language, problem) for problem in error.problems)
    return Graded(*of, "invalid", "", 0.0, 0.0, "", told, answer)


def _marked(questions: Sequence[Posed], share: float, language: str) -> list[Graded]:
    """One working of one student, or a single answer."""
    errors: dict[Line, InputError] = {}
    for each in questions:
        try:
            workbook = workbook_of({**each.scene, "seed": each.seed})
            workbook.task(each.line.task)
        except InputError as error:
            errors[each.line] = error
    known = [each for each in questions if each.line not in errors]
    scheme = Scheme({each.line.task: each.points for each in known if each.points is not None}, share)
    marks = iter(mark(workbook, [each.line for each in known], scheme) if known else ())
    return [
        _refused((each.student, str(each.scene["scene"]), each.line.task), each.line.text, errors[each.line], language)
        if each.line in errors
        else _graded(each, workbook, next(marks), language)
        for each in questions
    ]


def _graded(posed: Posed, workbook: Workbook, marked: Marked, language: str) -> Graded:
    verdict = marked.verdict
    told = verdict_document(verdict, workbook.scene, language)
    found = (verdict.outcome, _mistake(verdict), marked.points, marked.of, verdict.understood_as, str(told["feedback"]))
    return Graded(posed.student, workbook.scene.id, posed.line.task, *found, posed.line.text)


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
