"""Reading one table of a scene document, field by field.

Problems are collected, not raised, so that a user sees all of them at once; a field that cannot be read is replaced
by a harmless value so that the rest can still be looked at.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from fractions import Fraction
from typing import TypeVar

from ..errors import InputError, Parameter, Problem, escaped
from ..language.expression import Expression
from ..language.names import Names
from ..language.parser import parse
from ..language.tree import Equation, Number
from .checks import as_float, default_name
from .lengths import difference
from .user_text import Translated, translated

T = TypeVar("T")
NOT_OF: Mapping[type, str] = {
    str: "not-text",
    float: "not-a-number",
    int: "not-an-integer",
    bool: "not-a-flag",
    list: "not-a-list",
    Mapping: "not-a-table",
}
LIMIT = 64  # tables in a list
NOTHING = Expression("0", Number(Fraction(0)))
UNREAD_NAMES = frozenset({"unknown-name", "function-not-allowed", "unit"})
INEQUALITIES = frozenset("<>≤≥")


@dataclass(frozen=True)
class Context:
    """What the fields of a scene may refer to."""

    names: Names
    places: tuple[str, ...]
    dimension: int
    multipliers: frozenset[str] = frozenset()  # names of what no field may refer to, as it follows from the motion


@dataclass
class Reader:
    """A table of the document at `pointer`; `problems` is shared by all tables of one reading."""

    table: Mapping[str, object]
    pointer: str
    problems: list[Problem]
    context: Context | None = None
    used: set[str] = field(default_factory=lambda: {"kind"})
    default_name: str = ""

    def complain(self, code: str, key: str = "", **parameters: Parameter) -> None:
        """Notes a problem by its code in the catalog, at a key or at the table itself."""
        self.problems.append(Problem(code, f"{self.pointer}/{key}" if key else self.pointer, parameters=parameters))

    def get(self, key: str, kind: type[T] | tuple[type[T], ...], default: T | None) -> T | None:
        """The field, if it is of the kind wanted; without a default it must be there."""
        self.used.add(key)
        value = self.table.get(key)
        if value is None:
            if default is None:
                self.complain("missing-field", escaped(key), field=key)
            return default
        if not isinstance(value, kind) or isinstance(value, bool) is not (kind is bool):
            self.complain(NOT_OF[kind[0] if isinstance(kind, tuple) else kind], escaped(key))
            return default
        return value

    def text(self, key: str, default: str | None = None) -> str:
        """A text; what is missing without a default is a problem."""
        return self.get(key, str, default) or ""

    def name(self) -> str:
        """The name of what is read."""
        return self.text("name", self.default_name or None)

    def flag(self, key: str, *, default: bool) -> bool:
        """True or false."""
        return bool(self.get(key, bool, default))

    def number(self, key: str, default: float) -> float:
        """A finite number; the default in place of one that is not."""
        found = as_float(self.get(key, (float, int), default))
        if math.isfinite(found):
            return found
        self.complain("not-finite", key)
        return default

    def bound(self, key: str) -> float | None:
        """A bound, which may be left out."""
        self.used.add(key)
        return None if self.table.get(key) is None else self.number(key, 0.0)

    def translated(self, key: str) -> Translated:
        """A text by language; one without a language is for all."""
        texts = self.get(key, (Mapping, str), {}) or {}
        if not isinstance(texts, Mapping):
            return translated(texts)
        readable = {language: text for language, text in texts.items() if isinstance(text, str)}
        for language in sorted(map(str, texts.keys() - readable.keys())):
            self.complain(NOT_OF[str], f"{escaped(key)}/{escaped(language)}")
        return translated(readable)

    def strings(self, key: str) -> tuple[str, ...]:
        """A list of texts, empty if it is left out."""
        values = self.get(key, (list, tuple), None)
        return () if values is None else tuple(self._string(f"{key}/{i}", value) for i, value in enumerate(values))

    def _string(self, key: str, value: object) -> str:
        if isinstance(value, str):
            return value
        self.complain(NOT_OF[str], key)
        return "0"

    def tables(self, key: str, context: Context | None = None) -> tuple[Reader, ...]:
        """The tables of a list, each to be read by itself; those that are none are complained about."""
        values = self.get(key, (list, tuple), [])
        if values is None or len(values) > LIMIT:
            self.complain("too-many", key, field=key, limit=LIMIT)
            return ()
        kinds = [str(value.get("kind", "")) if isinstance(value, Mapping) else "" for value in values]
        pointer, joint = f"{self.pointer}/{key}", "-" if key == "loads" else ""
        self.problems += [
            Problem("not-a-table", f"{pointer}/{i}") for i, v in enumerate(values) if not isinstance(v, Mapping)
        ]
        return tuple(
            Reader(
                value,
                f"{pointer}/{i}",
                self.problems,
                context or self.context,
                default_name=default_name(kinds, i, joint),
            )
            for i, value in enumerate(values)
            if isinstance(value, Mapping)
        )

    def expression(self, key: str, default: str | None = None) -> Expression:
        """A scalar expression without derivatives of expressions."""
        text = self.text(key, default)
        return self.parsed(text, key) if text else self._empty(key)

    def _empty(self, key: str) -> Expression:
        if isinstance(self.table.get(key), str):
            self.complain("empty-expression", key, field=key)
        return NOTHING

    def vector(self, key: str) -> tuple[Expression, ...]:
        """As many expressions as the scene has dimensions; another number is a problem."""
        texts = self.strings(key)
        dimension = self.named.dimension
        if isinstance(self.table.get(key), list | tuple) and len(texts) != dimension:
            self.complain("wrong-dimension", key, expected=dimension, found=len(texts))
        parsed = tuple(self.parsed(text, f"{key}/{i}") for i, text in enumerate(texts[:dimension]))
        return parsed + (NOTHING,) * (dimension - len(parsed))

    def vector_or_tensor(self, key: str) -> tuple[Expression, ...] | tuple[tuple[Expression, ...], ...]:
        """A vector, or the rows of a square matrix; a vector of nothing where a row cannot be read."""
        rows = self.table.get(key)
        if not isinstance(rows, list | tuple) or not any(isinstance(row, list | tuple) for row in rows):
            return self.vector(key)
        self.used.add(key)
        dimension = self.named.dimension
        if len(rows) != dimension:
            self.complain("wrong-dimension", key, expected=dimension, found=len(rows))
            return (NOTHING,) * dimension
        row = Reader({str(i): row for i, row in enumerate(rows)}, f"{self.pointer}/{key}", self.problems, self.context)
        known = len(self.problems)
        read = tuple(row.vector(str(i)) for i in range(dimension))
        return read if len(self.problems) == known else (NOTHING,) * dimension

    def position(self, key: str) -> tuple[Expression, ...]:
        """A position field r(q, t)."""
        return tuple(self._without_rates(part, f"{key}/{i}") for i, part in enumerate(self.vector(key)))

    def angle(self, key: str) -> Expression:
        """An angle φ(q, t); of one that depends on rates δφ would be more than Σ ∂φ/∂q δq."""
        return self._without_rates(self.expression(key), key)

    def _without_rates(self, expression: Expression, key: str) -> Expression:
        for rate in sorted(expression.rates):
            self.complain("position-with-rate", key, coordinate=rate)
        return expression

    def place(self, key: str) -> str:
        """The name of a point or body; another name is a problem, told with the nearest one."""
        name = self.text(key)
        if name and name not in self.named.places:
            near = get_close_matches(name, self.named.places, n=1)
            self.complain("unknown-place", key, name=name, suggestion=near[0] if near else "")
        return name

    def equation(self, key: str) -> Expression:
        """An equation between scalars as left − right, the text as written; without a sign, what is to be zero."""
        text = self.text(key)
        return self.parsed(text, key, is_equation=True) if text else self._empty(key)

    def parsed(self, text: str, key: str, *, is_equation: bool = False) -> Expression:
        """A text as a scalar expression; NOTHING in place of one with a problem."""
        try:
            expression = parse(text, self.named.names)
        except InputError as error:
            told = (_told_for_scenes(text, problem, self.named.multipliers) for problem in error.problems)
            self.problems.extend(problem.below(f"{self.pointer}/{key}") for problem in told)
            return NOTHING
        if is_equation and isinstance(expression.tree, Equation):
            expression = Expression(text, difference(expression.tree.left, expression.tree.right))
        if not expression.is_scalar:
            self.complain("not-scalar", key)
        elif expression.has_derivatives:
            self.complain("derivative-in-scene", key)
        else:
            return expression
        return NOTHING

    @property
    def named(self) -> Context:
        """The context, once names are known."""
        if self.context is None:
            raise LookupError("names are read before expressions")
        return self.context

    def build(self, make: Callable[[Reader], T]) -> Iterator[T]:
        """What `make` makes of this table, or nothing if the thing itself objects; unknown fields are reported."""
        try:
            made = make(self)
        except InputError as error:
            self.problems.extend(problem.below(self.pointer) for problem in error.problems)
            return
        yield made
        for key in sorted(self.table.keys() - self.used):
            near = get_close_matches(key, self.used, n=1)
            self.complain("unknown-field", escaped(key), field=key[:40], suggestion=near[0] if near else "")


def _told_for_scenes(text: str, problem: Problem, multipliers: frozenset[str]) -> Problem:
    """What cannot be read, as what its author meant by it: a multiplier, an inequality, LaTeX."""
    word = text[problem.offset : problem.offset + (problem.length or 1)] if problem.offset is not None else ""
    if problem.code in UNREAD_NAMES and word in multipliers:
        return replace(problem, code="multiplier-in-scene", parameters={"name": word})
    if problem.code == "unexpected-character" and word in INEQUALITIES:
        return replace(problem, code="inequality-in-scene", parameters={"character": word})
    if problem.code == "unexpected-character" and word == "\\":
        return replace(problem, code="latex-in-scene", parameters={})
    return problem
