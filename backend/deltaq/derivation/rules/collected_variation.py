"""δI without the rates of the directions: δI = [∂F/∂ẋ δx] + ∫ (∂F/∂x − d/dt ∂F/∂ẋ) δx dt.

Of the boundary terms only those at free ends are left.
Source: Gelfand, Fomin, Calculus of Variations, §4, eq. (5).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import sympy as sp

from ..differential_expression import direction
from ..formula import AtTime, Explicit, Formula, Partial, Plus, Rate, Term, Times, minus
from ..functional import Functional
from ..step import Relation, Step
from .functional import variation
from .integration_by_parts import boundary

RULE = "collected-variation"


def apply(functional: Functional) -> Step:
    formal = _sum(functional, lambda x: euler_expression(functional, x), lambda x: momentum(functional, x))
    written = _sum(
        functional, lambda x: Explicit(functional.euler_lagrange(x)), lambda x: Explicit(functional.momentum(x))
    )
    return Step(RULE, "", (Relation((variation(functional), formal, written)),))


def momentum(functional: Functional, function: str) -> Partial:
    """∂F/∂ẋ"""
    return Partial(functional.named, functional.symbols.rate(function, 1))


def euler_expression(functional: Functional, function: str) -> Plus:
    """∂F/∂x − d/dt ∂F/∂ẋ, of what there is."""
    slope = (Term(Partial(functional.named, functional.symbols.name(function))),)
    rate = (minus(Rate(momentum(functional, function))),)
    own = functional.along_of(function)
    has_slope, has_rate = (functional.symbols.rate(function, n) in own for n in range(2))
    return Plus((*(slope if has_slope else ()), *(rate if has_rate else ())))


def _sum(functional: Functional, expression: Callable[[str], Formula], slope: Callable[[str], Formula]) -> Plus:
    """The boundary terms where there are any, and the integral."""
    ends = tuple(term for x in functional.moving for term in _at_free_ends(functional, slope(x), x))
    terms = [Times((expression(x), Explicit(direction(x)))) for x in functional.present]
    inside = terms[0] if len(terms) == 1 else Plus(tuple(map(Term, terms)))
    return Plus((*ends, Term(functional.on(inside))))


def _at_free_ends(functional: Functional, slope: Formula, x: str) -> Iterator[Term]:
    """[p δx] over both ends, or p δx at the one that is free, less at the lower."""
    match functional.fixed:
        case (False, False):
            yield Term(boundary(functional, slope, x))
        case (True, False):
            yield Term(_at(functional.interval.upper, slope, x))
        case (False, True):
            yield minus(_at(functional.interval.lower, slope, x))


def _at(end: sp.Expr, slope: Formula, x: str) -> AtTime:
    return AtTime(Times((slope, Explicit(direction(x)))), end)
