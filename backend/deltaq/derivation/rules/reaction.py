"""The reaction in the motion of the scene: what was released is put back as it was held, and q̈ by its equations.

Source: Lanczos, The Variational Principles of Mechanics, ch. III.5.
"""

from __future__ import annotations

from ..formula import Explicit, Formula, Inserted, Named, Plus, Quantity, Substituted, minus
from ..held_reactions import rivals
from ..released import Release
from ..step import Relation, Step
from .reaction_equation import RULE as EQUATION
from .release import displaced

RULE = "reaction"


def apply(release: Release) -> Step:
    """Z with the constancy put in, without accelerations where that is short, and the force of a rod or string."""
    system, name = release.system, release.name
    reaction = Named(Quantity("reaction", name), release.reaction)
    held: Formula = Substituted(reaction, release.constancy)
    lines = [Relation((held, Explicit(release.in_motion)))]
    if release.accelerations is not None and release.closed is not None:
        lines.append(Relation((Inserted(Explicit(release.in_motion), release.accelerations), Explicit(release.closed))))
    if release.is_of_rod:
        force = Named(Quantity("rod-force", name), system.display(-release.value))
        lines.append(Relation((force, Plus((minus(Explicit(release.value)),)), Explicit(force.value))))
    shared = rivals(release)
    kind = f"{release.kind}-shared" if shared else release.kind
    outcome = kind if release.closed is not None else f"{kind}-accelerated"
    about = {"coordinate": name, "outcome": outcome, **displaced(release)}
    about |= {"loads": ", ".join(shared)} if shared else {}
    equations = tuple(f"equation:{q}" for q in system.free) if release.accelerations else ()
    return Step(RULE, name, tuple(lines), (), about, premises=(f"{EQUATION}:{name}", *equations))
