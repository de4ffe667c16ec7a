"""Chain rule of the first variation: δr = ∂r/∂qᵢ δqᵢ, summed over the free coordinates; the time is not varied.

Source: Lanczos, The Variational Principles of Mechanics, ch. II; the lecture's chain rule.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Partial, Plus, Quantity, Term, Times
from ..step import Relation, Step
from ..system import System
from . import gateaux_differential, tangent_vector

RULE = "virtual-displacement"


def apply(system: System, place: str) -> Step:
    """δr = Σ ∂r/∂qᵢ δqᵢ at a place by the letters, then with the tangents put in; δr = 0 at a place that is fixed.

    Its substeps are δr by the definition and each ∂r/∂qᵢ.
    """
    position, total = system.named_position(place), system.virtual_displacement(place)
    names = system.coordinates_of(place)
    formal = [Times((Partial(position, system.q(q)), Explicit(system.variation(q)))) for q in names]
    written = [Times((Explicit(system.tangent(place, q)), Explicit(system.variation(q)))) for q in names]
    left = Named(Quantity("virtual-displacement", place), total, position.arguments)
    lines = [Plus(tuple(map(Term, formal))), Plus(tuple(map(Term, written)))] if names else []
    line = Relation((left, *lines, Explicit(total)))
    tangents = (tangent_vector.apply(system, place, q) for q in names)
    step = Step(RULE, place, (line,), (system.source(place),), {"place": place})
    return step.with_substeps(gateaux_differential.apply(system, place), *tangents)
