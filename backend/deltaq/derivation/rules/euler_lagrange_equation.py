"""Fundamental lemma: δI = 0 for all independent δx only if the factor of each vanishes: ∂F/∂x − d/dt ∂F/∂ẋ = 0.

Source: Euler (1744), Lagrange (1755); Gelfand, Fomin, Calculus of Variations, §3, lemma 1, and §4.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Equation, Explicit
from ..functional import Functional
from ..step import Relation, Step
from .collected_variation import euler_expression

RULE = "euler-lagrange-equation"


def apply(functional: Functional, function: str) -> Step:
    """The equation of one function, ∂F/∂x − d/dt ∂F/∂ẋ (+ d²/dt² ∂F/∂ẍ) = 0, by its symbols ⇔ written out."""
    zero = Explicit(sp.Integer(0))
    law = Equation(euler_expression(functional, function), zero)
    written = Equation(Explicit(functional.euler_lagrange(function)), zero)
    return Step(RULE, function, (Relation((law, written), "⇔"),), (), {"coordinate": function})
