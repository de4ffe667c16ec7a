"""Free moment in the plane: forces that turn a body by δφ do the work δW = M δφ, with M = x F_y − y F_x; so Q = M.

Source: the lecture's second example of generalized forces.
"""

from __future__ import annotations

import sympy as sp

from ..abstract_motion import AbstractMotion, symbol
from ..calculus import column
from ..formula import Called, Dot, Explicit, Named, Partial, Quantity, Times
from ..step import Relation, Step

RULE = "free-moment"
RADIUS, ANGLE, TURN = symbol("a"), symbol("phi"), symbol("delta(phi)")
FX, FY = symbol("F_x"), symbol("F_y")


def apply(_motion: AbstractMotion) -> Step:
    """A particle of the body at the distance a from the axis; the moments of all particles add up."""
    x, y = RADIUS * sp.cos(ANGLE), RADIUS * sp.sin(ANGLE)
    arm = Partial(Named(Quantity("position"), column((x, y))), ANGLE)
    force = Named(Quantity("force"), column((FX, FY)))
    moment = Called(Quantity("moment"), Explicit(x * FY - y * FX))
    work = Called(Quantity("virtual-work"), Times((Dot(force, arm), Explicit(TURN))))
    lines = (
        Relation((Dot(force, arm), Dot(force, Explicit(column((-y, x)))), moment)),
        Relation((work, work.of, Times((moment, Explicit(TURN))))),
        Relation((Called(Quantity("only-generalized-force"), Partial(work, TURN)), moment)),
    )
    return Step(RULE, "", lines)
