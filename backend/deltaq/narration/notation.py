"""Formulas on paper: LaTeX of what a step says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby

import sympy as sp

from ..derivation.formula import (
    AtTime,
    Boundary,
    Bounds,
    Called,
    Directional,
    Dot,
    Each,
    Equation,
    Explicit,
    Formula,
    FunctionFormula,
    Gateaux,
    Given,
    Integral,
    LimitOfQuotient,
    MassIntegral,
    MatrixFormula,
    Named,
    Owners,
    Partial,
    Plus,
    Quantity,
    Rate,
    Ratio,
    Shifted,
    Substituted,
    Summed,
    Term,
    Times,
    Value,
)
from ..language.latex_printer import Typography, latex
from .matrix_writing import write_matrix
from .symbols import SymbolTable

NEIGHBOUR = "ʰ"
REGIONS: Mapping[str, str] = {"B": r"\mathcal{B}", "S": "S", "V": "V"}


@dataclass(frozen=True)
class Notation:
    """Writes formulas: `typography` sets the symbols of the scene, `symbols` those of quantities."""

    typography: Typography
    symbols: SymbolTable
    h: sp.Symbol

    def value(self, value: Value) -> str:
        """LaTeX of a scalar, vector or matrix."""
        return latex(value, self.typography)

    def formula(self, formula: Formula) -> str:  # noqa: PLR0912 - one case for each kind
        """LaTeX of a formula that stands alone; what is not computed (∂, d/dt, ∫ of a letter) stays as it is."""
        match formula:
            case Given(_, value) | Explicit(value, ()):
                return self.value(value)
            case Explicit(value, owners):
                return self._owned(value, owners)
            case Named(quantity, _, arguments):
                return self.applied(quantity, arguments)
            case Partial(of, by):
                return self._partial(of, self.value(by))
            case Rate(of):
                return self._rate(of)
            case Gateaux(of):
                return self._gateaux(of)
            case Shifted(value, h):
                return self.at_zero(self.factor(Explicit(value)), h)
            case Times(factors):
                return r"\,".join(self._powers(factors))
            case Dot(left, right):
                return rf"{self.factor(left)} \cdot {self.factor(right)}"
            case Plus(terms):
                return self._sum(terms)
            case Substituted(of, values):
                return self._substituted(of, values)
            case Integral(of, material):
                return self._integral(of, material)
            case FunctionFormula():
                return write_function(self, formula)
            case MatrixFormula():
                return write_matrix(self, formula)
            case Equation(left, right):
                return f"{self.formula(left)} = {self.formula(right)}"

    def _owned(self, value: Value, owners: Owners) -> str:
        """A value in whose brackets each summand is marked with where it comes from."""
        marks = {
            bracket: {term: partial(self.symbols.wrap, in_classes(sources)) for term, sources in terms}
            for bracket, terms in owners
        }
        return latex(value, self.typography.with_summands(marks))

    def applied(self, quantity: Quantity, arguments: tuple[sp.Expr, ...]) -> str:
        """A name with what it depends on: r(q₁, q₂, t)."""
        inside = ", ".join(map(self.value, arguments))
        return self.symbols.latex(quantity) + (f"({inside})" if arguments else "")

    def at_time(self, of: Formula, time: sp.Expr) -> str:
        """A formula at an instant; a single symbol as a function of time."""
        if isinstance(of, Explicit) and of.value.is_Symbol:
            return f"{self.value(of.value)}({self.value(time)})"
        return rf"\left.{self.formula(of)}\right|_{{t = {self.value(time)}}}"

    def _partial(self, of: Formula, by: str) -> str:
        if isinstance(of, Named | Called):
            return rf"\frac{{\partial {self._bare(of)}}}{{\partial {by}}}"
        return rf"\frac{{\partial}}{{\partial {by}}}\left({self.formula(of)}\right)"

    def _bare(self, of: Formula) -> str:
        """The name without its arguments, for the numerator of a derivative."""
        return self.symbols.latex(of.quantity) if isinstance(of, Named | Called) else self.factor(of)

    def _integral(self, of: Formula, material: tuple[Bounds, ...]) -> str:
        signs = "".join(rf"\int_{{{self.value(b.lower)}}}^{{{self.value(b.upper)}}} " for b in material)
        elements = "".join(rf"\,\mathrm{{d}}{self.value(b.symbol)}" for b in reversed(material))
        return f"{signs}{self.factor(of)}{elements}"

    def factor(self, formula: Formula) -> str:
        """In parentheses where it is a sum of its own."""
        text = self.formula(formula)
        return rf"\left({text}\right)" if self._is_sum(formula) else text

    def _powers(self, factors: tuple[Formula, ...]) -> Iterator[str]:
        """The factors; a name that stands there twice is squared."""
        for text, alike in groupby(factors, self.factor):
            first, *others = alike
            if others and isinstance(first, Named):
                yield f"{text}^{{{1 + len(others)}}}"
            else:
                yield from (text, *(text for _ in others))

    def _is_sum(self, formula: Formula) -> bool:
        written_out = isinstance(formula, Explicit | Given) and isinstance(formula.value, sp.Add)
        return isinstance(formula, Plus) or written_out

    def _rate(self, of: Formula) -> str:
        if isinstance(of, Named):
            return rf"\frac{{\mathrm{{d}} {self._bare(of)}}}{{\mathrm{{d}} t}}"
        return rf"\frac{{\mathrm{{d}}}}{{\mathrm{{d}} t}}\left({self.formula(of)}\right)"

    def _gateaux(self, of: Formula) -> str:
        if not isinstance(of, Named) or not of.arguments:
            return rf"\delta {self._bare(of)}"
        h = self.value(self.h)
        shifted = ", ".join(self._shifted_argument(argument, h) for argument in of.arguments)
        return self.at_zero(rf"{self._bare(of)}({shifted})", self.h)

    def _shifted_argument(self, argument: sp.Symbol, h: str) -> str:
        variation = sp.Symbol(f"delta({argument.name})", real=True)
        text = self.value(argument)
        return rf"{text} + {h}\,{self.value(variation)}" if self.symbols.is_varied(argument.name) else text

    def at_zero(self, text: str, h: sp.Symbol) -> str:
        """The derivative with respect to h at h = 0."""
        letter = self.value(h)
        return rf"\left.\frac{{\partial}}{{\partial {letter}}} {text}\right|_{{{letter}=0}}"

    def term(self, term: Term) -> str:
        """A single term with its sign."""
        return self._sum((term,))

    def _sum(self, terms: tuple[Term, ...]) -> str:
        pieces: list[str] = []
        for term in filter(counts, terms):
            text, negative = self._unsigned(term)
            sign = "-" if negative else "+"
            pieces.append(f"{sign if pieces or negative else ''} {self._marked(term, text)}")
        return " ".join(pieces).strip() or "0"

    def _unsigned(self, term: Term) -> tuple[str, bool]:
        """The term without its sign, which stands outside the mark so that it is spaced as an operator."""
        text = self.formula(term.formula)
        if term.sign < 0 and self._is_sum(term.formula):
            return self.factor(term.formula), True
        leads_with_minus = text.startswith("-")
        return text.removeprefix("-"), leads_with_minus is not (term.sign < 0)

    def _marked(self, term: Term, text: str) -> str:
        return self.symbols.wrap(f"{in_classes(term.sources)} {term.role}".strip(), text)

    def _substituted(self, of: Formula, values: Mapping[sp.Symbol, sp.Expr]) -> str:
        present = of.value.free_symbols if isinstance(of, Given | Explicit | Named) else set(values)
        rules = ", ".join(f"{self.value(s)} = {self.value(v)}" for s, v in values.items() if s in present)
        return rf"\left.{self.formula(of)}\right|_{{{rules}}}" if rules else self.formula(of)


def in_classes(sources: tuple[str, ...]) -> str:
    """Bodies and loads as classes of the page."""
    return " ".join(source.replace(":", "-") for source in sources)


def counts(term: Term) -> bool:
    """Whether a summand is worth writing: a zero is not."""
    return not (isinstance(term.formula, Explicit) and term.formula.value == 0)


def write_function(notation: Notation, formula: FunctionFormula) -> str:
    """The formula in this notation."""
    match formula:
        case Called(quantity, _, arguments):
            return notation.applied(quantity, arguments)
        case Directional(of, along, h):
            return notation.at_zero(notation.factor(moved(of, along)), h)
        case LimitOfQuotient(of, along, h):
            difference = f"{notation.formula(moved(of, along))} - {notation.formula(of)}"
            return rf"\lim_{{{notation.value(h)} \to 0}} \frac{{{difference}}}{{{notation.value(h)}}}"
        case AtTime(of, time):
            return notation.at_time(of, time)
        case Boundary(of, lower, upper):
            ends = rf"_{{{notation.value(lower)}}}^{{{notation.value(upper)}}}"
            return rf"\left[{notation.formula(of)}\right]{ends}"
        case MassIntegral(of, region, element):
            return rf"\int_{{{REGIONS[region]}}} {notation.factor(of)} \,\mathrm{{d}}{element}"
        case Ratio(numerator, denominator):
            return rf"\frac{{{notation.formula(numerator)}}}{{{notation.formula(denominator)}}}"
        case Summed(shown) | Each(shown):
            return notation.formula(shown)
    raise TypeError(f"no LaTeX for {type(formula).__name__}")


def neighbour(symbol: sp.Symbol) -> sp.Symbol:
    """A symbol that is written as x + h v, so that neither the algebra nor the printer takes it apart."""
    head, bracket, tail = symbol.name.partition(")")
    return sp.Symbol(f"{head}{NEIGHBOUR}{bracket}{tail}", real=True)


def moved(of: Formula, along: Mapping[sp.Symbol, sp.Expr]) -> Formula:
    """The formula at x + h v, as it is written: in the arguments of what has a name, else put in."""
    steps = {symbol: neighbour(symbol) for symbol in along}
    match of:
        case Named(_, _, arguments) | Called(_, _, arguments):
            return replace(of, arguments=tuple(steps.get(argument, argument) for argument in arguments))
        case Explicit(value):
            return Explicit(value.xreplace(steps))
        case Integral(inside) | AtTime(inside):
            return replace(of, of=moved(inside, along))
    return of
