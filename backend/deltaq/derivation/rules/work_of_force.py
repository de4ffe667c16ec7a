"""Virtual work of a force: δW = F · δr, with δr at the place where the force acts.

Source: Szabó, Höhere Technische Mechanik, §I.4; the lecture's δW_a for a single force.
"""

from __future__ import annotations

from ...mechanics.contributions import PointForce
from ..formula import Dot, Explicit, Named, Quantity
from ..step import Relation, Step
from ..system import System

RULE = "work-of-force"


def apply(system: System, load: PointForce, subject: str) -> Step:
    force = system.force(load)
    displacement = system.virtual_displacement(load.place)
    work = system.collected(system.dot(force, displacement))
    symbols = Dot(
        Named(Quantity("force", load.source, load.place), force),
        Named(Quantity("virtual-displacement", load.place), displacement),
    )
    members = (
        Named(Quantity("virtual-work", load.source, load.place), work),
        symbols,
        Dot(Explicit(force), Explicit(displacement)),
        Explicit(work),
    )
    about = {"load": load.source, "place": load.place}
    return Step(RULE, subject, (Relation(members),), (f"load:{load.source}",), about)
