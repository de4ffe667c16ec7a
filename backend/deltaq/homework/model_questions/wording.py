"""Answers in words and formulas, cut into formulas; every formula keeps its place in the text.

What is replaced keeps its length, so that an offset in a formula is one in the answer. `90°` is π/2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import sympy as sp

from ...errors import ExpressionError, Problem
from ...language.latex_tables import SYSTEMS
from ...language.names import Names, Symbol
from ...language.parser import Syntax, parse
from ...language.symbols import Symbols
from ...language.sympy_algebra import to_sympy
from ..solution import Solution

OPENING, CLOSING = "([{", ")]}"
BOTH = re.compile(r"±|\\pm(?![A-Za-z])|\+/?-")
DEGREES: Mapping[Syntax, re.Pattern[str]] = MappingProxyType(
    {"plain": re.compile("°"), "latex": re.compile(r"°|\^\s*(?:\\circ(?![A-Za-z])|\{\s*\\circ\s*\})")}
)
FOR = re.compile(r"f\{?\\\"\s*\{?u\}*r(?![a-z])")  # „für“ without the letter ü
NEW_LINE = r"\\"
MATRIX = re.compile(r"\\begin\s*\{[bp]matrix\}((?:(?!\\begin).)*?)\\end\s*\{[bp]matrix\}", re.DOTALL)
LAYOUT = re.compile(
    rf"\\(?:begin|end)\s*\{{(?:{'|'.join(map(re.escape, sorted(SYSTEMS)))})\}}|(?<!\\)\\[,;!: ]|&|\$|\\left\.|\\right\."
)
TEXT = re.compile(r"\\(?:text|mathrm|textrm|operatorname)\s*\{([^{}]*)\}")


@dataclass(frozen=True)
class Piece:
    """A part of a text, and where it begins."""

    text: str
    start: int

    @property
    def is_empty(self) -> bool:
        """Nothing but spaces and stops."""
        return not self.text.strip(" .,;\t\n")

    def cut(self, start: int, end: int | None = None) -> Piece:
        """A part of the part."""
        return Piece(self.text[start:end], self.start + start)


def refuse(code: str, piece: Piece | None = None, **parameters: str | int) -> ExpressionError:
    """What is wrong with an answer, or with a part of it."""
    if piece is None:
        return ExpressionError(Problem(code, parameters=parameters))
    offset = piece.start + len(piece.text) - len(piece.text.lstrip())
    return ExpressionError(Problem(code, "", offset, len(piece.text.strip()), parameters=parameters))


def blanked(pattern: str | re.Pattern[str], text: str, sign: str = "") -> str:
    """The text with what matches replaced by a sign and blanks."""
    return re.sub(pattern, lambda found: sign.ljust(len(found[0])), text)


def without_text_commands(text: str) -> str:
    r"""`\text{oder}` → `oder`, with blanks around; also one command in another."""
    for _ in range(2):
        text = TEXT.sub(lambda found: found[1].rjust(len(found[0]) - 1) + " ", text)
    return text


def prepared(text: str, syntax: Syntax) -> str:
    r"""Without what only lays formulas out: aligned lines and thin spaces; a column of a matrix becomes a list."""
    if syntax == "plain":
        return text
    spelled = FOR.sub(lambda found: "für".ljust(len(found[0])), text)
    listed = MATRIX.sub(lambda found: f"[{found[1].replace(NEW_LINE, ', ')}]".ljust(len(found[0])), spelled)
    return blanked(LAYOUT, without_text_commands(listed))


def split(piece: Piece, separators: str) -> Iterator[Piece]:
    """The parts between separators that stand in no brackets; empty ones are left out."""
    depth, start = 0, 0
    for index, sign in enumerate(piece.text):
        depth += (sign in OPENING) - (sign in CLOSING)
        if sign in separators and depth <= 0:
            yield from _filled(piece.cut(start, index))
            start = index + 1
    yield from _filled(piece.cut(start))


def _filled(piece: Piece) -> Iterator[Piece]:
    if not piece.is_empty:
        yield piece


def both_signs(piece: Piece) -> Iterator[Piece]:
    """± as + and as −."""
    if BOTH.search(piece.text):
        yield from (Piece(blanked(BOTH, piece.text, sign), piece.start) for sign in "+-")
    else:
        yield piece


def is_number(value: Any) -> bool:
    """Neither a list nor an equation: SymPy's matrices are expressions as well."""
    return isinstance(value, sp.Expr) and not isinstance(value, sp.MatrixBase)


@dataclass(frozen=True)
class Formulas:
    """Reads formulas in the names of a scene and some besides."""

    names: Names
    syntax: Syntax

    def value(self, piece: Piece) -> Any:
        """The formula as an expression. Raises ExpressionError with the offset in the answer."""
        source = DEGREES[self.syntax].sub("*pi/180", piece.text.rstrip(" .,\t\n"))
        try:
            return to_sympy(parse(source, self.names, self.syntax).tree, Symbols(self.names))
        except ExpressionError as error:
            raise ExpressionError(*(_moved(problem, piece) for problem in error.problems)) from None


def _moved(problem: Problem, piece: Piece) -> Problem:
    return replace(problem, offset=piece.start + min(problem.offset or 0, len(piece.text)))


def formulas(solution: Solution, syntax: Syntax, extra: Sequence[Symbol] = ()) -> Formulas:
    """With the scene's names; those among the extra ones that mean nothing in the scene come besides."""
    known = solution.scene.names
    own = known.symbols[:-2]
    taken = {symbol.name for symbol in own}
    return Formulas(Names((*own, *(symbol for symbol in extra if symbol.name not in taken))), syntax)
