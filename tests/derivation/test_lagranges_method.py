"""Every scene against SymPy's own LagrangesMethod, at random points."""

from __future__ import annotations

import random

import pytest
import sympy as sp
from tests.derivation.peer import Peer
from tests.derivation.scenes import constrained, spring_in_space

from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene, scene_ids

SCENES = [*(pytest.param(load_scene(name), id=name) for name in scene_ids())]
SCENES += [pytest.param(spring_in_space(), id="spring and drag in space")]
SCENES += [pytest.param(scene, id=scene.id) for scene in constrained()]


@pytest.fixture(scope="module", params=SCENES)
def system(request: pytest.FixtureRequest) -> System:
    """A scene's system; its tests follow each other."""
    return System(request.param)


@pytest.mark.one_in(14)
def test_equations_agree(system: System) -> None:
    ours = list(result_of(system).equations.values())
    theirs = Peer(system.scene).equations()
    names = {symbol.name for equation in (*ours, *theirs) for symbol in equation.free_symbols}
    source = random.Random(7)
    for _ in range(3):
        point = {name: sp.Float(source.uniform(0.3, 1.2), 30) for name in sorted(names)}
        for our, their in zip(ours, theirs, strict=True):
            difference, size = value(our, point) - value(their, point), value(their, point)
            assert abs(difference) < 1e-18 * max(1, abs(size))


def value(expression: sp.Expr, point: dict[str, sp.Float]) -> sp.Float:
    return sp.N(expression.xreplace({symbol: point[symbol.name] for symbol in expression.free_symbols}), 25)


@pytest.mark.one_in(5)
def test_mass_matrix_and_forcing_are_the_equations(system: System) -> None:
    result = result_of(system)
    accelerations = sp.Matrix([system.acceleration(q) for q in system.free])
    equations = sp.Matrix(list(result.equations.values()))
    reactions = sp.Matrix([system.reaction(q) for q in system.free])
    for gap in result.mass_matrix * accelerations - result.forcing - reactions - equations:
        assert system.is_zero(sp.expand(gap))
