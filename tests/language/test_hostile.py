"""Hostile texts are refused with a problem that points into the text; nothing runs, recurses or explodes."""

from __future__ import annotations

import pytest
from tests.language.hostile import BOMBS, CODE, LARGE, LATEX
from tests.language.scene_names import read

from deltaq.errors import ExpressionError
from deltaq.language.parser import Syntax

PLAIN = [*CODE, *BOMBS, *LARGE]


def check(text: str, syntax: Syntax) -> None:
    with pytest.raises(ExpressionError) as caught:
        read(text, syntax)
    (problem,) = caught.value.problems
    if problem.offset is not None:
        assert 0 <= problem.offset <= len(text)
        assert 0 <= (problem.length or 0) <= len(text) - problem.offset


@pytest.mark.parametrize("text", PLAIN, ids=[f"plain-{i}" for i in range(len(PLAIN))])
def test_plain_text_is_refused(text: str) -> None:
    check(text, "plain")


@pytest.mark.parametrize("text", LATEX, ids=[f"latex-{i}" for i in range(len(LATEX))])
def test_latex_is_refused(text: str) -> None:
    check(text, "latex")


@pytest.mark.parametrize("text", PLAIN, ids=[f"plain-{i}" for i in range(len(PLAIN))])
def test_plain_text_read_as_latex_breaks_nothing(text: str) -> None:
    try:
        value = read(text, "latex")
    except ExpressionError as error:
        value = error.problems
    assert value is not None


def test_the_corpus_is_large() -> None:
    assert len(set(PLAIN)) >= 190
    assert len(set(LATEX)) >= 65
