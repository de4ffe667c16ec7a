"""Rods and rigid bodies as particles at their centres of mass: the energy of rotation is left out.

König's theorem splits E = ½ m v_S² + ½ J ω²; what is dropped is small where a body is small against its path.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §5.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import singledispatch

from ....mechanics.bodies import Body
from ....mechanics.bodies.continuum import Continuum
from ....mechanics.bodies.particle import Particle
from ....mechanics.bodies.rigid import RigidBody
from ....mechanics.scene import Scene
from ....model.mass_centre import mass_centre
from ..findings import Part
from ..names import tidied
from ..simplification import Kind, SimplificationContext, Simplified


def _offered(context: SimplificationContext) -> Iterator[Part]:
    if any(body.kind != Particle.kind for body in context.scene.bodies):
        yield Part("point-mass", {})


def _simplify(context: SimplificationContext, _part: Part) -> Simplified:
    scene = context.scene
    particles = tuple(_particle(body, scene) for body in scene.bodies)
    return Simplified(tidied(replace(scene, bodies=particles), scene.labels))


@singledispatch
def _particle(body: Body, _scene: Scene) -> Body:
    """The body as a particle; a particle is one already."""
    return body


@_particle.register
def _(body: RigidBody, _scene: Scene) -> Particle:
    return Particle(body.name, body.mass, body.position)


@_particle.register
def _(body: Continuum, scene: Scene) -> Particle:
    return Particle(body.name, *mass_centre(body, scene))


KIND = Kind("point-mass", _offered, _simplify)
