"""From the model's expressions back to a scene's: texts in the scene's own names, read by the one parser."""

from __future__ import annotations

import re
from dataclasses import dataclass

import symengine as se

from ..language.expression import Expression
from ..language.names import Names
from ..language.parser import parse
from .functions import Expr
from .symbols import CLOCK, Symbols

MARK = "#"


@dataclass(frozen=True)
class Writer:
    """Writes expressions in `symbols` as a scene with these `names` would."""

    symbols: Symbols
    names: Names

    def expression(self, expr: Expr) -> Expression:
        """Raises ExpressionError where the language has no words for it, or where it is too long for a scene."""
        return parse(self.text(expr), self.names)

    def text(self, expr: Expr) -> str:
        """`m*l^2*dot(phi)^2/2`"""
        marked = str(se.sympify(expr).xreplace(self._marked))
        return re.sub(rf"\bE\b(?!{MARK})", "exp(1)", marked).replace(MARK, "").replace("**", "^")

    @property
    def _marked(self) -> dict[Expr, Expr]:
        """Every name with a mark, which tells a parameter E from the constant e, and the like."""
        symbols, dot = self.symbols, se.Function("dot")
        names = {name: se.Symbol(name + MARK) for name in (*symbols.values, *symbols.rates)}
        values = {symbol: names[name] for name, symbol in symbols.values.items() if name != "pi"}
        return {**values, **{symbol: dot(names[name]) for name, symbol in symbols.rates.items() if name != CLOCK}}
