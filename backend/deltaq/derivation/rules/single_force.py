"""Single force: with Cartesian coordinates, δW = F · δr = F_x δx + F_y δy + F_z δz, so Q_x = F_x, Q_y = F_y, Q_z = F_z.

Source: the lecture's first example of generalized forces.
"""

from __future__ import annotations

import sympy as sp

from ..abstract_motion import AbstractMotion, symbol
from ..calculus import column
from ..formula import Called, Dot, Explicit, Named, Partial, Plus, Quantity, Term, Times
from ..step import Relation, Step

RULE = "single-force"
AXES = ("x", "y", "z")
FORCES = tuple(symbol(f"F_{axis}") for axis in AXES)
DISPLACEMENTS = tuple(symbol(f"delta({axis})") for axis in AXES)


def apply(_motion: AbstractMotion) -> Step:
    force = Named(Quantity("force"), column(FORCES))
    displacement = Named(Quantity("virtual-displacement"), column(DISPLACEMENTS))
    pairs = zip(AXES, FORCES, DISPLACEMENTS, strict=True)
    written = Plus(
        tuple(Term(Times((Explicit(f), Named(Quantity("variation-along-axis", axis), d)))) for axis, f, d in pairs)
    )
    work = Called(Quantity("virtual-work"), Dot(force, displacement))
    lines = (
        Relation((force, Explicit(force.value))),
        Relation((work, Dot(force, displacement), written)),
        *(_force(work, axis, f, d) for axis, f, d in zip(AXES, FORCES, DISPLACEMENTS, strict=True)),
    )
    return Step(RULE, "", lines)


def _force(work: Called, axis: str, force: sp.Symbol, displacement: sp.Symbol) -> Relation:
    """The coefficient of δx is Q_x."""
    return Relation((Called(Quantity("generalized-force", axis), Partial(work, displacement)), Explicit(force)))
