"""Cyclic coordinate: if ∂L/∂q = 0 and no other force acts on it, Qᵈ = 0, its momentum p = ∂L/∂q̇ is conserved.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.6; Landau, Lifshitz, Mechanics, §40.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Explicit, Named, Partial, Quantity
from ..impacts import contacts_along
from ..step import Relation, Step
from ..system import System

RULE = "cyclic-coordinate"


def apply(system: System, coordinate: str) -> Step:
    """The two premises ∂L/∂q = 0 and Qᵈ = 0, then p = ∂L/∂q̇ written out. The coordinate must be cyclic already."""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    outside = Named(Quantity("nonconservative-force", coordinate), system.nonconservative_force(coordinate))
    momentum = Named(Quantity("momentum", coordinate), system.momentum(coordinate))
    nothing = Explicit(system.zero)
    lines = (
        Relation((Partial(lagrangian, system.q(coordinate)), nothing)),
        Relation((outside, nothing)),
        Relation((momentum, Partial(lagrangian, system.rate(coordinate)), Explicit(momentum.value))),
    )
    return Step(RULE, coordinate, lines, (), {"coordinate": coordinate} | _between(system, coordinate))


def _between(system: System, coordinate: str) -> dict[str, str]:
    """The contacts that act along the coordinate: only between their impacts is nothing else that does."""
    found = contacts_along(system, {coordinate: sp.Integer(1)})
    return {"contacts": ", ".join(found)} if found else {}
