"""Every scene of the library climbs, and every rung of it is a scene like any other."""

from __future__ import annotations

import pytest
from tests.lab.ladder.climbing import climbed

from deltaq.lab.ladder.findings import FULL
from deltaq.mechanics.document import examine
from deltaq.mechanics.library import load_scene, scene_ids


@pytest.mark.parametrize("identifier", scene_ids())
def test_scene_climbs(identifier: str) -> None:
    found = climbed(load_scene(identifier), 2.0, (0.5, 1.0))
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
            assert found.measured[rung.id].outcome.status in ("ok", "event")
    full = found.measured[FULL].deviation
    assert full is not None
    assert full.relative < 1e-6
