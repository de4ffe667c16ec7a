"""SymPy → plain text that the parser reads back to the same expression.

Only explicit `*`, `/`, `^`, parentheses, function calls, dot(x) to ddddot(x), delta(x), d(x) and decimal numbers are
used, so that any program can read it.
"""

from __future__ import annotations

from typing import Any

import sympy

from .functions import CLASSES
from .memory import cached_method
from .numerals import ATOM, POWER, PRODUCT, SUM, base_exponent, fraction_parts, plain_number, signed_sum
from .order import Order, arguments_of


def plain(expr: Any, order: Order | None = None) -> str:
    """The plain text of a SymPy expression, matrix, equation or Tuple of equations. parse(plain(e)) is e."""
    if isinstance(expr, sympy.MatrixBase):
        return _matrix(expr, order)
    if isinstance(expr, sympy.Eq):
        return f"{plain(expr.lhs, order)} = {plain(expr.rhs, order)}"
    if isinstance(expr, sympy.Tuple):
        return "[" + ", ".join(plain(part, order) for part in expr) + "]"
    return _printer(order or Order()).text(sympy.sympify(expr, strict=True))


@cached_method
def _printer(order: Order) -> _Plain:
    return _Plain(order)


def _matrix(matrix: Any, order: Order | None) -> str:
    rows = [[plain(entry, order) for entry in row] for row in matrix.tolist()]
    if matrix.shape[1] == 1:
        return "[" + ", ".join(entry for (entry,) in rows) + "]"
    return "[" + ", ".join("[" + ", ".join(row) + "]" for row in rows) + "]"


class _Plain:
    def __init__(self, order: Order) -> None:
        self._order = order

    def text(self, expr: sympy.Expr, binding: int = SUM) -> str:
        """The text, in parentheses if it binds less than `binding`."""
        text, own = self._with_binding(expr)
        return f"({text})" if own < binding else text

    @cached_method
    def _with_binding(self, expr: sympy.Expr) -> tuple[str, int]:  # noqa: PLR0911 - one case for each kind
        if expr.is_Symbol:
            return expr.name, ATOM
        if expr.is_Rational or expr.is_Float:
            return plain_number(expr)
        if expr is sympy.pi:
            return "pi", ATOM
        if expr is sympy.E:
            return "exp(1)", ATOM
        if expr.is_Add:
            return self._sum(expr), SUM
        if expr.is_Mul:
            return self._product(expr)
        if expr.is_Pow:
            return self._power(expr)
        name = CLASSES.get(type(expr).__name__, type(expr).__name__)
        return f"{name}({', '.join(self.text(a) for a in arguments_of(expr))})", ATOM

    def _sum(self, expr: sympy.Expr) -> str:
        return signed_sum(self.text(term, PRODUCT) for term in self._order.terms(expr))

    def _product(self, expr: sympy.Expr) -> tuple[str, int]:
        sign, upper, lower = fraction_parts(expr)
        above = "*".join(self.text(f, PRODUCT) for f in self._order.factors(upper)) or "1"
        if len(lower) == 2 and lower[0].is_Rational and lower[1].is_Add:
            # Not 1/(2*(a + b)): the computer algebra would multiply this out when it is read back.
            above += f"/{lower[0]}"
            lower = lower[1:]
        if [str(f) for f in lower] == ["d(t)"] and any(str(f).startswith("d(") for f in upper):
            # dx/dt is read as the rate.
            return f"{sign}{above}*(1/d(t))", PRODUCT
        if lower:
            below = "*".join(self.text(f, PRODUCT) for f in self._order.factors(lower))
            above += f"/({below})" if len(lower) > 1 else f"/{self.text(lower[0], POWER)}"
        return sign + above, PRODUCT

    def _power(self, expr: sympy.Expr) -> tuple[str, int]:
        base, exponent = base_exponent(expr)
        if exponent.is_Rational and exponent.is_negative:
            return f"1/{self.text(base**-exponent, POWER)}", PRODUCT
        if exponent == sympy.Rational(1, 2):
            return f"sqrt({self.text(base)})", ATOM
        if exponent.is_Integer or exponent.is_Rational:
            shown = str(exponent) if exponent.is_Integer else f"({exponent})"
            return f"{self.text(base, ATOM)}^{shown}", POWER
        return f"exp({self.text(exponent * sympy.log(base))})", ATOM
