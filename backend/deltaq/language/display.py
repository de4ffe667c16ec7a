"""The form in which a result is shown: as a textbook prints it, or as it was given where that is shorter.

What is too long to be planned is arranged by kinds of terms, over a common denominator or not, whichever is shorter.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import sympy

from ..errors import ExpressionError, Problem
from .arrangement import Arrangement
from .fourier import Form, TooLargeError
from .normal_form import Reader
from .operations import operations
from .order import Order, split_symbol
from .symbols import Symbols
from .textbook import Textbook, given_sums, textbook

_MAX_SHOWN = 600  # terms: more are not read by anyone, so they stay as they are


def display(expr: Any, symbols: Symbols, given: frozenset[Any] = frozenset()) -> Any:
    """The shortest of the equivalent forms of an expression; entry by entry for a Matrix, side by side for an Eq.

    `given` are sums as the author wrote them: where x₂ − x₁ is one of them, x₁ − x₂ is not shown.
    """
    if isinstance(expr, sympy.MatrixBase):
        return expr.applyfunc(lambda entry: display(entry, symbols, given))
    if isinstance(expr, sympy.Eq):
        return sympy.Eq(display(expr.lhs, symbols, given), display(expr.rhs, symbols, given), evaluate=False)
    if isinstance(expr, sympy.Tuple):
        return sympy.Tuple(*(display(part, symbols, given) for part in expr))
    try:
        return _shown(expr, symbols.order, given)
    except TooLargeError:
        return expr
    except ZeroDivisionError:
        raise ExpressionError(Problem("division-by-zero")) from None


def _shown(expr: Any, order: Order, given: frozenset[Any]) -> Any:
    try:
        found = textbook(expr, order, given or given_sums((expr,)))
    except TooLargeError:
        return min(_candidates(expr, order), key=size)
    return expr if operations(expr) < operations(found) and not _hides_unity(expr) else found


def display_form(form: Form, reader: Reader, symbols: Symbols, given: frozenset[Any] = frozenset()) -> Any:
    """The shortest of the equivalent expressions of a form whose generators are symbols."""
    if len(form) > _MAX_SHOWN:
        return reader.expression(form)
    with suppress(TooLargeError):
        return Textbook(reader, symbols.order, given).whole(form)
    arranged = Arrangement(reader, symbols.order).expression(form)
    moves = any(split_symbol(name)[0] for mono, _, _ in form for name, _ in mono)
    return arranged if moves else min(arranged, reader.expression(form), key=size)


def size(expr: Any) -> int:
    """How long it is to write: the number of its parts."""
    return 1 + sum(map(size, expr.args)) if expr.args else 1


def _candidates(expr: Any, order: Order) -> list[Any]:
    reader = Reader()
    form = reader.form(expr)
    if len(form) > _MAX_SHOWN:
        return [expr]
    arranged = Arrangement(reader, order)
    candidates = [arranged.expression(form)]
    if reader.bases:
        numerator, denominator = reader.cleared(form)
        candidates.append(arranged.expression(numerator) / reader.monomial(denominator))
    moves = any(split_symbol(s.name)[0] for s in expr.free_symbols)
    if not moves or reader.bases or not reader.is_exact:
        candidates += [] if _hides_unity(expr) else [expr]
        candidates += _with_bases_displayed(expr, order)
    return candidates


def _hides_unity(expr: Any) -> bool:
    """Whether squares hold sine and cosine of one angle, so that cos² + sin² may be in it."""
    squares = [p.base for p in expr.atoms(sympy.Pow) if p.exp.is_Integer and p.exp > 1]
    sines, cosines = (
        {wave.args[0] for base in squares for wave in base.atoms(function)} for function in (sympy.sin, sympy.cos)
    )
    return bool(sines & cosines)


def _with_bases_displayed(expr: Any, order: Order) -> list[Any]:
    """The expression with what stands under its roots displayed, if there are roots of sums."""
    roots = [p for p in expr.atoms(sympy.Pow) if p.base.is_Add and not p.exp.is_Integer]
    shown = {root: min(_candidates(root.base, order), key=size) ** root.exp for root in roots if root != expr}
    inner = expr.xreplace(shown)
    return [] if inner == expr or _hides_unity(inner) else [inner]
