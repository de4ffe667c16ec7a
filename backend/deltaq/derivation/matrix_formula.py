"""Formulas of the model: vectors and matrices, values in an equilibrium, numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import sympy as sp

if TYPE_CHECKING:
    from .formula import Formula, Quantity, Value


class MatrixFormula:
    """What the formulas of this file have in common: they are evaluated and written apart from the others."""


@dataclass(frozen=True)
class Stack(MatrixFormula):
    """Formulas one below the other: a column vector."""

    rows: tuple[Formula, ...]


@dataclass(frozen=True)
class MatrixTimes(MatrixFormula):
    """A square matrix times a vector."""

    matrix: Formula
    vector: Formula


@dataclass(frozen=True)
class Jacobian(MatrixFormula):
    """The matrix of ∂(of)ᵢ/∂(by)ₖ; `name` is how the vector of the variables is called."""

    of: Formula
    by: tuple[sp.Symbol, ...]
    name: Quantity


@dataclass(frozen=True)
class Determinant(MatrixFormula):
    """det(of)"""

    of: Formula


@dataclass(frozen=True)
class Power(MatrixFormula):
    """(of) to a whole power."""

    of: Formula
    exponent: int


@dataclass(frozen=True)
class AtEquilibrium(MatrixFormula):
    """`of` in an equilibrium: the coordinates have these values, all rates are zero. Written with the index 0."""

    of: Formula
    values: Mapping[sp.Symbol, sp.Expr] = field(hash=False)


@dataclass(frozen=True)
class Inserted(MatrixFormula):
    """`of` with symbols standing for these values, which are not written: numbers of parameters, a momentum for p."""

    of: Formula
    values: Mapping[sp.Symbol, sp.Expr] = field(hash=False)


@dataclass(frozen=True)
class Rounded(MatrixFormula):
    """An exact value that is written with a few digits and its unit."""

    value: Value
    unit: str = ""
