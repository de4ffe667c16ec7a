"""Chain rule: the directional derivative is the gradient times the direction, D_v f = grad f · v = ∂f/∂xᵢ vᵢ.

Source: the lecture; Forster, Analysis 2, §6, Satz 5.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion
from ..calculus import column
from ..formula import Directional, Dot, Named, Quantity
from ..step import Relation, Step
from ._general import ALONG, VECTOR, H
from .directional_derivative import by_chain_rule, derivative, field_of

RULE = "chain-rule-of-direction"


def apply(motion: AbstractMotion) -> Step:
    field = field_of(motion)
    gradient = Named(Quantity("gradient"), column(field.value.diff(x) for x in VECTOR))
    along = Named(Quantity("direction"), column(VECTOR.values()))
    members = (derivative(motion), Directional(field, ALONG, H), Dot(gradient, along), by_chain_rule(motion))
    return Step(RULE, "", (Relation(members),))
