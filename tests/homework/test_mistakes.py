"""The table of mistakes: each is named, none that was not made, and the term is shown. The script beside does all."""

from __future__ import annotations

from .mistakes import judged, mistakes

ROWS = list(mistakes())
SCENES = ("pendulum", "cart-pendulum", "spring-pendulum")  # that the gate has time for
EVERY = 3  # of their rows one is judged


def test_mistakes_are_named_and_none_that_was_not_made() -> None:
    seen = list(judged([row for row in ROWS if row.scene in SCENES][::EVERY]))
    wrong = [each for each in seen if not each.row.right]
    assert [each for each in seen if each.kind not in ("named", "accepted", "not named")] == []
    assert sum(each.kind == "named" for each in wrong) >= 0.95 * len(wrong)
    assert sum(each.shown for each in wrong) >= 0.8 * len(wrong)


def test_table_is_large_enough() -> None:
    assert sum(not row.right for row in ROWS) >= 350
    assert len({row.scene for row in ROWS}) >= 15
    assert len({row.task.partition(":")[0] for row in ROWS}) == 13
