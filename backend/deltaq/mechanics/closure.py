"""A scene while contacts stay closed: each gap is kept at zero, as a holonomic constraint is, and its event is none.

The reactions of closed contacts are then multipliers like others, but for their sign: they only act towards opening.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 5.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import count

from .bodies import Body
from .constraints import Constraint
from .constraints.equation import EquationConstraint
from .event import Event
from .loads import Load
from .point import Point
from .scene import Scene


def closed(scene: Scene, contacts: Sequence[Event]) -> Scene:
    """The scene in which these contacts, some of its events, stay closed; their constraints come last, in this order.

    Raises SceneError where they would leave no motion.
    """
    things: tuple[Body | Point | Load | Constraint, ...]
    things = (*scene.bodies, *scene.points, *scene.loads, *scene.constraints)
    taken = {thing.name for thing in things}
    fresh = (name for k in count(1) if (name := f"contact_{k}") not in taken)
    kept = tuple(EquationConstraint(next(fresh), contact.value) for contact in contacts)
    others = tuple(event for event in scene.events if event not in contacts)
    return replace(scene, constraints=(*scene.constraints, *kept), events=others)
