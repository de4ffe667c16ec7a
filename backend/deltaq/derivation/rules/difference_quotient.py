"""Ordinary derivative: df/dx = lim (f(x + h) − f(x))/h.

For vectors there is no such number: it depends on the direction of h.
Source: the lecture; Forster, Analysis 2, §6.
"""

from __future__ import annotations

import sympy as sp

from ..abstract_motion import AbstractMotion
from ..formula import Called, LimitOfQuotient, Named, Partial, Quantity
from ..step import Relation, Step
from ._general import VECTOR, H, X

RULE = "difference-quotient"


def apply(motion: AbstractMotion) -> Step:
    """One variable; then two unit vectors that give two limits."""
    scalar = Named(Quantity("function-of-vector"), motion.function(X), (X,))
    vector = Named(Quantity("function-of-vector"), motion.function(*VECTOR))
    unit = [{x: sp.Integer(int(x == chosen)) for x in VECTOR} for chosen in list(VECTOR)[:2]]
    limits = [
        Called(Quantity("limit-along", str(n)), LimitOfQuotient(vector, along, H)) for n, along in enumerate(unit, 1)
    ]
    ordinary = Called(Quantity("ordinary-derivative"), Partial(scalar, X))
    limit = Called(Quantity("ordinary-limit"), LimitOfQuotient(scalar, {X: sp.Integer(1)}, H))
    return Step(RULE, "", (Relation((ordinary, limit)), Relation((limits[0], limits[1]), "≠")))
