"""Guide: a coordinate whose motion is prescribed is no longer free, q := q(t), and its variation vanishes, δq = 0.

The constraint is rheonomic: it depends on time explicitly.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.3; Szabó, Höhere Technische Mechanik, §I.5.
"""

from __future__ import annotations

from ...mechanics.guide import Guide
from ..formula import Given, Named, Quantity
from ..step import Relation, Step
from ..system import System

RULE = "guide"


def apply(system: System, guide: Guide) -> Step:
    """q := q(t) for one guided coordinate, with q(t) as the scene states it."""
    given = Given((guide.value.tree,), system.expression(guide.value.tree))
    name = Named(Quantity("coordinate", guide.coordinate), given.value)
    return Step(RULE, guide.coordinate, (Relation((name, given)),), (), {"coordinate": guide.coordinate})
