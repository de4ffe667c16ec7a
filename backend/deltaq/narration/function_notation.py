"""How functions and their directions are written: x(t), δx, δẋ, or v and v̇ where the user names the direction."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import sympy as sp

from ..derivation.differential_expression import direction
from ..derivation.formula import Called, Explicit, Formula, Given, MassIntegral, Partial, Quantity, Rate, Times
from ..language.latex_printer import Typography
from ..language.order import split_symbol
from ..language.spelling import latex_of
from .letters import Letters, in_symbol
from .notation import NEIGHBOUR, Notation
from .prose import CatalogText, words

SYMBOLS: Mapping[str, str] = {
    "function": "f",
    "integrand": "F",
    "value-functional": "I_{{{at}}}",
    "integral-functional": "I",
    "variation-of-function": r"\delta f",
    "variation-of-value": r"\delta I_{{{at}}}",
    "variation-of-integral": r"\delta I",
    "first-energy": "H",
    "first-momentum": "p_{{{of}}}",
    "constant": r"\mathrm{{const.}}",
}
OF_TIME = (
    "function",
    "value-functional",
    "integral-functional",
    "function-of-function",
    "function-of-functions",
    "identity-functional",
)
VARIATION = 5  # the kind that the language's order gives δ; δẋ and δẍ follow
ACCENTS = ("{}", r"\dot{{{}}}", r"\ddot{{{}}}")


@dataclass(frozen=True)
class FunctionTypography(Typography):
    """Symbols of functions of time; `directions` has the LaTeX of each direction, "" for δ of its function.

    `argument` is put behind every function: x(t₀).
    """

    directions: Mapping[str, str] = field(default_factory=dict)
    argument: str = ""
    h: str = "h"

    def symbol(self, name: str) -> str:
        kind, base = split_symbol(name)
        function = base.rstrip(NEIGHBOUR)
        if function not in self.directions:
            return super().symbol(name)
        if base.endswith(NEIGHBOUR):
            of = name.replace(NEIGHBOUR, "")
            return rf"\left({self.symbol(of)} + {self.h}\,{self.symbol(direction(function, kind).name)}\right)"
        is_direction = VARIATION <= kind < VARIATION + len(ACCENTS)
        text = self.mark(name, self._direction(function, kind - VARIATION)) if is_direction else super().symbol(name)
        return text + self.argument

    def power(self, name: str, exponent: str) -> str:
        return f"{self.symbol(name)}^{{{exponent}}}"  # behind the argument

    def _direction(self, function: str, order: int) -> str:
        named = self.directions[function]
        known = self.names.get(function)
        letter = named or (known.typeset if known else latex_of(function))
        head, underscore, index = letter.partition("_")
        dotted = ACCENTS[order].format(head) + underscore + index
        return dotted if named else rf"\delta {dotted}"


@dataclass(frozen=True)
class FunctionNotation(Notation):
    """Writes formulas about functions; names carry their functions as x(t)."""

    def formula(self, formula: Formula) -> str:
        """A derivative that is not written out gets a bar where it is taken at an instant."""
        argument = self._functions.argument
        if argument and isinstance(formula, Partial | Rate):
            return rf"\left.{self._with('').formula(formula)}\right|_{{t = {argument[1:-1]}}}"
        match formula:
            case Times(factors):
                return r"\,".join(map(self._bracketed, factors))
            case Rate(Rate(of)):
                return rf"\frac{{\mathrm{{d}}^2}}{{\mathrm{{d}} t^2}}\left({self.formula(of)}\right)"
            case Rate(Called() as of):
                return rf"\frac{{\mathrm{{d}} {self._bare(of)}}}{{\mathrm{{d}} t}}"
        return super().formula(formula)

    def _bracketed(self, factor: Formula) -> str:
        """An integral over a region ends with its element, so that a factor behind it needs brackets before it."""
        text = self.factor(factor)
        return rf"\left({text}\right)" if isinstance(factor, MassIntegral) else text

    def applied(self, quantity: Quantity, arguments: tuple[sp.Expr, ...]) -> str:
        """f(x(t) + h v(t)); the neighbour needs no brackets of its own as an argument."""
        notation = self._with("(t)") if quantity.kind in OF_TIME else self._with("")
        texts = [notation.value(a) for a in arguments]
        inside = ", ".join(t.removeprefix(r"\left(").removesuffix(r"\right)") for t in texts)
        return self.symbols.latex(quantity) + (f"({inside})" if arguments else "")

    def at_time(self, of: Formula, time: sp.Expr) -> str:
        """x(t₀) + h δx(t₀), of what is written out; else with a bar."""
        t = sp.Symbol("t", real=True)
        if isinstance(of, Explicit | Given):
            return self._with(f"({self.value(time)})").factor(Explicit(of.value.xreplace({t: time})))
        return self._with(f"({self.value(time)})").formula(of)

    @property
    def _functions(self) -> FunctionTypography:
        if not isinstance(self.typography, FunctionTypography):
            raise TypeError("functions need their own typography")
        return self.typography

    def _with(self, argument: str) -> FunctionNotation:
        return replace(self, typography=replace(self._functions, argument=argument))


@dataclass(frozen=True)
class FunctionSymbols:
    """LaTeX of f, F and I, or of what stands for them; `at` is the instant of the value functional."""

    coordinate_latex: Mapping[str, str]
    wrap: Callable[[str, str], str]
    at: str = ""
    letters: Letters = field(default_factory=dict)

    def latex(self, quantity: Quantity) -> str:
        of = self.coordinate_latex.get(quantity.of, quantity.of)
        return in_symbol(SYMBOLS[quantity.kind], self.letters).format(at=self.at, of=of)

    def label(self, name: str) -> CatalogText:
        return words(name)

    def is_varied(self, name: str) -> bool:
        return name in self.coordinate_latex
