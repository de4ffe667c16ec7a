"""A scene ready to be asked about: its solution, the points at which answers are evaluated, and the wrong answers."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache

from ..contract.assignment import USUAL, Aspect
from ..contract.base import SceneWithChanges
from ..contract.check import RowQuestion
from ..contract.reading import read
from ..contract.task import SceneAskedAbout
from ..derivation.multipliers import simplified
from ..errors import InputError
from ..language.canonical import display
from ..language.memory import cached_method
from ..mechanics.requests import changed_scene
from ..mechanics.scene import Scene
from .alternatives import alternatives
from .equality import Fingerprint, Parts
from .faulty_solution import FaultySolution, misconceptions
from .gradebook import content_of
from .sampling import Sampler, close
from .solution import Solution
from .task import Task, task_of, tasks_of
from .variants import DRAWS, Variant, individual

CACHED = 48
MOST_OPERATIONS = 6000  # of a right answer: beyond it the wrong ones take seconds each


@dataclass(frozen=True)
class Candidate:
    """A wrong answer: the solution that leads to it, its parts, and the numbers by which it is found."""

    solution: FaultySolution
    parts: Parts
    fingerprint: Fingerprint


@dataclass(frozen=True, eq=False)
class Workbook:
    """What is computed once for a scene, and serves every answer to it.

    `variant` is what is told otherwise in it, and `seed` whose it is.
    """

    scene: Scene
    variant: Variant = Variant()
    seed: str = ""

    @cached_property
    def solution(self) -> Solution:
        """The way from the scene to every right answer."""
        return Solution(self.scene, seed=self.seed)

    @cached_property
    def sampler(self) -> Sampler:
        """Numbers that tell answers apart."""
        return Sampler(self.solution)

    @cached_property
    def tasks(self) -> tuple[Task, ...]:
        """All that can be asked about the scene."""
        return tuple(tasks_of(self.solution))

    @cached_method
    def task(self, identifier: str) -> Task:
        """The task of this id. Raises UnknownNameError."""
        return task_of(self.solution, identifier)

    @cached_method
    def right(self, task: Task) -> Parts:
        """The right answer to a task."""
        return task.value(self.solution)

    @cached_method
    def alternatives(self, task: Task) -> tuple[tuple[Parts, tuple[str, ...]], ...]:
        """The answers that are right besides, each with the loads that it leaves out of V."""
        return tuple(alternatives(self.solution, task))

    @cached_method
    def shown(self, task: Task) -> Parts:
        """The right answer in its display form; where constraints answer, with common factors cancelled."""
        right = self.right(task)
        if self.solution.conditions and task.quantity.form == "expression":
            right = tuple(simplified(self.solution.model, part.expand()) for part in right)
        return self.short(right)

    def short(self, parts: Parts) -> Parts:
        """Any answer in its display form."""
        return tuple(display(part.expand(), self.solution.symbols) for part in parts)

    @cached_method
    def fingerprint(self, task: Task) -> Fingerprint | None:
        """Numbers that every right answer to the task shares; None where numbers cannot tell."""
        return task.quantity.equality.fingerprint(self.right(task), self.sampler)

    @cached_property
    def faulty_solutions(self) -> tuple[FaultySolution, ...]:
        """Every misconception in every way it can be made on this scene."""
        return tuple(faulty for kind in misconceptions() for faulty in kind.variants(self.solution))

    @cached_method
    def candidates(self, task: Task) -> tuple[Candidate, ...]:
        """The wrong answers to a task, each solution that changes the answer once, the likely ones first."""
        size = sum(part.count_ops() for part in self.right(task))
        return tuple(self.candidates_by(task, self.faulty_solutions)) if size <= MOST_OPERATIONS else ()

    def candidates_by(self, task: Task, solutions: Iterable[FaultySolution]) -> Iterator[Candidate]:
        """The wrong answers that these solutions lead to."""
        right = self.fingerprint(task)
        for solution in solutions:
            parts = _attempt(task, solution)
            found = task.quantity.equality.fingerprint(parts, self.sampler) if parts else None
            if found and (right is None or len(found) != len(right) or not close(found, right)):
                yield Candidate(solution, parts, found)


def _attempt(task: Task, solution: FaultySolution) -> Parts:
    """The answer that a wrong solution leads to; none where it leads nowhere (an integral without a closed form)."""
    try:
        return task.value(solution)
    except (InputError, ValueError, ZeroDivisionError):
        return ()


def workbook_of(document: Mapping[str, object]) -> Workbook:
    """The workbook of a document with the fields of SceneAskedAbout. Raises InputError for what cannot be read."""
    asked = read(SceneAskedAbout, document)
    return workbook_asked_by(asked)


def workbook_asked_by(asked: SceneAskedAbout | RowQuestion) -> Workbook:
    """The workbook of a request: its scene as the student of its seed gets it."""
    return workbook_asked_about(asked, asked.seed, asked.vary)


def workbook_asked_about(
    asked: SceneWithChanges, seed: str | None = None, vary: tuple[Aspect, ...] = USUAL
) -> Workbook:
    """The workbook of a scene with its changes, as the student of a seed gets it; the same content has the same."""
    return _cached_workbook(content_of(asked), seed, tuple(sorted(set(vary))))


@lru_cache(maxsize=CACHED)
def _cached_workbook(content: str, seed: str | None, vary: tuple[Aspect, ...]) -> Workbook:
    if seed is None:
        return Workbook(changed_scene(SceneWithChanges.model_validate(json.loads(content))))
    return _own_workbook(_cached_workbook(content, None, ()), seed, vary)


def _own_workbook(common: Workbook, seed: str, vary: tuple[Aspect, ...]) -> Workbook:
    """What the student of a seed gets: of its draws the first in which the same things can be asked.

    With other values a rest may be unstable, with other factors it may have no closed form; a later draw changes less.
    """
    asked = [task.id for task in common.tasks]
    for draw in range(DRAWS):
        own = Workbook(*individual(common.scene, seed, vary, draw), seed)
        if [task.id for task in own.tasks] == asked:
            return own
    return Workbook(common.scene, seed=seed)
