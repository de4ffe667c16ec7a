"""Release: the constraint is let go and replaced by its reaction.

The constraint is ideal: in virtual displacements that keep it the reaction does no work. What vanishes for every δq
with Σ aᵢ δqᵢ = 0 is a multiple of that sum: δWᶻ = λ Σ aᵢ δqᵢ. From here on all δqᵢ are free.
Source: Lagrange, Mécanique analytique (1788), part 1, sect. IV; Lanczos, The Variational Principles
of Mechanics, ch. II.5.
"""

from __future__ import annotations

from ...mechanics.conditions import Condition
from ...mechanics.constraints.distance import DistanceConstraint
from ..formula import Explicit, Named, Plus, Quantity, Term, Times
from ..step import Relation, Step
from ..system import System
from .constrained_variation import slope

RULE = "work-of-reaction"


def apply(system: System, condition: Condition) -> Step:
    """δWᶻ = λ (Σ aᵢ δqᵢ): by the letters, and written out; what stands before δqᵢ is its reaction."""
    multiplier = Explicit(system.multiplier(condition))
    inside = Plus(
        tuple(
            Term(Times((slope(system, condition, q), Explicit(system.variation(q))))) for q in system.bound(condition)
        )
    )
    work = Named(_work_of(system, condition), system.reaction_work(condition))
    line = Relation((work, Times((multiplier, inside)), Explicit(work.value)))
    constraint = next(each for each in system.scene.constraints if each.name == condition.source)
    outcome = "distance" if isinstance(constraint, DistanceConstraint) else "text"
    about = {"outcome": outcome, "constraint": condition.source}
    return Step(RULE, condition.source, (line,), (f"constraint:{condition.source}",), about)


def _work_of(system: System, condition: Condition) -> Quantity:
    return Quantity("reaction-work", condition.source if len(system.conditions) > 1 else "")
