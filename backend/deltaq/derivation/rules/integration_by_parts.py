"""Integration by parts: ∫ ∂F/∂ẋ δẋ dt = [∂F/∂ẋ δx] − ∫ d/dt(∂F/∂ẋ) δx dt. It takes the rate off the direction.

Source: Gelfand, Fomin, Calculus of Variations, §4; Lanczos, The Variational Principles of Mechanics, ch. II.10.
"""

from __future__ import annotations

from ..differential_expression import direction
from ..formula import Boundary, Explicit, Formula, Partial, Plus, Rate, Term, Times, minus
from ..functional import Functional
from ..step import Relation, Step

RULE = "integration-by-parts"


def apply(functional: Functional, function: str) -> Step:
    momentum = Partial(functional.named, functional.symbols.rate(function, 1))
    speed = functional.on(Times((momentum, Explicit(direction(function, 1)))))
    formal = _parts(functional, momentum, Rate(momentum), function)
    written = _parts(
        functional, Explicit(functional.momentum(function)), Explicit(functional.momentum_rate(function)), function
    )
    return Step(RULE, function, (Relation((speed, formal, written)),), (), {"coordinate": function})


def _parts(functional: Functional, momentum: Formula, rate: Formula, function: str) -> Plus:
    """[p δx] − ∫ ṗ δx dt"""
    within = functional.on(Times((rate, Explicit(direction(function)))))
    return Plus((Term(boundary(functional, momentum, function)), minus(within)))


def boundary(functional: Functional, momentum: Formula, function: str) -> Boundary:
    """[p δx] from one end to the other"""
    bounds = functional.interval
    return Boundary(Times((momentum, Explicit(direction(function)))), bounds.lower, bounds.upper)
