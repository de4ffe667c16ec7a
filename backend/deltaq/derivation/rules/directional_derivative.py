"""Directional derivative: D_v f(x) = lim (f(x + h v) − f(x))/h = ∂/∂h f(x + h v) at h = 0.

Source: the lecture; Forster, Analysis 2, §6.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, summed, symbol
from ..formula import Called, Directional, Explicit, LimitOfQuotient, Named, Partial, Quantity, Summed, Times
from ..step import Relation, Step
from ._general import ALONG, VECTOR, H

RULE = "directional-derivative"


def apply(motion: AbstractMotion) -> Step:
    field = field_of(motion)
    members = (derivative(motion), LimitOfQuotient(field, ALONG, H), Directional(field, ALONG, H))
    return Step(RULE, "", (Relation(members),))


def field_of(motion: AbstractMotion) -> Named:
    """f(x) of a vector x"""
    return Named(Quantity("function-of-vector"), motion.function(*VECTOR), (symbol("X"),))


def derivative(motion: AbstractMotion) -> Called:
    """D_v f(x)"""
    return Called(Quantity("directional-derivative"), by_chain_rule(motion))


def by_chain_rule(motion: AbstractMotion) -> Summed:
    """∂f/∂xᵢ vᵢ"""
    return summed(
        lambda i: Times((Partial(field_of(motion), symbol(f"x_{i}")), Explicit(symbol(f"v_{i}")))), "i", len(VECTOR)
    )
