r"""All positions of rest: `phi = 0; phi = pi`, `phi = n pi`, `cos(theta) = g/(R Omega^2)`, `[0, 0]; [0, pi]`.

A semicolon, a line or „or“ parts positions, a comma the coordinates of one; a coordinate that comes again begins the
next position. Angles count up to whole turns. Values are compared at three sets of parameters with 30 digits; a number
is right to three digits at the scene's own. What was not found as an equilibrium is right if it is at rest.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations, islice, product
from types import MappingProxyType
from typing import Any

import sympy as sp

from ...derivation.bound_equilibria import smooth_conditions, smooth_matrix
from ...derivation.equilibria import Equilibrium, is_angle
from ...derivation.impacts import frictions
from ...derivation.matrix_form import forces_at_rest
from ...derivation.optional import kink_search_of, motions_of, search_of
from ...derivation.system import System
from ...language.latex_printer import Typography, latex
from ...language.memory import cached_method
from ...language.names import Symbol
from ...language.parser import Syntax
from ...language.plain_printer import plain
from ..equality import Parts
from ..solution import Solution
from ..verdict import Verdict
from . import Understood, Written
from .wording import Formulas, Piece, blanked, both_signs, formulas, is_number, prepared, refuse, split

Position = Mapping[sp.Symbol, sp.Expr]
Said = tuple[sp.Symbol, tuple[sp.Expr, ...]]

MOST = 8  # positions that are asked for
MOST_GIVEN = 40
DIGITS = 30
SHOWN_DIGITS = 5
DECIMALS = 15
SAME = sp.Float("1e-18")
ROUNDED = sp.Float("5e-3")  # how far a number may be off that was written with three digits
NUDGES = (0, 1, -1)  # of the parameters, by thousandths of different size
WHOLE = tuple(Symbol(name, "parameter") for name in ("n", "k", "j"))
INTEGERS = (
    r"[,;]?\s*(?:mit|with|für|for)?\s*(?<![A-Za-z])[nkj]\s*(?:∈|\\in(?![A-Za-z])|\bin\b)\s*"
    r"(?:ℤ|\\mathbb\s*\{?\s*Z\s*\}?|\\Z|Z)(?![A-Za-z])"
)
OR = r"\b(?:oder|or|sowie)\b|\\lor(?![A-Za-z])|\\vee(?![A-Za-z])|∨|\\\\|\n"
AND = r"\b(?:und|and)\b|\\land(?![A-Za-z])|\\wedge(?![A-Za-z])|∧|\\q?quad(?![A-Za-z])"
BARS = re.compile(r"\([^()|]+(?:\|[^()|]+)+\)")  # (0|pi), as schools write coordinates
BRACES: Mapping[Syntax, str] = MappingProxyType({"plain": r"[{}]", "latex": r"(?:\\left|\\right)?\\[{}]"})
BOTH_INDICES = r"_\s*(?:\{\s*\d\s*(?:[,/]\s*\d\s*)+\}|1\s*[,/]\s*2(?!\d))"
ANY = re.compile(r"\b(?:beliebig|arbitrary|any|frei|free)\b")


def asked(solution: Solution) -> tuple[Equilibrium, ...]:
    """The equilibria with all contacts open, if all are known, few enough, and isolated.

    But for coordinates that may have any value.
    """
    model = solution.model
    search = search_of(model)
    if search is None or not search.is_complete_off_contacts or not 0 < search.count == len(search.found) <= MOST:
        return ()
    if frictions(model) or any(linear.band is not None for linear in motions_of(model)) or _is_ranged(model):
        return ()  # dry friction holds it beside them, too
    moving = set(map(model.q, model.free))
    told = {frozenset(each.values) for each in search.found}
    alone = len(told) == 1 and all(set(each.values) | set(map(model.q, each.free)) == moving for each in search.found)
    apart = not any(value.free_symbols & moving for each in search.found for value in each.values.values())
    return search.found if alone and apart and search.found[0].values else ()


def _is_ranged(model: System) -> bool:
    """Whether it rests in whole ranges, or where forces jump over balance."""
    known = kink_search_of(model)
    return known is not None and bool(known.found or known.kinks)


@dataclass(frozen=True)
class Given:
    """The positions as they were given; `narrowed` are coordinates with a value that may have any."""

    positions: tuple[Position, ...]
    narrowed: tuple[str, ...] = ()


class Positions:
    """Judges a set of positions."""

    def read(self, solution: Solution, _subject: str, text: str, syntax: Syntax) -> Understood[Given]:
        """Every position that the answer names."""
        wanted = tuple(asked(solution)[0].values)
        reader = _Reader(solution, formulas(solution, syntax, (*WHOLE, *_numbered(wanted))), wanted)
        given = reader.given(_prepared(text, syntax))
        typography = Typography(solution.scene.names)
        rows = [r",\; ".join(_rows(each, typography)) for each in given.positions]
        return Understood(
            tuple(value for each in given.positions for value in each.values()),
            "; ".join(map(_typed, given.positions)),
            r"\begin{gathered} " + r" \\ ".join(rows) + r" \end{gathered}" if len(rows) > 1 else rows[0],
            given,
        )

    def verdict(self, solution: Solution, _subject: str, given: Understood[Given]) -> Verdict:
        """What is too many takes one of the right ones away."""
        answer = given.content
        right = asked(solution)
        found = [_place(solution.model, each, right) for each in answer.positions]
        wrong = [each for each, place in zip(answer.positions, found, strict=True) if place is None]
        hit = {place.index for place in found if place is not None and place.index >= 0}
        partial = max(0, len(hit) - len(wrong)) / len(right)
        if wrong:
            member = ", ".join(_rows(wrong[0], Typography(solution.scene.names)))
            remark = "no-equilibrium" if _keeps_constraints(solution.model, wrong[0]) else "off-constraint"
            return Verdict("wrong", remark=remark, partial=partial, parameters={"member": member})
        if answer.narrowed:
            return Verdict("wrong", remark="one-of-family", about=answer.narrowed[0], partial=partial / 2)
        if len(hit) < len(right):
            return Verdict("wrong", remark="equilibrium-missing", partial=partial)
        return Verdict("correct", remark="rounded" if any(each and each.rounded for each in found) else "")

    def written(self, solution: Solution, _subject: str, _language: str) -> Written:
        """Every equilibrium, one after the other."""
        typography, right = Typography(solution.scene.names), [shown_values(each) for each in asked(solution)]
        return Written(tuple(map(_typed, right)), tuple(r",\; ".join(_rows(each, typography)) for each in right))


def shown_values(equilibrium: Equilibrium) -> Position:
    """Formulas, or numbers to a few digits where there is none."""
    if equilibrium.exact:
        return equilibrium.values
    numbers = {q: round(float(value), DECIMALS) for q, value in equilibrium.values.items()}  # a zero of balls is near 0
    return {q: sp.Rational(f"{number:.{SHOWN_DIGITS}g}") for q, number in numbers.items()}


def value(solution: Solution) -> Parts:
    """The values of all coordinates in all equilibria."""
    return tuple(value for each in asked(solution) for value in each.values.values())


def _numbered(wanted: Sequence[sp.Symbol]) -> list[Symbol]:
    """phi_1, phi_2 … for the first and second value of phi."""
    return [Symbol(f"{q.name}{n}", "parameter") for q in wanted if q.name.isalpha() for n in range(10)]


def _typed(position: Position) -> str:
    return ", ".join(f"{q.name} = {plain(value)}" for q, value in position.items())


def _rows(position: Position, typography: Typography) -> list[str]:
    return [latex(sp.Eq(q, value, evaluate=False), typography) for q, value in position.items()]


def _prepared(text: str, syntax: Syntax) -> Piece:
    """Words become signs of the same length."""
    text = BARS.sub(lambda found: found[0].replace("|", ","), text)
    plainer = blanked(
        BRACES[syntax],
        blanked(
            r"∈|\\in(?![A-Za-z])|(?<=\s)in(?=\s)", blanked(INTEGERS, blanked(BOTH_INDICES, prepared(text, syntax))), "="
        ),
    )
    return Piece(blanked(AND, blanked(OR, plainer, ";"), ","), 0)


@dataclass
class _Reader:
    """Goes through the pieces, and knows which coordinate was spoken of last."""

    solution: Solution
    formulas: Formulas
    wanted: tuple[sp.Symbol, ...]
    last: sp.Symbol | None = None
    narrowed: dict[str, None] = field(default_factory=dict)

    def given(self, text: Piece) -> Given:
        """All positions. Raises ExpressionError for one that lacks a coordinate."""
        found = (each for group in split(text, ";") for each in self._group(group))
        positions = list(islice(found, MOST_GIVEN + 1))
        if not positions:
            raise refuse("empty", text)
        if len(positions) > MOST_GIVEN:
            raise refuse("answer-positions-many", limit=MOST_GIVEN)
        return Given(tuple(positions), tuple(self.narrowed))

    def _group(self, group: Piece) -> Iterator[Position]:
        """The positions between two semicolons."""
        current: dict[sp.Symbol, tuple[sp.Expr, ...]] = {}
        for piece in split(group, ","):
            for q, values in self._said(piece):
                if q in current:
                    yield from self._complete(current, group)
                    current = {}
                current[q] = values
        if current:
            yield from self._complete(current, group)

    def _complete(self, current: Mapping[sp.Symbol, tuple[sp.Expr, ...]], group: Piece) -> Iterator[Position]:
        if set(current) != set(self.wanted):
            raise refuse("answer-position-incomplete", group, names=", ".join(q.name for q in self.wanted))
        for values in product(*(current[q] for q in self.wanted)):
            yield dict(zip(self.wanted, values, strict=True))

    def _said(self, piece: Piece) -> Iterator[Said]:
        """The coordinates that a piece gives values to."""
        if ANY.search(piece.text):
            return
        *left, right = split(piece, "=")
        lefts: list[Piece | None] = [*left] or [None]
        for each in lefts:
            yield from self._equation(each, right, piece)

    def _equation(self, left: Piece | None, right: Piece, piece: Piece) -> Iterator[Said]:
        found: dict[sp.Symbol, list[sp.Expr]] = {}
        for each in both_signs(right):
            value = self.formulas.value(_listed(each))
            known = None if left is None else self.formulas.value(_listed(left))
            for q, one in self._paired(known, value, piece):
                found.setdefault(q, []).extend(self._values(q, one, piece))
        for q, values in found.items():
            self.last = q
            if q in self.wanted:
                yield q, tuple(values)
            else:
                self.narrowed[q.name] = None

    def _paired(self, left: Any, right: Any, piece: Piece) -> Iterator[tuple[sp.Symbol, sp.Expr]]:
        """Each coordinate with what must vanish."""
        if isinstance(right, sp.MatrixBase):
            names = list(left) if isinstance(left, sp.MatrixBase) else list(self.wanted)
            if len(names) != len(right):
                raise refuse("answer-position-incomplete", piece, names=", ".join(q.name for q in self.wanted))
            yield from ((q, q - value) for q, value in zip(names, right, strict=True))
            return
        if not is_number(right) or not (left is None or is_number(left)):
            raise refuse("answer-position", piece)
        if left is None:
            q = self.last or (self.wanted[0] if len(self.wanted) == 1 else None)
            if q is None:
                raise refuse("answer-position-incomplete", piece, names=", ".join(q.name for q in self.wanted))
            yield q, q - right
            return
        residual = self._unnumbered(left - right)
        moving = [q for q in map(self.solution.q, self.solution.free) if residual.has(q)]
        if len(moving) != 1:
            raise refuse("answer-position", piece)
        yield moving[0], residual

    def _unnumbered(self, value: sp.Expr) -> sp.Expr:
        known = {symbol.name for symbol in self.solution.scene.names.symbols}
        own = {q.name: q for q in self.wanted}
        copies = {s: own[s.name[:-1]] for s in value.free_symbols if s.name not in known and s.name[:-1] in own}
        return value.xreplace(copies)

    def _values(self, q: sp.Symbol, residual: sp.Expr, piece: Piece) -> Iterator[sp.Expr]:
        solved = _solved(residual, q)
        parameters = {*self.solution.parameter_values, *(sp.Symbol(s.name, real=True) for s in WHOLE)}
        if not solved or any(value.free_symbols - parameters for value in solved):
            raise refuse("answer-position", piece)
        for value in solved:
            yield from self._whole(q, value, piece)

    def _whole(self, q: sp.Symbol, value: sp.Expr, piece: Piece) -> Iterator[sp.Expr]:
        """The values for all whole numbers n, as far as they differ by no whole turn."""
        counting = sorted(value.free_symbols - set(self.solution.parameter_values), key=str)
        if not counting:
            yield value
            return
        turns = 2 * sp.pi / sp.Abs(value.diff(counting[0]))
        angle = is_angle(self.solution.model, q)
        if len(counting) > 1 or not angle or not (turns.is_Integer and turns <= MOST):
            raise refuse("answer-position", piece)
        yield from (value.xreplace({counting[0]: sp.Integer(n)}) for n in range(int(turns)))


def _listed(piece: Piece) -> Piece:
    """(a, b) → [a, b]"""
    inside = piece.text.strip()
    listed = inside.startswith("(") and inside.endswith(")") and len(list(split(Piece(inside[1:-1], 0), ","))) > 1
    start = len(piece.text) - len(piece.text.lstrip())
    return Piece(piece.text[:start] + f"[{inside[1:-1]}]", piece.start) if listed else piece


def _solved(residual: sp.Expr, q: sp.Symbol) -> tuple[sp.Expr, ...]:
    """The roots of what is linear in q, or in one sine, cosine or tangent of it; none where it is neither."""
    waves = [each for each in residual.atoms(sp.sin, sp.cos, sp.tan) if each.has(q)]
    if not waves:
        return tuple(_linear(residual, q))
    if len(waves) > 1 or waves[0].args[0] != q:
        return ()
    hidden = sp.Dummy()
    found = list(_linear(residual.xreplace({waves[0]: hidden}), hidden))
    if not found or found[0].has(q):
        return ()
    (c,) = found
    match waves[0]:
        case sp.sin():
            return (sp.asin(c), sp.pi - sp.asin(c))
        case sp.cos():
            return (sp.acos(c), -sp.acos(c))
        case _:
            return (sp.atan(c), sp.atan(c) + sp.pi)


def _linear(residual: sp.Expr, unknown: sp.Symbol) -> Iterator[sp.Expr]:
    slope = residual.diff(unknown)
    if slope != 0 and not slope.has(unknown):
        yield sp.expand(unknown - residual / slope)


# --- comparing -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Hit:
    """Which equilibrium a position is, −1 for one that is at rest and none of those; whether by rounded numbers."""

    index: int
    rounded: bool


def _place(model: System, given: Position, right: Sequence[Equilibrium]) -> _Hit | None:
    for index, each in enumerate(right):
        same = [_same(model, q, given[q], each.values[q], exact=each.exact) for q in each.values]
        if None not in same:
            return _Hit(index, rounded=any(same))
    return _Hit(-1, rounded=False) if _is_at_rest(model, given) else None


def _same(model: System, q: sp.Symbol, given: sp.Expr, right: sp.Expr, *, exact: bool) -> bool | None:
    """None if the values differ; else whether they are equal as rounded numbers only."""
    turn = 2 * sp.pi.n(DIGITS) if is_angle(model, q) else None
    own, *_ = apart = [_apart(given, right, values, turn) for values in parameter_sets(model)]
    if exact and all(distance is not None and distance < SAME for distance in apart):
        return False
    size = max(sp.Float(1) if turn else sp.Float(0), abs(_number(right, parameter_sets(model)[0]) or 0))
    is_number = not given.free_symbols or not exact
    return True if is_number and own is not None and own <= max(ROUNDED * size, SAME) else None


def _apart(given: sp.Expr, right: sp.Expr, values: Mapping[sp.Symbol, sp.Expr], turn: sp.Expr | None) -> sp.Expr | None:
    """How far two values are from each other; None where one is not real."""
    one, other = _number(given, values), _number(right, values)
    if one is None or other is None:
        return None
    distance = abs(one - other)
    return distance if turn is None else min(distance % turn, turn - distance % turn)


def _number(value: sp.Expr, values: Mapping[sp.Symbol, sp.Expr]) -> sp.Float | None:
    number = sp.N(value.xreplace(dict(values)), DIGITS)
    return sp.Float(number, DIGITS) if number.is_Float or number.is_Rational else None


@cached_method
def parameter_sets(model: System) -> tuple[Mapping[sp.Symbol, sp.Expr], ...]:
    """The scene's parameters, and two sets near them in which none is a simple fraction of another."""
    return tuple(
        {
            symbol: value * (1 + sp.Rational(nudge * sp.prime(index + 5), 10_000 + 7 * index))
            for index, (symbol, value) in enumerate(model.parameter_values.items())
        }
        for nudge in NUDGES
    )


def _is_at_rest(model: System, position: Position) -> bool:
    return _keeps_constraints(model, position) and _vanish(model, _unbalanced(model), position)


def _keeps_constraints(model: System, position: Position) -> bool:
    return _vanish(model, smooth_conditions(model), position)


@cached_method
def _unbalanced(model: System) -> tuple[sp.Expr, ...]:
    """What is zero where reactions balance the forces: f, or all minors of A with f as one row more."""
    forces = forces_at_rest(model)
    if not model.conditions:
        return tuple(forces)
    table = smooth_matrix(model).col_join(forces.T)
    chosen = combinations(range(table.cols), table.rows)
    return tuple(table.extract(list(range(table.rows)), list(columns)).det(method="berkowitz") for columns in chosen)


def _vanish(model: System, values: Sequence[sp.Expr], position: Position) -> bool:
    there = [value.xreplace(dict(position)) for value in values]
    numbers = [_number(value, parameters) for value in there for parameters in parameter_sets(model)]
    return all(number is not None and abs(number) < SAME for number in numbers)
