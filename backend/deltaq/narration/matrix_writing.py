"""How vectors, matrices and numbers of the model are written."""

from __future__ import annotations

import math
from typing import Protocol

import sympy as sp

from ..derivation.formula import (
    AtEquilibrium,
    Determinant,
    Formula,
    Inserted,
    Jacobian,
    MatrixFormula,
    MatrixTimes,
    Named,
    Power,
    Rounded,
    Stack,
    Value,
)
from .symbols import SymbolTable

DIGITS = 4
TINY = 1e-12


class Writer(Protocol):
    """What writes the parts of a formula."""

    @property
    def symbols(self) -> SymbolTable:
        """How quantities are lettered."""

    def formula(self, formula: Formula) -> str:
        """LaTeX of a formula that stands alone."""

    def factor(self, formula: Formula) -> str:
        """LaTeX of a formula as a factor of a product: a sum is in brackets."""


def write_matrix(writer: Writer, formula: MatrixFormula) -> str:  # noqa: PLR0911 - one case for each kind
    """LaTeX of the formulas of the model."""
    match formula:
        case Stack(rows):
            return _column([writer.formula(row) for row in rows])
        case MatrixTimes(matrix, vector):
            return rf"{writer.factor(matrix)}\,{writer.factor(vector)}"
        case Jacobian(of, _, name):
            above = writer.symbols.latex(of.quantity) if isinstance(of, Named) else writer.factor(of)
            return rf"\frac{{\partial {above}}}{{\partial {writer.symbols.latex(name)}}}"
        case Determinant(of):
            return rf"\det\left({writer.formula(of)}\right)"
        case Power(of, exponent):
            return f"{writer.factor(of)}^{{{exponent}}}"
        case AtEquilibrium(of):
            return rf"\left.{writer.formula(of)}\right|_{{0}}"
        case Inserted(of):
            return writer.formula(of)
        case Rounded(value, unit):
            return rounded(value, unit)
        case _:
            raise TypeError(f"{type(formula).__name__} is no formula of the model")


def rounded(value: Value, unit: str = "") -> str:
    """LaTeX of a number, or of a vector or matrix of numbers, to four digits."""
    if isinstance(value, sp.MatrixBase):
        return _column([" & ".join(map(_number, row)) for row in value.tolist()])
    return _number(value) + (rf"\,{_unit(unit)}" if unit else "")


def _unit(unit: str) -> str:
    """1/s as s⁻¹: behind a number it would read as one more digit."""
    one, _, below = unit.partition("/")
    return rf"\mathrm{{{below}}}^{{-1}}" if one == "1" and below.isalpha() else rf"\text{{{unit}}}"


def _column(rows: list[str]) -> str:
    return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"


def _number(value: sp.Expr) -> str:
    return _power(*number_parts(value))


def number_latex(value: float) -> str:
    """A number with four digits as LaTeX, with a power of ten where it has one; zero without a sign."""
    mantissa, _, exponent = f"{value + 0.0:.{DIGITS}g}".partition("e")
    return _power(mantissa, int(exponent or 0))


def _power(mantissa: str, exponent: int) -> str:
    return rf"{mantissa} \cdot 10^{{{exponent}}}" if exponent else mantissa


def number_parts(value: sp.Expr) -> tuple[str, int]:
    """Four digits of a number, also of one beyond those of IEEE 754, and the power of ten behind them if it has one."""
    size = float(value) if abs(value) > TINY else 0.0
    text = f"{size:.{DIGITS}g}" if math.isfinite(size) else str(sp.Float(value, DIGITS))
    mantissa, _, exponent = text.partition("e")
    return mantissa, int(exponent or 0)
