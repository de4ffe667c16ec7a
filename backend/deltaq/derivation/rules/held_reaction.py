"""The reaction beside another one: Z while friction sticks or a contact rests, which act along what was released, too.

Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4 and 5.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..formula import Explicit, Inserted, Named, Plus, Quantity, Rate, Term, Times, minus
from ..held_reactions import RESTS, STICKS, HeldReaction
from ..impacts import bouncing, gap_rate
from ..released import Release
from ..step import Relation, Step
from .contact_gap import RULE as GAP
from .reaction_equation import RULE as EQUATION
from .sticking_condition import RULE as STICKING

RULE = "held-reaction"


def apply(release: Release, found: HeldReaction) -> Step:
    """Of a contact its force first; Z by that force, and with the accelerations that it leaves."""
    about = {"coordinate": release.name, "load" if found.kind == STICKS else "event": found.name}
    subject, equation = f"{release.name}:{found.name}", f"{EQUATION}:{release.name}"
    if found.force is None or found.motion is None or found.value is None:
        return Step(RULE, subject, (), (), {**about, "outcome": f"{found.kind}-unknown"}, premises=(equation,))
    reaction = Named(Quantity("held-reaction", release.name), found.value)
    parts = (Term(Explicit(found.others)), minus(Times((found.force, Explicit(found.slope)))))
    by_force = Inserted(Plus(parts if found.slope != 0 else parts[:1]), found.motion)
    lines = (*_contact(release, found), Relation((reaction, by_force, Explicit(found.value))))
    of_mode = STICKING if found.kind == STICKS else GAP
    equations = tuple(f"equation:{q}" for q in release.system.free)
    premises = (equation, f"{of_mode}:{found.name}", *equations)
    return Step(RULE, subject, lines, _sources(found), {**about, "outcome": found.kind}, premises=premises)


def _contact(release: Release, found: HeldReaction) -> Iterator[Relation]:
    """λ, and that the gap stays as it is with it, as does what was released."""
    system = release.system
    for event in bouncing(system) if found.kind == RESTS else ():
        if event.name == found.name and found.force is not None and found.motion is not None:
            yield Relation((found.force, Explicit(found.force.value)))
            kept = Inserted(Rate(Explicit(gap_rate(system, event))), {**release.constancy, **found.motion})
            yield Relation((kept, Explicit(system.zero)))


def _sources(found: HeldReaction) -> tuple[str, ...]:
    return (f"load:{found.name}",) if found.kind == STICKS else ()
