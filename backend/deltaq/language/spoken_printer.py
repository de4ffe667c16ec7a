"""SymPy → words as a lecturer says them: m ℓ² φ̈ is "m times l squared times phi double dot".

The words say which part belongs to which, and no more than is needed for it. What binds more loosely than its place
asks stands between "open bracket" and "close bracket"; fractions and roots of more than a symbol say where they end.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

import sympy

from .functions import CLASSES
from .memory import cached_method
from .numerals import Decides, base_exponent, decimal, decimals_of, ends, exact, fraction_parts, named_root
from .order import Order, arguments_of
from .spoken_symbols import LARGEST, SpokenSymbols, Vocabulary

# How tightly words hold together. A prefix, as "sine of", reaches over one atom and no further.
SUM, QUOTIENT, PRODUCT, POWER, PREFIX, ATOM = range(6)
_MOST_PARTS = 12
_WORDS = frozenset({"d", "delta", "e", "a"})  # letters that are words, or begin some
_SHORT = 4  # words of a term that needs no pause before it


class SpokenPrinter:
    """Says expressions; `decimals` and `roots` as in a Typography."""

    def __init__(
        self,
        symbols: SpokenSymbols,
        *,
        decimals: bool | None = None,
        order: Order | None = None,
        roots: Mapping[Any, str] | None = None,
    ) -> None:
        self.symbols = symbols
        self.words: Vocabulary = symbols.vocabulary
        self._decimals = decimals
        self._roots = roots or {}
        self._order = order or Order(symbols.names)
        self._printers: dict[Decides, _Speech] = {}

    @cached_method
    def text(self, value: Any, binding: int = SUM) -> str:
        """The words for a value; in brackets if they bind more loosely."""
        if isinstance(value, sympy.MatrixBase):
            return self._matrix(value)
        if isinstance(value, sympy.Eq):
            return f"{self.text(value.lhs)} {self.words.say('equals', self.text(value.rhs))}"
        if isinstance(value, sympy.Tuple):
            return ". ".join(map(self.text, value))
        expr = sympy.sympify(value, strict=True)
        return self._for(expr).text(expr, binding)

    def summands(self, value: sympy.Expr) -> list[str]:
        """The terms of a sum in the order in which they are said, each with its minus."""
        return self._for(value).summands(value)

    def _for(self, expr: sympy.Expr) -> _Speech:
        decides = decimals_of(expr, wanted=self._decimals)
        if decides not in self._printers:
            self._printers[decides] = _Speech(self.symbols, self._order, decides, self._roots)
        return self._printers[decides]

    def _matrix(self, value: sympy.MatrixBase) -> str:
        rows = [[self.text(entry) for entry in row] for row in value.tolist()]
        return said_matrix(self.words, rows)


def said_matrix(words: Vocabulary, rows: list[list[str]]) -> str:
    """A vector by its components, a matrix by its rows."""
    if all(len(row) == 1 for row in rows):
        parts = [words.say("component", words.whole(i), entry) for i, (entry,) in enumerate(rows, 1)]
        return words.say("vector", ", ".join(parts))
    joint = words.say("next")
    parts = [words.say("row", words.whole(i), joint.join(row)) for i, row in enumerate(rows, 1)]
    return words.say("matrix", ", ".join(parts))


class _Speech:
    def __init__(
        self,
        symbols: SpokenSymbols,
        order: Order,
        as_decimal: Decides,
        roots: Mapping[Any, str],
        *,
        in_root: bool = False,
    ) -> None:
        self._symbols = symbols
        self._words = symbols.vocabulary
        self._order = order
        self._as_decimal = as_decimal
        self._roots = roots
        self._in_root = in_root

    def text(self, expr: sympy.Expr, binding: int = SUM) -> str:
        text, own = self._with_binding(expr)
        if own >= binding:
            return text
        return self._long(expr) if own == QUOTIENT else self._words.say("bracket", text)

    def _long(self, expr: sympy.Expr) -> str:
        """A fraction that says where it ends, although it is short."""
        sign, upper, lower = fraction_parts(expr, self._as_decimal)
        text = self._words.say("fraction", self._side(upper), self._side(lower))
        return self._words.say("minus", text) if sign else text

    @cached_method
    def _with_binding(self, expr: sympy.Expr) -> tuple[str, int]:  # noqa: PLR0911 - one case for each kind
        named = named_root(expr, self._roots)
        if named:
            return self._letter(*named)
        if expr.is_Symbol:
            return self._symbols.symbol(expr.name), ATOM if self._symbols.is_atom(expr.name) else PREFIX
        if expr.is_Rational or expr.is_Float:
            return self._number(expr)
        if expr is sympy.pi:
            return self._words.say("greek.pi"), ATOM
        if expr.is_Add:
            return joined_terms(self._words, self.summands(expr)), SUM
        if expr.is_Mul:
            return self._product(expr)
        if expr is sympy.E and not self._is_taken("e"):
            return self._words.say("euler"), ATOM
        if expr is sympy.E or isinstance(expr, sympy.exp):
            return self._exponential(expr)
        return self._power(expr)

    def summands(self, expr: sympy.Expr) -> list[str]:
        return (
            [self.text(term, QUOTIENT) for term in self._order.terms(expr)] if self._is_sum(expr) else [self.text(expr)]
        )

    def _is_sum(self, expr: sympy.Expr) -> bool:
        """Whether it is said as a sum, and not as the square of a root that has a name."""
        return bool(expr.is_Add) and named_root(expr, self._roots) is None

    def _letter(self, letter: str, exponent: int) -> tuple[str, int]:
        """A root by its name, or a power of it."""
        said = self._symbols.symbol(letter)
        return (said, ATOM) if exponent == 1 else (self._raised(said, sympy.Integer(exponent)), POWER)

    def _number(self, number: sympy.Expr) -> tuple[str, int]:
        value = exact(number)
        size = abs(value)
        text, binding = self._size(size, is_float=bool(number.is_Float))
        return (self._words.say("minus", text), PRODUCT) if value < 0 else (text, binding)

    def _size(self, size: Fraction, *, is_float: bool) -> tuple[str, int]:
        if size.denominator == 1:
            return self._words.whole(size.numerator), ATOM
        if self._as_decimal(size) or (is_float and ends(size)):
            return decimal(size).replace(".", self._words.point), ATOM
        return self._fraction_of_numbers(size), PRODUCT

    def _fraction_of_numbers(self, size: Fraction) -> str:
        if size.denominator <= _MOST_PARTS and size.numerator <= LARGEST:
            number = "one" if size.numerator == 1 else "several"
            count = self._words.say("one") if size.numerator == 1 else self._words.whole(size.numerator)
            return f"{count} {self._words.say(f'parts.{number}.{size.denominator}')}"
        return self._words.say("fraction", self._words.whole(size.numerator), self._words.whole(size.denominator))

    def _is_taken(self, letter: str) -> bool:
        """Whether a symbol of the scene is called so."""
        return letter in self._symbols.reader.plain

    def _exponential(self, expr: sympy.Expr) -> tuple[str, int]:
        exponent = sympy.Mul(*expr.args)  # 1 of e itself
        if self._is_taken("e"):
            return self._words.say("of", self._words.say("functions.exp"), self.text(exponent, ATOM)), PREFIX
        return self._words.say("power", self._words.say("euler"), self._exponent(exponent)), POWER

    def _product(self, expr: sympy.Expr) -> tuple[str, int]:
        sign, upper, lower = fraction_parts(expr, self._as_decimal)
        text, binding = self._unsigned(upper, lower)
        return (self._words.say("minus", text), binding) if sign else (text, binding)

    def _unsigned(self, upper: list[sympy.Expr], lower: list[sympy.Expr]) -> tuple[str, int]:
        if not lower:
            return self._factors(upper), PRODUCT
        numbers = [f for f in upper if f.is_Rational]
        rest = [f for f in upper if not f.is_Rational]
        if all(f.is_Rational for f in lower) and (len(rest) > 1 or numbers or not self._is_simple(rest)):
            size = Fraction(int(sympy.Mul(*numbers)), int(sympy.Mul(*lower)))
            first = self._order.factors(rest)[0]
            is_short = size.denominator <= _MOST_PARTS and size.numerator <= LARGEST
            joint = self._together if is_short and self._follows(first) else self._times
            return joint(self._fraction_of_numbers(size), self._factors(rest)), PRODUCT
        return self._quotient(upper, lower)

    def _quotient(self, upper: list[sympy.Expr], lower: list[sympy.Expr]) -> tuple[str, int]:
        both = self._side(upper), self._side(lower)
        simple = self._is_simple(upper) and self._is_simple(lower)
        return self._words.say("over" if simple else "fraction", *both), QUOTIENT if simple else ATOM

    def _is_simple(self, factors: list[sympy.Expr]) -> bool:
        """Nothing, one symbol, or one whole number: what needs no word for its end."""
        if not factors:
            return True
        first, *others = factors
        named = named_root(first, self._roots)
        is_short = first.is_Symbol or first.is_Integer or first is sympy.pi or (named is not None and named[1] == 1)
        return not others and bool(is_short)

    def _side(self, factors: list[sympy.Expr]) -> str:
        """What stands above or below the line; a sum needs no brackets there, but no short fraction may stand in it."""
        if len(factors) != 1 or not self._is_sum(factors[0]):
            return self._factors(factors)
        return joined_terms(self._words, [self.text(term, PRODUCT) for term in self._order.terms(factors[0])])

    def _factors(self, factors: list[sympy.Expr]) -> str:
        if not factors:
            return self._words.whole(1)
        ordered = self._order.factors(factors)
        text = self.text(ordered[0], PRODUCT)
        for before, factor in pairwise(ordered):
            joint = self._together if self._leads(before) and self._follows(factor) else self._times
            text = joint(text, self.text(factor, PRODUCT))
        return text

    def _times(self, left: str, right: str) -> str:
        return self._words.say("times", left, right)

    def _together(self, left: str, right: str) -> str:
        """Letters side by side, as they are read: m l squared."""
        return f"{left} {right}"

    def _leads(self, factor: sympy.Expr) -> bool:
        """Whether another letter may follow: a whole number, or a letter without a word as its index."""
        indices = {self._words.say(key, "").strip() for key in ("subscript", "superscript")}
        if factor.is_Integer:
            return bool(0 < factor <= LARGEST)
        return self._follows(factor) and indices.isdisjoint(self.text(factor).split())

    def _follows(self, factor: sympy.Expr) -> bool:
        """Whether this is a letter or its square that no word begins for which it could be taken."""
        base, exponent = base_exponent(factor)
        if not base.is_Symbol or exponent not in (1, 2) or not self._symbols.is_atom(base.name):
            return False
        bracket = self._words.say("bracket", "").split()[0]  # x + h v is a symbol, too
        return self.text(base).split()[0] not in {*_WORDS, bracket}

    def _power(self, expr: sympy.Expr) -> tuple[str, int]:
        """A power, a root, a fraction with nothing above its line, or a function with its power, which may be one."""
        base, exponent = base_exponent(expr)
        if exponent.is_Rational and exponent.is_negative:
            return self._quotient([], [base**-exponent])
        if exponent == sympy.Rational(1, 2):
            return self._root(base)
        if _takes_power(base, exponent):
            return self._call(base, exponent), PREFIX
        return self._raised(self.text(base, ATOM), exponent), POWER

    def _root(self, base: sympy.Expr) -> tuple[str, int]:
        """A root says where it ends unless it is of a symbol; within another one it always does."""
        if self._is_simple([base]) and not self._in_root:
            return self._words.say("root", self.text(base)), PREFIX
        return self._words.say("long-root", self._under_root.text(base)), ATOM

    @cached_property
    def _under_root(self) -> _Speech:
        return (
            self if self._in_root else _Speech(self._symbols, self._order, self._as_decimal, self._roots, in_root=True)
        )

    def _raised(self, base: str, exponent: sympy.Expr) -> str:
        key = f"power-{exponent}" if exponent in (2, 3) else "power"
        return self._words.say(key, base, self._exponent(exponent))

    def _exponent(self, exponent: sympy.Expr) -> str:
        return self.text(exponent, SUM if exponent.is_Rational else ATOM)

    def _call(self, expr: sympy.Expr, power: sympy.Expr = sympy.S.One) -> str:
        """A function with its power: sine squared of phi."""
        name = CLASSES.get(type(expr).__name__, type(expr).__name__)
        function = self._words.words.get(f"functions.{name}", name)
        raised = function if power == 1 else self._raised(function, power)
        return self._words.say("of", raised, self._arguments(expr))

    def _arguments(self, expr: sympy.Expr) -> str:
        arguments = arguments_of(expr)
        if len(arguments) == 1:
            return self.text(arguments[0], ATOM)
        return self._words.say("bracket", self._words.say("and").join(self.text(a) for a in arguments))


def joined_terms(words: Vocabulary, terms: list[str]) -> str:
    """Terms as a sum: what begins with a minus needs no plus; long terms are set off by pauses."""
    return paused(signed(words, terms))


def signed(words: Vocabulary, terms: Iterable[str]) -> list[str]:
    """Terms with the sign that joins each to those before."""
    minus = words.say("minus", "")
    first, *others = terms
    return [first, *(term if term.startswith(minus) else words.say("plus", term) for term in others)]


def paused(pieces: list[str]) -> str:
    """Pieces in a row, with pauses unless all are short."""
    return (", " if any(len(piece.split()) > _SHORT for piece in pieces) else " ").join(pieces)


def _takes_power(base: sympy.Expr, exponent: sympy.Expr) -> bool:
    """Whether the power stands behind the name of the function, as in sine squared of phi."""
    return bool(base.is_Function and exponent.is_Integer) and not isinstance(base, sympy.exp)
