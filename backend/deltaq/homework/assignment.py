"""Assignments: which tasks of which scenes, what each counts, and whether every student gets their own values.

format = 1
title = { de = "Blatt 3", en = "Sheet 3" }
individual = true            # each student's own, drawn from their name
vary = ["values", "axes", "coordinates", "factors"]  # what differs; values alone if it is left out
follow_through = 0.5         # share of the points for a right consequence of a wrong line

[[tasks]]
scene = "pendulum"           # an id, or a scene document
task = "equation:phi"
points = 3
"""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

from ..contract.assignment import USUAL, Aspect, AssignedTaskDocument, AssignmentDocument
from ..contract.base import SceneWithChanges
from ..contract.reading import made_of
from ..errors import InputError, Problem, RequestError
from .gradebook import CHANGES
from .task import Task
from .workbook import Workbook, workbook_asked_about


def load_assignment(path: Path) -> AssignmentDocument:
    """The assignment of a TOML or JSON file. Raises InputError that points at what is wrong."""
    content = path.read_bytes()
    try:
        text = content.decode("utf-8-sig")
        document = json.loads(text) if path.suffix == ".json" else tomllib.loads(text)
    except ValueError as error:
        raise RequestError(Problem("assignment-syntax", parameters={"detail": str(error)[:200]})) from None
    return read_assignment(document)


def read_assignment(document: object) -> AssignmentDocument:
    """The assignment of a document, its tasks looked up. Raises InputError with all that is wrong."""
    sheet = made_of(document, AssignmentDocument)
    look_up(sheet)
    return sheet


def look_up(sheet: AssignmentDocument) -> None:
    """Raises InputError that points at the first task which its scene does not have."""
    for number, assigned in enumerate(sheet.tasks):
        try:
            resolved(assigned, None)
        except InputError as error:
            raise type(error)(*(problem.below(f"/tasks/{number}") for problem in error.problems)) from None


def resolved(
    assigned: AssignedTaskDocument, seed: str | None, vary: tuple[Aspect, ...] = USUAL
) -> tuple[Workbook, Task]:
    """The workbook of a task's scene as the student of a seed gets it (as it is without one), and the task in it.

    Raises UnknownNameError if the scene has no such task.
    """
    workbook = workbook_asked_about(assigned, seed, vary)
    return workbook, workbook.task(assigned.task)


def scene_of(assigned: AssignedTaskDocument) -> SceneWithChanges:
    """The scene of a task with its changes, and nothing else of the task."""
    return SceneWithChanges(**{name: getattr(assigned, name) for name in CHANGES})
