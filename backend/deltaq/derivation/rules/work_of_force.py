"""Virtual work of a force: δW = F · δr, with δr at the place where the force acts.

Source: Szabó, Höhere Technische Mechanik, §I.4; the lecture's δW_a for a single force.
"""

from __future__ import annotations

from ...mechanics.contributions import PointForce
from ..formula import Dot, Explicit, Named, Partial, Quantity, Term
from ..step import Relation, Step
from ..system import System

RULE = "work-of-force"
LOAD = PointForce


def apply(system: System, load: PointForce, subject: str) -> Step:
    """δW = F · δr at the place of the load: by the letters, with F and δr put in, and collected by the δqᵢ."""
    displacement = system.virtual_displacement(load.place)
    members = (
        Named(Quantity("virtual-work", load.source, load.place), system.virtual_work(load)),
        Dot(_force(system, load), Named(Quantity("virtual-displacement", load.place), displacement)),
        Dot(Explicit(system.force(load)), Explicit(displacement)),
        Explicit(system.virtual_work(load)),
    )
    about = {"load": load.source, "place": load.place}
    return Step(RULE, subject, (Relation(members),), (f"load:{load.source}",), about)


def share(system: System, load: PointForce, coordinate: str) -> Term:
    """F · ∂r/∂qᵢ"""
    lever = Partial(system.named_position(load.place), system.q(coordinate))
    return Term(Dot(_force(system, load), lever), (f"load:{load.source}",))


def _force(system: System, load: PointForce) -> Named:
    return Named(Quantity("force", load.source, load.place), system.force(load))
