"""How a computation ended, as each language says it."""

from __future__ import annotations

import re
from string import Formatter
from typing import Any

import pytest

from deltaq.narration.catalog import catalog, template
from deltaq.narration.outcome import explained, outcomes_explained

STATUSES = sorted(key for key, entry in dict(catalog("de")["statuses"]).items() if "reason" in entry)


def ended(code: str, lang: str) -> dict[str, Any]:
    """What ended with this code, and all its placeholders 0.5."""
    fields = {name for _, name, _, _ in Formatter().parse(template(lang, f"statuses.{code}.reason")) if name}
    return {"reason": {"code": code, "parameters": dict.fromkeys(fields, 0.5)}, "event": None, "choice": None}


@pytest.mark.parametrize("code", STATUSES)
@pytest.mark.parametrize(("lang", "mark"), [("de", ","), ("en", ".")])
def test_numbers_have_the_decimal_mark_of_the_language(code: str, lang: str, mark: str) -> None:
    answer = ended(code, lang)
    told = [explained(answer, lang)["reason"]]
    told += outcomes_explained({"any": (code, answer["reason"]["parameters"])}, lang)["reasons"].values()
    for sentence in told:
        assert set(re.findall(r"0(.)5", sentence)) == ({mark} if answer["reason"]["parameters"] else set())


def test_why_a_method_was_chosen_has_it_too() -> None:
    answer = ended("ok", "de") | {"choice": {"code": "event", "parameters": {"t": 0.5, "title": "–"}}}
    assert "0,5" in explained(answer, "de")["choice"]
