"""What the API asks of homework: plain data in, plain data out."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Mapping

from ..contract.assignment import Aspect, AssignedTaskDocument
from ..contract.check import CheckRequest, LinesRequest, ReadingRequest, TableRequest
from ..contract.reading import read as read_request
from ..contract.task import AssignmentRequest, PollRequest, PracticeRequest, SolutionRequest, StackRequest, TasksRequest
from ..errors import ExpressionError, Problem, RequestError
from ..mechanics.requests import inside
from ..mechanics.user_text import plainly, translated
from ..mechanics.writing import write_scene
from ..narration.catalog import language_of
from .assignment import look_up, resolved
from .feedback import Document, problem_documents, reading_documents, verdict_document
from .gradebook import Shares
from .grading import Sheet, plan_of, read_class
from .handins import code_of
from .motion import moved_scene
from .poll import poll
from .practice.exercise import exercise_of
from .practice.levels import LEVELS
from .stack.question import quiz
from .statement import model_answer, task_document
from .workbook import Workbook, workbook_asked_by, workbook_of
from .working import Scheme, check_following, line_of, mark, shown_line, wrong_among


def tasks_request(document: Mapping[str, object]) -> Document:
    """The fields of a TasksRequest → {scene, symbols, tasks}."""
    asked = read_request(TasksRequest, document)
    workbook, language = workbook_asked_by(asked), language_of(asked.lang)
    return {
        "scene": write_scene(workbook.scene),
        "symbols": _symbols(workbook),
        "tasks": [task_document(task, workbook, language) for task in workbook.tasks],
    }


def _symbols(workbook: Workbook) -> list[Document]:
    """What an answer may speak of: names with their LaTeX, for a keyboard."""
    scene = workbook.scene
    units = {c.name: c.unit for c in scene.coordinates} | {p.name: p.unit for p in scene.parameters}
    values = scene.parameter_values
    return [
        {"name": s.name, "latex": s.typeset, "kind": s.kind, "unit": units.get(s.name, ""), "value": values.get(s.name)}
        for s in scene.names.symbols
    ]


def check_request(document: Mapping[str, object]) -> Document:
    """The fields of a CheckRequest → the verdict. Raises InputError for what is not an answer."""
    asked = read_request(CheckRequest, document)
    workbook, language = workbook_asked_by(asked), language_of(asked.lang)
    line = line_of(asked, language)
    wrong = wrong_among(workbook, [line_of(one, language) for one in asked.previous])
    verdict = check_following(workbook, workbook.task(line.task), line, wrong)
    return verdict_document(verdict, workbook.scene, language)


def reading_request(document: Mapping[str, object]) -> Document:
    """The fields of a ReadingRequest → what the answer is understood as, LaTeX and plain; no verdict."""
    asked = read_request(ReadingRequest, document)
    workbook, language = workbook_asked_by(asked), language_of(asked.lang)
    line = line_of(asked, language)
    try:
        shown = shown_line(workbook, line)
    except ExpressionError as error:
        return {"latex": "", "plain": "", "problems": problem_documents(error.problems, language), "readings": []}
    readings = reading_documents(shown.readings)
    return {"latex": shown.latex, "plain": shown.plain, "problems": [], "readings": readings}


def solution_request(document: Mapping[str, object]) -> Document:
    """The fields of a SolutionRequest → the right answer, one text for each part, plain and LaTeX."""
    asked = read_request(SolutionRequest, document)
    workbook = workbook_asked_by(asked)
    return model_answer(workbook.task(asked.task), workbook, language_of(asked.lang))


def poll_request(document: Mapping[str, object]) -> Document:
    """The fields of a PollRequest → {choices}: results of a step to choose from, one of them right."""
    asked = read_request(PollRequest, document)
    return {"choices": poll(workbook_asked_by(asked), asked.step, language_of(asked.lang))}


def motion_request(document: Mapping[str, object]) -> Document:
    """The fields of a ReadingRequest → the scene that moves as the answer says. Raises InputError where none does."""
    asked = read_request(ReadingRequest, document)
    workbook, line = workbook_asked_by(asked), line_of(asked, language_of(asked.lang))
    return {"scene": moved_scene(workbook, workbook.task(line.task), line.text, line.syntax)}


def lines_request(document: Mapping[str, object]) -> Document:
    """The fields of a LinesRequest → the verdict and the points of every line, and where the first mistake is."""
    asked = read_request(LinesRequest, document)
    workbook, language = workbook_asked_by(asked), language_of(asked.lang)
    lines = [line_of(one, language) for one in asked.lines]
    marked = mark(
        workbook, lines, Scheme(asked.scheme.points, Shares(asked.scheme.follow_through, asked.scheme.simplified))
    )
    first = next((n for n, each in enumerate(marked) if each.verdict.outcome in ("wrong", "invalid")), None)
    worth = {line.task: each.of for line, each in zip(lines, marked, strict=True)}
    return {
        "lines": [
            {**verdict_document(each.verdict, workbook.scene, language), "points": each.points, "of": each.of}
            for each in marked
        ],
        "first_wrong": first,
        "points": sum(each.points for each in marked),
        "of": sum(worth.values()),
    }


def assignment_request(document: Mapping[str, object]) -> Document:
    """The fields of an AssignmentRequest → its tasks in order, each with its scene, symbols and points.

    Raises InputError that points below /assignment.
    """
    asked = read_request(AssignmentRequest, document)
    sheet, language = asked.assignment, language_of(asked.lang)
    with inside("/assignment"):
        look_up(sheet)
    seed = asked.seed if sheet.individual else None
    return {
        "title": plainly(translated(sheet.title)),
        "follow_through": sheet.follow_through,
        "simplified": sheet.simplified,
        "code": code_of(sheet),
        "tasks": [_assigned_document(assigned, seed, sheet.vary, language) for assigned in sheet.tasks],
    }


def _assigned_document(
    assigned: AssignedTaskDocument, seed: str | None, vary: tuple[Aspect, ...], language: str
) -> Document:
    workbook, task = resolved(assigned, seed, vary)
    told = task_document(task, workbook, language)
    points = task.quantity.points if assigned.points is None else assigned.points
    return {"scene": write_scene(workbook.scene), "symbols": _symbols(workbook), "task": told | {"points": points}}


def practice_request(document: Mapping[str, object]) -> Document:
    """The fields of a PracticeRequest → {scene, symbols, task, level, recalled}. Raises UnknownNameError."""
    asked = read_request(PracticeRequest, document)
    found = exercise_of(LEVELS[asked.level - 1], asked.seed, asked.number, asked.recall or "", asked.kind or "")
    workbook = found.workbook
    return {
        "scene": write_scene(workbook.scene),
        "symbols": _symbols(workbook),
        "task": task_document(found.task, workbook, language_of(asked.lang)),
        "level": found.level.number,
        "recalled": found.recalled or None,
    }


def table_request(document: Mapping[str, object]) -> Document:
    """The fields of a TableRequest → the plan by which its rows are marked.

    Raises InputError that points below /table, /assignment or /scene.
    """
    asked = read_request(TableRequest, document)
    if asked.assignment:
        with inside("/assignment"):
            look_up(asked.assignment)
    if asked.scene:
        workbook_of({"scene": asked.scene})  # what is wrong with it is told once, not in each row
    sheet, language = Sheet(asked.assignment, asked.scene or ""), language_of(asked.lang)
    with inside("/table"):
        found = read_class(_bytes("".join(asked.table), asked.encoding), sheet, language)
    return plan_of(found.table, sheet, language, found.refused).document


def _bytes(table: str, encoding: str) -> bytes:
    """A table as it stood in its file. Raises RequestError for what is no base64."""
    if encoding == "text":
        return table.encode("utf-8", errors="replace")
    try:
        return b64decode(table, validate=True)
    except ValueError:
        raise RequestError(Problem("answers-encoding")) from None


def stack_request(document: Mapping[str, object]) -> Document:
    """The fields of a StackRequest → {xml}: questions for STACK, of all tasks if none is named."""
    asked = read_request(StackRequest, document)
    workbook = workbook_asked_by(asked)
    tasks = [workbook.task(identifier) for identifier in asked.tasks] or workbook.tasks
    return {"xml": quiz(workbook, tasks, language_of(asked.lang))}
