"""A quantity that can be asked for: its form, its kind of equality, and its value by a solution."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

from .equality import Equality, Parts, conserved, lagrangian, symmetry, up_to_constant
from .model_questions import QuestionJudge
from .solution import Solution

Form = Literal["expression", "vector", "equation", "equations", "set", "positions", "stability", "rate", "order"]
Subjects = Callable[[Solution], Iterable[str]]


@dataclass(frozen=True)
class Quantity:
    """One kind of task: `subjects` lists what it can be asked of, `value` are the parts of its answer.

    `needs` are the quantities it is derived from, `chapter` is where the derivation shows it and `steps` the steps that
    do, the likeliest first. `labels` are the symbols that may stand on the left of the answer, and `points` is what it
    counts if nobody says otherwise. `judge` decides on answers that are more than expressions.
    """

    kind: str
    form: Form
    equality: Equality
    value: Callable[[Solution, str], Parts]
    subjects: Subjects
    chapter: str
    labels: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    points: float = 1.0
    steps: tuple[str, ...] = ()
    judge: QuestionJudge[Any] | None = None

    @property
    def up_to_factor(self) -> bool:
        """Whether a constant factor makes no difference: an integral of motion has no unit of its own."""
        return self.equality in (conserved, symmetry)

    @property
    def up_to_constant(self) -> bool:
        """Whether an added constant makes no difference."""
        return self.up_to_factor or self.equality in (up_to_constant, lagrangian)
