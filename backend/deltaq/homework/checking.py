"""Checking one answer: by the judge of its kind of question, or as formulas: compared by numbers, decided exactly, and
diagnosed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

from ..errors import ExpressionError
from ..language.bounds import MAX_CHARACTERS
from ..language.latex_printer import Typography, latex
from ..language.parser import Syntax
from ..language.plain_printer import plain
from ..language.tokens import fail
from ..language.tree import Span
from ..mechanics.scene import Scene
from . import slips
from .counterexamples import counterexample
from .diagnosis import Diagnosis, diagnose
from .dimensions import Told, other_unit, unlike_terms
from .equality import Match, Parts, equation, kept_by_constraints
from .model_questions import QuestionJudge, Understood, Written
from .partwise import DECIDED, part_outcomes, part_share
from .reading import Candidate, Reading, candidates
from .sampling import DISTINCT, close
from .solution import Solution
from .task import Task
from .verdict import ShownReading, Slip, Verdict
from .workbook import Workbook

DECIMAL = re.compile(r"(?<=[0-9])\s?(?:,|\{,\})(?=[0-9])")


@dataclass(frozen=True)
class Answer:
    """What somebody wrote; `decimal_comma` tells how 0,5 is usually meant where it can be meant in two ways."""

    text: str
    syntax: Syntax
    decimal_comma: bool = False


@dataclass(frozen=True)
class Shown:
    """An answer as it is understood before it is judged: its parts, LaTeX and plain, and the ways to read it."""

    parts: Parts
    latex: str
    plain: str
    readings: tuple[ShownReading, ...] = ()


class Judge(Protocol):
    """What decides on the answers to a task."""

    def check(self, workbook: Workbook, task: Task, answer: Answer, /) -> Verdict:
        """The verdict. Of several readings that survive, one that is right is taken; else the first."""

    def shown(self, workbook: Workbook, task: Task, answer: Answer, /) -> Shown:
        """How an answer is read. Raises ExpressionError with the offset in the text."""

    def written(self, workbook: Workbook, task: Task, language: str, /) -> Written:
        """The right answer in its display form."""


def judge_of(task: Task) -> Judge:
    """The judge of a task: formulas are compared, all other answers have a judge of their own."""
    own = task.quantity.judge
    return FormulaJudge() if own is None else AnswerJudge(own)


def check(workbook: Workbook, task: Task, text: str, syntax: Syntax, *, decimal_comma: bool = False) -> Verdict:
    """The verdict on one answer to one task."""
    return judge_of(task).check(workbook, task, Answer(text, syntax, decimal_comma))


# --- answers that are more than formulas -----------------------------------------------------------------------------


@dataclass(frozen=True)
class AnswerJudge:
    """Has the judge of a kind of question read an answer with and without decimal commas."""

    own: QuestionJudge[Any]

    def check(self, workbook: Workbook, task: Task, answer: Answer) -> Verdict:
        """What is right in one of the readings is right."""
        try:
            found = self._readings(workbook, task, answer)
        except ExpressionError as error:
            return Verdict("invalid", problems=error.problems)
        judged = [
            replace(self.own.verdict(workbook.solution, task.subject, one), understood_as=one.latex) for one in found
        ]
        return next((one for one in judged if one.outcome == "correct"), judged[0])

    def shown(self, workbook: Workbook, task: Task, answer: Answer) -> Shown:
        """By the usual reading."""
        first, *_ = self._readings(workbook, task, answer)
        return Shown(first.parts, first.latex, first.plain)

    def written(self, workbook: Workbook, task: Task, language: str) -> Written:
        """As the judge writes it."""
        return self.own.written(workbook.solution, task.subject, language)

    def _readings(self, workbook: Workbook, task: Task, answer: Answer) -> list[Understood[Any]]:
        """Those that can be read, the usual one first. Raises ExpressionError, of the usual one, if there is none."""
        found, failed = [], []
        for text in _with_and_without_decimals(answer):
            try:
                found.append(self.own.read(workbook.solution, task.subject, text, answer.syntax))
            except ExpressionError as error:
                failed.append(error)
        if not found:
            raise failed[0]
        return found


def _with_and_without_decimals(answer: Answer) -> Iterator[str]:
    length = len(answer.text)
    if length > MAX_CHARACTERS:
        fail("too-long", Span(MAX_CHARACTERS, length - MAX_CHARACTERS), length=length, limit=MAX_CHARACTERS)
    points = DECIMAL.sub(lambda found: ".".rjust(len(found[0])), answer.text)
    yield from dict.fromkeys((points, answer.text) if answer.decimal_comma else (answer.text, points))


# --- formulas --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FormulaJudge:
    """Compares expressions, vectors and equations."""

    def check(self, workbook: Workbook, task: Task, answer: Answer) -> Verdict:
        """Read, compared by numbers, decided exactly, and diagnosed."""
        try:
            found = _candidates(workbook, task, answer)
        except ExpressionError as error:
            return Verdict("invalid", problems=error.problems)
        judged = [(one.reading, _match(workbook, task, one.reading)) for one in found if one.survives]
        taken = next((n for n, (_, match) in enumerate(judged) if match.equal), 0)
        verdict = _judged(workbook, task, *judged[taken], answer.text, answer.syntax)
        return replace(verdict, readings=shown_readings(workbook.scene, found, taken))

    def shown(self, workbook: Workbook, task: Task, answer: Answer) -> Shown:
        """The first of the readings, with the others."""
        found = _candidates(workbook, task, answer)
        first, readings = found[0].reading, shown_readings(workbook.scene, found, 0)
        return Shown(first.parts, latex(first.shown, Typography(workbook.scene.names)), plain(first.shown), readings)

    def written(self, workbook: Workbook, task: Task, _language: str) -> Written:
        """One text for each part; equations with `= 0`."""
        typography, shown = Typography(workbook.scene.names), workbook.shown(task)
        ending = " = 0" if task.quantity.form in ("equation", "equations") else ""
        return Written(
            tuple(plain(part) + ending for part in shown), tuple(latex(part, typography) + ending for part in shown)
        )


def _candidates(workbook: Workbook, task: Task, answer: Answer) -> tuple[Candidate, ...]:
    return candidates(task, workbook.solution, answer.text, answer.syntax, decimal_comma=answer.decimal_comma)


def shown_readings(scene: Scene, found: Sequence[Candidate], taken: int) -> tuple[ShownReading, ...]:
    """The readings of an answer as they can be typed; none where there is nothing to choose."""
    typography = Typography(scene.names)
    if len(found) < 2:
        return ()
    return tuple(
        ShownReading(latex(one.reading.shown, typography), plain(one.reading.shown), taken=n == taken)
        for n, one in enumerate(found)
    )


def _match(workbook: Workbook, task: Task, reading: Reading) -> Match:
    """Whether an answer is right, and with it all members of its chain."""
    match = compare(workbook, task, reading.parts)
    if not match.equal or not reading.claims:
        return match
    held = [claim_holds(workbook, task, claim.parts) for claim in reading.claims]
    if False in held:
        return Match(equal=False, remark="chain")
    return match if all(held) else Match(equal=None)


def claim_holds(workbook: Workbook, task: Task, parts: Parts) -> bool | None:
    """Whether a member of a chain agrees with the right answer; of a system and of frequencies, with a part of it."""
    decide = DECIDED.get(task.quantity.form)
    if decide is not None and task.quantity.form != "vector":
        return all(outcome == "correct" for outcome in decide(workbook, task, parts))
    return compare(workbook, task, parts).equal


def _judged(workbook: Workbook, task: Task, reading: Reading, match: Match, text: str, syntax: Syntax) -> Verdict:
    typography = Typography(workbook.scene.names)
    shown = latex(reading.shown, typography)
    if match.equal:
        return Verdict(
            "correct", shown, match.remark, about="/".join(match.about), nonzero=_told_factors(workbook, match)
        )
    if match.remark == "chain":
        broken = next(one for one in reading.claims if claim_holds(workbook, task, one.parts) is False)
        return Verdict("wrong", shown, "chain", parameters={"member": latex(broken.shown, typography)})
    parts = part_outcomes(workbook, task, reading.parts)
    if match.equal is None:
        return Verdict("undecided", shown, parts=parts)
    found = _wrong(workbook, task, reading, match, text, syntax)
    return replace(found, parts=parts, partial=part_share(workbook, task, reading.parts))


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
    return (
        _besides(workbook, task, given)
        or _on_constraint(workbook, task, given)
        or _solved(workbook.solution, task, given)
    )


def _besides(workbook: Workbook, task: Task, given: Parts) -> Match | None:
    """The match with another right answer: one that keeps a constant force out of the potential."""
    for parts, left_out in workbook.alternatives(task):
        # What speaks of the load, as the constant M for M φ, does not leave it out.
        speaks = given[0].free_symbols & (workbook.right(task)[0].free_symbols - parts[0].free_symbols)
        if not speaks and task.quantity.equality.same(given, parts, workbook.solution).equal:
            return Match(equal=True, remark="constant-force", about=left_out)
    return None


def _on_constraint(workbook: Workbook, task: Task, given: Parts) -> Match | None:
    """The match of equations that are right wherever the constraints are kept: S x/l for S x/√(x² + y²)."""
    is_law = task.quantity.form in ("equation", "equations")
    kept = is_law and kept_by_constraints.proportional(given, workbook.right(task), workbook.solution)
    return Match(equal=True) if kept else None


def _solved(solution: Solution, task: Task, given: Parts) -> Match:
    """An equation solved for its own acceleration is another combination of the set, and right as well."""
    others = {solution.acceleration(q) for q in solution.free if q != task.subject}
    if task.quantity.kind == "equation" and not given[0].free_symbols & others:
        return equation.same_solved(given, solution)
    return Match(equal=False)


def _wrong(workbook: Workbook, task: Task, reading: Reading, match: Match, text: str, syntax: Syntax) -> Verdict:
    given, right = reading.parts, workbook.right(task)
    shown = latex(reading.shown, Typography(workbook.scene.names))
    if match.remark == "degenerate":
        found_slips = slips.slip_search(workbook, task).slips(reading, text)
        terms = tuple(slip for slip in found_slips if slip.kind == "rate")  # a dot makes the difference
        return _with_slips(Verdict("wrong", shown, match.remark), terms, workbook, reading, text)
    example = counterexample(task, given, right, workbook.solution)
    found = Diagnosis() if match.remark else diagnose(workbook, task, reading, text)
    units = None if found.misconceptions or found.slips else _units(workbook, task, reading, syntax)
    if units:
        identifier, told = units
        return Verdict("wrong", shown, "", (identifier,), counterexample=example, parameters=told)
    about = found.about[0] if found.about else ""
    verdict = Verdict("wrong", shown, match.remark, found.misconceptions, about, counterexample=example)
    return _with_slips(verdict, found.slips, workbook, reading, text)


def _with_slips(
    verdict: Verdict, found: tuple[slips.Slip, ...], workbook: Workbook, reading: Reading, text: str
) -> Verdict:
    """The verdict with the terms that are wrong, and the answer with these terms marked."""
    told = tuple(_told(slip, workbook) for slip in found)
    places = [slip.place for slip in told if slip.place]
    marked = slips.marked_latex(reading, text, places, workbook.scene.names) if places else ""
    return replace(verdict, slips=told, marked=marked)


def _told_factors(workbook: Workbook, match: Match) -> tuple[str, ...]:
    """What must not be zero, in LaTeX."""
    return tuple(latex(factor, Typography(workbook.scene.names)) for factor in match.nonzero)


def _told(slip: slips.Slip, workbook: Workbook) -> Slip:
    """The slip with its term in LaTeX."""
    term = "" if slip.term is None else latex(slip.term, Typography(workbook.scene.names))
    return Slip(slip.kind, term, slip.place, slip.part, slip.term is not None and slip.term.is_Add)


def _units(workbook: Workbook, task: Task, reading: Reading, syntax: Syntax) -> Told | None:
    """Terms that cannot be added come first; then another unit than the one asked for."""
    unlike = unlike_terms(reading, workbook.scene, syntax)
    measured = task.quantity.form in ("expression", "vector") and not task.quantity.up_to_factor
    return unlike or (other_unit(reading, workbook.shown(task), workbook.scene) if measured else None)
