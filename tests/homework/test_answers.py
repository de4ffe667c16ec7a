"""The table of answers: outcome and reason of each, over all scenes in it and in both syntaxes."""

from __future__ import annotations

from itertools import groupby

import pytest

from deltaq.homework.checking import check
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import workbook_of

from .table import Row, rows

ROWS = list(rows())
SCENES = {scene: list(group) for scene, group in groupby(ROWS, key=lambda row: row.scene)}


def reason(verdict: Verdict) -> str:
    """The one word by which the table names why."""
    if verdict.problems:
        return verdict.problems[0].code
    if verdict.misconceptions:
        return verdict.misconceptions[0]
    return f"slip:{verdict.slip.kind}" if verdict.slip else verdict.remark or "-"


def verdict_of(row: Row) -> tuple[str, str]:
    workbook = workbook_of({"scene": row.scene})
    verdict = check(workbook, workbook.task(row.task), row.answer, row.syntax)
    return verdict.outcome, "-" if row.outcome == "invalid" and row.reason == "-" else reason(verdict)


@pytest.mark.one_in(6)
@pytest.mark.parametrize("scene", SCENES)
def test_answers(scene: str) -> None:
    wrong = {
        f"{row.task} {row.answer} ({row.comment})": (found, (row.outcome, row.reason))
        for row in SCENES[scene]
        if (found := verdict_of(row)) != (row.outcome, row.reason)
    }
    assert wrong == {}


def test_table_is_large_enough() -> None:
    assert len(ROWS) >= 300
    assert len(SCENES) >= 12
    assert sum(row.syntax == "latex" for row in ROWS) >= 50
    assert len({row.reason for row in ROWS}) >= 50
