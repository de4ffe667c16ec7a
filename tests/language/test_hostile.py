"""Hostile texts are refused with a problem that points into the text; nothing runs, recurses or explodes."""

from __future__ import annotations

import pytest
import sympy
from tests.hostile import KINDS
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


@pytest.mark.parametrize("syntax", ["plain", "latex"])
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_not_refused_has_a_value(kind: str, syntax: Syntax) -> None:
    for text in KINDS[kind]:
        try:
            value = read(text, syntax)
        except ExpressionError:
            check(text, syntax)
        else:
            assert isinstance(value, sympy.Basic), text


def test_the_corpus_is_large() -> None:
    lines = [text for texts in KINDS.values() for text in texts]
    assert len(set(lines)) == len(lines) >= 1200
