"""The Euler–Lagrange equation times a factor that cannot be zero: without denominators, common roots and constants.

Source: derivation.clearing, which says when a factor may be left out.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Equation, Explicit, Times
from ..functional import Functional
from ..step import Relation, Step
from .collected_variation import euler_expression

RULE = "cleared-equation"


def apply(functional: Functional, function: str) -> Step | None:
    """None if there is nothing to be cleared."""
    found = functional.cleared_equation(function)
    if found.factor == 1:
        return None
    left = Times((Explicit(found.factor), euler_expression(functional, function)))
    lines = (
        Relation((left, Explicit(found.value))),
        Relation((Equation(Explicit(found.value), Explicit(sp.Integer(0))),)),
    )
    outcome = "-and-".join(found.reasons) or "number"
    return Step(RULE, function, lines, (), {"coordinate": function, "outcome": outcome})
