"""Cyclic function: if F does not hold x, ∂F/∂ẋ (with ẍ: ∂F/∂ẋ − d/dt ∂F/∂ẍ) is constant along every solution.

Its rate is all that the Euler–Lagrange equation says.
Source: Gelfand, Fomin, Calculus of Variations, §4, case 1.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Called, Equation, Explicit, Plus, Quantity, Rate, minus
from ..functional import Functional
from ..step import Relation, Step
from ._constant import constant
from .collected_variation import euler_expression
from .integration_by_parts import momentum

RULE = "cyclic-function"


def apply(functional: Functional, function: str) -> Step:
    """p = ∂F/∂ẋ written out, the Euler–Lagrange equation as −dp/dt = 0, and p = const.

    It is meant for a function that is not in F itself (`Functional.ignorable`); nothing here checks it.
    """
    value, zero = functional.momentum(function), Explicit(sp.Integer(0))
    name = Called(Quantity("first-momentum", function), Explicit(value))
    equation = Equation(euler_expression(functional, function), zero)
    lines = (
        Relation((name, momentum(functional, function, 0), Explicit(value))),
        Relation((equation, Equation(Plus((minus(Rate(name)),)), zero)), "⇔"),
        *constant(name, value, functional.symbols),
    )
    return Step(RULE, function, lines, (), {"coordinate": function})
