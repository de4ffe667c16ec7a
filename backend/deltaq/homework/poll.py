"""A question to a hall: the right result of a step among wrong ones, each of which a known misconception leads to."""

from __future__ import annotations

from collections.abc import Iterator
from hashlib import sha256

from ..language.latex_printer import Typography, latex
from ..narration.catalog import text
from .equality import Parts
from .feedback import Document, about_texts
from .statement import steps_of
from .task import Task
from .workbook import Candidate, Workbook

MOST = 4  # choices
LONGEST = 260  # letters of a formula that is still compared with others at a glance
SINGLE_BODY = "kinetic-energy-of-"  # of the only body: the kinetic energy of the system
ROW = r",\quad "


def poll(workbook: Workbook, step: str, language: str) -> list[Document]:
    """Two to four choices in an order that tells nothing; none where no misconception leads to another result."""
    task = _task_of(workbook, step)
    if task is None or task.quantity.judge is not None:
        return []
    right = _formula(workbook, task, workbook.shown(task))
    choices = {right: {"latex": right, "right": True, "title": "", "hint": ""}}
    kinds = set[str]()
    for candidate in workbook.candidates(task):
        formula = _formula(workbook, task, workbook.short(candidate.parts))
        if len(choices) < MOST and candidate.solution.id not in kinds and formula not in choices:
            kinds.add(candidate.solution.id)
            choices[formula] = {"latex": formula, "right": False, **_told(candidate, workbook, language)}
    if len(choices) < 2 or any(len(formula) > LONGEST for formula in choices):
        return []
    return [choices[formula] for formula in sorted(choices, key=lambda one: sha256(one.encode()).hexdigest())]


def _task_of(workbook: Workbook, step: str) -> Task | None:
    """The one thing that a step answers; none where it answers several."""
    single = len(workbook.scene.bodies) == 1 and step.startswith(SINGLE_BODY)
    wanted = "kinetic-energy" if single else step
    answered = [task for task in workbook.tasks if wanted in steps_of(task, workbook)]
    same = [task for task in answered if task.id == wanted]
    return same[0] if same else answered[0] if len(answered) == 1 else None


def _formula(workbook: Workbook, task: Task, parts: Parts) -> str:
    ending = " = 0" if task.quantity.form in ("equation", "equations") else ""
    rows = list(_rows(workbook, parts))
    if task.quantity.form == "vector":
        return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"
    return ROW.join(row + ending for row in rows)


def _rows(workbook: Workbook, parts: Parts) -> Iterator[str]:
    typography = Typography(workbook.scene.names)
    for part in parts:
        yield latex(part, typography)


def _told(candidate: Candidate, workbook: Workbook, language: str) -> Document:
    """Which misconception it is, and what it forgets."""
    about = about_texts(candidate.solution.about, workbook.scene, language)
    key = f"homework.misconceptions.{candidate.solution.id}"
    return {part: text(language, f"{key}.{part}", **about) for part in ("title", "hint")}
