"""Formulas on paper: LaTeX of what a step says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby

import sympy as sp

from ..derivation.formula import (
    Bounds,
    Dot,
    Equation,
    Explicit,
    Formula,
    Gateaux,
    Given,
    Integral,
    Named,
    Partial,
    Plus,
    Quantity,
    Rate,
    Shifted,
    Substituted,
    Term,
    Times,
    Value,
)
from ..derivation.function_formula import Called, FunctionFormula
from ..derivation.matrix_formula import MatrixFormula
from ..language.latex_printer import Typography, latex
from .function_writing import write
from .matrix_writing import write_matrix
from .symbols import SymbolTable


@dataclass(frozen=True)
class Notation:
    """Writes formulas: `typography` sets the symbols of the scene, `symbols` those of quantities."""

    typography: Typography
    symbols: SymbolTable
    h: sp.Symbol

    def value(self, value: Value) -> str:
        return latex(value, self.typography)

    def formula(self, formula: Formula) -> str:  # noqa: PLR0912 - one case for each kind
        match formula:
            case Given(_, value) | Explicit(value):
                return self.value(value)
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
                return write(self, formula)
            case MatrixFormula():
                return write_matrix(self, formula)
            case Equation(left, right):
                return f"{self.formula(left)} = {self.formula(right)}"

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

    def _sum(self, terms: tuple[Term, ...]) -> str:
        pieces: list[str] = []
        for term in filter(_counts, terms):
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
        classes = [source.replace(":", "-") for source in term.sources]
        return self.symbols.wrap(" ".join([*classes, *([term.role] if term.role else [])]), text)

    def _substituted(self, of: Formula, values: Mapping[sp.Symbol, sp.Expr]) -> str:
        present = of.value.free_symbols if isinstance(of, Given | Explicit | Named) else set(values)
        rules = ", ".join(f"{self.value(s)} = {self.value(v)}" for s, v in values.items() if s in present)
        return rf"\left.{self.formula(of)}\right|_{{{rules}}}" if rules else self.formula(of)


def _counts(term: Term) -> bool:
    """Whether a summand is worth writing: a zero is not."""
    return not (isinstance(term.formula, Explicit) and term.formula.value == 0)
