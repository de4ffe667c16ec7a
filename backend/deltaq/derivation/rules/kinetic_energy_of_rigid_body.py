"""König's theorem: E = m/2 v · v + 1/2 Σ Jₖ ωₖ², the centre of mass and the turning about it apart.

The Jₖ are principal moments of inertia about the centre of mass, the ωₖ the components of the angular velocity in the
body frame; in the plane there is one of each.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §5.3.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...mechanics.bodies import Body
from ...mechanics.bodies.rigid import RigidBody
from ...mechanics.kinetics import Rotation
from ..formula import Explicit, Plus, Term, Times
from ..step import Relation, Step
from ..system import System
from .kinetic_energy_of_particle import half_mass_times_square

RULE = "kinetic-energy-of-rigid-body"
BODY = RigidBody


def apply(system: System, body: Body) -> Step:
    """Each ωₖ by the rates of the coordinates, then E = m/2 v · v + 1/2 Σ Jₖ ωₖ² of one body and its value."""
    turning = [part for part in body.kinetics if isinstance(part, Rotation)]
    law = Plus((Term(half_mass_times_square(system, body)), *(t for part in turning for t in _rotation(system, part))))
    lines = (
        *(line for part in turning for line in _angular_velocities(system, part)),
        Relation((system.named_kinetic_energy(body), law, Explicit(system.kinetic_energy_of(body)))),
    )
    return Step(RULE, body.name, lines, (f"body:{body.name}",), {"place": body.name})


def _rotation(system: System, part: Rotation) -> Iterator[Term]:
    """1/2 Jₖ ωₖ² for each principal axis."""
    for moment, omega in zip(part.inertia, system.named_angular_velocities(part), strict=True):
        yield Term(Times((Explicit(system.expression(moment) / 2), omega, omega)))


def _angular_velocities(system: System, part: Rotation) -> Iterator[Relation]:
    for tree, omega in zip(part.angular_velocity, system.named_angular_velocities(part), strict=True):
        yield Relation((omega, system.given_rate(tree), Explicit(omega.value)))
