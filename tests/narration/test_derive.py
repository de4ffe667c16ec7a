"""The document of a derivation."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import pytest
from tests import derived

from deltaq.derivation.engine import formulation_names
from deltaq.errors import InputError, Problem
from deltaq.language.canonical import zero_test
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.plain_printer import plain
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.narration.derive import derive_request
from deltaq.narration.marks import bare

LANGUAGE = {"dalembert-lagrange": "de", "hamilton": "en"}
CHAPTERS = {
    "dalembert-lagrange": [
        "configuration",
        "variation",
        "virtual-work",
        "kinetic-energy",
        "dalembert-to-lagrange",
        "decomposition",
        "lagrange",
        "model",
    ],
    "hamilton": [
        "configuration",
        "kinetic-energy",
        "variation",
        "virtual-work",
        "decomposition",
        "hamilton",
        "lagrange",
        "model",
    ],
}
SAFE = re.compile(r"[A-Za-z0-9:_-]+")


def all_steps(answer: dict) -> list[dict]:
    steps = [step for chapter in answer["chapters"] for step in chapter["steps"]]
    return steps + [substep for step in steps for substep in step["substeps"]]


def told(scene: str, formulation: str) -> dict[str, Any]:
    """One principle in one language, the other one in the other."""
    return derived.told(scene, LANGUAGE[formulation], formulation)


@pytest.mark.one_in(12)
@pytest.mark.parametrize("formulation", formulation_names())
@pytest.mark.parametrize("scene", scene_ids())
def test_every_scene_is_told(scene: str, formulation: str) -> None:
    answer = told(scene, formulation)
    json.dumps(answer, allow_nan=False)
    *before, model = CHAPTERS[formulation]
    there = load_scene(scene)
    further = ["constraints"] if there.constraints else []
    if any(event.bounces for event in there.events) or any(load.kind == "friction" for load in there.loads):
        further.append("contact")
    assert [chapter["id"] for chapter in answer["chapters"]] == [*before, *further, model]
    for step in all_steps(answer):
        assert SAFE.fullmatch(step["id"]), step["id"]
        assert step["verified"] is True
        assert step["latex"].count("{") == step["latex"].count("}")
        assert bare(step["marked"]) == bare(step["latex"])


def plain_texts(part: object) -> Iterator[str]:
    """Everything an answer gives as plain text, component by component."""
    if isinstance(part, dict):
        if "plain" in part:
            yield from leaves(part["plain"])
        for value in part.values():
            yield from plain_texts(value)
    elif isinstance(part, list):
        for value in part:
            yield from plain_texts(value)


def leaves(part: object) -> Iterator[str]:
    if isinstance(part, list):
        for inner in part:
            yield from leaves(inner)
    else:
        assert isinstance(part, str)
        yield part


@pytest.mark.one_in(8)
@pytest.mark.parametrize("formulation", formulation_names())
@pytest.mark.parametrize("scene", scene_ids())
def test_plain_texts_are_read_back_by_the_parser(scene: str, formulation: str) -> None:
    """With the scene's names, and those that the answer declares."""
    answer = told(scene, formulation)
    known = [symbol for symbol in load_scene(scene).names.symbols if symbol.kind not in ("time", "constant")]
    own = [Symbol(symbol["name"], "parameter", symbol["latex"]) for symbol in answer["result"]["symbols"]]
    names = Names((*known, *own))
    texts = list(plain_texts(answer))
    assert len(texts) > 10
    for text in texts:
        read = parse(text, names)
        if "= 0" in text:
            continue
        value = to_sympy(read.tree, Symbols(names))
        assert zero_test(to_sympy(parse(plain(value), names).tree, Symbols(names)) - value, Symbols(names)).outcome


def test_momenta_of_the_routh_function_are_declared() -> None:
    result = derive_request({"scene": "spherical-pendulum"})["result"]
    assert result["symbols"] == [
        {"name": "p_psi", "latex": r"p_{\psi}", "spoken": "p sub psi", "kind": "momentum", "coordinate": "psi"}
    ]
    assert "p_psi" in result["routh"]["plain"]


def test_each_load_says_whether_it_has_a_potential() -> None:
    loads = {each["load"]: each for each in derive_request({"scene": "elastic-pendulum"})["result"]["loads"]}
    weight, drive = loads["weight"], loads["drive"]
    assert (weight["outcome"], weight["potential"] is not None) == ("conservative", True)
    assert [pair["plain"] for pair in weight["curl"]] == ["0"]
    assert (drive["outcome"], drive["has_potential"]) == ("nonconservative", False)
    assert drive["potential"] is None
    assert [pair["coordinates"] for pair in drive["curl"]] == [["y", "phi"]]
    assert drive["curl"][0]["plain"] == "-F0*cos(phi)"


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
    parameters = {"expected": "dalembert-lagrange, hamilton"}
    assert caught.value.problems == (Problem("request-not-one-of", "/formulation", parameters=parameters),)


@pytest.mark.parametrize(
    ("scene", "step", "own"),
    [
        ("atwood", "noether:1", "not the quantity itself (generalized momentum) that is constant"),
        ("double-atwood", "noether:2", "without the impulse of these forces"),
        ("double-atwood", "noether:3", "So an integral is conserved: integral of uniform motion"),
        ("foucault", "noether:1", "So an integral is conserved: angular momentum about the origin"),
    ],
)
def test_under_constant_forces_it_is_not_the_momentum_that_is_conserved(scene: str, step: str, own: str) -> None:
    chapters = derive_request({"scene": scene, "lang": "en"})["chapters"]
    texts = {one["id"]: one["text"] for chapter in chapters for one in chapter["steps"]}
    assert own in texts[step]


@pytest.mark.one_in(8)
@pytest.mark.parametrize("language", ["de", "en"])
@pytest.mark.parametrize("scene", scene_ids())
def test_titles_of_a_chapter_tell_its_steps_apart(scene: str, language: str) -> None:
    for chapter in derived.told(scene, language)["chapters"]:
        titles = [step["title"] for step in chapter["steps"]]
        assert sorted(set(titles)) == sorted(titles)


def test_steps_that_are_alike_say_whose_they_are_and_others_do_not() -> None:
    for scene, titles in {
        "double-pendulum": ["Virtual work: weight (upper bob)", "Virtual work: weight (lower bob)"],
        "pendulum": ["Virtual work: weight"],
    }.items():
        works = [step for chapter in derived.told(scene, "en")["chapters"] for step in chapter["steps"]]
        assert [step["title"] for step in works if step["rule"] == "work-of-force"] == titles
        assert all(step["title"] in step["announced"] for step in works if step["rule"] == "work-of-force")
