"""Formulas as they stand in a step: unevaluated operations over SymPy values.

A step says that several formulas are equal: `δr = ∂r/∂q₁ δq₁ + ∂r/∂q₂ δq₂ = …`. Each formula has two readers, which do
not know each other: the narration prints it, and the verification evaluates it. Values are SymPy expressions, or
column matrices for vectors.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import sympy as sp

from ..language.tree import Node
from .function_formula import FunctionFormula
from .matrix_formula import AtEquilibrium, Determinant, Inserted, Jacobian, MatrixTimes, Power, Rounded, Stack

Value: TypeAlias = sp.Expr | sp.ImmutableMatrix


@dataclass(frozen=True)
class Quantity:
    """What a symbol stands for: its kind (position, kinetic-energy …) and whose it is ("" for the system's).

    `part` narrows it down: the load that a generalized force comes from, the place where a load acts.
    """

    kind: str
    of: str = ""
    part: str = ""


@dataclass(frozen=True)
class Given:
    """Expressions as the scene states them; a vector has several trees."""

    trees: tuple[Node, ...]
    value: Value


@dataclass(frozen=True)
class Explicit:
    """A value written out."""

    value: Value


@dataclass(frozen=True)
class Named:
    """A quantity under its symbol, with the value that an earlier step gave it."""

    quantity: Quantity
    value: Value
    arguments: tuple[sp.Symbol, ...] = ()


@dataclass(frozen=True)
class Partial:
    """∂(of)/∂(by)"""

    of: Formula
    by: sp.Symbol


@dataclass(frozen=True)
class Rate:
    """d(of)/dt along the motion"""

    of: Formula


@dataclass(frozen=True)
class Gateaux:
    """The first variation by its definition: ∂/∂h of(q + h δq) at h = 0, the time frozen."""

    of: Formula


@dataclass(frozen=True)
class Shifted:
    """∂/∂h of the written-out value at q + h δq, at h = 0: the line between the definition and its result."""

    value: Value
    h: sp.Symbol


@dataclass(frozen=True)
class Times:
    """A product, written side by side."""

    factors: tuple[Formula, ...]


@dataclass(frozen=True)
class Dot:
    """The scalar product of two vectors."""

    left: Formula
    right: Formula


@dataclass(frozen=True)
class Term:
    """A summand and where it comes from: names of bodies and loads, as `body:bob`, `load:weight`."""

    formula: Formula
    sources: tuple[str, ...] = ()
    sign: int = 1
    role: str = ""

    @property
    def written_out(self) -> Value:
        """The value of the formula without the sign; only what is written out has one."""
        if not isinstance(self.formula, Explicit):
            raise TypeError(f"{type(self.formula).__name__} is not written out")
        return self.formula.value


@dataclass(frozen=True)
class Plus:
    """A sum of terms that remember their sources."""

    terms: tuple[Term, ...]


@dataclass(frozen=True)
class Substituted:
    """`of` with symbols replaced by values: a guide put into a position."""

    of: Formula
    values: Mapping[sp.Symbol, sp.Expr] = field(hash=False)


@dataclass(frozen=True)
class Bounds:
    """A material coordinate and the interval it runs over."""

    symbol: sp.Symbol
    lower: sp.Expr
    upper: sp.Expr


@dataclass(frozen=True)
class Integral:
    """∫ of over material coordinates, the last one innermost."""

    of: Formula
    material: tuple[Bounds, ...]


@dataclass(frozen=True)
class Equation:
    """left = right as a condition on the motion, not an identity; its value is left − right."""

    left: Formula
    right: Formula


Formula = (
    Given
    | Explicit
    | Named
    | Partial
    | Rate
    | Gateaux
    | Shifted
    | Times
    | Dot
    | Plus
    | Substituted
    | Integral
    | Equation
    | FunctionFormula
    | Stack
    | MatrixTimes
    | Jacobian
    | Determinant
    | Power
    | AtEquilibrium
    | Inserted
    | Rounded
)


def minus(formula: Formula, *sources: str) -> Term:
    """The formula as a term that is subtracted."""
    return Term(formula, sources, -1)
