"""The tables of inputs are not to shrink: what once was read, or refused, stays so."""

from __future__ import annotations

import pytest
from tests.language import test_latex_syntax, test_plain_syntax

TABLES = [
    pytest.param(test_plain_syntax.ACCEPTED, 145, id="plain text that is read"),
    pytest.param(test_plain_syntax.REFUSED, 200, id="plain text that is refused"),
    pytest.param(test_latex_syntax.ACCEPTED, 135, id="LaTeX that is read"),
    pytest.param(test_latex_syntax.REFUSED, 135, id="LaTeX that is refused"),
]


@pytest.mark.parametrize(("table", "least"), TABLES)
def test_a_table_is_large_and_has_no_row_twice(table: list[tuple[object, ...]], least: int) -> None:
    texts = [row[0] for row in table]
    assert len(set(texts)) == len(texts) >= least
