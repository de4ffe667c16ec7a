"""Chain rule of the first variation: δf(x(t)) = ∂f/∂xᵢ δxᵢ(t).

Independent xᵢ have independent δxᵢ: coefficients may be compared.
Source: the lecture; Lanczos, The Variational Principles of Mechanics, ch. II.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, each, summed, symbol
from ..formula import Called, Directional, Named, Partial, Quantity, Summed, Times
from ..step import Relation, Step
from ._general import ALONG, VECTOR, H

RULE = "chain-rule-of-variation"


def apply(motion: AbstractMotion) -> Step:
    field = Named(Quantity("function-of-functions"), motion.function(*VECTOR), (symbol("X"),))
    total = _chain(field, "direction-component")
    variation = Called(Quantity("variation-of-field"), total)
    lines = (
        Relation((Called(Quantity("variation-of-field-along"), total), Directional(field, ALONG, H), total)),
        Relation((variation, _chain(field, "variation-component"))),
        Relation(
            (
                each(lambda i: Called(Quantity("coefficient", i), Partial(total, symbol(f"v_{i}"))), len(VECTOR)),
                each(lambda i: Partial(field, symbol(f"x_{i}")), len(VECTOR)),
            )
        ),
    )
    return Step(RULE, "", lines)


def _chain(field: Named, component: str) -> Summed:
    """∂f/∂xᵢ vᵢ, with vᵢ(t) or δxᵢ(t) for the direction."""

    def term(i: str) -> Times:
        slope = Called(Quantity("slope-along", i), Partial(field, symbol(f"x_{i}")))
        return Times((slope, Named(Quantity(component, i), symbol(f"v_{i}"))))

    return summed(term, "i", len(VECTOR))
