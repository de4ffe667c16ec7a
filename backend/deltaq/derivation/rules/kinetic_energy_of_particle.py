"""Kinetic energy of a particle: E = m/2 v · v.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.1.
"""

from __future__ import annotations

from ...mechanics.bodies import Body
from ...mechanics.bodies.particle import Particle
from ..formula import Dot, Explicit, Times
from ..step import Relation, Step
from ..system import System

RULE = "kinetic-energy-of-particle"
BODY = Particle


def apply(system: System, body: Body) -> Step:
    """E = m/2 v · v of one body, then its value in the coordinates."""
    law = half_mass_times_square(system, body)
    line = Relation((system.named_kinetic_energy(body), law, Explicit(system.kinetic_energy_of(body))))
    return Step(RULE, body.name, (line,), (f"body:{body.name}",), {"place": body.name})


def half_mass_times_square(system: System, body: Body) -> Times:
    """m/2 v · v, with v of the centre of mass for a rigid body."""
    velocity = system.named_velocity(body.name)
    return Times((Explicit(system.mass(body) / 2), Dot(velocity, velocity)))
