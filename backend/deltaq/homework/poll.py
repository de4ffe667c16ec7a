"""A question to a hall: the right result of a step among wrong ones, each of which a known misconception leads to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from hashlib import sha256

from ..derivation.formula import Quantity
from ..language.latex_printer import Typography, latex
from ..narration.catalog import text
from ..narration.marks import unmarked
from ..narration.symbols import QuantitySymbols
from .equality import Parts
from .faulty_solution import FaultySolution
from .feedback import Document, about_texts
from .hall import AUGMENTED, asked_of_halls, blocks, left_side
from .statement import steps_of
from .task import Task
from .workbook import Workbook

MOST = 4  # choices
ROWS = 9  # of all choices together: more are not on one screen
LONGEST = 260  # letters of a formula that is still compared with others at a glance
SINGLE_BODY = "kinetic-energy-of-"  # of the only body: the kinetic energy of the system
ENDING = ("impact-loss",)  # what a step ends with that answers unlike things
REACTION_WORK = "work-of-reaction"
EACH = ("generalized-force", "linearized")  # what one step tells of every coordinate
ROW = r",\quad "
BREAK = r" \\ "
Wrong = tuple[FaultySolution, str]  # with what it leads to


def poll(workbook: Workbook, step: str, language: str) -> list[Document]:
    """Two to four choices in an order that tells nothing; none where no misconception leads to another result."""
    tasks = _tasks_of(workbook, step)
    if not tasks or any(task.quantity.judge is not None for task in tasks):
        return []
    by_blocks = tasks[0].quantity.kind == AUGMENTED
    right, wrong = _by_blocks(workbook, tasks[0]) if by_blocks else _by_answers(workbook, step, tasks, language)
    choices = {right: {"latex": right, "right": True, "title": "", "hint": ""}}
    kinds = set[str]()
    for solution, formula in wrong:
        fresh = solution.id not in kinds and formula and formula not in choices
        if len(choices) < min(MOST, ROWS // len(tasks)) and fresh:
            kinds.add(solution.id)
            choices[formula] = {"latex": formula, "right": False, **_told(solution, workbook, language)}
    if len(choices) < 2 or any(len(formula) > LONGEST for formula in choices):
        return []
    return [choices[formula] for formula in sorted(choices, key=lambda one: sha256(one.encode()).hexdigest())]


def _by_blocks(workbook: Workbook, task: Task) -> tuple[str, Iterator[Wrong]]:
    """The right choice and the wrong ones of what is too long to be chosen by its entries."""
    true = workbook.solution
    wrong = ((each.solution, blocks(each.solution, true)) for each in workbook.candidates(task))
    return blocks(true, true), wrong


def _by_answers(workbook: Workbook, step: str, tasks: tuple[Task, ...], language: str) -> tuple[str, Iterator[Wrong]]:
    """The right choice and the wrong ones, written out."""
    named = _is_part(workbook, step, tasks)
    right = _formula(workbook, {task: workbook.shown(task) for task in tasks}, language, named=named)
    found = _wrong(workbook, tasks)
    return right, ((solution, _formula(workbook, answers, language, named=named)) for solution, answers in found)


def _tasks_of(workbook: Workbook, step: str) -> tuple[Task, ...]:
    """What a step answers: one thing, the same of every coordinate, or of unlike things the one that it ends with."""
    wanted, answered = _answered(workbook, step)
    same = tuple(task for task in answered if task.id == wanted)
    alike = {task.quantity.kind for task in answered}
    ending = tuple(task for task in answered if task.quantity.kind in ENDING)
    every = answered if len(answered) == 1 or (len(alike) == 1 and alike <= set(EACH)) else ()
    return same[:1] or every or ending[:1]


def _answered(workbook: Workbook, step: str) -> tuple[str, tuple[Task, ...]]:
    single = len(workbook.scene.bodies) == 1 and step.startswith(SINGLE_BODY)
    wanted = "kinetic-energy" if single else step
    asked = (*workbook.tasks, *asked_of_halls(workbook.solution))
    return wanted, tuple(task for task in asked if wanted in steps_of(task, workbook) and not _is_mentioned(task, step))


def _is_mentioned(task: Task, step: str) -> bool:
    """Whether a step speaks of what a task asks for, but does not tell it yet."""
    return step == f"{REACTION_WORK}:{task.subject}"


def _is_part(workbook: Workbook, step: str, tasks: tuple[Task, ...]) -> bool:
    """Whether a step answers other things, too: then choices say what they are of."""
    wanted, answered = _answered(workbook, step)
    return len(tasks) == 1 < len(answered) and tasks[0].id != wanted


def _wrong(workbook: Workbook, tasks: tuple[Task, ...]) -> Iterator[tuple[FaultySolution, Mapping[Task, Parts]]]:
    """The answers that each misconception leads to, the likely ones first; what it leaves right is right."""
    found = {task: {one.solution: workbook.short(one.parts) for one in workbook.candidates(task)} for task in tasks}
    for solution in dict.fromkeys(solution for task in tasks for solution in found[task]):
        yield solution, {task: found[task].get(solution) or workbook.shown(task) for task in tasks}


def _formula(workbook: Workbook, answers: Mapping[Task, Parts], language: str, *, named: bool) -> str:
    if len(answers) == 1:
        ((task, parts),) = answers.items()
        in_hall = left_side(task, workbook.solution, _symbols(workbook, language))
        left = _left(workbook, task, language) if named else in_hall
        return left + _of_one(workbook, task, parts)
    rows = [f"{_left(workbook, task, language)}&{_of_one(workbook, task, parts)}" for task, parts in answers.items()]
    return rf"\begin{{aligned}}{BREAK.join(rows)}\end{{aligned}}"


def _left(workbook: Workbook, task: Task, language: str) -> str:
    """The symbol of what is asked; an equation has none."""
    if task.quantity.form == "equation":
        return ""
    return _symbols(workbook, language).latex(Quantity(task.quantity.kind, task.subject)) + " ={}"


def _symbols(workbook: Workbook, language: str) -> QuantitySymbols:
    scene = workbook.scene
    names = {symbol.name: symbol.typeset for symbol in scene.names.symbols if symbol.kind == "coordinate"}
    return QuantitySymbols(scene, language, names, unmarked)


def _of_one(workbook: Workbook, task: Task, parts: Parts) -> str:
    ending = " = 0" if task.quantity.form in ("equation", "equations") else ""
    rows = list(_rows(workbook, parts))
    if task.quantity.form == "vector":
        return r"\begin{bmatrix} " + BREAK.join(rows) + r" \end{bmatrix}"
    return ROW.join(row + ending for row in rows)


def _rows(workbook: Workbook, parts: Parts) -> Iterator[str]:
    typography = Typography(workbook.scene.names)
    for part in parts:
        yield latex(part, typography)


def _told(solution: FaultySolution, workbook: Workbook, language: str) -> Document:
    """Which misconception it is, and what it forgets."""
    about = about_texts(solution.about, workbook.scene, language)
    key = f"homework.misconceptions.{solution.id}"
    return {part: text(language, f"{key}.{part}", **about) for part in ("title", "hint")}
