"""What a student wrote → the parts of an answer, by candidate readings: by convention, by dimensions, by the task."""

from __future__ import annotations

from ...language.parser import Syntax
from ..solution import Solution
from ..task import Task
from .candidates import Candidate, candidates, sums
from .reader import Claim, Reading

__all__ = ["Candidate", "Claim", "Reading", "candidates", "read", "sums"]


def read(task: Task, solution: Solution, text: str, syntax: Syntax, *, decimal_comma: bool = False) -> Reading:
    """The reading to take of an answer. Raises ExpressionError with the offset in the text."""
    return candidates(task, solution, text, syntax, decimal_comma=decimal_comma)[0].reading
