"""Tasks: what can be asked about a scene."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches

from ..errors import Problem, UnknownNameError
from .equality import Parts
from .quantities import QUANTITIES, quantity_of
from .quantity import Quantity
from .solution import Solution


@dataclass(frozen=True)
class Task:
    """One question: a quantity of a subject (a body, a coordinate, a number), "" where there is only one."""

    quantity: Quantity
    subject: str = ""

    @property
    def id(self) -> str:
        """`kinetic-energy`, `equation:phi`"""
        return f"{self.quantity.kind}:{self.subject}" if self.subject else self.quantity.kind

    def value(self, solution: Solution) -> Parts:
        """The parts of the answer that a solution leads to; none where it leads nowhere."""
        return self.quantity.value(solution, self.subject)


def tasks_of(solution: Solution) -> Iterator[Task]:
    """All tasks of a scene, in the order in which a derivation answers them."""
    for quantity in QUANTITIES:
        for subject in quantity.subjects(solution):
            yield Task(quantity, subject)


def task_of(solution: Solution, identifier: str) -> Task:
    """The task of this id. Raises UnknownNameError with the nearest one."""
    kind, _, subject = identifier.partition(":")
    quantity = quantity_of(kind)
    if quantity is not None and subject in quantity.subjects(solution):
        return Task(quantity, subject)
    known = [task.id for task in tasks_of(solution)]
    near = get_close_matches(identifier, known, n=1)
    parameters = {"name": identifier[:64], "known": ", ".join(known), "suggestion": near[0] if near else ""}
    raise UnknownNameError(Problem("unknown-task", "/task", parameters=parameters))
