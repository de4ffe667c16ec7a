"""Every scene against SymPy's own LagrangesMethod, at random points."""

from __future__ import annotations

import random

import pytest
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, Particle, Point, ReferenceFrame, dynamicsymbols
from tests.derivation.scenes import chain, spring_in_space

from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.mechanics.contributions import PointForce
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

SCENES = [*(pytest.param(load_scene(name), id=name) for name in scene_ids())]
SCENES += [pytest.param(chain(2), id="double pendulum"), pytest.param(chain(3), id="triple pendulum")]
SCENES += [pytest.param(spring_in_space(), id="spring and drag in space")]


def peer(scene: Scene) -> sp.Matrix:
    """Left sides of Lagrange's equations by LagrangesMethod, in the symbols of δq."""
    system = System(scene)
    functions = {q: dynamicsymbols(f"f_{q}") for q in system.free}
    time = dynamicsymbols._t
    moving = {system.q(q): f for q, f in functions.items()} | {system.t: time}
    moving |= {system.rate(q): f.diff(time) for q, f in functions.items()}
    frame, origin = ReferenceFrame("N"), Point("O")
    origin.set_vel(frame, 0)
    axes = (frame.x, frame.y, frame.z)

    def place(name: str) -> Point:
        components = system.guided(system.vector(c.tree for c in scene.place(name))).xreplace(moving)
        point = origin.locatenew(name, sum((c * axis for c, axis in zip(components, axes, strict=False)), 0 * frame.x))
        point.set_vel(frame, point.pos_from(origin).dt(frame))
        return point

    particles = [Particle(b.name, place(b.name), system.expression(b.mass.tree)) for b in scene.bodies]
    forces, potential = [], sp.Integer(0)
    for load in scene.contributions:
        if isinstance(load, PointForce):
            components = system.force(load).xreplace(moving)
            forces.append((place(load.place), sum(c * axis for c, axis in zip(components, axes, strict=False))))
        else:
            potential += system.guided(system.expression(load.energy)).xreplace(moving)
    kinetic = sum((p.kinetic_energy(frame) for p in particles), sp.Integer(0))
    method = LagrangesMethod(kinetic - potential, list(functions.values()), forcelist=forces, frame=frame)
    back = {f.diff(time, 2): system.acceleration(q) for q, f in functions.items()}
    first = {f.diff(time): system.rate(q) for q, f in functions.items()}
    zeroth = {f: system.q(q) for q, f in functions.items()} | {time: system.t}
    return method.form_lagranges_equations().subs(back).subs(first).subs(zeroth)


@pytest.mark.parametrize("scene", SCENES)
def test_equations_agree(scene: Scene) -> None:
    result = result_of(System(scene))
    theirs = peer(scene)
    source = random.Random(7)
    for _ in range(3):
        symbols = theirs.free_symbols.union(*(equation.free_symbols for equation in result.equations.values()))
        point = {symbol: sp.Float(source.uniform(0.3, 1.7), 30) for symbol in sorted(symbols, key=str)}
        for ours, other in zip(result.equations.values(), theirs, strict=True):
            assert abs(sp.N((ours - other).xreplace(point), 25)) < 1e-18


@pytest.mark.parametrize("scene", SCENES)
def test_mass_matrix_and_forcing_are_the_equations(scene: Scene) -> None:
    system = System(scene)
    result = result_of(system)
    accelerations = sp.Matrix([system.acceleration(q) for q in system.free])
    equations = sp.Matrix(list(result.equations.values()))
    for gap in result.mass_matrix * accelerations - result.forcing - equations:
        assert system.is_zero(sp.expand(gap))
