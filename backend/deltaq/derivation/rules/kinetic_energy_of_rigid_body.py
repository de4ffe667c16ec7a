"""König's theorem: E = m/2 v · v + 1/2 Σ Jₖₗ ωₖ ωₗ, the centre of mass and the turning about it apart.

The Jₖₗ are the tensor of inertia about the centre of mass, the ωₖ the components of the angular velocity, both along
axes of the body: 1/2 Σ Jₖ ωₖ² if these are principal ones. In the plane there is one of each.
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
    """Each ωₖ by the rates of the coordinates, then E = m/2 v · v + 1/2 Σ Jₖₗ ωₖ ωₗ of one body and its value."""
    turning = [part for part in body.kinetics if isinstance(part, Rotation)]
    law = Plus((Term(half_mass_times_square(system, body)), *(t for part in turning for t in _rotation(system, part))))
    lines = (
        *(line for part in turning for line in _angular_velocities(system, part)),
        Relation((system.named_kinetic_energy(body), law, Explicit(system.kinetic_energy_of(body)))),
    )
    return Step(RULE, body.name, lines, (f"body:{body.name}",), {"place": body.name})


def _rotation(system: System, part: Rotation) -> Iterator[Term]:
    """1/2 Jₖₖ ωₖ² for each axis, Jₖₗ ωₖ ωₗ for each pair of axes with a product of inertia."""
    omega = system.named_angular_velocities(part)
    for k, l, entry in part.entries:
        factor = system.expression(entry) / (1 + (k == l))
        yield Term(Times((Explicit(factor), omega[k], omega[l])))


def _angular_velocities(system: System, part: Rotation) -> Iterator[Relation]:
    for tree, omega in zip(part.angular_velocity, system.named_angular_velocities(part), strict=True):
        yield Relation((omega, system.given_rate(tree), Explicit(omega.value)))
