"""First variation (Gâteaux differential) by definition: δf(x) = ∂/∂h f(x + h δx) at h = 0, in every direction δx.

Under an integral with constant limits, differentiation and integration are exchanged.
Source: Gelfand, Fomin, Calculus of Variations, §3; the lecture's definition.
"""

from __future__ import annotations

from ..domain import Interval
from ..formula import Directional, Explicit, Formula
from ..functional import Functional
from ..step import Relation, Step
from .functional import named, variation

RULE = "variation-by-definition"


def apply(functional: Functional) -> Step:
    """δf = ∂/∂h f(x + h δx) at h = 0: by the letters, with the functions put in, and carried out."""
    members = (
        variation(functional),
        definition(functional, named(functional)),
        *_inserted(functional),
        functional.on(Explicit(functional.by_definition)),
    )
    return Step(RULE, "", (Relation(members),))


def definition(functional: Functional, of: Formula) -> Directional:
    """∂/∂h of(x + h δx) at h = 0"""
    return Directional(of, functional.jets, functional.h)


def _inserted(functional: Functional) -> tuple[Formula, ...]:
    """x + h δx put in; under an integral also the line after the exchange."""
    written = definition(functional, functional.on(functional.explicit))
    if isinstance(functional.domain, Interval):
        return written, functional.on(definition(functional, functional.explicit))
    return (written,)
