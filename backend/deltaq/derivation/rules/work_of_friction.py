"""Virtual work of dry friction: δW = −F sgn(q̇) δq while it slips; where it sticks the force is a reaction, |Q| ≤ F₀.

Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 5.
"""

from __future__ import annotations

from ...mechanics.contributions import Friction
from ..formula import Explicit, Named, Partial, Plus, Quantity, Term, Times
from ..step import Relation, Step
from ..system import System

RULE = "work-of-friction"
LOAD = Friction


def apply(system: System, load: Friction, subject: str) -> Step:
    """The friction force against slipping, then its work on δc."""
    source = f"load:{load.source}"
    work = Explicit(system.virtual_work(load))
    by_force = Plus((Term(Times((_force(system, load), Explicit(system.vary(system.slipping(load))))), (source,)),))
    lines = (
        Relation((_force(system, load), Explicit(system.friction_force(load)))),
        Relation((Named(Quantity("virtual-work", load.source), work.value), by_force, work)),
    )
    return Step(RULE, subject, lines, (source,), {"load": load.source})


def share(system: System, load: Friction, coordinate: str) -> Term:
    """The force times ∂c/∂qᵢ."""
    slope = Partial(Named(Quantity("slip", load.source), system.slipping(load)), system.q(coordinate))
    return Term(Times((_force(system, load), slope)), (f"load:{load.source}",))


def _force(system: System, load: Friction) -> Named:
    return Named(Quantity("friction-force", load.source), system.friction_force(load))
