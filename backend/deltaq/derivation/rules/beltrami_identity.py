"""Beltrami's identity: if F does not hold the time, H = Σ ẋ ∂F/∂ẋ − F is constant along every solution.

For any functions dH/dt = −Σ ẋ (∂F/∂x − d/dt ∂F/∂ẋ). With ẍ in F it is
H = Σ ẋ (∂F/∂ẋ − d/dt ∂F/∂ẍ) + ẍ ∂F/∂ẍ − F, and the bracket has + d²/dt² ∂F/∂ẍ.
Source: Beltrami (1868); Gelfand, Fomin, Calculus of Variations, §4, case 2, and §18.
"""

from __future__ import annotations

from ..formula import Called, Explicit, Plus, Quantity, Rate, Term, Times, minus
from ..functional import Functional
from ..step import Relation, Step
from ._constant import constant
from .collected_variation import euler_expression
from .integration_by_parts import momentum

RULE = "beltrami-identity"


def apply(functional: Functional) -> Step:
    """H = Σ ẋ ∂F/∂ẋ − F written out, its rate dH/dt = −Σ ẋ (∂F/∂x − d/dt ∂F/∂ẋ), and H = const.

    It is meant for an autonomous F (`Functional.has_energy`); nothing here checks it.
    """
    value = functional.energy
    name = Called(Quantity("first-energy"), Explicit(value))
    rates = ((x, Explicit(functional.symbols.rate(x, 1))) for x in functional.moving)
    change = Plus(tuple(minus(Times((rate, euler_expression(functional, x)))) for x, rate in rates))
    lines = (Relation((name, _energy(functional), Explicit(value))), Relation((Rate(name), change)))
    return Step(RULE, "", (*lines, *constant(name, value, functional.symbols)))


def _energy(functional: Functional) -> Plus:
    """Σ pₙ x⁽ⁿ⁺¹⁾ − F"""
    products = (
        Times((Explicit(functional.symbols.rate(x, n + 1)), momentum(functional, x, n))) for x, n in functional.boundary
    )
    return Plus((*map(Term, products), minus(functional.named)))
