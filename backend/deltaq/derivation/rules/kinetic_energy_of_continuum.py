"""Kinetic energy of a continuum: E = ∫ 1/2 v · v dm, with dm = density times the element of material.

Source: the lecture's definition of E; Truesdell, Toupin, The Classical Field Theories, §166.
"""

from __future__ import annotations

from ...mechanics.bodies import Body
from ...mechanics.bodies.continuum import Continuum
from ...mechanics.kinetics import Distribution
from ..formula import Dot, Explicit, Integral, Times
from ..step import Relation, Step
from ..system import System

RULE = "kinetic-energy-of-continuum"
BODY = Continuum


def apply(system: System, body: Body) -> Step:
    """E = ∫ 1/2 v · v dm over the body: with the letter v, with v written out, and integrated."""
    velocity = system.named_velocity(body.name)
    laws = tuple(
        Integral(
            Times((Explicit(system.expression(part.density) / 2), Dot(square, square))), system.bounds(part.material)
        )
        for part in body.kinetics
        if isinstance(part, Distribution)
        for square in (velocity, Explicit(velocity.value))
    )
    line = Relation((system.named_kinetic_energy(body), *laws, Explicit(system.kinetic_energy_of(body))))
    return Step(RULE, body.name, (line,), (f"body:{body.name}",), {"place": body.name})
