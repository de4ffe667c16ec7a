"""What is derived and told stays what it was when somebody approved it: `python -m tests.narration.approved write`."""

from __future__ import annotations

import pytest
from tests.narration.approved import FOLDER, NAMES, text


@pytest.mark.one_in(8)
@pytest.mark.parametrize("name", NAMES)
def test_an_answer_is_the_one_that_was_approved(name: str) -> None:
    assert text(name) == (FOLDER / f"{name}.txt").read_text(encoding="utf-8")


def test_nothing_is_approved_that_is_no_more() -> None:
    assert sorted(path.stem for path in FOLDER.iterdir()) == sorted(NAMES)
