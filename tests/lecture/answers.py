"""What the app answers, each request made once. Scenes are told in German, as the lecture is."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from deltaq.narration.derive import derive_request
from deltaq.narration.proof import proof_request
from deltaq.narration.vary import vary_request

IDENTITY = {
    "expression": "x",
    "functions": ["x"],
    "direction": ["v"],
    "parameters": [{"name": "t0", "latex": "t_0"}],
    "functional": {"kind": "value", "at": "t0"},
}
POSITION = {
    "expression": "[l*sin(phi), y + l*cos(phi)]",
    "functions": [{"name": "y", "latex": "q_1"}, {"name": "phi", "latex": "q_2"}],
    "parameters": [{"name": "l", "latex": "\\ell"}],
}
SEVERAL = {"expression": "x1*sin(x2)", "functions": ["x1", "x2"]}


@cache
def answer(request: str) -> dict:
    """`proof`, a variation by its name here, or the derivation of a scene."""
    variations = {"identity": IDENTITY, "position": POSITION, "several functions": SEVERAL}
    if request == "proof":
        return proof_request({"lang": "en"})
    return (
        vary_request(variations[request]) if request in variations else derive_request({"scene": request, "lang": "de"})
    )


def steps(request: str) -> dict[str, dict]:
    """All steps and substeps by their ids."""
    return {
        found["id"]: found
        for chapter in answer(request)["chapters"]
        for step in chapter["steps"]
        for found in walk(step)
    }


def walk(step: dict) -> Iterator[dict]:
    yield step
    for substep in step["substeps"]:
        yield from walk(substep)
