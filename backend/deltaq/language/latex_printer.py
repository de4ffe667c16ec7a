"""SymPy → LaTeX as the lecture writes it: m \\ell^2 \\ddot{\\varphi} + m g \\ell \\sin\\varphi."""

from __future__ import annotations

from typing import Any

import sympy

from .functions import CLASSES, FUNCTIONS, Function
from .memory import cached_method
from .numerals import (
    ATOM,
    POWER,
    PRODUCT,
    SUM,
    Decides,
    base_exponent,
    decimal,
    decimals_of,
    ends,
    exact,
    fraction_parts,
    named_root,
    signed_sum,
)
from .order import arguments_of, split_symbol
from .typography import Mark, Typography, unmarked

_SET_OFF = r" \, "

__all__ = ["Mark", "Typography", "latex", "unmarked"]


def latex(expr: Any, typography: Typography) -> str:
    """LaTeX of an expression; a Matrix in brackets; an Eq with its sign; a Tuple of Eq as rows."""
    if isinstance(expr, sympy.MatrixBase):
        rows = [" & ".join(latex(entry, typography) for entry in row) for row in expr.tolist()]
        return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"
    if isinstance(expr, sympy.Eq):
        return f"{latex(expr.lhs, typography)} = {latex(expr.rhs, typography)}"
    if isinstance(expr, sympy.Tuple):
        rows = [latex(part, typography).replace(" = ", " &= ") for part in expr]
        return r"\begin{aligned} " + r" \\ ".join(rows) + r" \end{aligned}"
    value = sympy.sympify(expr, strict=True)
    return _printer(typography, decimals_of(value, wanted=typography.decimals)).text(value)


@cached_method
def _printer(typography: Typography, as_decimal: Decides) -> _Latex:
    return _Latex(typography, as_decimal)


class _Latex:
    def __init__(self, typography: Typography, as_decimal: Decides) -> None:
        self._typography = typography
        self._as_decimal = as_decimal
        self._order = typography.order
        self._plain = _printer(typography.base, as_decimal) if typography.base else None

    def text(self, expr: sympy.Expr, binding: int = SUM) -> str:
        printer = self if self._is_marked(expr) else self._plain or self
        text, own = printer.bound(expr)
        return _bracketed(text) if own < binding else text

    def _is_marked(self, expr: sympy.Expr) -> bool:
        """Whether a sum stands in it whose terms are wrapped; all else is printed once for all formulas."""
        return any(part in self._typography.summands for part in expr.atoms(sympy.Add)) if self._plain else True

    @cached_method
    def bound(self, expr: sympy.Expr) -> tuple[str, int]:  # noqa: PLR0911 - one case for each kind
        named = named_root(expr, self._typography.roots)
        if named:
            return self._letter(*named)
        if expr.is_Symbol:
            return self._typography.symbol(expr.name), ATOM if split_symbol(expr.name)[0] < 4 else PRODUCT
        if expr.is_Rational or expr.is_Float:
            return self._number(expr)
        if expr is sympy.pi:
            return r"\pi", ATOM
        if expr.is_Add:
            return self._sum(expr), SUM
        if expr.is_Mul:
            return self._product(expr), PRODUCT
        if expr is sympy.E or isinstance(expr, sympy.exp):
            return self._exponential(expr), POWER
        return (self._power(expr), POWER) if expr.is_Pow else (self.call(expr), PRODUCT)

    def _letter(self, letter: str, exponent: int) -> tuple[str, int]:
        """A root by its name, or a power of it."""
        if exponent == 1:
            return self._typography.symbol(letter), ATOM
        return self._typography.power(letter, str(exponent)), POWER

    def _number(self, number: sympy.Expr) -> tuple[str, int]:
        value = exact(number)
        sign, size = "-" if value < 0 else "", abs(value)
        binding = PRODUCT if value < 0 else ATOM
        if size.denominator == 1:
            return f"{sign}{size.numerator}", binding
        if self._as_decimal(size) or (number.is_Float and ends(size)):
            return f"{sign}{decimal(size)}", binding
        return rf"{sign}\frac{{{size.numerator}}}{{{size.denominator}}}", min(binding, PRODUCT)

    def _exponential(self, expr: sympy.Expr) -> str:
        exponent = self.text(sympy.Mul(*expr.args))  # 1 of e itself
        return rf"\mathrm{{e}}^{{{exponent}}}"

    def _sum(self, expr: sympy.Expr) -> str:
        terms = self._order.terms(expr)
        return signed_sum(self._typography.summand(expr, term, self.text(term, PRODUCT)) for term in terms)

    def _product(self, expr: sympy.Expr) -> str:
        sign, upper, lower = fraction_parts(expr, self._as_decimal)
        if all(f.is_Rational for f in lower):
            return sign + self._with_number_in_front(upper, lower)
        return rf"{sign}\frac{{{self.factors(upper)}}}{{{self.factors(lower)}}}"

    def _with_number_in_front(self, upper: list[sympy.Expr], lower: list[sympy.Expr]) -> str:
        if not lower:
            return self.factors(upper, whole=False)
        numbers = [f for f in upper if f.is_Rational]
        rest = [f for f in upper if not f.is_Rational]
        if len(rest) == 1 and not numbers and (rest[0] is sympy.pi or rest[0].is_Symbol):
            numbers, rest = rest, []
        fraction = rf"\frac{{{self.factors(numbers)}}}{{{self.factors(lower)}}}"
        following = self.factors(rest, whole=False)
        return f"{fraction}{_joint(' ', following)}{following}" if rest else fraction

    def factors(self, factors: list[sympy.Expr], *, whole: bool = True) -> str:
        """A product; a thin space sets off δ and d, and what follows the argument of a function without brackets.

        Before a bracket the argument is closed by brackets of its own. A single sum needs none if it is the `whole`
        of what is written, and no sign or number stands before it.
        """
        ordered = self._order.factors(factors)
        text = ""
        following = sympy.S.One
        for factor in reversed(ordered):
            closed = text.startswith(("(", r"\left("))
            printed = self._factor(factor, closed=closed, alone=whole and len(ordered) == 1)
            apart = _is_infinitesimal(following) or (not closed and _is_open(factor) and not _is_call(following))
            text = f"{printed}{_joint(_SET_OFF if apart else ' ', text)}{text}" if text else printed
            following = factor
        return text or "1"

    @cached_method
    def _factor(self, factor: sympy.Expr, *, closed: bool, alone: bool) -> str:
        base, exponent = base_exponent(factor)
        if _takes_power(base, exponent):
            return self.call(base, exponent, closed=closed)
        if factor.is_Symbol:
            return self._typography.symbol(factor.name)
        return self.text(factor, SUM if alone else PRODUCT)

    def _power(self, expr: sympy.Expr) -> str:
        base, exponent = base_exponent(expr)
        if exponent.is_Rational and exponent.is_negative:
            return rf"\frac{{1}}{{{self.text(base**-exponent)}}}"
        if exponent == sympy.Rational(1, 2):
            return rf"\sqrt{{{self.text(base)}}}"
        if _takes_power(base, exponent):
            return self.call(base, exponent)
        if base.is_Symbol and split_symbol(base.name)[0] < 4:
            return self._typography.power(base.name, self._exponent(exponent))
        return f"{self.text(base, ATOM)}^{{{self._exponent(exponent)}}}"

    def _exponent(self, exponent: sympy.Expr) -> str:
        return str(exponent) if exponent.is_Rational else self.text(exponent)

    def call(self, expr: sympy.Expr, power: sympy.Expr = sympy.S.One, *, closed: bool = False) -> str:
        """A function with its power: \\sin^{2}\\varphi, \\cos(\\varphi_1 - \\varphi_2)."""
        name = CLASSES.get(type(expr).__name__, type(expr).__name__)
        arguments = [self.text(a) for a in arguments_of(expr)]
        raised = "" if power == 1 else f"^{{{power}}}"
        if name == "abs":
            return rf"\left|{arguments[0]}\right|{raised}"
        command = FUNCTIONS[name].latex if name in FUNCTIONS else rf"\operatorname{{{name}}}"
        if _has_bare_argument(expr) and not closed:
            return f"{command}{raised}{_spaced(arguments[0])}"
        return f"{command}{raised}{_bracketed(', '.join(arguments))}"


def _spaced(argument: str) -> str:
    return argument if argument.startswith("\\") else f" {argument}"


def _has_bare_argument(call: sympy.Expr) -> bool:
    """Whether the argument is written without brackets: a single symbol that is no rate, after a command of LaTeX."""
    known = FUNCTIONS.get(CLASSES.get(type(call).__name__, type(call).__name__))
    if known is None or known.latex.endswith("}") or known.arguments > 1:
        return False
    return all(argument.is_Symbol and not split_symbol(argument.name)[0] for argument in call.args)


def _is_open(factor: sympy.Expr) -> bool:
    """Whether a factor ends with an argument without brackets."""
    base, exponent = base_exponent(factor)
    return _takes_power(base, exponent) and _has_bare_argument(base)


def _is_call(factor: sympy.Expr) -> bool:
    """Whether a factor starts with the name of a function, which ends the argument before it."""
    base, exponent = base_exponent(factor)
    return _takes_power(base, exponent) and not isinstance(base, sympy.Abs)


def _takes_power(base: sympy.Expr, exponent: sympy.Expr) -> bool:
    """Whether this is a function whose power stands after its name, as in sin² x."""
    known = FUNCTIONS.get(CLASSES.get(type(base).__name__, type(base).__name__))
    if known is None or known.name == "exp" or not base.is_Function:
        return False
    return bool(exponent == 1 or (_is_raised_by_name(known) and exponent.is_Integer))


def _is_raised_by_name(known: Function) -> bool:
    """Whether the power stands behind the name, or behind the bars."""
    return known.power_after_name or known.name == "abs"


def _joint(space: str, following: str) -> str:
    """What stands between two factors: a sign if the second starts with a digit."""
    return r" \cdot " if following[0].isdigit() else space


def _is_infinitesimal(factor: sympy.Expr) -> bool:
    return bool(factor.is_Symbol) and split_symbol(factor.name)[0] >= 4


def _bracketed(text: str) -> str:
    tall = any(command in text for command in (r"\frac", r"\left", r"\sqrt"))
    return rf"\left({text}\right)" if tall else f"({text})"
