"""The Gâteaux differential is linear in the direction, so the definition and the chain rule give the same δf.

Source: Gelfand, Fomin, Calculus of Variations, §3; the lecture's transfer of D_v f = ∂f/∂xᵢ vᵢ to the first variation.
"""

from __future__ import annotations

from ..formula import Explicit
from ..functional import Functional
from ..step import Relation, Step
from .functional import named
from .variation_by_definition import definition

RULE = "both-routes"


def apply(functional: Functional) -> Step:
    """Definition = its result = the chain rule's result."""
    members = (
        definition(functional, named(functional)),
        functional.on(Explicit(functional.by_definition)),
        functional.on(Explicit(functional.by_chain_rule)),
    )
    return Step(RULE, "", (Relation(members),))
