"""A scene ready to be asked about: its true road, the points at which answers are evaluated, and the wrong answers."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache

from ..errors import InputError
from ..language.canonical import display
from ..language.memory import cached_method
from ..mechanics.requests import changed_scene
from ..mechanics.scene import Scene
from .detour import Detour, misconceptions
from .equality import Fingerprint, Parts
from .road import Road
from .sampling import Sampler, close
from .seeds import seeded
from .task import Task, task_of, tasks_of

KEPT = 48
MOST_OPERATIONS = 6000  # of a right answer: beyond it the wrong ones take seconds each


@dataclass(frozen=True)
class Candidate:
    """A wrong answer: the road that leads to it, its parts, and the numbers by which it is found."""

    road: Detour
    parts: Parts
    fingerprint: Fingerprint


@dataclass(frozen=True, eq=False)
class Workbook:
    """What is computed once for a scene, and serves every answer to it."""

    scene: Scene

    @cached_property
    def road(self) -> Road:
        """The way from the scene to every right answer."""
        return Road(self.scene)

    @cached_property
    def sampler(self) -> Sampler:
        """Numbers that tell answers apart."""
        return Sampler(self.road)

    @cached_property
    def tasks(self) -> tuple[Task, ...]:
        """All that can be asked about the scene."""
        return tuple(tasks_of(self.road))

    @cached_method
    def task(self, identifier: str) -> Task:
        """The task of this id. Raises UnknownNameError."""
        return task_of(self.road, identifier)

    @cached_method
    def right(self, task: Task) -> Parts:
        """The right answer to a task."""
        return task.value(self.road)

    @cached_method
    def shown(self, task: Task) -> Parts:
        """The right answer in its display form."""
        return self.short(self.right(task))

    def short(self, parts: Parts) -> Parts:
        """Any answer in its display form."""
        return tuple(display(part.expand(), self.road.symbols) for part in parts)

    @cached_method
    def fingerprint(self, task: Task) -> Fingerprint | None:
        """Numbers that every right answer to the task shares; None where numbers cannot tell."""
        return task.quantity.equality.fingerprint(self.right(task), self.sampler)

    @cached_property
    def detours(self) -> tuple[Detour, ...]:
        """Every misconception in every way it can be made on this scene."""
        return tuple(detour for kind in misconceptions() for detour in kind.variants(self.road))

    @cached_method
    def candidates(self, task: Task) -> tuple[Candidate, ...]:
        """The wrong answers to a task, each road that changes the answer once, the likely ones first."""
        size = sum(part.count_ops() for part in self.right(task))
        return tuple(self._candidates(task)) if size <= MOST_OPERATIONS else ()

    def _candidates(self, task: Task) -> Iterator[Candidate]:
        right = self.fingerprint(task)
        for road in self.detours:
            parts = _attempt(task, road)
            found = task.quantity.equality.fingerprint(parts, self.sampler) if parts else None
            if found and (right is None or len(found) != len(right) or not close(found, right)):
                yield Candidate(road, parts, found)


def _attempt(task: Task, road: Detour) -> Parts:
    """The answer that a wrong road leads to; none where it leads nowhere (an integral without a closed form)."""
    try:
        return task.value(road)
    except (InputError, ValueError, ZeroDivisionError):
        return ()


def workbook_of(document: Mapping[str, object]) -> Workbook:
    """The workbook of {scene, guides?, freeze?, parameters?, seed?}; the same content has the same one."""
    fields = ("scene", "guides", "freeze", "parameters", "seed")
    return _kept_workbook(json.dumps({field: document.get(field) for field in fields}, sort_keys=True))


@lru_cache(maxsize=KEPT)
def _kept_workbook(text: str) -> Workbook:
    document = json.loads(text)
    scene, seed = changed_scene(document), document["seed"]
    return Workbook(scene if seed is None else seeded(scene, str(seed)))
