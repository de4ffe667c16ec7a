"""The numbers of formulas, made from the formulas themselves: what reading them back is compared with."""

from __future__ import annotations

import cmath
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import sympy as sp
from tests.narration.spoken_reader import FUNCTIONS, at_random, opaque, words_of

from deltaq.derivation.formula import (
    AtEquilibrium,
    AtTime,
    Boundary,
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
    Times,
)
from deltaq.language.order import split_symbol
from deltaq.language.spelling import latex_of
from deltaq.narration.function_notation import OF_TIME
from deltaq.narration.notation import NEIGHBOUR, moved
from deltaq.narration.speech import FunctionWords, Speech

RATES = {1: "dot", 2: "ddot", 3: "dddot", 8: "ddddot"}


@dataclass
class Values:
    """Numbers for one way of speaking; `heard` collects what is heard of each symbol."""

    speech: Speech
    argument: complex | None = None

    def __post_init__(self) -> None:
        self.heard: dict[tuple[str, ...], dict[str, complex]] = {}
        self.functions: set[tuple[str, ...]] = set()

    @property
    def ambiguous(self) -> list[tuple[str, ...]]:
        """What is heard of two symbols."""
        return [words for words, meant in self.heard.items() if len(meant) > 1]

    @property
    def lexicon(self) -> dict[tuple[str, ...], complex]:
        return {words: next(iter(meant.values())) for words, meant in self.heard.items()}

    def _known(self, said: str, identity: str, *, takes: bool = True) -> complex:
        value = at_random(identity)
        if takes:
            self.functions.add(words_of(said))
        self.heard.setdefault(words_of(said), {})[identity] = value
        return value

    def symbol(self, name: str) -> complex:
        words = self.speech.words
        kind, base = split_symbol(name)
        if NEIGHBOUR in name:
            plain = name.replace(NEIGHBOUR, "")
            step = {0: "delta({})", 1: "dot(delta({}))", 2: "ddot(delta({}))"}[kind].format(base.rstrip(NEIGHBOUR))
            return self.symbol(plain) + self.symbol(self.speech.h.name) * self.symbol(step)
        directions = words.directions if isinstance(words, FunctionWords) else {}
        named = bool(directions.get(base)) and kind >= 5
        if kind >= 5 and not named:
            value = opaque("delta", self._letter(RATES[kind - 5].join(("", f"({base})")) if kind > 5 else base))
        elif kind == 4:
            value = opaque("d", self._letter(base))
        elif named:
            heard = words.decorated(kind - 5, words.reader.words(directions[base]))
            value = self._known(heard, _written(directions[base], kind - 5))
        else:
            value = self._letter(name)
        return value if self.argument is None or base not in directions else opaque("of", value, self.argument)

    def _letter(self, name: str) -> complex:
        kind, base = split_symbol(name)
        words = self.speech.words
        takes = base in (words.directions if isinstance(words, FunctionWords) else {})
        said = words.decorated(kind, words.letter(base))
        known = words.names.get(base)
        return self._known(said, _written(known.typeset if known else latex_of(base), kind), takes=takes)

    def quantity(self, quantity: Quantity) -> complex:
        if quantity.kind == "zero-vector":
            return 0j
        words = self.speech.words
        if f"quantities.{quantity.kind}" in words.vocabulary.words:
            said = words.vocabulary.say(f"quantities.{quantity.kind}", words.reader.words(quantity.of))
            return self._known(said, f"phrase {quantity.kind} {quantity.of}")
        latex = self.speech.symbols.latex(quantity)
        for prefix, name in ((r"\delta", "delta"), (r"\mathrm{d}", "d")):
            if latex.startswith(prefix):
                return opaque(name, self._written(latex.removeprefix(prefix).strip()))
        return self._written(latex)

    def _written(self, latex: str) -> complex:
        return self._known(self.speech.words.reader.words(latex), _written(latex))

    def expression(self, value: sp.Expr) -> complex:  # noqa: PLR0911 - one case for each kind
        if value.is_Symbol:
            return self.symbol(value.name)
        if value.is_number and not value.has(sp.Function):
            return complex(value)
        parts = [self.expression(part) for part in value.args]
        if value.is_Add:
            return sum(parts, 0j)
        if value.is_Mul:
            return _product(parts)
        if value.is_Pow:
            return parts[0] ** parts[1]
        if isinstance(value, sp.exp):
            return cmath.exp(parts[0])
        return FUNCTIONS[{"Abs": "abs"}.get(type(value).__name__, type(value).__name__)](parts[0])

    def value(self, value: object) -> complex:
        if not isinstance(value, sp.MatrixBase):
            return self.expression(sp.sympify(value))
        return opaque("vector" if value.cols == 1 else "matrix", *map(self.expression, value))

    def of(self, formula: Formula) -> complex:  # noqa: C901, PLR0911, PLR0912 - one case for each kind
        of_functions = isinstance(self.speech.words, FunctionWords)
        if self.argument is not None and isinstance(formula, Partial | Rate):
            return opaque("at time", self._at(None).of(formula), self.argument)
        match formula:
            case Given(_, value) | Explicit(value):
                return self.value(value)
            case Named(quantity, _, arguments) | Called(quantity, _, arguments):
                return self._applied(self.quantity(quantity), quantity, arguments)
            case Partial(of, by):
                return opaque("partial", self._bare(of), self.value(by))
            case Rate(Rate(of)):
                return opaque("rate2", self.of(of))
            case Rate(of):
                return opaque("rate", self._bare(of))
            case Gateaux(of) if isinstance(of, Named) and of.arguments:
                along = {q: self.symbol(q.name) for q in of.arguments}
                h = self.value(self.speech.h)
                for q in of.arguments:
                    if self.speech.symbols.is_varied(q.name):
                        along[q] += h * self.symbol(f"delta({q.name})")
                return opaque("at zero", h, opaque("of", self.quantity(of.quantity), *along.values()))
            case Gateaux(of):
                return opaque("delta", self._bare(of))
            case Shifted(value, h):
                return opaque("at zero", self.value(h), self.value(value))
            case Times(factors):
                return _product([self.of(factor) for factor in factors])
            case MatrixTimes(left, right):
                return self.of(left) * self.of(right)
            case Dot(left, right):
                return opaque("dot", self.of(left), self.of(right))
            case Plus(terms):
                return sum((term.sign * self.of(term.formula) for term in terms), 0j)
            case Substituted(of, values):
                present = of.value.free_symbols if isinstance(of, Given | Explicit | Named) else set(values)
                rules = [self.value(part) for s, v in values.items() if s in present for part in (s, v)]
                return opaque("substituted", self.of(of), *rules) if rules else self.of(of)
            case Integral(of, material):
                value = self.of(of)
                for b in reversed(material):
                    value = opaque("integral", self.value(b.lower), self.value(b.upper), value, self.value(b.symbol))
                return value
            case Equation(left, right):
                return opaque("=", self.of(left), self.of(right))
            case Directional(of, along, h):
                return opaque("at zero", self.value(h), self.of(moved(of, along)))
            case LimitOfQuotient(of, along, h):
                difference = self.of(moved(of, along)) - self.of(of)
                return opaque("limit", self.value(h), difference / self.value(h))
            case AtTime(of, time) if of_functions:
                moment = self._at(self.value(time))
                if isinstance(of, Explicit | Given):
                    return moment.value(of.value.xreplace({sp.Symbol("t", real=True): time}))
                return moment.of(of)
            case Boundary(of, lower, upper):
                return opaque("boundary", self.of(of), self.value(lower), self.value(upper))
            case MassIntegral(of, region, element):
                return opaque(f"integral over {region.lower()} d {element.lower()}", self.of(of))
            case Ratio(numerator, denominator):
                return self.of(numerator) / self.of(denominator)
            case Summed(shown) | Each(shown) | Inserted(shown):
                return self.of(shown)
            case Stack(rows):
                return opaque("vector", *map(self.of, rows))
            case Jacobian(of, _, name):
                return opaque("partial", self._bare(of), self.quantity(name))
            case Determinant(of):
                return opaque("det", self.of(of))
            case Power(of, exponent):
                return self.of(of) ** exponent
            case AtEquilibrium(of):
                return opaque("equilibrium", self.of(of))
            case Rounded(value, unit):
                return self._rounded(value, unit)
        raise TypeError(type(formula).__name__)

    def _rounded(self, value: object, unit: str) -> complex:
        if isinstance(value, sp.MatrixBase):
            return opaque("vector" if value.cols == 1 else "matrix", *(_digits(one) for one in value))
        return _digits(value) * (at_random(unit) if unit else 1)

    def _bare(self, of: Formula) -> complex:
        return self.quantity(of.quantity) if isinstance(of, Named | Called) else self.of(of)

    def _applied(self, name: complex, quantity: Quantity, arguments: tuple[sp.Expr, ...]) -> complex:
        if not arguments:
            return name
        inner = self
        if isinstance(self.speech.words, FunctionWords):
            inner = self._at(self.symbol("t") if quantity.kind in OF_TIME else None)
        return opaque("of", name, *map(inner.value, arguments))

    def _at(self, argument: complex | None) -> Values:
        inner = replace(self, argument=argument)
        inner.heard, inner.functions = self.heard, self.functions
        return inner


def _written(latex: str, kind: int = 0) -> str:
    """What is written alike is the same symbol."""
    return f"{kind} {re.sub('[{} ]', '', latex)}"


def _product(parts: Iterable[complex]) -> complex:
    value = 1 + 0j
    for part in parts:
        value *= part
    return value


def _digits(value: sp.Expr) -> complex:
    return complex(float(f"{float(value) if abs(value) > 1e-12 else 0.0:.4g}"))


def members(steps: Iterable[object]) -> Iterator[Formula]:
    """All formulas of the steps."""
    for step in steps:
        for relation in step.relations:  # type: ignore[attr-defined]
            yield from relation.members
