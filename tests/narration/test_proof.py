"""The document of the general proof."""

from __future__ import annotations

import json

import pytest

from deltaq.errors import Problem, UnknownNameError
from deltaq.narration.proof import proof_request


@pytest.mark.one_in(2)
@pytest.mark.parametrize("lang", ["de", "en"])
def test_proof_is_told(lang: str) -> None:
    answer = proof_request({"lang": lang})
    json.dumps(answer, allow_nan=False)
    assert answer["id"] == "dalembert-lagrange"
    steps = [step for chapter in answer["chapters"] for step in chapter["steps"]]  # type: ignore[attr-defined, union-attr]
    assert len(steps) == 20
    for step in steps:
        assert step["verified"] is True
        assert step["text"].endswith(".")
        assert step["latex"].count("{") == step["latex"].count("}")
    energy = next(step for step in steps if step["id"] == "general-integral")
    assert r"\htmlClass{energy-kinetic}{E}" in energy["marked"]
    assert "htmlClass" not in energy["latex"]


def test_unknown_proof() -> None:
    with pytest.raises(UnknownNameError) as caught:
        proof_request({"id": "fermat"})
    parameters = {"name": "fermat", "known": "dalembert-lagrange"}
    assert caught.value.problems == (Problem("unknown-proof", parameters=parameters),)
