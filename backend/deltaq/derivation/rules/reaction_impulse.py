"""The impulse of a reaction: at an impact what holds a length exerts Ẑ = Σ Mₗⱼ Δq̇ⱼ − Λ ∂g/∂l − Σ Λ_c aₗ in no time.

It is the equation of the released coordinate, integrated over the impact: finite forces do not count.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 8.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Plus, Quantity, Term, Times, minus
from ..held_reactions import ReactionImpulse
from ..impacts import bouncing
from ..released import Release
from ..step import Relation, Step
from .impact_law import RULE as IMPACT
from .reaction_equation import RULE as EQUATION

RULE = "reaction-impulse"


def apply(release: Release, found: ReactionImpulse) -> Step:
    """Ẑ by the jumps of the rates and the impulses, then written out."""
    name, event = release.name, found.event.name
    several = len(bouncing(release.system)) > 1
    jumps = {q: Named(Quantity("rate-jump", q), jump) for q, jump in found.impact.rates.items()}
    impulse = Named(Quantity("impulse", event if several else ""), found.impact.impulse)
    answers = {
        source: Named(Quantity("constraint-impulse", source), found.impact.answers[source]) for source in found.shares
    }
    terms = (
        *(Term(Times((Explicit(part), jumps[q]))) for q, part in found.inertia.items() if part != 0),
        *(minus(Times((impulse, Explicit(found.slope)))) for _ in range(found.slope != 0)),
        *(minus(Times((answers[source], Explicit(part)))) for source, part in found.shares.items() if part != 0),
    )
    line = Relation((Named(Quantity("reaction-impulse", name), found.value), Plus(terms), Explicit(found.value)))
    premises = (f"{EQUATION}:{name}", f"{IMPACT}:{event}")
    return Step(RULE, f"{name}:{event}", (line,), (), {"coordinate": name, "event": event}, premises=premises)
