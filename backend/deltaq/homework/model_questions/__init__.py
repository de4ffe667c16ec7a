"""Questions on the last chapter whose answers are no expressions: positions of rest, their stability, steady motions.

An answer is a set of positions, a word with a condition, or a rule for a rate. Each kind of question has a judge of its
own, which reads the answer, says whether it is right, and writes the right one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from ...language.parser import Syntax
from ..equality import Parts
from ..solution import Solution
from ..verdict import Verdict

C = TypeVar("C")


@dataclass(frozen=True)
class Written:
    """An answer as text that can be typed, and as LaTeX: one of each for every part."""

    plain: tuple[str, ...]
    latex: tuple[str, ...]


@dataclass(frozen=True)
class Understood(Generic[C]):
    """An answer as it was read: its expressions, how it is shown, and what its judge needs of it."""

    parts: Parts
    plain: str
    latex: str
    content: C


class QuestionJudge(Protocol[C]):
    """What decides on the answers to one kind of question."""

    def read(self, solution: Solution, subject: str, text: str, syntax: Syntax, /) -> Understood[C]:
        """The answer as it is meant. Raises ExpressionError with the offset in the text."""

    def verdict(self, solution: Solution, subject: str, given: Understood[C], /) -> Verdict:
        """Whether it is right, and what is wrong with it."""

    def written(self, solution: Solution, subject: str, language: str, /) -> Written:
        """The right answer."""
