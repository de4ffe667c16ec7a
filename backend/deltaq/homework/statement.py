"""A task as a document: statement, hints and right answer, with its texts in one language."""

from __future__ import annotations

from ..narration.catalog import keys, text
from ..narration.prose import joined
from .axes import axes_text
from .checking import judge_of
from .feedback import Document, label
from .ordering.judge import Ordering
from .ordering.telling import block_documents
from .subjects import contact_of, coordinate_of
from .task import Task
from .telling import variant_sentences
from .told import asked_about, reaction_sentences
from .workbook import Workbook


def task_document(task: Task, workbook: Workbook, language: str) -> Document:
    """A task with its statement, the form wanted, three hints, and where the derivation answers it."""
    key = f"homework.tasks.{task.quantity.kind}"
    own = f"{key}.bound" if workbook.solution.conditions and "bound" in keys(language, key) else key
    values = _subject(task, workbook, language)
    told_otherwise = (*reaction_sentences(task, workbook, language), *variant_sentences(workbook, language))
    return {
        "id": task.id,
        "kind": task.quantity.kind,
        "subject": task.subject,
        "title": text(language, f"{key}.title", **values),
        "statement": joined(" ", [text(language, f"{own}.statement", **values), *told_otherwise]),
        "form": task.quantity.form,
        "form_text": text(language, f"homework.forms.{task.quantity.form}"),
        "components": workbook.scene.dimension if task.quantity.form == "vector" else None,
        "points": task.quantity.points,
        "needs": _needs(task, workbook),
        "hints": [text(language, f"{own}.hints.{level}", **values) for level in (1, 2, 3)],
        "blocks": _blocks(task, workbook, language),
        "solution": {"chapter": task.quantity.chapter, "steps": steps_of(task, workbook)},
    }


def _blocks(task: Task, workbook: Workbook, language: str) -> list[Document]:
    """What is to be put in order."""
    own = task.quantity.judge
    return block_documents(workbook.solution, own.goal, task.subject, language) if isinstance(own, Ordering) else []


def steps_of(task: Task, workbook: Workbook) -> list[str]:
    """Ids of the steps that may show the answer, the likeliest first."""
    conserved = task.quantity.kind == "conserved" and workbook.solution.conserved_of[int(task.subject) - 1]
    contact = contact_of(workbook.solution, task.subject)
    names = {"subject": task.subject, "cyclic": conserved or "", "contact": contact}
    return [step.format(**names) for step in task.quantity.steps]


def _needs(task: Task, workbook: Workbook) -> list[str]:
    """The tasks from whose answers this one is derived."""
    known = workbook.tasks
    return [each.id for each in known if each.quantity.kind in task.quantity.needs]


def _subject(task: Task, workbook: Workbook, language: str) -> dict[str, object]:
    scene = workbook.scene
    values: dict[str, object] = {
        "subject": label(coordinate_of(task.subject), scene, language),
        "dimension": scene.dimension,
    }
    if task.quantity.form == "vector":
        values["axes"] = axes_text(scene, language)
    return values | asked_about(task, workbook, language)


def model_answer(task: Task, workbook: Workbook, language: str = "en") -> Document:
    """The right answer as plain text and LaTeX, in its display form."""
    right = judge_of(task).written(workbook, task, language)
    return {"plain": list(right.plain), "latex": list(right.latex)}
