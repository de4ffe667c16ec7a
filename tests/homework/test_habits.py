"""Answers as students type them: nearly all right ones are accepted, no wrong one ever is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import pytest

from .habits import Habit, adversarial, habits

ROWS = tuple(habits())
WRONG = tuple(row for row in ROWS if not row.right)
LEAST_ACCEPTED = 0.97


def test_the_table_is_large_and_halved() -> None:
    sizes = Counter((row.right, row.held_out) for row in ROWS)
    assert sum(row.right for row in ROWS) >= 350
    assert len(WRONG) >= 190
    assert all(abs(sizes[right, True] - sizes[right, False]) <= 1 for right in (True, False))
    assert sum(row.syntax == "latex" for row in ROWS) >= 180


@pytest.mark.parametrize("held_out", [False, True])
def test_right_answers_are_accepted(*, held_out: bool) -> None:
    rows = [row for row in ROWS if row.right and row.held_out == held_out]
    outcomes = {row: row.verdict().outcome for row in rows}
    assert [row for row, outcome in outcomes.items() if outcome == "wrong"] == []
    assert sum(outcome == "correct" for outcome in outcomes.values()) >= LEAST_ACCEPTED * len(rows)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("scene", sorted({row.scene for row in WRONG}))
def test_wrong_answers_are_not(scene: str) -> None:
    assert accepted(row for row in WRONG if row.scene == scene) == []


def test_no_favourable_reading_makes_a_wrong_answer_right() -> None:
    rows = tuple(adversarial())
    assert len(rows) >= 140
    assert accepted(rows) == []


def accepted(rows: Iterable[Habit]) -> list[Habit]:
    """The rows that are not found wrong, or refused."""
    return [row for row in rows if row.verdict().outcome not in ("wrong", "invalid")]
