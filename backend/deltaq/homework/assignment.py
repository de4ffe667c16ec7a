"""Assignments: which tasks of which scenes, what each counts, and whether every student gets their own values.

format = 1
title = { de = "Blatt 3", en = "Sheet 3" }
individual = true            # values drawn from the student's name
follow_through = 0.5         # share of the points for a right consequence of a wrong line

[[tasks]]
scene = "pendulum"           # an id, or a scene document
task = "equation:phi"
points = 3
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from ..errors import InputError, Problem, RequestError, escaped
from ..mechanics.user_text import Translated, translated
from .gradebook import FOLLOW_THROUGH
from .task import Task
from .workbook import Workbook, workbook_of

FORMAT = 1
MOST_TASKS = 64
FIELDS = {"format", "title", "individual", "follow_through", "tasks"}
TASK_FIELDS = {"scene", "task", "points", "guides", "freeze", "parameters"}


@dataclass(frozen=True)
class AssignedTask:
    """One task of an assignment: the scene with its changes, the task's id, and what it counts (None: as usual)."""

    scene: Mapping[str, object]
    task: str
    points: float | None = None

    def workbook(self, seed: str | None) -> Workbook:
        """The workbook of the scene, with the values that belong to a seed; its own ones without."""
        return workbook_of({**self.scene, "seed": seed})

    def resolved(self, seed: str | None) -> tuple[Workbook, Task]:
        """The workbook and the task in it. Raises UnknownNameError if the scene has no such task."""
        workbook = self.workbook(seed)
        return workbook, workbook.task(self.task)


@dataclass(frozen=True)
class Assignment:
    """The tasks in order; `individual` draws each student's parameter values from a seed."""

    title: Translated
    tasks: tuple[AssignedTask, ...]
    individual: bool
    follow_through: float


def load_assignment(path: Path) -> Assignment:
    """The assignment of a TOML or JSON file. Raises InputError that points at what is wrong."""
    content = path.read_bytes()
    try:
        text = content.decode("utf-8-sig")
        document = json.loads(text) if path.suffix == ".json" else tomllib.loads(text)
    except ValueError as error:
        raise RequestError(Problem("assignment-syntax", parameters={"detail": str(error)[:200]})) from None
    return read_assignment(document)


def read_assignment(document: object) -> Assignment:
    """The assignment of a document. Raises InputError with all that is wrong."""
    if not isinstance(document, Mapping):
        raise RequestError(Problem("request-not-object"))
    problems = [*_problems(document)]
    if problems:
        raise RequestError(*problems)
    tasks = tuple(_task(entry, f"/tasks/{n}") for n, entry in enumerate(document["tasks"]))
    share = float(document.get("follow_through", FOLLOW_THROUGH))
    title = translated(document.get("title") or {})
    return Assignment(title, tasks, bool(document.get("individual", False)), share)


def _problems(document: Mapping[str, object]) -> Iterator[Problem]:
    if document.get("format") != FORMAT:
        yield Problem("assignment-format", "/format", parameters={"format": FORMAT})
    for name in sorted(document.keys() - FIELDS):
        yield Problem("unknown-field", f"/{escaped(name)}", parameters={"field": name[:40]})
    title = document.get("title") or ""
    texts = title if isinstance(title, Mapping) else {"": title}
    for language in sorted(language for language, text in texts.items() if not isinstance(text, str)):
        yield Problem("request-not-text", f"/title/{escaped(language)}" if language else "/title")
    if not isinstance(document.get("individual", False), bool):
        yield Problem("request-not-boolean", "/individual")
    if not _is_number(document.get("follow_through", FOLLOW_THROUGH), 1.0):
        yield Problem("assignment-share", "/follow_through")
    tasks = document.get("tasks")
    if not isinstance(tasks, list) or not tasks:
        yield Problem("assignment-no-task", "/tasks")
    elif len(tasks) > MOST_TASKS:
        yield Problem("request-too-many", "/tasks", parameters={"max_length": MOST_TASKS})
    else:
        for n, entry in enumerate(tasks):
            yield from _task_problems(entry, f"/tasks/{n}")


def _task_problems(entry: object, pointer: str) -> Iterator[Problem]:
    if not isinstance(entry, Mapping):
        yield Problem("request-not-object", pointer)
        return
    for name in sorted(entry.keys() - TASK_FIELDS):
        yield Problem("unknown-field", f"{pointer}/{escaped(name)}", parameters={"field": name[:40]})
    for name in ("scene", "task"):
        if name not in entry:
            yield Problem("missing-field", f"{pointer}/{name}", parameters={"field": name})
    if "points" in entry and not _is_number(entry["points"], 1000.0):
        yield Problem("request-not-number", f"{pointer}/points")


def _is_number(value: object, most: float) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and 0 <= value <= most


def _task(entry: Mapping[str, object], pointer: str) -> AssignedTask:
    """The task, if its scene has it."""
    scene = {name: entry[name] for name in ("scene", "guides", "freeze", "parameters") if name in entry}
    points = float(cast("float", entry["points"])) if "points" in entry else None
    assigned = AssignedTask(scene, str(entry["task"]), points)
    try:
        assigned.resolved(None)
    except InputError as error:
        raise type(error)(*(problem.below(pointer) for problem in error.problems)) from None
    return assigned
