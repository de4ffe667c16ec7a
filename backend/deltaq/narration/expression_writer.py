"""Expressions as data: plain text of the language, LaTeX, and words."""

from __future__ import annotations

from dataclasses import dataclass, field

import sympy as sp

from ..language.latex_printer import Typography, latex
from ..language.memory import cached_method
from ..language.order import Order
from ..language.plain_printer import plain
from ..language.spelling import latex_of
from .matrix_writing import rounded
from .speech import Speech

Document = dict[str, object]
ZERO = " = 0"


@dataclass(frozen=True)
class ExpressionWriter:
    """Writes what programs read and what people see and hear of the same expression."""

    typography: Typography
    speech: Speech
    order: Order = field(default_factory=Order)

    def written(self, value: sp.Expr) -> Document:
        """An expression."""
        return dict(self._written(value))

    @cached_method
    def _written(self, value: sp.Expr) -> Document:
        """The same, made once: most entries of large matrices are zero."""
        return {
            "plain": plain(value, self.order),
            "latex": latex(value, self.typography),
            "spoken": self.speech.value(value),
        }

    def equated(self, value: sp.Expr) -> Document:
        """The equation that says that the expression is zero."""
        return {
            "plain": plain(value, self.order) + ZERO,
            "latex": latex(value, self.typography) + ZERO,
            "spoken": self.speech.equated(value),
        }

    def equation(self, left: sp.Expr, right: sp.Expr) -> Document:
        """Both sides of an equation."""
        equation = sp.Eq(left, right, evaluate=False)
        return {
            "plain": f"{plain(left, self.order)} = {plain(right, self.order)}",
            "latex": latex(equation, self.typography),
            "spoken": self.speech.value(equation),
        }

    def vector(self, value: sp.ImmutableMatrix) -> Document:
        """A column by its components."""
        text = [plain(component, self.order) for component in value]
        return {"plain": text, "latex": latex(value, self.typography), "spoken": self.speech.value(value)}

    def matrix(self, value: sp.ImmutableMatrix) -> Document:
        """A matrix by its rows."""
        text = [[plain(entry, self.order) for entry in row] for row in value.tolist()]
        return {"plain": text, "latex": latex(value, self.typography), "spoken": self.speech.value(value)}

    def number(self, value: sp.Expr, number: float) -> Document:
        """A number that is rounded on paper, with all its digits for programs."""
        return {"plain": repr(number), "latex": rounded(value), "spoken": self.speech.rounded(value), "number": number}

    def name(self, name: str) -> Document:
        """A name that the scene does not have."""
        return {"name": name, "latex": latex_of(name), "spoken": self.speech.name(name)}
