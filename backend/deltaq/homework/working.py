"""A student's whole working, line by line: right, wrong, or following correctly from a line that was wrong.

What follows from a wrong line should hold the coordinates that the right answer holds, and most of its terms. Where it
holds less, the mistake has made the rest easier: that is told, and earns less. A line that makes everything after it
trivial carries nothing: the mistake in it must be one that can be named, and something must be left that moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import sympy as sp

from ..contract.check import WrittenAnswer
from ..language.canonical import display
from ..language.memory import cached_method
from ..language.parser import Syntax
from .checking import Answer, Shown, check, judge_of
from .diagnosis import diagnose
from .equality import Parts
from .gradebook import Shares, earned_share, standing_after
from .own import OwnSolution
from .reading import Reading
from .solution import Solution
from .task import Task
from .verdict import Verdict
from .workbook import Workbook

SUBSTANTIAL = 0.6  # of the terms of the right answer
LEAST = 0.3  # of them: where less is left, nothing was derived
MOST_WRONG = 6
DECIMAL_COMMA = frozenset({"de"})  # languages that write 0,5


@dataclass(frozen=True)
class Line:
    """One answer in a working."""

    task: str
    text: str
    syntax: Syntax = "plain"
    decimal_comma: bool = False


class Answered(Protocol):
    """A task and what was answered, as the contract's requests and their lines have it."""

    @property
    def task(self) -> str:
        """Its id."""

    @property
    def answer(self) -> WrittenAnswer:
        """The text, and how it is written."""


def line_of(asked: Answered, language: str) -> Line:
    """What was answered, in a language that may write decimals with a comma, as a line of a working."""
    return Line(asked.task, asked.answer.value, asked.answer.syntax, decimal_comma=language in DECIMAL_COMMA)


def shown_line(workbook: Workbook, line: Line) -> Shown:
    """How a line is read. Raises ExpressionError."""
    task = workbook.task(line.task)
    return judge_of(task).shown(workbook, task, Answer(line.text, line.syntax, line.decimal_comma))


def parts_of(workbook: Workbook, line: Line) -> Parts:
    """What a line says. Raises ExpressionError."""
    return shown_line(workbook, line).parts


@dataclass(frozen=True)
class Scheme:
    """How points are given: by task, and the shares of a line that follows correctly from a wrong one."""

    points: Mapping[str, float] = field(default_factory=dict)
    shares: Shares = Shares()

    def of(self, task: Task) -> float:
        """The points that a task is worth."""
        return self.points.get(task.id, task.quantity.points)


@dataclass(frozen=True)
class Marked:
    """A line with its verdict and the points it earns."""

    verdict: Verdict
    points: float
    of: float


def mark(workbook: Workbook, lines: Sequence[Line], scheme: Scheme) -> list[Marked]:
    """The lines in order, each in the light of those before it. How they earn points is told in `gradebook`."""
    best: dict[str, float] = {}
    wrong: Mapping[str, Parts] = {}
    marked = []
    for line in lines:
        task = workbook.task(line.task)
        verdict, wrong = _judged(workbook, task, line, wrong)
        worth = scheme.of(task) * earned_share(verdict.outcome, verdict.remark, verdict.partial, scheme.shares)
        before = best.get(task.id, 0.0)
        best[task.id] = max(before, worth)
        marked.append(Marked(verdict, max(0.0, worth - before), scheme.of(task)))
    return marked


def wrong_among(workbook: Workbook, lines: Sequence[Line]) -> Mapping[str, Parts]:
    """The wrong answers that stand after these lines, by task: what was corrected stands no more."""
    wrong: Mapping[str, Parts] = {}
    for line in lines:
        _, wrong = _judged(workbook, workbook.task(line.task), line, wrong)
    return wrong


def _judged(
    workbook: Workbook, task: Task, line: Line, wrong: Mapping[str, Parts]
) -> tuple[Verdict, Mapping[str, Parts]]:
    """The verdict on a line, and the wrong answers that stand after it."""
    verdict = check_following(workbook, task, line, wrong)

    def parts() -> Parts:
        return parts_of(workbook, line)

    return verdict, standing_after(wrong, task.id, verdict.outcome, parts)


def check_following(workbook: Workbook, task: Task, line: Line, wrong: Mapping[str, Parts]) -> Verdict:
    """The verdict on a line in the light of the wrong lines before it."""
    verdict = check(workbook, task, line.text, line.syntax, decimal_comma=line.decimal_comma)
    if verdict.outcome != "wrong" or not wrong:
        return verdict
    given = parts_of(workbook, line)
    if task.id in wrong and task.quantity.equality.same(given, wrong[task.id], workbook.solution).equal:
        return replace(
            verdict, outcome="follow_through", remark="repeated", misconceptions=(), slips=(), marked="", blocks=()
        )
    ways = [way for way in _ways_from_wrong_lines(workbook, task, wrong) if _follows(task, given, way)]
    if not ways:
        return verdict
    if any(_substantial(task.value(way), workbook.shown(task), workbook) for way in ways):
        return _following(verdict, "")
    easier = [tuple(way.answers) for way in ways if _carries(workbook, task, way)]
    return _following(verdict, "simplified", min(easier, key=len)) if easier else verdict


def _following(verdict: Verdict, remark: str, source: tuple[str, ...] = ()) -> Verdict:
    """The verdict on a line that is right in the light of those before it."""
    found = replace(verdict, outcome="follow_through", remark=remark, misconceptions=(), slips=(), marked="")
    return replace(found, counterexample=None, source=source)


def _ways_from_wrong_lines(workbook: Workbook, task: Task, wrong: Mapping[str, Parts]) -> Iterator[OwnSolution]:
    """From all wrong lines, then from each of them alone; never from an earlier answer to the same task."""
    others = {name: parts for name, parts in wrong.items() if name != task.id}
    alone = [{name: parts} for name, parts in others.items()]
    for answers in [others, *alone[-MOST_WRONG:]] if len(alone) > 1 else alone:
        yield OwnSolution(workbook.scene, workbook.solution, answers)


def _follows(task: Task, given: Parts, solution: Solution) -> bool:
    """Whether the line is what their own lines lead to."""
    try:
        expected = task.value(solution)
    except (ValueError, ZeroDivisionError):
        return False
    return task.quantity.equality.same(given, expected, solution).equal is True


def _carries(workbook: Workbook, task: Task, way: OwnSolution) -> bool:
    """Whether something is left to be derived from lines of which each has a mistake that can be named."""
    expected, right = task.value(way), workbook.shown(task)
    own, true = (_content(parts, workbook) for parts in (expected, right))
    accelerations = {workbook.solution.acceleration(q) for q in workbook.solution.free}
    parameters = {workbook.solution.q(p.name) for p in workbook.scene.parameters}
    moving = _symbols(right) & accelerations or _symbols(right) - parameters
    enough = own >= LEAST * true and bool(_symbols(expected) & moving)
    return enough and all(_is_named(workbook, name, parts) for name, parts in way.answers.items())


def _symbols(parts: Parts) -> set[sp.Symbol]:
    return {symbol for part in parts for symbol in part.free_symbols}


@cached_method
def _is_named(workbook: Workbook, task: str, parts: Parts) -> bool:
    """Whether the mistake in a wrong line can be named: one law, or one term in each of its parts."""
    if not any(parts):
        return False  # from nothing follows nothing
    found = diagnose(workbook, workbook.task(task), Reading(parts, None, ()), "")
    return bool(found.misconceptions or found.slips)


def _substantial(expected: Parts, right: Parts, workbook: Workbook) -> bool:
    """Every coordinate, rate and acceleration of the right answer, and most of its terms."""
    parameters = {workbook.solution.q(p.name) for p in workbook.scene.parameters}
    own, true = (_content(parts, workbook) for parts in (expected, right))
    needed = {symbol for part in right for symbol in part.free_symbols} - parameters
    held = {symbol for part in expected for symbol in part.free_symbols}
    return needed <= held and own >= SUBSTANTIAL * true


def _content(parts: Parts, workbook: Workbook) -> int:
    """The number of terms in display form."""
    shown = (display(sp.expand(part), workbook.solution.symbols).expand() for part in parts)
    return sum(len(sp.Add.make_args(part)) for part in shown if part != 0)
