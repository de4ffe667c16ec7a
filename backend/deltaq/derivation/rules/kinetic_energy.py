"""Kinetic energy of a particle: E = m/2 v · v.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.1.
"""

from __future__ import annotations

from ...mechanics.bodies import Body
from ..formula import Dot, Explicit, Named, Quantity, Times
from ..step import Relation, Step
from ..system import System

RULE = "kinetic-energy-of-particle"


def apply(system: System, body: Body) -> Step:
    velocity = Named(Quantity("velocity", body.name), system.velocity(body.name))
    half_mass = Explicit(system.mass(body) / 2)
    energy = system.kinetic_energy_of(body)
    left = Named(Quantity("kinetic-energy", body.name if len(system.scene.bodies) > 1 else ""), energy)
    line = Relation((left, Times((half_mass, Dot(velocity, velocity))), Explicit(energy)))
    return Step(RULE, body.name, (line,), (f"body:{body.name}",), {"place": body.name})
