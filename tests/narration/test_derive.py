"""The document of a derivation."""

from __future__ import annotations

import json
import re

import pytest

from deltaq.errors import InputError, Problem
from deltaq.language.parser import parse
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.narration.derive import derive_request
from deltaq.narration.marks import bare

SAFE = re.compile(r"[A-Za-z0-9:_-]+")


def all_steps(answer: dict) -> list[dict]:
    steps = [step for chapter in answer["chapters"] for step in chapter["steps"]]
    return steps + [substep for step in steps for substep in step["substeps"]]


@pytest.mark.parametrize("lang", ["de", "en"])
@pytest.mark.parametrize("scene", scene_ids())
def test_every_scene_is_told(scene: str, lang: str) -> None:
    answer = derive_request({"scene": scene, "lang": lang})
    json.dumps(answer, allow_nan=False)
    assert [chapter["id"] for chapter in answer["chapters"]] == [
        "configuration",
        "variation",
        "virtual-work",
        "kinetic-energy",
        "dalembert-to-lagrange",
        "decomposition",
        "lagrange",
        "model",
    ]
    for step in all_steps(answer):
        assert SAFE.fullmatch(step["id"]), step["id"]
        assert step["verified"] is True
        assert step["latex"].count("{") == step["latex"].count("}")
        assert bare(step["marked"]) == bare(step["latex"])


@pytest.mark.parametrize("scene", scene_ids())
def test_plain_results_are_read_back_by_the_parser(scene: str) -> None:
    names = load_scene(scene).names
    result = derive_request({"scene": scene})["result"]
    for key in ("virtual_work", "kinetic_energy", "potential_energy", "lagrangian"):
        parse(result[key]["plain"], names)
    for equation in result["equations"]:
        assert equation["plain"].endswith(" = 0")
        parse(equation["plain"], names)


def test_changes_of_a_request() -> None:
    guided = derive_request(
        {
            "scene": "base-pendulum",
            "guides": [{"coordinate": "y", "value": "y0*sin(omega*t)"}],
            "parameters": {"y0": 0.1, "omega": 5.0},
        }
    )
    (equation,) = guided["result"]["equations"]
    (library,) = derive_request({"scene": "guided-pendulum"})["result"]["equations"]
    assert equation["plain"] == library["plain"]


def test_conserved_quantities() -> None:
    kinds = {c["kind"] for c in derive_request({"scene": "base-pendulum"})["result"]["conserved"]}
    assert kinds == {"energy"}
    assert derive_request({"scene": "guided-pendulum"})["result"]["conserved"] == []
    assert derive_request({"scene": "elastic-pendulum"})["result"]["conserved"] == []


def test_unknown_formulation() -> None:
    with pytest.raises(InputError) as caught:
        derive_request({"scene": "pendulum", "formulation": "newton"})
    parameters = {"name": "newton", "known": "dalembert-lagrange, hamilton", "suggestion": ""}
    assert caught.value.problems == (Problem("unknown-formulation", "/formulation", parameters=parameters),)
