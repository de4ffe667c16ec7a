"""Product rule: ∂r/∂qᵢ · v̇ = d/dt(∂r/∂qᵢ · v) − d/dt(∂r/∂qᵢ) · v.

With the two laws before it this is d/dt ∂/∂q̇ᵢ(v·v/2) − ∂/∂qᵢ(v·v/2).
Source: Lagrange, Mécanique analytique (1788); Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.50; the
lecture.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Dot, Explicit, Partial, Plus, Rate, Term, Times, minus
from ..step import Relation, Step
from ..system import System

RULE = "product-rule"


def apply(system: System, place: str) -> Step:
    """∂r/∂qᵢ · v̇ at a place, one line for each coordinate that its position depends on.

    By the product rule first, then by d/dt ∂/∂q̇ᵢ − ∂/∂qᵢ of v · v/2. Both are formulas of letters; nothing is computed.
    """
    lines = tuple(_line(system, place, q) for q in system.coordinates_of(place))
    return Step(RULE, place, lines, (system.source(place),), {"place": place})


def _line(system: System, place: str, coordinate: str) -> Relation:
    q, rate = system.q(coordinate), system.rate(coordinate)
    velocity = system.named_velocity(place)
    tangent = Partial(system.named_position(place), q)
    half_square = Times((Explicit(sp.Rational(1, 2)), Dot(velocity, velocity)))
    by_parts = Plus((Term(Rate(Dot(tangent, velocity))), minus(Dot(Rate(tangent), velocity))))
    by_energy = Plus((Term(Rate(Partial(half_square, rate))), minus(Partial(half_square, q))))
    return Relation((Dot(tangent, Rate(velocity)), by_parts, by_energy))
