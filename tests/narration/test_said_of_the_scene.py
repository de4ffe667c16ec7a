"""What steps say in words is true of the scene: of constraints, of time, of bodies that turn, of what is missing."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from tests.mechanics.test_problems import BY_TOPIC, document

from deltaq.narration.derive import derive_request

SPHERE = "Particle that leaves a smooth sphere: the normal force and where it vanishes"
WIRE = "The same in the plane, by a rheonomic constraint: the force of the wire"
HOOP = "Hoop rolling down an incline, friction by a multiplier (Goldstein, Poole, Safko, §2.4)"
DISC = "Disc rolling upright on a plane (Goldstein, Poole, Safko, §1.3)"
FREE = "Two bodies under their gravitation"
YOYO = "Yo-yo: a disc that unwinds from its string"
ALL = (SPHERE, WIRE, HOOP, DISC, FREE, YOYO)
WORDS = {
    "multiplier": {"en": "multiplier", "de": "Multiplikator"},
    "independent": {"en": "variations are independent", "de": "Variationen sind unabhängig"},
    "time": {"en": "rates and time", "de": "Geschwindigkeiten und Zeit"},
    "moments": {"en": "moments of inertia", "de": "Trägheitsmomente"},
    "euler": {"en": "Euler", "de": "Euler"},
}


@cache
def told(topic: str, lang: str) -> dict[str, Any]:
    return dict(derive_request({"scene": document(BY_TOPIC[topic]), "lang": lang}))


def steps(topic: str, lang: str, rule: str) -> list[dict[str, Any]]:
    return [step for c in told(topic, lang)["chapters"] for step in c["steps"] if step["rule"] == rule]


def says(step: dict[str, Any], word: str, lang: str) -> bool:
    return WORDS[word][lang] in step["text"]


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("topic", ALL)
def test_an_equation_is_of_the_second_kind_unless_a_multiplier_stands_in_it(topic: str, lang: str) -> None:
    result = told(topic, lang)["result"]
    held = {force["coordinate"] for constraint in result["constraints"] for force in constraint["forces"]}
    for step in steps(topic, lang, "equation"):
        assert says(step, "multiplier", lang) is (step["id"].partition(":")[2] in held)
    (title,) = [chapter["title"] for chapter in told(topic, lang)["chapters"] if chapter["id"] == "lagrange"]
    assert (WORDS["multiplier"][lang] in title) is bool(held)


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("topic", ALL)
def test_variations_that_constraints_bind_are_not_called_independent(topic: str, lang: str) -> None:
    (step,) = steps(topic, lang, "generalized-forces")
    assert says(step, "independent", lang) is (not told(topic, lang)["result"]["constraints"])


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("topic", ALL)
def test_a_reaction_depends_on_time_where_it_is_said_to(topic: str, lang: str) -> None:
    by_name = {c["name"]: c["reaction"]["plain"] for c in told(topic, lang)["result"]["constraints"]}
    for step in steps(topic, lang, "multiplier"):
        assert says(step, "time", lang) is ("*t)" in by_name[step["id"].partition(":")[2]])


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize(
    ("topic", "word"), [(SPHERE, None), (FREE, None), (HOOP, "moments"), (YOYO, "moments"), (DISC, "euler")]
)
def test_the_work_of_inertia_is_that_of_bodies_that_turn(topic: str, word: str | None, lang: str) -> None:
    for step in steps(topic, lang, "inertia-work"):
        assert [each for each in ("moments", "euler") if says(step, each, lang)] == ([word] if word else [])


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("topic", ALL)
def test_what_is_missing_is_named_in_words(topic: str, lang: str) -> None:
    """And not by the name that the part has in the program."""
    titles = [step["title"] for step in steps(topic, lang, "left-out")]
    assert all("(" not in title and "-" not in title for title in titles)
    assert len(set(titles)) == len(titles)


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize(("scene", "on_positions"), [("four-bar", True), ("rolling-disc-in-space", False)])
def test_constraints_on_rates_are_differentiated_once(scene: str, lang: str, on_positions: bool) -> None:
    """What stands beside the accelerations is no part of Φ̈ where Φ holds the rates already."""
    answer = derive_request({"scene": scene, "lang": lang})
    said = [step["text"] for chapter in answer["chapters"] for step in chapter["steps"]]
    assert any("boldsymbol\\gamma" in text for text in said)
    assert on_positions or not any("ddot\\Phi" in text for text in said)


def test_numbers_of_an_equilibrium_have_units() -> None:
    """Multipliers, too, where the scene tells what they are measured in."""
    answer = derive_request({"scene": "four-bar", "lang": "en"})
    (first,) = [step for chapter in answer["chapters"] for step in chapter["steps"] if step["id"] == "equilibrium:1"]
    numbers = [line for line in first["latex"].split("\\\\[0.4em]") if "approx" in line]
    assert len(numbers) == 5
    assert all("\\text{rad}" in line or "\\text{N}" in line for line in numbers)


@pytest.mark.parametrize(
    ("scene", "place", "word"),
    [
        pytest.param("slider-crank", "crank", {"en": "fixed", "de": "fest:"}, id="a crank about its centre of mass"),
        pytest.param("slider-crank", "piston", {"en": "determine", "de": "legen"}, id="a piston"),
        pytest.param("foucault", "bob", {"en": "determine", "de": "legen"}, id="a bob on the turning earth"),
    ],
)
@pytest.mark.parametrize("lang", ["en", "de"])
def test_coordinates_determine_the_position_where_it_depends_on_any(
    scene: str, place: str, word: dict[str, str], lang: str
) -> None:
    answer = derive_request({"scene": scene, "lang": lang})
    (step,) = [s for chapter in answer["chapters"] for s in chapter["steps"] if s["id"] == f"position:{place}"]
    assert word[lang] in step["text"]
