"""Sticking: friction is a reaction then, R ∂c/∂q, as large as c̈ = u̇ needs it; it sticks as long as |R| ≤ F₀.

Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 5.
"""

from __future__ import annotations

from ...mechanics.contributions import Friction
from ..formula import Explicit, Inserted, Named, Quantity, Rate
from ..impacts import Held, largest_force
from ..step import Relation, Step
from ..system import System

RULE = "sticking-condition"


def apply(system: System, load: Friction, found: Held) -> Step:
    """R, that nothing slips with it, and F₀."""
    static = largest_force(system, load, found)
    slip_rate = Rate(Explicit(system.slip_rate(load)))
    lines = (
        Relation((Named(Quantity("holding-force", load.source), found.force), Explicit(found.force))),
        Relation((Inserted(slip_rate, found.motion), Explicit(system.zero))),
        Relation((Named(Quantity("largest-holding-force", load.source), static), Explicit(system.display(static)))),
    )
    equations = tuple(f"equation:{q}" for q in system.free)
    sources = (f"load:{load.source}",)
    return Step(RULE, load.source, lines, sources, {"load": load.source}, premises=equations)
