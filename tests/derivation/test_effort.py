"""Shares of operations: a part that is too long is left out, says so, and leaves all else as it is."""

from __future__ import annotations

import pytest

from deltaq.derivation.effort import Effort
from deltaq.derivation.engine import chapters
from deltaq.derivation.result import Result, result_of
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene


def derived(scene: str, share: int) -> tuple[System, list[str], Result]:
    """The steps of the last chapter, and the result, where each part may spend so much."""
    system = System(load_scene(scene))
    system.effort.share = share
    *_, model = chapters(system)
    return system, [step.id for step in model.steps], result_of(system)


@pytest.mark.parametrize("scene", ["heavy-top", "triple-pendulum"])
def test_parts_without_a_share_are_left_out_and_the_others_stay(scene: str) -> None:
    short, steps, result = derived(scene, 20)
    _, whole, complete = derived(scene, 300_000)
    left_out = list(short.effort.left_out)
    assert "integrals" in left_out
    assert [step for step in steps if step.startswith("left-out")] == [f"left-out:{part}" for part in left_out]
    assert not [step for step in whole if step.startswith("left-out")]
    assert set(steps) - {f"left-out:{part}" for part in left_out} < set(whole)
    assert result.equations == complete.equations
    assert (result.generators, complete.generators != ()) == ((), True)


def test_the_same_question_has_the_same_answer() -> None:
    spent = []
    for _ in range(2):
        system, steps, _ = derived("heavy-top", 400)
        spent.append((dict(system.effort.spent), list(system.effort.left_out), steps))
    assert spent[0] == spent[1]


def test_nothing_is_counted_outside_of_a_part() -> None:
    effort = Effort(share=10)
    effort.spend(1000)
    assert effort.afford("integrals", lambda: effort.spend(10) or "found", "nothing") == "found"
    assert effort.afford("integrals", lambda: effort.spend(1) or "found", "nothing") == "nothing"
    assert effort.afford("canonical", lambda: "found", "nothing") == "found"
    assert (effort.spent, list(effort.left_out)) == ({"integrals": 11, "canonical": 0}, ["integrals"])
