"""Release: what the scene holds is let go in thought, and the reaction that held it does the work δW = Z δl.

Where l also says what bodies are made of, it is a displacement u of places that is let go, and δW = Z δu.

Source: Szabó, Höhere Technische Mechanik, §I.4; Lanczos, The Variational Principles of Mechanics, ch. III.5.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Quantity, Times
from ..released import Release
from ..step import Relation, Step
from . import velocity
from ._choice import energy_rule_of

RULE = "release"


def apply(release: Release) -> Step:
    """δW = Z δl; below it the velocities and energies of the bodies that would move."""
    wider, name = release.wider, release.name
    reaction = Named(Quantity("reaction", name), release.reaction)
    variation = wider.variation(release.coordinate)
    work = Named(Quantity("reaction-work"), release.reaction * variation)
    line = Relation((work, Times((reaction, Explicit(variation)))))
    about = {"coordinate": name, "outcome": release.kind, **displaced(release)}
    step = Step(RULE, name, (line,), (), about)
    return step.with_substeps(*_motions(release))


def displaced(release: Release) -> dict[str, str]:
    """For the sentences: which bodies are displaced in thought, by what, and from where a rod is held."""
    shift = release.held.shift
    if shift is None:
        return {}
    start = {} if shift.rod is None else {"start": shift.rod.start}
    return {"displacement": release.coordinate, "bodies": ", ".join(shift.moved), **start}


def _motions(release: Release) -> tuple[Step, ...]:
    """v and E of the bodies whose place depends on what is released."""
    wider = release.wider
    moved = [body for body in wider.scene.bodies if any(release.coordinate in part.names for part in body.position)]
    steps = [
        each for body in moved for each in (velocity.apply(wider, body.name), energy_rule_of(body).apply(wider, body))
    ]
    return tuple(steps)
