"""What the API asks of homework: plain data in, plain data out."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Mapping, Sequence
from typing import cast

from ..errors import ExpressionError, Problem, RequestError
from ..language.latex_printer import Typography, latex
from ..language.plain_printer import plain
from ..mechanics.requests import inside
from ..mechanics.user_text import plainly
from ..mechanics.writing import write_scene
from ..narration.catalog import language_in
from .assignment import AssignedTask, Assignment, read_assignment
from .feedback import Document, problem_documents, verdict_document
from .grading import Sheet, line_of, plan_of, read_answers
from .motion import moved_scene
from .reading import read
from .stack.question import quiz
from .statement import model_answer, task_document
from .workbook import Workbook, workbook_of
from .working import Scheme, check_following, mark, wrong_among


def tasks_request(document: Mapping[str, object]) -> Document:
    """{scene, guides?, freeze?, parameters?, seed?, lang?} → {scene, symbols, tasks}."""
    workbook = workbook_of(document)
    language = language_in(document)
    return {
        "scene": write_scene(workbook.scene),
        "symbols": _symbols(workbook),
        "tasks": [task_document(task, workbook, language) for task in workbook.tasks],
    }


def _symbols(workbook: Workbook) -> list[Document]:
    """What an answer may speak of: names with their LaTeX, for a keyboard."""
    scene = workbook.scene
    units = {c.name: c.unit for c in scene.coordinates} | {p.name: p.unit for p in scene.parameters}
    values = {p.name: p.value for p in scene.parameters}
    return [
        {"name": s.name, "latex": s.typeset, "kind": s.kind, "unit": units.get(s.name, ""), "value": values.get(s.name)}
        for s in scene.names.symbols
    ]


def check_request(document: Mapping[str, object]) -> Document:
    """{scene, task, answer: {syntax, value}, …} → the verdict. Raises InputError for what is not an answer."""
    workbook = workbook_of(document)
    line = line_of(document)
    previous = [line_of(one) for one in cast("Sequence[Mapping[str, object]]", document.get("previous") or ())]
    wrong = wrong_among(workbook, previous)
    verdict = check_following(workbook, workbook.task(line.task), line, wrong)
    return verdict_document(verdict, workbook.scene, language_in(document))


def reading_request(document: Mapping[str, object]) -> Document:
    """{scene, task, answer, …} → what the answer is understood as, LaTeX and plain; no verdict."""
    workbook = workbook_of(document)
    line = line_of(document)
    try:
        shown = read(workbook.task(line.task), workbook.solution, line.text, line.syntax).shown
    except ExpressionError as error:
        problems = problem_documents(error.problems, language_in(document))
        return {"latex": "", "plain": "", "problems": problems}
    return {"latex": latex(shown, Typography(workbook.scene.names)), "plain": plain(shown), "problems": []}


def solution_request(document: Mapping[str, object]) -> Document:
    """{scene, task, …} → the right answer, one text for each part, plain and LaTeX."""
    workbook = workbook_of(document)
    return model_answer(workbook.task(str(document["task"])), workbook)


def motion_request(document: Mapping[str, object]) -> Document:
    """{scene, task, answer, …} → the scene that moves as the answer says. Raises InputError where there is none."""
    workbook = workbook_of(document)
    line = line_of(document)
    return {"scene": moved_scene(workbook, workbook.task(line.task), line.text, line.syntax)}


def lines_request(document: Mapping[str, object]) -> Document:
    """{scene, lines, scheme?, …} → the verdict and the points of every line, and where the first mistake is."""
    workbook = workbook_of(document)
    lines = [line_of(one) for one in cast("Sequence[Mapping[str, object]]", document["lines"])]
    marked = mark(workbook, lines, _scheme(cast("Mapping[str, object]", document.get("scheme") or {})))
    first = next((n for n, each in enumerate(marked) if each.verdict.outcome in ("wrong", "invalid")), None)
    worth = {line.task: each.of for line, each in zip(lines, marked, strict=True)}
    language = language_in(document)
    return {
        "lines": [
            {**verdict_document(each.verdict, workbook.scene, language), "points": each.points, "of": each.of}
            for each in marked
        ],
        "first_wrong": first,
        "points": sum(each.points for each in marked),
        "of": sum(worth.values()),
    }


def _scheme(document: Mapping[str, object]) -> Scheme:
    points = cast("Mapping[str, float]", document.get("points") or {})
    return Scheme(points, float(cast("float", document.get("follow_through", Scheme.follow_through))))


def assignment_request(document: Mapping[str, object]) -> Document:
    """{assignment, seed?, lang?} → its tasks in order, each with its scene, symbols and points; the seed is a student.

    Raises InputError that points below /assignment.
    """
    sheet = _assignment(document)
    seed = cast("str | None", document.get("seed")) if sheet.individual else None
    language = language_in(document)
    return {
        "title": plainly(sheet.title),
        "follow_through": sheet.follow_through,
        "tasks": [_assigned_document(assigned, seed, language) for assigned in sheet.tasks],
    }


def _assigned_document(assigned: AssignedTask, seed: str | None, language: str) -> Document:
    workbook, task = assigned.resolved(seed)
    told = task_document(task, workbook, language)
    points = task.quantity.points if assigned.points is None else assigned.points
    return {"scene": write_scene(workbook.scene), "symbols": _symbols(workbook), "task": told | {"points": points}}


def _assignment(document: Mapping[str, object]) -> Assignment:
    with inside("/assignment"):
        return read_assignment(document["assignment"])


def table_request(document: Mapping[str, object]) -> Document:
    """{table: pieces, encoding, assignment?, scene?, lang} → the plan by which its rows are marked.

    Raises InputError that points below /table, /assignment or /scene.
    """
    assignment = None if document.get("assignment") is None else _assignment(document)
    scene = document.get("scene") or ""
    if scene:
        workbook_of({"scene": scene})  # what is wrong with it is told once, not in each row
    with inside("/table"):
        table = read_answers(_bytes("".join(cast("Sequence[str]", document["table"])), str(document["encoding"])))
    return plan_of(table, Sheet(assignment, scene), language_in(document)).document


def _bytes(table: str, encoding: str) -> bytes:
    """A table as it stood in its file. Raises RequestError for what is no base64."""
    if encoding == "text":
        return table.encode("utf-8", errors="replace")
    try:
        return b64decode(table, validate=True)
    except ValueError:
        raise RequestError(Problem("answers-encoding")) from None


def stack_request(document: Mapping[str, object]) -> Document:
    """{scene, tasks?, …} → {xml}: questions for STACK, of all tasks if none is named."""
    workbook = workbook_of(document)
    named = cast("Sequence[str]", document.get("tasks") or ())
    tasks = [workbook.task(identifier) for identifier in named] or workbook.tasks
    return {"xml": quiz(workbook, tasks, language_in(document))}
