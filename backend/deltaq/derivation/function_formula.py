"""Formulas about functions: derivatives in a direction, values at an instant, boundary terms, sums over an index."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import sympy as sp

if TYPE_CHECKING:
    from .formula import Bounds, Formula, Quantity


@dataclass(frozen=True)
class FunctionFormula:
    """What the formulas of this file have in common; the readers of formulas know them by it."""


@dataclass(frozen=True)
class Called(FunctionFormula):
    """A formula under a name: I(x), δI. `arguments` are what it is said to depend on."""

    quantity: Quantity
    of: Formula
    arguments: tuple[sp.Expr, ...] = ()


@dataclass(frozen=True)
class Directional(FunctionFormula):
    """∂/∂h of(x + h v) at h = 0: the derivative in a direction, for functions the Gâteaux differential.

    `along` gives each symbol its direction: x ↦ δx, ẋ ↦ δẋ.
    """

    of: Formula
    along: Mapping[sp.Symbol, sp.Expr] = field(hash=False)
    h: sp.Symbol


@dataclass(frozen=True)
class LimitOfQuotient(FunctionFormula):
    """The limit of (of(x + h v) − of(x))/h as h → 0."""

    of: Formula
    along: Mapping[sp.Symbol, sp.Expr] = field(hash=False)
    h: sp.Symbol


@dataclass(frozen=True)
class AtTime(FunctionFormula):
    """The value of `of` at the instant `time`."""

    of: Formula
    time: sp.Expr


@dataclass(frozen=True)
class Boundary(FunctionFormula):
    """[of] from `lower` to `upper`: the value at the end less the value at the start."""

    of: Formula
    lower: sp.Expr
    upper: sp.Expr


@dataclass(frozen=True)
class Over(FunctionFormula):
    """∫ of over a region of material, written with the element `element`: dm, dS, dV.

    One material coordinate stands for all, `weight` is the density of the element.
    """

    of: Formula
    region: str
    element: str
    bounds: Bounds
    weight: sp.Expr


@dataclass(frozen=True)
class Ratio(FunctionFormula):
    """numerator/denominator, written as a fraction; both are scalars."""

    numerator: Formula
    denominator: Formula


@dataclass(frozen=True)
class Summed(FunctionFormula):
    """A sum over a repeated index (Einstein's convention).

    `shown` is the term with the index, `terms` are those for each of its values.
    """

    shown: Formula
    terms: tuple[Formula, ...]


@dataclass(frozen=True)
class Each(FunctionFormula):
    """A formula with a free index: `shown` with the index, `instances` for each of its values."""

    shown: Formula
    instances: tuple[Formula, ...]
