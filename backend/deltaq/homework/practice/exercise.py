"""An exercise: a system drawn at random and a task about it, or one in which a misconception can be made again."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from itertools import islice, product

from ...errors import Problem, UnknownNameError
from ..faulty_solution import FaultySolution, misconceptions
from ..quantities import quantity_of
from ..task import Task
from ..workbook import Workbook, workbook_of
from .draw import Draw
from .levels import LEVELS, Level, system_of

LONGEST = 120  # operations of an answer that is still written by hand
TRIALS = 24  # systems that are looked at for a misconception
VARIANTS = 6  # of a family, looked at for a task
SHARE = 0.5  # of the operations of the longest answer: what is shorter is too easy a subject of a task


@dataclass(frozen=True)
class Exercise:
    """A task about a system. `recalled` is the misconception that it can be got wrong by."""

    workbook: Workbook
    task: Task
    level: Level
    recalled: str = ""


def exercise_of(level: Level, seed: str, number: int, recall: str = "", kind: str = "") -> Exercise:
    """The so manyeth exercise of a seed at a level; with `recall` one in which this misconception can be made.

    It is sought at the level first, then at the ones below and above; a task of this `kind` is preferred. Where there
    is none in so many trials, the exercise is one without it. Raises UnknownNameError for an unknown misconception.
    """
    if recall:
        found = next(_recalling(level, f"{seed}/{recall}", number, _misconception(recall), kind), None)
        if found:
            return found
    return next(_fresh(level, seed, number))


def _misconception(identifier: str) -> type[FaultySolution]:
    known = {each.id: each for each in misconceptions()}
    if identifier not in known:
        near = get_close_matches(identifier, known, n=1)
        parameters = {"name": identifier, "suggestion": near[0] if near else ""}
        raise UnknownNameError(Problem("unknown-misconception", "/recall", parameters=parameters))
    return known[identifier]


def _fresh(level: Level, seed: str, number: int) -> Iterator[Exercise]:
    """Of a family that has no such task in several variants, as of one that is always driven, the next is taken."""
    for place, trial in product(range(number, number + len(level.families)), range(VARIANTS)):
        workbook = _workbook(level, seed, place, trial)
        draw = Draw(seed, level.number, place, trial, "task")
        for kind in draw.shuffled(level.kinds):
            tasks = worthwhile(workbook, kind)
            if tasks:
                yield Exercise(workbook, draw.one_of(tasks), level)


def _workbook(level: Level, seed: str, number: int, trial: int = 0) -> Workbook:
    return workbook_of({"scene": system_of(level, seed, number, trial)})


def worthwhile(workbook: Workbook, kind: str) -> tuple[Task, ...]:
    """The tasks of a kind whose answers are neither nothing nor endless, without those that are much the easiest."""
    quantity = quantity_of(kind)
    tasks = [Task(quantity, subject) for subject in quantity.subjects(workbook.solution)] if quantity else []
    sizes = {task: _operations(workbook, task) for task in tasks}
    possible = {task: size for task, size in sizes.items() if 0 < size <= LONGEST}
    least = SHARE * max(possible.values(), default=0)
    return tuple(task for task, size in possible.items() if size >= least)


def _operations(workbook: Workbook, task: Task) -> int:
    """How long the right answer is; 0 where there is nothing to be worked out: it is zero, or a symbol."""
    parts = workbook.right(task)
    if task.quantity.judge is not None:
        return max(1, len(parts))  # places and conditions, not formulas
    return int(sum(part.count_ops() for part in workbook.short(parts)))


def _recalling(level: Level, seed: str, number: int, mistake: type[FaultySolution], kind: str) -> Iterator[Exercise]:
    """Exercises in which a misconception can be made: of that kind at the level, then of any at the nearest levels."""
    nearest = sorted(LEVELS, key=lambda each: (abs(each.number - level.number), each.number))
    for one, kinds in ((level, (kind,)), *((each, each.kinds) for each in nearest)):
        for trial in range(TRIALS if quantity_of(kinds[0]) else 0):
            workbook = _workbook(one, seed, number + trial)
            for task in _tempting(workbook, mistake, kinds):
                yield Exercise(workbook, task, one, mistake.id)


def _tempting(workbook: Workbook, mistake: type[FaultySolution], kinds: tuple[str, ...]) -> Iterator[Task]:
    """Tasks whose answer the misconception changes, of the kinds that show it if there are any."""
    solutions = tuple(mistake.variants(workbook.solution))
    telling = tuple(kind for kind in kinds if kind in (mistake.evident or ()))
    for kind in (telling or kinds) if solutions else ():
        for task in worthwhile(workbook, kind):
            if any(islice(workbook.candidates_by(task, solutions), 1)):
                yield task
