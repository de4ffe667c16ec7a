"""Formulas aloud: what a lecturer says who reads a step, in words that leave one way to write it down.

The grammar is that of `language/spoken_printer.py`. What stands for a whole is said first (the fraction, the value of,
the integral), and what reaches over more than one symbol says where it ends.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from itertools import groupby

import sympy as sp

from ..derivation.differential_expression import direction
from ..derivation.formula import (
    AtEquilibrium,
    AtTime,
    Boundary,
    Bounds,
    Called,
    Determinant,
    Directional,
    Dot,
    Each,
    Equation,
    Explicit,
    Formula,
    Gateaux,
    Given,
    Inserted,
    Integral,
    Jacobian,
    LimitOfQuotient,
    MassIntegral,
    MatrixTimes,
    Named,
    Partial,
    Plus,
    Power,
    Quantity,
    Rate,
    Ratio,
    Rounded,
    Shifted,
    Stack,
    Substituted,
    Summed,
    Term,
    Times,
    Value,
)
from ..derivation.step import Relation
from ..language.latex_printer import Typography
from ..language.memory import cached_method
from ..language.order import split_symbol
from ..language.spoken_printer import (
    ATOM,
    POWER,
    PREFIX,
    PRODUCT,
    SUM,
    SpokenPrinter,
    joined_terms,
    paused,
    said_matrix,
    signed,
)
from ..language.spoken_symbols import SpokenSymbols, Vocabulary
from .catalog import catalog
from .function_notation import OF_TIME, VARIATION, FunctionNotation, FunctionTypography
from .marks import unmarked
from .matrix_writing import number_parts
from .notation import NEIGHBOUR, Notation, counts, moved
from .prose import CatalogText, pieces
from .symbols import SymbolTable

SIGNS: Mapping[str, str] = {
    "=": "equals",
    "≠": "unequal",
    "≈": "nearly",
    "⇔": "equivalent",
    "<": "less",
    "≤": "at-most",
}
Said = tuple[str, int]


@cache
def vocabulary(language: str) -> Vocabulary:
    """The words of a language for formulas."""
    return Vocabulary(dict(_flat(catalog(language)["speech"], "")), "," if language == "de" else ".")


def _flat(entry: object, key: str) -> Iterator[tuple[str, str]]:
    if isinstance(entry, Mapping):
        for name, part in entry.items():
            yield from _flat(part, f"{key}.{name}" if key else name)
    else:
        yield key, str(entry)


@dataclass(frozen=True)
class FunctionWords(SpokenSymbols):
    """How functions of time are said, and their directions; `argument` follows every function: x of t."""

    directions: Mapping[str, str] = field(default_factory=dict)
    argument: str = ""
    h: str = "h"

    def symbol(self, name: str) -> str:
        """A symbol as it is said, by its name."""
        kind, base = split_symbol(name)
        function = base.rstrip(NEIGHBOUR)
        if function not in self.directions:
            return super().symbol(name)
        say = self.vocabulary.say
        if base.endswith(NEIGHBOUR):
            step = say("times", self.h, self.symbol(direction(function, kind).name))
            return say("bracket", f"{self.symbol(name.replace(NEIGHBOUR, ''))} {say('plus', step)}")
        text = self._direction(function, kind) if VARIATION <= kind < VARIATION + 3 else super().symbol(name)
        return say("of", text, self.argument) if self.argument else text

    def _direction(self, function: str, kind: int) -> str:
        named = self.directions[function]
        if not named:
            return self.decorated(kind, self.letter(function))
        return self.decorated(kind - VARIATION, self.reader.words(named))

    def is_atom(self, name: str) -> bool:
        """Whether a symbol is said as one word."""
        kind, base = split_symbol(name)
        function = base.rstrip(NEIGHBOUR)
        if function not in self.directions or base.endswith(NEIGHBOUR):
            return super().is_atom(name)
        is_named = bool(self.directions[function]) and kind >= VARIATION
        return not self.argument and (is_named or super().is_atom(name))


@dataclass(frozen=True)
class Speech:
    """Says formulas in one language, with the symbols of a notation."""

    words: SpokenSymbols
    symbols: SymbolTable
    typography: Typography
    h: sp.Symbol

    @cached_property
    def printer(self) -> SpokenPrinter:
        """Who says expressions."""
        typography = self.typography
        return SpokenPrinter(self.words, decimals=typography.decimals, order=typography.order, roots=typography.roots)

    def lines(self, relations: tuple[Relation, ...]) -> list[list[str]]:
        """For each relation its terms, each with the sign before it."""
        return [self._line(relation) for relation in relations]

    def spoken(self, relations: tuple[Relation, ...], where: Sequence[tuple[str, str]] = ()) -> tuple[str, list[int]]:
        """What a step says, and what letters in it stand for; and where each of its terms begins in it."""
        text, places = "", []
        explained = (
            [self._say("with" if number == 0 else "and-where", letter), self._say("equals", value)]
            for number, (letter, value) in enumerate(where)
        )
        for line in (*self.lines(relations), *explained):
            text += ". " if text else ""
            for piece in line:
                text += _pause(text, piece)
                places.append(len(text))
                text += piece
        return text, places

    def sentences(self, *texts: CatalogText) -> str:
        """Sentences with the symbols in them in words."""
        return ". ".join(self._heard(text).removesuffix(".") for text in texts if text)

    def _heard(self, text: CatalogText) -> str:
        reader = self.words.reader
        return "".join(reader.words(piece.text) if piece.is_formula else piece.text for piece in pieces(text))

    def formula(self, formula: Formula) -> str:
        """A formula in words."""
        return self._said(formula)[0]

    def value(self, value: Value) -> str:
        """An expression or a vector in words."""
        return self.printer.text(value)

    def equated(self, value: Value) -> str:
        """The equation that says that the value is zero."""
        return self._say("equals-zero", self.value(value))

    def members(self, formula: Formula) -> list[str]:
        """The terms of a formula as they follow each other, each with its sign."""
        match formula:
            case Equation(left, right):
                first, *others = self.members(right)
                return [*self.members(left), self._say("equals", first), *others]
            case Plus(terms):
                return signed(self.words.vocabulary, self._terms(terms))
            case Explicit(value) if isinstance(value, sp.Add):
                return signed(self.words.vocabulary, self.printer.summands(value))
            case Inserted(of) | Summed(of) | Each(of):
                return self.members(of)
        return [self.formula(formula)]

    def _line(self, relation: Relation) -> list[str]:
        told = (next(alike) for _, alike in groupby(map(self.members, relation.members)))
        pieces = list(next(told))
        for first, *others in told:
            pieces += [self._say(SIGNS[relation.sign], first), *others]
        return pieces

    def _say(self, key: str, *parts: str) -> str:
        return self.words.vocabulary.say(key, *parts)

    def at(self, formula: Formula, binding: int) -> str:
        """The formula where it has to hold together so tightly."""
        if isinstance(formula, Given | Explicit):
            return self.printer.text(formula.value, binding)
        text, own = self._said(formula)
        return text if own >= binding else self._say("bracket", text)

    def _said(self, formula: Formula) -> Said:  # noqa: PLR0911 - one case for each kind
        match formula:
            case Given(_, value) | Explicit(value):
                return self.value(value), SUM
            case Named(quantity, _, arguments) | Called(quantity, _, arguments):
                return self.applied(quantity, arguments)
            case Times(factors):
                return self._times(factors)
            case Dot(left, right):
                return self._say("scalar-product", self.at(left, PREFIX), self.at(right, PREFIX)), PREFIX
            case Plus(terms):
                return joined_terms(self.words.vocabulary, self._terms(terms)), SUM
            case Substituted(of, values):
                return self._substituted(of, values)
            case Integral(of, material):
                return self._integral(of, material), ATOM
            case Equation():
                return paused(self.members(formula)), 0
        return self._derived(formula)

    def _derived(self, formula: Formula) -> Said:  # noqa: PLR0911 - one case for each kind
        match formula:
            case Partial(of, by):
                return self._say("partial", self.bare(of), self.value(by)), PREFIX
            case Rate(Rate(of)):
                return self._say("second-rate", self.at(of, PREFIX)), PREFIX
            case Rate(of):
                return self._say("rate", self.bare(of)), PREFIX
            case Gateaux(of):
                return self._gateaux(of)
            case Shifted(value, h):
                return self._at_zero(self.printer.text(value, PREFIX), h)
            case Directional(of, along, h):
                return self._at_zero(self.at(moved(of, along), PREFIX), h)
            case LimitOfQuotient(of, along, h):
                difference = f"{self.at(moved(of, along), PRODUCT)} {self._say('minus', self.at(of, PRODUCT))}"
                return self._say("limit", self.value(h), self._say("fraction", difference, self.value(h))), PREFIX
        return self._of_functions(formula)

    def _of_functions(self, formula: Formula) -> Said:
        match formula:
            case AtTime(of, time):
                return self.at_time(of, time)
            case Boundary(of, lower, upper):
                return self._say("boundary", self.formula(of), self.value(lower), self.value(upper)), ATOM
            case MassIntegral(of, region, element):
                return self._say("integral-over", region, self.at(of, PRODUCT), element), ATOM
            case Ratio(numerator, denominator):
                return self._say("fraction", self.at(numerator, PRODUCT), self.at(denominator, PRODUCT)), ATOM
            case Summed(shown) | Each(shown):
                return self._said(shown)
        return self._of_model(formula)

    def _of_model(self, formula: Formula) -> Said:  # noqa: PLR0911 - one case for each kind
        match formula:
            case Stack(rows):
                return said_matrix(self.words.vocabulary, [[self.formula(row)] for row in rows]), ATOM
            case MatrixTimes(matrix, vector):
                return self._say("times", self.at(matrix, PRODUCT), self.at(vector, PRODUCT)), PRODUCT
            case Jacobian(of, _, name):
                return self._say("partial", self.bare(of), self._quantity(name)), PREFIX
            case Determinant(of):
                return self._say("determinant", self.at(of, ATOM)), PREFIX
            case Power(of, exponent):
                return self._raised(self.at(of, ATOM), exponent), POWER
            case AtEquilibrium(of):
                return self._say("at-equilibrium", self.formula(of)), ATOM
            case Inserted(of):
                return self._said(of)
            case Rounded(value, unit):
                return self._measured(value, unit), PRODUCT if not isinstance(value, sp.MatrixBase) else ATOM
        raise TypeError(f"no words for {type(formula).__name__}")

    def bare(self, of: Formula) -> str:
        """What a derivative is taken of: a name without its arguments, else what holds together."""
        return self._quantity(of.quantity) if isinstance(of, Named | Called) else self.at(of, PREFIX)

    @cached_method
    def _quantity(self, quantity: Quantity) -> str:
        reader, words = self.words.reader, self.words.vocabulary.words
        pattern = words.get(f"quantities.{quantity.kind}")
        return pattern.format(reader.words(quantity.of)) if pattern else reader.words(self.symbols.latex(quantity))

    def applied(self, quantity: Quantity, arguments: tuple[sp.Expr, ...]) -> Said:
        """A name with what it depends on: r of q one and q two and t."""
        texts = [self.printer.text(a, ATOM if len(arguments) == 1 else SUM) for a in arguments]
        return self._with_arguments(quantity, texts, bare=all(a.is_Symbol for a in arguments))

    def _with_arguments(self, quantity: Quantity, texts: list[str], *, bare: bool) -> Said:
        """`bare`: none of several arguments is more than a symbol."""
        name = self._quantity(quantity)
        if not texts:
            return name, PREFIX if name.partition(" ")[0] in self._prefixes else ATOM
        inside = self._say("and").join(texts)
        return self._say("of", name, inside if bare or len(texts) == 1 else self._say("bracket", inside)), PREFIX

    @cached_property
    def _prefixes(self) -> frozenset[str]:
        """Words with which a symbol begins that is made of another one."""
        return frozenset(self._say(key, "").strip() for key in ("variation", "differential"))

    def at_time(self, of: Formula, time: sp.Expr) -> Said:
        """A formula at an instant; a single symbol as a function of time."""
        if isinstance(of, Explicit) and of.value.is_Symbol:
            return self._say("of", self.value(of.value), self.printer.text(time, ATOM)), PREFIX
        return self._say("value-at-time", self.formula(of), self.value(time)), ATOM

    def _gateaux(self, of: Formula) -> Said:
        if not isinstance(of, Named) or not of.arguments:
            return self._say("variation", self.bare(of)), PREFIX
        texts = [self._shifted(argument) for argument in of.arguments]
        inside = self._say("bracket", self._say("and").join(texts))
        return self._at_zero(self._say("of", self._quantity(of.quantity), inside), self.h)

    def _shifted(self, argument: sp.Symbol) -> str:
        text = self.printer.text(argument)
        if not self.symbols.is_varied(argument.name):
            return text
        variation = self.value(sp.Symbol(f"delta({argument.name})", real=True))
        return f"{text} {self._say('plus', self._say('times', self.value(self.h), variation))}"

    def _at_zero(self, text: str, h: sp.Symbol) -> Said:
        return self._say("at-zero", self.value(h), text), PREFIX

    def _times(self, factors: tuple[Formula, ...]) -> Said:
        text, *others = self._powers(factors)
        for other in others:
            text = self._say("times", text, other)
        return text, PRODUCT

    def _powers(self, factors: tuple[Formula, ...]) -> Iterator[str]:
        """The factors; a name that stands there twice is squared."""
        for text, alike in groupby(factors, lambda factor: self.at(factor, PRODUCT)):
            first, *others = alike
            if others and isinstance(first, Named):
                yield self._raised(self.at(first, ATOM), 1 + len(others))
            else:
                yield from (text, *(text for _ in others))

    def _raised(self, base: str, exponent: int) -> str:
        key = f"power-{exponent}" if exponent in (2, 3) else "power"
        return self._say(key, base, self.value(sp.Integer(exponent)))

    def _terms(self, terms: tuple[Term, ...]) -> list[str]:
        return [text for term in filter(counts, terms) for text in self._unsigned(term)] or [self.value(sp.S.Zero)]

    def _unsigned(self, term: Term) -> list[str]:
        """The term with its minus, if it has one; a sum that is added needs no brackets."""
        texts = self.members(term.formula)
        plus, minus = self._say("plus", ""), self._say("minus", "")
        if term.sign > 0:
            return [text.removeprefix(plus) for text in texts]
        if len(texts) > 1:
            return [self._say("minus", self.at(term.formula, PRODUCT))]
        (text,) = texts
        return [text.removeprefix(minus) if text.startswith(minus) else minus + text]

    def _substituted(self, of: Formula, values: Mapping[sp.Symbol, sp.Expr]) -> Said:
        present = of.value.free_symbols if isinstance(of, Given | Explicit | Named) else set(values)
        rules = [self._say("rule", self.value(s), self.value(v)) for s, v in values.items() if s in present]
        if not rules:
            return self._said(of)
        return self._say("substituted", self.formula(of), self._say("and").join(rules)), ATOM

    def _integral(self, of: Formula, material: tuple[Bounds, ...]) -> str:
        text = self.at(of, PRODUCT)
        for bounds in reversed(material):
            ends = self.value(bounds.lower), self.value(bounds.upper)
            text = self._say("integral", *ends, text, self.value(bounds.symbol))
        return text

    def rounded(self, value: Value) -> str:
        """A number with the digits that are written."""
        return self._measured(value, "")

    def name(self, name: str) -> str:
        """A name that is no symbol of the scene."""
        return self.words.symbol(name)

    def _measured(self, value: Value, unit: str) -> str:
        if isinstance(value, sp.MatrixBase):
            rows = [[self._digits(entry) for entry in row] for row in value.tolist()]
            return said_matrix(self.words.vocabulary, rows)
        units = self.words.vocabulary.words
        return f"{self._digits(value)} {units.get(f'units.{unit}', unit)}".strip()

    def _digits(self, value: sp.Expr) -> str:
        mantissa, exponent = number_parts(value)
        sign = self._say("minus", "") if mantissa.startswith("-") else ""
        size = sign + mantissa.removeprefix("-").replace(".", self.words.vocabulary.point)
        return self._say("tens", size, self.value(sp.Integer(exponent))) if exponent else size


@dataclass(frozen=True)
class FunctionSpeech(Speech):
    """Says formulas about functions; names carry their functions as x of t."""

    def _said(self, formula: Formula) -> Said:
        argument = self._functions.argument
        if argument and isinstance(formula, Partial | Rate):
            plain = self._with("").formula(formula)
            return self._say("value-at-time", plain, argument), ATOM
        return super()._said(formula)

    def applied(self, quantity: Quantity, arguments: tuple[sp.Expr, ...]) -> Said:
        """A name with what it depends on."""
        inner = self._with("t" if quantity.kind in OF_TIME else "")
        texts = [inner.printer.text(a, PREFIX if len(arguments) == 1 else SUM) for a in arguments]
        bare = quantity.kind not in OF_TIME and all(a.is_Symbol and NEIGHBOUR not in a.name for a in arguments)
        return self._with_arguments(quantity, texts, bare=bare)

    def at_time(self, of: Formula, time: sp.Expr) -> Said:
        """What is written out with the instant put in, else the formula and the instant."""
        inner = self._with(self.printer.text(time, ATOM))
        if isinstance(of, Explicit | Given):
            moment = of.value.xreplace({sp.Symbol("t", real=True): time})
            return inner.printer.text(moment, PRODUCT), PRODUCT
        return inner._said(of)  # noqa: SLF001 - of its own kind

    @property
    def _functions(self) -> FunctionWords:
        if not isinstance(self.words, FunctionWords):
            raise TypeError("functions need their own words")
        return self.words

    @cached_method
    def _with(self, argument: str) -> FunctionSpeech:
        return replace(self, words=replace(self._functions, argument=argument))


def _pause(text: str, piece: str) -> str:
    """What stands between the terms of a line: a short pause before all but the shortest."""
    if not text or text.endswith(". "):
        return ""
    last = text.rpartition(". ")[2].rpartition(", ")[2]
    return " " if len(last.split()) <= 2 or len(piece.split()) <= 2 else ", "


def speech_of(notation: Notation, language: str) -> Speech:
    """Who says what this notation writes."""
    words, typography, symbols = vocabulary(language), notation.typography, notation.symbols
    clean = replace(symbols, wrap=unmarked)  # type: ignore[type-var]
    if isinstance(notation, FunctionNotation) and isinstance(typography, FunctionTypography):
        functions = FunctionWords(typography.names, words, directions=typography.directions)
        h = functions.reader.words(typography.h)
        return FunctionSpeech(replace(functions, h=h), clean, typography, notation.h)
    return Speech(SpokenSymbols(typography.names, words), clean, typography, notation.h)
