"""δI without the rates of the directions: δI = [∂F/∂ẋ δx] + ∫ (∂F/∂x − d/dt ∂F/∂ẋ + d²/dt² ∂F/∂ẍ) δx dt.

Of the boundary terms only those at free ends are left.
Source: Gelfand, Fomin, Calculus of Variations, §4, eq. (5), and §11.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import sympy as sp

from ..differential_expression import direction
from ..formula import AtTime, Explicit, Formula, Partial, Plus, Rate, Term, Times, minus
from ..functional import Functional
from ..step import Relation, Step
from .functional import variation
from .integration_by_parts import alone, boundary_term, momentum

RULE = "collected-variation"


def apply(functional: Functional) -> Step:
    """δI = Σ [p δx] + ∫ (left side of Euler–Lagrange) δx dt over the functions: by the letters, then written out."""
    formal = _sum(functional, lambda x: euler_expression(functional, x), lambda x, n: momentum(functional, x, n))
    written = _sum(
        functional, lambda x: Explicit(functional.euler_lagrange(x)), lambda x, n: Explicit(functional.momentum(x, n))
    )
    return Step(RULE, "", (Relation((variation(functional), formal, written)),))


def euler_expression(functional: Functional, function: str) -> Plus:
    """∂F/∂x − d/dt ∂F/∂ẋ + d²/dt² ∂F/∂ẍ, of what there is."""
    slopes = [Partial(functional.named, functional.symbols.rate(function, n)) for n in range(3)]
    terms = (Term(slopes[0]), minus(Rate(slopes[1])), Term(Rate(Rate(slopes[2]))))
    return Plus(tuple(terms[order] for order in functional.orders(function)))


def _sum(functional: Functional, expression: Callable[[str], Formula], factor: Callable[[str, int], Formula]) -> Plus:
    """The boundary terms where there are any, and the integral."""
    ends = tuple(term for x, n in functional.boundary for term in _at_free_ends(functional, factor(x, n), x, n))
    terms = [Times((alone(expression(x)), Explicit(direction(x)))) for x in functional.present]
    inside = terms[0] if len(terms) == 1 else Plus(tuple(map(Term, terms)))
    return Plus((*ends, Term(functional.on(inside))))


def _at_free_ends(functional: Functional, factor: Formula, x: str, order: int) -> Iterator[Term]:
    """[p δx] over both ends, or p δx at the one that is free, less at the lower."""
    bounds, ends = functional.interval, functional.free_ends(order)
    match bounds.lower in ends, bounds.upper in ends:
        case (True, True):
            yield Term(boundary_term(functional, factor, x, order))
        case (False, True):
            yield Term(_at(bounds.upper, factor, x, order))
        case (True, False):
            yield minus(_at(bounds.lower, factor, x, order))


def _at(end: sp.Expr, factor: Formula, x: str, order: int) -> AtTime:
    return AtTime(Times((factor, Explicit(direction(x, order)))), end)
