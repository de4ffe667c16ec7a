"""Checking one answer: it is read, compared by numbers, decided exactly, and diagnosed."""

from __future__ import annotations

from dataclasses import replace

from ..errors import ExpressionError
from ..language.latex_printer import Typography, latex
from ..language.parser import Syntax
from .counterexamples import counterexample
from .diagnosis import Diagnosis, diagnose, own_term
from .dimensions import Told, other_unit, unlike_terms
from .equality import Match, Parts, equation
from .partwise import part_outcomes
from .reading import Reading, read
from .sampling import DISTINCT, close
from .solution import Solution
from .task import Task
from .verdict import Slip, Verdict
from .workbook import Workbook


def check(workbook: Workbook, task: Task, text: str, syntax: Syntax) -> Verdict:
    """The verdict on one answer to one task: read, compared by numbers, decided exactly, and diagnosed."""
    try:
        reading = read(task, workbook.solution, text, syntax)
    except ExpressionError as error:
        return Verdict("invalid", problems=error.problems)
    typography = Typography(workbook.scene.names)
    shown = latex(reading.shown, typography)
    match = compare(workbook, task, reading.parts)
    if match.equal:
        return Verdict("correct", shown, match.remark)
    parts = part_outcomes(workbook, task, reading.parts)
    if match.equal is None:
        return Verdict("undecided", shown, parts=parts)
    return replace(_wrong(workbook, task, reading, match, shown, syntax), parts=parts)


def compare(workbook: Workbook, task: Task, given: Parts) -> Match:
    """Whether an answer is right. Numbers that differ settle it; else the exact test of the quantity decides."""
    if task.quantity.form == "set":  # numbers at the scene's values are answers, too
        return task.quantity.equality.same(given, workbook.right(task), workbook.solution)
    own = task.quantity.equality.fingerprint(given, workbook.sampler)
    right = workbook.fingerprint(task)
    if own == ():
        return Match(equal=False, remark="degenerate")
    if own is None or right is None or (len(own) == len(right) and close(own, right, DISTINCT)):
        return task.quantity.equality.same(given, workbook.right(task), workbook.solution)
    return _solved(workbook.solution, task, given)


def _solved(solution: Solution, task: Task, given: Parts) -> Match:
    """An equation solved for its own acceleration is another combination of the set, and right as well."""
    others = {solution.acceleration(q) for q in solution.free if q != task.subject}
    if task.quantity.kind == "equation" and not given[0].free_symbols & others:
        return equation.same_solved(given, solution)
    return Match(equal=False)


def _wrong(workbook: Workbook, task: Task, reading: Reading, match: Match, shown: str, syntax: Syntax) -> Verdict:
    given, right = reading.parts, workbook.right(task)
    if match.remark == "degenerate":
        return Verdict("wrong", shown, match.remark)
    example = counterexample(task, given, right, workbook.solution)
    found = Diagnosis() if match.remark else diagnose(workbook, task, given)
    units = None if found.misconceptions else _units(workbook, task, reading, syntax, alone=found.slip is None)
    if units:
        identifier, told = units
        return Verdict("wrong", shown, "", (identifier,), counterexample=example, parameters=told)
    typography = Typography(workbook.scene.names)
    slip = own_term(found.slip) if found.slip else None
    told_slip = Slip(slip.kind, latex(slip.term, typography)) if slip else None
    about = found.about[0] if found.about else ""
    return Verdict("wrong", shown, match.remark, found.misconceptions, about, told_slip, example)


def _units(workbook: Workbook, task: Task, reading: Reading, syntax: Syntax, *, alone: bool) -> Told | None:
    """Terms that cannot be added come first; another unit than the one asked for, where no slip explains it."""
    unlike = unlike_terms(reading, workbook.scene, syntax)
    measured = alone and task.quantity.form in ("expression", "vector") and task.quantity.kind != "conserved"
    return unlike or (other_unit(reading, workbook.shown(task), workbook.scene) if measured else None)
