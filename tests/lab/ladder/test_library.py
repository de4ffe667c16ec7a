"""Every scene of the library climbs, and every rung of it is a scene like any other."""

from __future__ import annotations

from functools import cache

import pytest
from tests.lab.ladder.climbing import Climbed, climbed
from tests.lab.ladder.observers import EXACT, Verdict, another

from deltaq.derivation.engine import derive
from deltaq.lab.ladder.findings import FULL
from deltaq.lab.ladder.measurement import LOST
from deltaq.mechanics.document import examine, read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.model.modes import modes_of
from deltaq.simulation.service import run

# Scenes with constraints have a ladder of their own (`test_minimal.py`); those whose motion goes on behind events none.
CLIMBED = [name for name in scene_ids() if not load_scene(name).constraints and modes_of(load_scene(name)) is None]
SPAN = 2.0


@cache
def own(identifier: str) -> Climbed:
    return climbed(load_scene(identifier), SPAN, (0.5, 1.0))


@pytest.mark.one_in(12)
@pytest.mark.parametrize("identifier", CLIMBED)
def test_another_observer_says_the_same(identifier: str) -> None:
    """In other units, from other origins and in a moving frame."""
    scene = load_scene(identifier)
    observer = another(scene.dimension)
    seen = climbed(observer.sees(scene), SPAN * observer.second)
    assert Verdict.of(own(identifier)).differs(Verdict.of(seen), EXACT) == []


@pytest.mark.one_in(7)
@pytest.mark.parametrize("identifier", CLIMBED)
def test_scene_climbs(identifier: str) -> None:
    found = own(identifier)
    rungs = found.ladder.rungs
    assert found.count == found.ladder.count
    assert found.least.rung in found.measured
    assert len({rung.id for rung in rungs}) == len(rungs)
    for rung in rungs:
        assert (rung.scene is None) == bool(rung.problems)
        if rung.scene is not None:
            scene, problems = examine(rung.scene)
            assert problems == ()
            assert scene is not None
            assert len(scene.free) == rung.degrees
            measured = found.measured[rung.id]
            runs_away = measured.deviation is not None and measured.deviation.relative == LOST
            assert measured.outcome.status in ("ok", "event", *(["diverged"] if runs_away else []))
            assert not (runs_away and measured.survives)
    full = found.measured[FULL].deviation
    assert full is not None
    assert full.relative < 1e-6


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("identifier", "rung"),
    [
        pytest.param("elastic-pendulum", "linearized", id="follower force, linearized"),
        pytest.param("quarter-car", "rigid:spring", id="coordinate given up"),
        pytest.param("spherical-pendulum", "cyclic:psi+linearized", id="effective potential, linearized"),
        pytest.param("cart-pendulum", "cyclic:x", id="seen from the centre of mass"),
        pytest.param("wind-on-rod", "point-mass", id="rod as a particle"),
        pytest.param("bead-on-free-hoop", "guided:psi", id="guided"),
    ],
)
def test_a_rung_can_be_opened_as_a_scene(identifier: str, rung: str) -> None:
    """It is derived step by step, each step verified, and simulated, as any other scene."""
    rungs = climbed(load_scene(identifier), 0.5).ladder.rungs
    document = next(each.scene for each in rungs if each.id == rung)
    assert document is not None
    _, derivation = derive(read_scene(document))
    assert all(step.verified for step in derivation.steps())
    assert run({"scene": document, "t_end": 1.0})["status"] == "ok"
