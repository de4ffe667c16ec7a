"""First variation: δ_v f(x) = ∂/∂h f(x(t) + h v(t)) at h = 0.

It is the Gâteaux differential of f at the function x in the direction of the function v.
Source: the lecture; Gelfand, Fomin, Calculus of Variations, §3.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion
from ..formula import Called, Directional, Explicit, Named, Partial, Quantity, Times
from ..step import Relation, Step
from ._general import H, V, X

RULE = "gateaux-definition"


def apply(motion: AbstractMotion) -> Step:
    of = Named(Quantity("function-of-function"), motion.function(X), (X,))
    slope = Times((Partial(of, X), Explicit(V)))
    members = (Called(Quantity("first-variation"), slope), Directional(of, {X: V}, H))
    return Step(RULE, "", (Relation(members),))
