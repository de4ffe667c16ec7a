"""Every misconception can be made somewhere, is found again from the answer it leads to, and is told in words."""

from __future__ import annotations

import pytest
from tests.derivation.scenes import constrained
from tests.homework.test_impacts import ROD
from tests.homework.test_impacts_with_constraints import WALLS
from tests.homework.wrong_answers import SHORT, assert_hints_are_whole, assert_mistakes_are_found

from deltaq.homework.faulty_solution import misconceptions
from deltaq.homework.hall import asked_of_halls
from deltaq.homework.workbook import workbook_of
from deltaq.mechanics.writing import write_scene
from deltaq.narration.catalog import catalog

SCENES = [*SHORT, "spring-pendulum", "rolling-disc", "coupled-pendulums", "charged-particle", "bouncing-ball"]
BOUND = ["cartesian-pendulum", "chaplygin-sleigh", "stick-slip"]


@pytest.mark.one_in(10)
@pytest.mark.parametrize("scene", SHORT)
def test_wrong_answers_are_wrong_and_their_mistakes_found(scene: str) -> None:
    assert_mistakes_are_found(scene)


def test_every_misconception_occurs() -> None:
    seen = {
        candidate.solution.id
        for scene in (
            *SCENES,
            *BOUND,
            ROD,
            WALLS,
            *(write_scene(scene) for scene in constrained() if scene.id == "sleigh"),
        )
        for workbook in [workbook_of({"scene": scene})]
        for task in (*workbook.tasks, *asked_of_halls(workbook.solution))
        for candidate in workbook.candidates(task)
    }
    assert {kind.id for kind in misconceptions()} - seen == set()


@pytest.mark.one_in(5)
@pytest.mark.parametrize("scene", SHORT)
def test_a_hint_names_only_what_the_mistake_is_about(scene: str) -> None:
    assert_hints_are_whole(scene)


def test_misconceptions_are_told_and_explained() -> None:
    kinds = misconceptions()
    assert len(kinds) >= 30
    for language in ("de", "en"):
        told = catalog(language)["homework"]["misconceptions"]  # type: ignore[index]
        assert set(told) == {kind.id for kind in kinds} | {"wrong-dimension", "other-unit"}
    assert all(kind.__doc__ and not kind.__doc__.startswith(kind.__name__) for kind in kinds)
