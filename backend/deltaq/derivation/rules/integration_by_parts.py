"""Integration by parts: ∫ ∂F/∂ẋ δẋ dt = [∂F/∂ẋ δx] − ∫ d/dt(∂F/∂ẋ) δx dt. It takes the rate off the direction.

A second rate needs it twice: ∫ ∂F/∂ẍ δẍ dt = [∂F/∂ẍ δẋ − d/dt(∂F/∂ẍ) δx] + ∫ d²/dt²(∂F/∂ẍ) δx dt.
Source: Gelfand, Fomin, Calculus of Variations, §4 and §11; Lanczos, The Variational Principles of Mechanics, ch. II.10.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..differential_expression import direction
from ..formula import Boundary, Explicit, Formula, Partial, Plus, Rate, Term, Times, minus
from ..functional import Functional
from ..step import Relation, Step

RULE = "integration-by-parts"
TWICE = "integration-by-parts-twice"


def steps(functional: Functional, function: str) -> Iterator[Step]:
    """One for each rate that occurs."""
    orders = functional.orders(function)
    if 1 in orders:
        yield apply(functional, function)
    if 2 in orders:
        yield twice(functional, function)


def apply(functional: Functional, function: str) -> Step:
    """∫ ∂F/∂ẋ δẋ dt of one function = boundary term − integral: by the letters, then differentiated."""
    momentum = Partial(functional.named, functional.symbols.rate(function, 1))
    formal = _parts(functional, momentum, Rate(momentum), function)
    written = _parts(
        functional, Explicit(functional.slope(function, 1)), Explicit(functional.momentum_rate(function)), function
    )
    members = (_integral(functional, momentum, function, 1), formal, written)
    return Step(RULE, function, (Relation(members),), (), {"coordinate": function})


def _parts(functional: Functional, momentum: Formula, rate: Formula, function: str) -> Plus:
    """[p δx] − ∫ ṗ δx dt"""
    within = _integral(functional, rate, function, 0)
    return Plus((Term(boundary(functional, _product(momentum, function, 0))), minus(within)))


def twice(functional: Functional, function: str) -> Step:
    """∫ ∂F/∂ẍ δẍ dt of one function, by parts once and again; the last line has the derivatives carried out."""
    moment = Partial(functional.named, functional.symbols.rate(function, 2))
    once = Plus(
        (
            Term(boundary(functional, _product(moment, function, 1))),
            minus(_integral(functional, Rate(moment), function, 1)),
        )
    )
    value = functional.slope(function, 2)
    rate = functional.rate(value)
    members = (
        _integral(functional, moment, function, 2),
        once,
        _both(functional, function, moment, Rate(moment), Rate(Rate(moment))),
        _both(functional, function, *map(Explicit, (value, rate, functional.rate(rate)))),
    )
    return Step(TWICE, function, (Relation(members),), (), {"coordinate": function})


def _both(functional: Functional, function: str, moment: Formula, rate: Formula, second: Formula) -> Plus:
    """[m δẋ − ṁ δx] + ∫ m̈ δx dt"""
    ends = Plus((Term(_product(moment, function, 1)), minus(_product(rate, function, 0))))
    return Plus((Term(boundary(functional, ends)), Term(_integral(functional, second, function, 0))))


def _integral(functional: Functional, factor: Formula, function: str, order: int) -> Formula:
    return functional.on(_product(factor, function, order))


def _product(factor: Formula, function: str, order: int) -> Times:
    """The factor times δx⁽ⁿ⁾"""
    return Times((factor, Explicit(direction(function, order))))


def momentum(functional: Functional, function: str, order: int) -> Formula:
    """The factor of δx⁽ⁿ⁾ in the boundary terms: ∂F/∂ẋ − d/dt ∂F/∂ẍ of δx, ∂F/∂ẍ of δẋ."""
    first, second = (Partial(functional.named, functional.symbols.rate(function, order + n)) for n in (1, 2))
    own = [order + n in functional.orders(function) for n in (1, 2)]
    return alone(Plus((*([Term(first)] if own[0] else []), *([minus(Rate(second))] if own[1] else []))))


def alone(formula: Formula) -> Formula:
    """A sum of one term is that term."""
    match formula:
        case Plus((Term(only, _, 1),)):
            return only
        case _:
            return formula


def boundary(functional: Functional, of: Formula) -> Boundary:
    """[of] from one end to the other"""
    bounds = functional.interval
    return Boundary(of, bounds.lower, bounds.upper)


def boundary_term(functional: Functional, factor: Formula, function: str, order: int) -> Boundary:
    """[p δx⁽ⁿ⁾]"""
    return boundary(functional, _product(factor, function, order))
