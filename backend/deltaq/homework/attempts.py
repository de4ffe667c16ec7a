"""Which answers count how much: in time or late, and among the attempts that are allowed.

- An attempt at a task is an answer that differs from the one before: who hands in everything again, with one task
  corrected, has made one attempt more at this task alone.
- The attempts of a person at a task are numbered in the order of the column `time`, where it is empty in that of the
  rows. Those beyond what the assignment allows are marked and earn nothing.
- What comes after the deadline earns the share that the assignment states for it. A row without a time is in time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime

from ..contract.assignment import AssignmentDocument, instant
from .gradebook import Row, Target

ALWAYS = datetime.min.replace(tzinfo=UTC)


def counted(rows: Sequence[Row], targets: Sequence[Target], assignment: AssignmentDocument | None) -> tuple[Row, ...]:
    """The rows with the number of the attempt that each is, whether it is late, and what share of its points counts."""
    numbers = _attempts(rows, targets)
    return tuple(_counted(row, numbers.get(index, 0), assignment) for index, row in enumerate(rows))


def _counted(row: Row, attempt: int, assignment: AssignmentDocument | None) -> Row:
    if assignment is None:
        return replace(row, attempt=attempt)
    late = assignment.deadline is not None and _time(row) > instant(assignment.deadline)
    beyond = assignment.attempts is not None and attempt > assignment.attempts
    return replace(row, attempt=attempt, late=late, counts=0.0 if beyond else assignment.late if late else 1.0)


def _time(row: Row) -> datetime:
    return instant(row.time) if row.time and not row.refused else ALWAYS


def _attempts(rows: Sequence[Row], targets: Sequence[Target]) -> dict[int, int]:
    """The number of the attempt by the place of the row; rows that answer no task, or are nobody's, have none."""
    made: dict[tuple[str, str, str], list[tuple[str, str]]] = {}
    found: dict[int, int] = {}
    for index in sorted(range(len(rows)), key=lambda n: (_time(rows[n]), n)):
        row = rows[index]
        if row.person is None or row.target is None or row.refused:
            continue
        target = targets[row.target]
        answers = made.setdefault((row.person, target.working, target.task), [])
        answer = (row.syntax, row.answer.strip())
        if not answers or answers[-1] != answer:
            answers.append(answer)
        found[index] = len(answers)
    return found
