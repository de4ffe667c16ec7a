"""Whole answers: whatever has LaTeX has words, in both languages, and they are words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest

from deltaq.narration.derive import derive_request
from deltaq.narration.expressions import typeset_request
from deltaq.narration.proof import proof_request
from deltaq.narration.vary import vary_request

SCENES = ("elastic-pendulum", "double-pendulum", "heavy-top", "bead-on-rotating-hoop", "swinging-atwood", "quarter-car")
ACTION = {
    "expression": "sqrt(1 + dot(y)^2)/sqrt(2*g*y)",
    "functions": ["y"],
    "parameters": ["g", "T"],
    "functional": {"kind": "integral", "from": "0", "to": "T", "ends": "free"},
}
VALUE = {
    "expression": "l*sin(phi)", "functions": ["phi"], "direction": ["v"], "parameters": ["l", "t0"],
    "functional": {"kind": "value", "at": "t0"},
}  # fmt: skip
ANSWERS = {
    **{
        scene: lambda lang, scene=scene: derive_request({"scene": scene, "canonical": True, "lang": lang})
        for scene in SCENES
    },
    "hamilton": lambda lang: derive_request({"scene": "pendulum", "formulation": "hamilton", "lang": lang}),
    "action": lambda lang: vary_request({**ACTION, "lang": lang}),
    "value": lambda lang: vary_request({**VALUE, "lang": lang}),
    "proof": lambda lang: proof_request({"lang": lang}),
    "expression": lambda lang: typeset_request(
        {"scene": "pendulum", "expression": "l*sin(phi)", "syntax": "plain", "lang": lang}
    ),
}


def formulas(part: Any, place: str = "") -> Iterator[tuple[str, str, str]]:
    """Where, LaTeX and words of all that has LaTeX."""
    if isinstance(part, dict):
        if part.get("latex"):
            yield place, part["latex"], part.get("spoken", "")
        for key, value in part.items():
            yield from formulas(value, f"{place}/{key}")
    elif isinstance(part, list | tuple):
        for value in part:
            yield from formulas(value, place)


@pytest.mark.one_in(6)
@pytest.mark.parametrize("lang", ["de", "en"])
@pytest.mark.parametrize("answer", ANSWERS)
def test_what_has_latex_has_words(answer: str, lang: str) -> None:
    found = list(formulas(ANSWERS[answer](lang)))
    assert found
    assert [place for place, _, spoken in found if not spoken.strip()] == []
    other = r"\b(equals|times|over)\b" if lang == "de" else r"\b(gleich|mal|durch)\b"
    unspoken = re.compile(rf"[\\_{{}}$^=*/<>]|[A-Za-z]\d|{other}")
    assert [spoken for _, _, spoken in found if unspoken.search(spoken)] == []
