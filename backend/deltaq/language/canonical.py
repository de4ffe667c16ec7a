"""The canonical form of an expression, and the zero test by which every equality in δq is decided.

A trigonometric polynomial in the coordinates has exactly one Fourier form, so equality is decided exactly and at once.
Rational functions are brought over one denominator first. For what has roots of sums, logarithms, inverse or absolute
values the form can still show equality; inequality is then shown by ball arithmetic, and what neither shows stays
undecided.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import sympy

from ..errors import ExpressionError, Problem
from .display import display
from .fourier import Form, Monomial, TooLargeError
from .intervals import sample_zero
from .normal_form import Reader
from .symbols import Symbols

__all__ = ["Decision", "canonical", "display", "is_zero", "zero_test"]

How = Literal["normal form", "ball arithmetic", "sampling", "none"]


@dataclass(frozen=True)
class Decision:
    """Whether an expression is zero (None: undecided), how this is known, and from how many points."""

    outcome: bool | None
    how: How
    points: int = 0


def canonical(expr: Any, symbols: Symbols) -> Any:
    """The Fourier form: a sum of coefficient · monomial · cos or sin of a linear form in the coordinates.

    Two equal trigonometric polynomials have the same canonical form. Quotients become one fraction of two such forms.
    Too large expressions come back as they are.
    """
    if isinstance(expr, sympy.MatrixBase):
        return expr.applyfunc(lambda entry: canonical(entry, symbols))
    if isinstance(expr, sympy.Eq):
        return sympy.Eq(canonical(expr.lhs, symbols), canonical(expr.rhs, symbols), evaluate=False)
    try:
        reader, numerator, denominator = _read(expr)
    except TooLargeError:
        return expr
    return reader.expression(numerator) / reader.monomial(denominator)


def is_zero(expr: Any, symbols: Symbols) -> bool | None:
    """Whether an expression (all entries of a Matrix, both sides of an Eq) vanishes identically; None: undecided."""
    return zero_test(expr, symbols).outcome


def zero_test(expr: Any, symbols: Symbols) -> Decision:
    """The same with its grounds: exact by normal form, certain by ball arithmetic, or seen at random points."""
    if isinstance(expr, sympy.Eq):
        return zero_test(expr.lhs - expr.rhs, symbols)
    if isinstance(expr, sympy.MatrixBase):
        return _weakest([zero_test(entry, symbols) for entry in expr])
    try:
        reader, numerator, _ = _read(expr)
    except TooLargeError:
        return _sampled(expr)
    if not numerator:
        return Decision(outcome=True, how="normal form")
    if reader.is_exact:
        return Decision(outcome=False, how="normal form")
    return _sampled(expr)


def _read(expr: Any) -> tuple[Reader, Form, Monomial]:
    reader = Reader()
    try:
        return reader, *reader.cleared(reader.form(expr))
    except ZeroDivisionError:
        raise ExpressionError(Problem("division-by-zero")) from None


def _sampled(expr: Any) -> Decision:
    outcome, points = sample_zero(expr)
    how: How = "none" if outcome is None else "sampling" if outcome else "ball arithmetic"
    return Decision(outcome, how, points)


def _weakest(decisions: list[Decision]) -> Decision:
    """A vector is zero if all of its entries are; one that is not settles it."""
    for wanted in (False, None):
        found = next((d for d in decisions if d.outcome is wanted), None)
        if found is not None:
            return found
    return min(decisions, key=lambda d: d.how == "normal form", default=Decision(outcome=True, how="normal form"))
