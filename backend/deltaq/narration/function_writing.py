"""LaTeX of formulas about functions: f(x + h v), limits, values at an instant, boundary terms, sums over an index."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import sympy as sp

from ..derivation.formula import Explicit, Formula, Integral, Named
from ..derivation.function_formula import (
    AtTime,
    Boundary,
    Called,
    Directional,
    Each,
    FunctionFormula,
    LimitOfQuotient,
    Over,
    Ratio,
    Summed,
)

if TYPE_CHECKING:
    from .notation import Notation

NEIGHBOUR = "ʰ"
REGIONS: Mapping[str, str] = {"B": r"\mathcal{B}", "S": "S", "V": "V"}


def write(notation: Notation, formula: FunctionFormula) -> str:  # noqa: PLR0911 - one case for each kind
    """The formula in this notation."""
    match formula:
        case Called(quantity, _, arguments):
            return notation.applied(quantity, arguments)
        case Directional(of, along, h):
            return notation.at_zero(notation.factor(moved(of, along)), h)
        case LimitOfQuotient(of, along, h):
            difference = f"{notation.formula(moved(of, along))} - {notation.formula(of)}"
            return rf"\lim_{{{notation.value(h)} \to 0}} \frac{{{difference}}}{{{notation.value(h)}}}"
        case AtTime(of, time):
            return notation.at_time(of, time)
        case Boundary(of, lower, upper):
            ends = rf"_{{{notation.value(lower)}}}^{{{notation.value(upper)}}}"
            return rf"\left[{notation.formula(of)}\right]{ends}"
        case Over(of, region, element):
            return rf"\int_{{{REGIONS[region]}}} {notation.factor(of)} \,\mathrm{{d}}{element}"
        case Ratio(numerator, denominator):
            return rf"\frac{{{notation.formula(numerator)}}}{{{notation.formula(denominator)}}}"
        case Summed(shown) | Each(shown):
            return notation.formula(shown)
    raise TypeError(f"no LaTeX for {type(formula).__name__}")


def neighbour(symbol: sp.Symbol) -> sp.Symbol:
    """A symbol that is written as x + h v, so that neither the algebra nor the printer takes it apart."""
    head, bracket, tail = symbol.name.partition(")")
    return sp.Symbol(f"{head}{NEIGHBOUR}{bracket}{tail}", real=True)


def moved(of: Formula, along: Mapping[sp.Symbol, sp.Expr]) -> Formula:
    """The formula at x + h v, as it is written: in the arguments of what has a name, else put in."""
    steps = {symbol: neighbour(symbol) for symbol in along}
    match of:
        case Named(_, _, arguments) | Called(_, _, arguments):
            return replace(of, arguments=tuple(steps.get(argument, argument) for argument in arguments))
        case Explicit(value):
            return Explicit(value.xreplace(steps))
        case Integral(inside) | AtTime(inside):
            return replace(of, of=moved(inside, along))
    return of
