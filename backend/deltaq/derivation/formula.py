"""Formulas as they stand in a step: unevaluated operations over SymPy values.

A step says that several formulas are equal: `δr = ∂r/∂q₁ δq₁ + ∂r/∂q₂ δq₂ = …`. Each formula has two readers, which do
not know each other: the narration prints it, and the verification evaluates it. Values are SymPy expressions, or
column matrices for vectors.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import sympy as sp

from ..language.memory import hashed_once
from ..language.tree import Node

Value: TypeAlias = sp.Expr | sp.ImmutableMatrix


@hashed_once
@dataclass(frozen=True)
class Quantity:
    """What a symbol stands for: its kind (position, kinetic-energy …) and whose it is ("" for the system's).

    `part` narrows it down: the load that a generalized force comes from, the place where a load acts.
    """

    kind: str
    of: str = ""
    part: str = ""


@hashed_once
@dataclass(frozen=True)
class Given:
    """Expressions as the scene states them; a vector has several trees."""

    trees: tuple[Node, ...]
    value: Value


# For sums inside a value: each summand with the bodies and loads it comes from.
Owners: TypeAlias = tuple[tuple[sp.Expr, tuple[tuple[sp.Expr, tuple[str, ...]], ...]], ...]


class Written:
    """A formula with a value."""

    value: Value

    @cached_property
    def parts(self) -> tuple[sp.Expr, ...]:
        """The expression, or the entries of the vector or matrix row by row: taking a matrix apart takes long."""
        return tuple(self.value.flat()) if isinstance(self.value, sp.MatrixBase) else (self.value,)


@hashed_once
@dataclass(frozen=True)
class Explicit(Written):
    """A value written out; `owners` tell summands in its brackets apart: m₁ and m₂ in (m₁ + m₂) l² φ̈."""

    value: Value
    owners: Owners = ()


@hashed_once
@dataclass(frozen=True)
class Named(Written):
    """A quantity under its symbol, with the value that an earlier step gave it."""

    quantity: Quantity
    value: Value
    arguments: tuple[sp.Symbol, ...] = ()


@hashed_once
@dataclass(frozen=True)
class Partial:
    """∂(of)/∂(by)"""

    of: Formula
    by: sp.Symbol


@hashed_once
@dataclass(frozen=True)
class Rate:
    """d(of)/dt along the motion"""

    of: Formula


@hashed_once
@dataclass(frozen=True)
class Gateaux:
    """The first variation by its definition: ∂/∂h of(q + h δq) at h = 0, the time frozen."""

    of: Formula


@hashed_once
@dataclass(frozen=True)
class Shifted:
    """∂/∂h of the written-out value at q + h δq, at h = 0: the line between the definition and its result."""

    value: Value
    h: sp.Symbol


@hashed_once
@dataclass(frozen=True)
class Times:
    """A product, written side by side."""

    factors: tuple[Formula, ...]


@hashed_once
@dataclass(frozen=True)
class Dot:
    """The scalar product of two vectors."""

    left: Formula
    right: Formula


@hashed_once
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


@hashed_once
@dataclass(frozen=True)
class Plus:
    """A sum of terms that remember their sources."""

    terms: tuple[Term, ...]


@hashed_once
@dataclass(frozen=True)
class Substituted:
    """`of` with symbols replaced by values: a guide put into a position."""

    of: Formula
    values: Mapping[sp.Symbol, sp.Expr] = field(hash=False)


@hashed_once
@dataclass(frozen=True)
class Bounds:
    """A material coordinate and the interval it runs over."""

    symbol: sp.Symbol
    lower: sp.Expr
    upper: sp.Expr


@hashed_once
@dataclass(frozen=True)
class Integral:
    """∫ of over material coordinates, the last one innermost."""

    of: Formula
    material: tuple[Bounds, ...]


@hashed_once
@dataclass(frozen=True)
class Equation:
    """left = right as a condition on the motion, not an identity; its value is left − right."""

    left: Formula
    right: Formula


@hashed_once
@dataclass(frozen=True)
class FunctionFormula:
    """Formulas about functions: directional derivatives, values at an instant, boundary terms, sums over an index."""


@hashed_once
@dataclass(frozen=True)
class Called(FunctionFormula):
    """A formula under a name: I(x), δI. `arguments` are what it is said to depend on."""

    quantity: Quantity
    of: Formula
    arguments: tuple[sp.Expr, ...] = ()


@hashed_once
@dataclass(frozen=True)
class Directional(FunctionFormula):
    """∂/∂h of(x + h v) at h = 0: the derivative in a direction, for functions the Gâteaux differential.

    `along` gives each symbol its direction: x ↦ δx, ẋ ↦ δẋ.
    """

    of: Formula
    along: Mapping[sp.Symbol, sp.Expr] = field(hash=False)
    h: sp.Symbol


@hashed_once
@dataclass(frozen=True)
class LimitOfQuotient(FunctionFormula):
    """The limit of (of(x + h v) − of(x))/h as h → 0."""

    of: Formula
    along: Mapping[sp.Symbol, sp.Expr] = field(hash=False)
    h: sp.Symbol


@hashed_once
@dataclass(frozen=True)
class AtTime(FunctionFormula):
    """The value of `of` at the instant `time`."""

    of: Formula
    time: sp.Expr


@hashed_once
@dataclass(frozen=True)
class Boundary(FunctionFormula):
    """[of] from `lower` to `upper`: the value at the end less the value at the start."""

    of: Formula
    lower: sp.Expr
    upper: sp.Expr


@hashed_once
@dataclass(frozen=True)
class MassIntegral(FunctionFormula):
    """∫ of over a region of material, written with the element `element`: dm, dS, dV.

    One material coordinate stands for all, `weight` is the density of the element.
    """

    of: Formula
    region: str
    element: str
    bounds: Bounds
    weight: sp.Expr


@hashed_once
@dataclass(frozen=True)
class Ratio(FunctionFormula):
    """numerator/denominator, written as a fraction; both are scalars."""

    numerator: Formula
    denominator: Formula


@hashed_once
@dataclass(frozen=True)
class Summed(FunctionFormula):
    """A sum over a repeated index (Einstein's convention).

    `shown` is the term with the index, `terms` are those for each of its values.
    """

    shown: Formula
    terms: tuple[Formula, ...]


@hashed_once
@dataclass(frozen=True)
class Each(FunctionFormula):
    """A formula with a free index: `shown` with the index, `instances` for each of its values."""

    shown: Formula
    instances: tuple[Formula, ...]


class MatrixFormula:
    """Formulas of the model: vectors and matrices, values in an equilibrium, numbers."""


@hashed_once
@dataclass(frozen=True)
class Stack(MatrixFormula):
    """Formulas one below the other: a column vector."""

    rows: tuple[Formula, ...]


@hashed_once
@dataclass(frozen=True)
class MatrixTimes(MatrixFormula):
    """A square matrix times a vector."""

    matrix: Formula
    vector: Formula


@hashed_once
@dataclass(frozen=True)
class Jacobian(MatrixFormula):
    """The matrix of ∂(of)ᵢ/∂(by)ₖ; `name` is how the vector of the variables is called."""

    of: Formula
    by: tuple[sp.Symbol, ...]
    name: Quantity


@hashed_once
@dataclass(frozen=True)
class Determinant(MatrixFormula):
    """det(of)"""

    of: Formula


@hashed_once
@dataclass(frozen=True)
class Power(MatrixFormula):
    """(of) to a whole power."""

    of: Formula
    exponent: int


@hashed_once
@dataclass(frozen=True)
class AtEquilibrium(MatrixFormula):
    """`of` in an equilibrium: the coordinates have these values, all rates are zero. Written with the index 0."""

    of: Formula
    values: Mapping[sp.Symbol, sp.Expr] = field(hash=False)


@hashed_once
@dataclass(frozen=True)
class Inserted(MatrixFormula):
    """`of` with symbols standing for these values, which are not written: numbers of parameters, a momentum for p."""

    of: Formula
    values: Mapping[sp.Symbol, sp.Expr] = field(hash=False)


@hashed_once
@dataclass(frozen=True)
class Rounded(Written, MatrixFormula):
    """An exact value that is written with a few digits and its unit."""

    value: Value
    unit: str = ""


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
