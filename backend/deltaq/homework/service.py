"""What the API asks of homework: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

from ..errors import ExpressionError
from ..language.latex_printer import Typography, latex
from ..language.parser import Syntax
from ..language.plain_printer import plain
from ..mechanics.requests import inside
from ..mechanics.user_text import plainly
from ..mechanics.writing import write_scene
from ..narration.catalog import language_in
from .assignment import AssignedTask, read_assignment
from .feedback import Document, problem_documents, verdict_document
from .motion import moved_scene
from .reading import read
from .stack.question import quiz
from .statement import model_answer, task_document
from .workbook import Workbook, workbook_of
from .working import Line, Scheme, check_following, mark, wrong_among


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
    line = _line(document)
    previous = [_line(one) for one in cast("Sequence[Mapping[str, object]]", document.get("previous") or ())]
    wrong = wrong_among(workbook, previous)
    verdict = check_following(workbook, workbook.task(line.task), line, wrong)
    return verdict_document(verdict, workbook.scene, language_in(document))


def _line(document: Mapping[str, object]) -> Line:
    answer = cast("Mapping[str, str]", document["answer"])
    return Line(str(document["task"]), answer["value"], cast("Syntax", answer.get("syntax") or "plain"))


def reading_request(document: Mapping[str, object]) -> Document:
    """{scene, task, answer, …} → what the answer is understood as, LaTeX and plain; no verdict."""
    workbook = workbook_of(document)
    line = _line(document)
    try:
        shown = read(workbook.task(line.task), workbook.road, line.text, line.syntax).shown
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
    line = _line(document)
    return {"scene": moved_scene(workbook, workbook.task(line.task), line.text, line.syntax)}


def lines_request(document: Mapping[str, object]) -> Document:
    """{scene, lines, scheme?, …} → the verdict and the points of every line, and where the first mistake is."""
    workbook = workbook_of(document)
    lines = [_line(one) for one in cast("Sequence[Mapping[str, object]]", document["lines"])]
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
    with inside("/assignment"):
        sheet = read_assignment(document["assignment"])
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


def stack_request(document: Mapping[str, object]) -> Document:
    """{scene, tasks?, …} → {xml}: questions for STACK, of all tasks if none is named."""
    workbook = workbook_of(document)
    named = cast("Sequence[str]", document.get("tasks") or ())
    tasks = [workbook.task(identifier) for identifier in named] or workbook.tasks
    return {"xml": quiz(workbook, tasks, language_in(document))}
