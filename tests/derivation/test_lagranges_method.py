"""Every scene against SymPy's own LagrangesMethod, at random points."""

from __future__ import annotations

import random

import pytest
import sympy as sp
from tests.derivation.peer import Peer
from tests.derivation.scenes import chain, spring_in_space

from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

SCENES = [*(pytest.param(load_scene(name), id=name) for name in scene_ids())]
SCENES += [pytest.param(chain(2), id="two links"), pytest.param(chain(3), id="three links")]
SCENES += [pytest.param(spring_in_space(), id="spring and drag in space")]


@pytest.mark.parametrize("scene", SCENES)
def test_equations_agree(scene: Scene) -> None:
    ours = list(result_of(System(scene)).equations.values())
    theirs = Peer(scene).equations()
    names = {symbol.name for equation in (*ours, *theirs) for symbol in equation.free_symbols}
    source = random.Random(7)
    for _ in range(3):
        point = {name: sp.Float(source.uniform(0.3, 1.2), 30) for name in sorted(names)}
        for our, their in zip(ours, theirs, strict=True):
            difference, size = value(our, point) - value(their, point), value(their, point)
            assert abs(difference) < 1e-18 * max(1, abs(size))


def value(expression: sp.Expr, point: dict[str, sp.Float]) -> sp.Float:
    return sp.N(expression.xreplace({symbol: point[symbol.name] for symbol in expression.free_symbols}), 25)


@pytest.mark.parametrize("scene", SCENES)
def test_mass_matrix_and_forcing_are_the_equations(scene: Scene) -> None:
    system = System(scene)
    result = result_of(system)
    accelerations = sp.Matrix([system.acceleration(q) for q in system.free])
    equations = sp.Matrix(list(result.equations.values()))
    for gap in result.mass_matrix * accelerations - result.forcing - equations:
        assert system.is_zero(sp.expand(gap))
