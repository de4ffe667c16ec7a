r"""Is an equilibrium stable: `stable`, `instabil`, `stable for R*Omega^2 < g`, `stabil für a < b, sonst instabil`.

What is true for other parameters is told by the signs of the eigenvalues of the stiffness matrix there (Lagrange,
Dirichlet), where a condition is known; else the verdict counts at the scene's values. Where gyroscopic forces act, a
potential without a minimum says nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

import sympy as sp

from ...derivation.conditions import Conditions, conditions
from ...derivation.equilibria import free_coordinates, is_angle
from ...derivation.linearization import Linearization
from ...derivation.optional import motions_of
from ...derivation.system import System
from ...language.latex_printer import Typography, latex
from ...language.memory import cached_method
from ...language.parser import Syntax
from ...language.plain_printer import plain
from ...narration.catalog import text as catalog_text
from ..equality import Parts
from ..solution import Solution
from ..verdict import Verdict
from . import Understood, Written
from .positions import asked as positions_asked
from .regions import Inequality, Place, Point, Valued, definiteness, places, points, says_the_same, valued
from .wording import Formulas, Piece, blanked, formulas, is_number, prepared, refuse, split

STABLE, UNSTABLE = "stable", "unstable"
OPPOSITE = {STABLE: UNSTABLE, UNSTABLE: STABLE}
_QUALIFIED = r"(?:(?:asymptotisch|asymptotically|lyapunov)[\s-]+)?"
WORD = re.compile(rf"{_QUALIFIED}(instabil|unstable|labil|nicht\s*stabil|not\s*stable|stabil|stable)", re.IGNORECASE)
ENGLISH = re.compile(r"stable", re.IGNORECASE)
UNSTABLE_WORDS = re.compile(r"instabil|unstable|labil|nicht|not", re.IGNORECASE)
_FILLING = (
    r"für|fuer|for|falls|if|wenn|when|solange|as\s+long\s+as|iff|genau\s+dann|only|nur|immer|always|stets|alle|all"
    r"|und|and|das|die|the|Gleichgewicht|Gleichgewichtslage|Lage|equilibrium|position|ist|is|it|es|sonst|else"
    r"|otherwise|ansonsten|exactly|gilt|values|Werte|parameters|Parameter"
)
LINKS = re.compile(
    rf"^\s*(?:für|fuer|for|falls|wenn|iff?|when)|\b(?:{_FILLING})\b|∧|\\land(?![A-Za-z])|\\q?quad(?![A-Za-z])|:|\\\\|\n",
    re.IGNORECASE,
)
SIGNS: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(("≤", "<=", "\\leq", "\\leqslant", "\\le", "\\lt"), "<"),
        **dict.fromkeys(("≥", ">=", "\\geq", "\\geqslant", "\\ge", "\\gt"), ">"),
    }
)
SIGN = re.compile("|".join(re.escape(sign) + r"(?![A-Za-z])" * (sign[0] == "\\") for sign in SIGNS))
HALF = 0.5
MOST_CLAUSES = 6
MOST_COMPARISONS = 12


@dataclass(frozen=True)
class Clause:
    """A verdict for the parameters for which all comparisons hold."""

    word: str
    comparisons: tuple[Inequality, ...] = ()
    language: str = "en"

    def applies(self, point: Point) -> bool:
        """Whether it speaks of these parameters."""
        return all(each.holds(point) for each in self.comparisons)


@dataclass(frozen=True)
class Claim:
    """What an answer says: of several clauses the first one that applies."""

    clauses: tuple[Clause, ...]

    def __call__(self, point: Point) -> str:
        """With a single condition everything else is the opposite."""
        found = next((each.word for each in self.clauses if each.applies(point)), "")
        if found or len(self.clauses) != 1:
            return found
        return OPPOSITE[self.clauses[0].word]

    def is_void(self, model: System) -> bool:
        """Whether a part of it speaks of no parameters at all."""
        return not all(any(map(each.applies, points(model))) for each in self.clauses)

    @property
    def has_condition(self) -> bool:
        """Whether it depends on the parameters."""
        return any(each.comparisons for each in self.clauses)


@dataclass(frozen=True, eq=False)
class Truth:
    """What is true of an equilibrium, for any parameters as far as that is known."""

    model: System
    linear: Linearization

    @property
    def here(self) -> str:
        """At the scene's values."""
        return self.linear.stability

    @cached_property
    def conditions(self) -> Conditions | None:
        """What is known for other parameters; None where nothing is."""
        return conditions(self.model, self.linear)

    @cached_property
    def depends(self) -> bool:
        """Whether other parameters change it."""
        return len({place.word for place in self.places}) > 1

    @cached_property
    def places(self) -> tuple[Place, ...]:
        """Where it is known."""
        return places(self, self.model)

    def __call__(self, point: Point) -> str:
        """By the definiteness of the stiffness matrix; "" where nothing is known, or no such equilibrium exists."""
        if point == points(self.model)[0]:
            return self.here
        if self.conditions is None or not self._exists(self.conditions, point):
            return ""
        matrix = [[entry(point) for entry in row] for row in self._entries]
        sign = definiteness(matrix)
        return STABLE if sign > 0 else UNSTABLE if sign < 0 and not self._turns else ""

    def _exists(self, known: Conditions, point: Point) -> bool:
        """A length does not change its sign: beyond zero it would be another position."""
        there = all(Inequality(self.model, each.smaller, each.larger).holds(point) for each in known.existence)
        return there and all(value(point) * value(points(self.model)[0]) >= 0 for value in self._lengths)

    @cached_property
    def _lengths(self) -> list[Valued]:
        found = self.linear.equilibrium.values.items()
        return [valued(self.model, value) for q, value in found if not is_angle(self.model, q)]

    @cached_property
    def _turns(self) -> bool:
        """Whether the forces that go with the rates have a gyroscopic part."""
        skew = self.linear.damping - self.linear.damping.T
        return any(not self.model.is_zero(entry) for entry in skew)

    @cached_property
    def _entries(self) -> list[list[Valued]]:
        every = range(self.linear.stiffness.rows)
        free = () if self.linear.tangent else free_coordinates(self.model)
        kept = [i for i in every if not free or self.model.free[i] not in free]
        matrix = self.linear.stiffness.extract(kept, kept)
        return [[valued(self.model, entry) for entry in row] for row in matrix.tolist()]


@cached_method
def truth_of(model: System, number: int) -> Truth:
    """What is true of the equilibrium of this number."""
    return Truth(model, motions_of(model)[number - 1])


def _right(truth: Truth, language: str = "en") -> Clause:
    """The word, and the condition where there is one."""
    known = truth.conditions.stability if truth.conditions and truth.depends else ()
    return Clause(truth.here, tuple(Inequality(truth.model, each.smaller, each.larger) for each in known), language)


class Stability:
    """Judges a verdict and its condition."""

    def read(self, solution: Solution, _subject: str, text: str, syntax: Syntax) -> Understood[Claim]:
        """The clauses of an answer."""
        claim = Claim(tuple(_clauses(_prepared(text, syntax), formulas(solution, syntax), solution.model)))
        typography = Typography(solution.scene.names)
        return Understood(
            tuple(part for each in claim.clauses for part in _parts_of(each)),
            ", ".join(_plain(each) for each in claim.clauses),
            r",\; ".join(_latex(each, typography) for each in claim.clauses),
            claim,
        )

    def verdict(self, solution: Solution, subject: str, given: Understood[Claim]) -> Verdict:
        """The word counts half where a condition is asked for."""
        claim, truth = given.content, truth_of(solution.model, int(subject))
        if claim.has_condition and claim.is_void(truth.model):
            return Verdict("wrong", remark="condition-other")
        if claim.has_condition and truth.depends:
            return _judged(claim, truth)
        if claim(points(truth.model)[0]) != truth.here:
            return Verdict("wrong", remark="stability-exchanged")
        if not claim.has_condition:
            return Verdict("wrong", remark="condition-missing", partial=HALF) if truth.depends else Verdict("correct")
        if truth.conditions is None:
            return Verdict("undecided")
        always = says_the_same(claim, truth.places)
        return Verdict("correct") if always else Verdict("wrong", remark="condition-needless", partial=HALF)

    def written(self, solution: Solution, subject: str, language: str) -> Written:
        """The word, and the condition where there is one."""
        clause = _right(truth_of(solution.model, int(subject)), language)
        return Written((_plain(clause),), (_latex(clause, Typography(solution.scene.names)),))


def asked(solution: Solution) -> list[str]:
    """Each equilibrium whose stability is known, and its condition if there is one, by its number."""
    count = len(motions_of(solution.model)) if positions_asked(solution) else 0
    return [str(n) for n in range(1, count + 1) if _is_known(truth_of(solution.model, n))]


def _is_known(truth: Truth) -> bool:
    """A condition that is but sufficient is none to be asked for."""
    return truth.here in OPPOSITE and (not truth.depends or says_the_same(Claim((_right(truth),)), truth.places))


def _judged(claim: Claim, truth: Truth) -> Verdict:
    if says_the_same(claim, truth.places):
        return Verdict("correct")
    turned = Claim(tuple(Clause(OPPOSITE[each.word], each.comparisons) for each in claim.clauses))
    if says_the_same(turned, truth.places):
        return Verdict("wrong", remark="condition-reversed", partial=HALF)
    here = claim(points(truth.model)[0]) == truth.here
    return Verdict("wrong", remark="condition-other", partial=HALF if here else 0.0)


def value(solution: Solution, subject: str) -> Parts:
    """1 for stable and −1 for unstable, and what must be positive for that."""
    return _parts_of(_right(truth_of(solution.model, int(subject))))


def _parts_of(clause: Clause) -> Parts:
    gaps = (each.larger - each.smaller for each in clause.comparisons)
    return (sp.Integer(1 if clause.word == STABLE else -1), *gaps)


# --- reading and writing ---------------------------------------------------------------------------------------------


def _prepared(text: str, syntax: Syntax) -> Piece:
    return Piece(SIGN.sub(lambda found: SIGNS[found[0]].ljust(len(found[0])), prepared(text, syntax)), 0)


def _clauses(text: Piece, reader: Formulas, model: System) -> Iterator[Clause]:
    """One for each word, with the comparisons between it and the next; or before the first one."""
    words = list(WORD.finditer(text.text))
    if not words:
        raise refuse("answer-stability", text)
    ends = [*(word.start() for word in words[1:]), len(text.text)]
    if len(words) > MOST_CLAUSES:
        raise refuse("answer-stability", text)
    before = text.cut(0, words[0].start())
    always = ""
    for number, (word, end) in enumerate(zip(words, ends, strict=True)):
        after = text.cut(word.end(), end)
        around = [after] if number else [before, after]
        held = tuple(each for piece in around for each in _comparisons(piece, reader, model))
        said = UNSTABLE if UNSTABLE_WORDS.search(word[0]) else STABLE
        if always not in ("", said):
            raise refuse("answer-stability", text)  # stable and unstable at once
        always = always if held else said
        yield Clause(said, held, "en" if ENGLISH.search(word[0]) else "de")


def _comparisons(piece: Piece, reader: Formulas, model: System) -> Iterator[Inequality]:
    for part in split(Piece(blanked(LINKS, piece.text, ";"), piece.start), ",;"):
        sides = list(split(part, "<>"))
        signs = [sign for sign in part.text if sign in "<>"]
        if len(sides) != len(signs) + 1 or not 0 < len(signs) <= MOST_COMPARISONS:
            raise refuse("answer-comparison", part)
        values = [_in_parameters(reader.value(side), side, model) for side in sides]
        for sign, left, right in zip(signs, values, values[1:], strict=False):
            yield Inequality(model, *((left, right) if sign == "<" else (right, left)))


def _in_parameters(value: Any, piece: Piece, model: System) -> sp.Expr:
    if not is_number(value) or value.free_symbols - set(model.parameter_values):
        raise refuse("answer-comparison", piece)
    return value


def _plain(clause: Clause) -> str:
    word = catalog_text(clause.language, f"homework.stability.{clause.word}")
    compared = ", ".join(f"{plain(each.smaller)} < {plain(each.larger)}" for each in clause.comparisons)
    return f"{word} {catalog_text(clause.language, 'homework.stability.for')} {compared}" if compared else str(word)


def _latex(clause: Clause, typography: Typography) -> str:
    word = catalog_text(clause.language, f"homework.stability.{clause.word}")
    compared = r",\; ".join(
        f"{latex(each.smaller, typography)} < {latex(each.larger, typography)}" for each in clause.comparisons
    )
    link = catalog_text(clause.language, "homework.stability.for")
    return rf"\text{{{word} {link} }} {compared}" if compared else rf"\text{{{word}}}"
