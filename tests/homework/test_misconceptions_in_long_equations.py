"""Misconceptions are found again where equations are long; apart from the others, since it takes as long as they do."""

from __future__ import annotations

import pytest
from tests.homework.wrong_answers import LONG, assert_hints_are_whole, assert_mistakes_are_found

PARTS = 4  # of the wrong answers of a scene


@pytest.mark.one_in(7)
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("scene", LONG)
def test_wrong_answers_are_wrong_and_their_mistakes_found(scene: str, part: int) -> None:
    assert_mistakes_are_found(scene, part, PARTS)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("scene", LONG)
def test_a_hint_names_only_what_the_mistake_is_about(scene: str) -> None:
    assert_hints_are_whole(scene)
