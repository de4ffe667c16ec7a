"""Contact: the gap g(q, t) ≥ 0 is zero where bodies touch, and its gradient is the direction in which they push.

A contact pushes and does not pull: g ≥ 0, λ ≥ 0, g λ = 0. As long as it is open, it plays no part.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4.
"""

from __future__ import annotations

from ...mechanics.event import Event
from ..formula import Explicit, Formula, Given, Named, Partial, Quantity, Rate, Substituted
from ..impacts import bouncing, gap, gap_rate, slopes
from ..step import Relation, Step
from ..system import System

RULE = "contact-gap"


def apply(system: System, event: Event) -> Step:
    """g as the scene states it, its gradient, and its rate along the motion."""
    name = named_gap(system, event)
    stated: Formula = Given((event.value.tree,), system.expression(event.value.tree))
    given = Substituted(stated, system.guides) if system.guides else stated
    lines = (
        Relation((name, given, Explicit(name.value))),
        *(Relation((slope_of(system, event, q), Explicit(slope))) for q, slope in slopes(system, event).items()),
        Relation((Rate(name), Explicit(gap_rate(system, event)))),
    )
    return Step(RULE, event.name, lines, (), {"event": event.name})


def named_gap(system: System, event: Event) -> Named:
    """g, with the name of the event where there are several."""
    return Named(Quantity("gap", event.name if len(bouncing(system)) > 1 else ""), gap(system, event))


def slope_of(system: System, event: Event, coordinate: str) -> Partial:
    """∂g/∂qᵢ"""
    return Partial(named_gap(system, event), system.q(coordinate))
