"""What is thought fast, told from a request."""

from __future__ import annotations

from typing import Any

import pytest

from deltaq.api.costs import degrees_of_freedom, expected
from deltaq.api.workers.job import Job
from deltaq.contract.base import SceneWithChanges
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.writing import write_scene


@pytest.mark.parametrize("identifier", scene_ids())
def test_degrees_of_freedom_are_the_scenes_own(identifier: str) -> None:
    scene = load_scene(identifier)
    named, brought = SceneWithChanges(scene=identifier), SceneWithChanges(scene=write_scene(scene))
    assert degrees_of_freedom(named) == len(scene.free)
    assert degrees_of_freedom(brought) == len(scene.coordinates)  # which of them are free is not read here


@pytest.mark.parametrize(
    ("question", "count"),
    [
        pytest.param({"scene": "chain-pendulum", "parameters": {"n": 12.0, "g": 9.0}}, 12, id="family"),
        pytest.param({"scene": "chain-pendulum", "parameters": {"n": 1e308}}, int(1e308), id="beyond all bounds"),
        pytest.param({"scene": "nothing"}, 0, id="no such scene"),
        pytest.param({"scene": {"coordinates": 7}}, 0, id="no list"),
        pytest.param({"scene": {}}, 0, id="empty document"),
    ],
)
def test_degrees_of_freedom(question: dict[str, Any], count: int) -> None:
    assert degrees_of_freedom(SceneWithChanges.model_validate(question)) == count


@pytest.mark.parametrize(("links", "pace"), [(3, "fast"), (4, "slow")])
def test_few_are_fast(links: int, pace: str) -> None:
    asked = SceneWithChanges(scene="chain-pendulum", parameters={"n": links})
    assert expected(Job("x", 1.0), asked, 3).pace == pace
