"""Constraints that follow from others: the equations hold, the multipliers are not unique, and that is said."""

from __future__ import annotations

from typing import Any

import pytest
from tests.simulation.constrained import platform

from deltaq.derivation.chapters import constraints
from deltaq.derivation.engine import derive
from deltaq.derivation.impacts import contacts
from deltaq.derivation.multipliers import multipliers
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request

Document = dict[str, Any]


def beside(rods: int) -> Scene:
    """A platform, and two coordinates of a particle that falls: fewer constraints than coordinates."""
    document: Document = write_scene(platform(rods))
    document["coordinates"] += [{"name": "u", "value": 3.0}, {"name": "v", "value": 0.0}]
    document["bodies"].append({"name": "ball", "kind": "particle", "mass": "m", "position": ["u", "v"]})
    return read_scene(document)


REDUNDANT = [
    pytest.param(platform(3), 1, id="as many as coordinates"),
    pytest.param(platform(4), 1, id="more than coordinates"),
    pytest.param(beside(3), 3, id="fewer than coordinates"),
    pytest.param(platform(3, positive=True), 1, id="of positive lengths"),
]


@pytest.mark.parametrize("formulation", ["dalembert-lagrange", "hamilton"])
@pytest.mark.parametrize(("scene", "freedoms"), REDUNDANT)
def test_every_step_holds_and_no_multiplier_is_given_a_value(scene: Scene, freedoms: int, formulation: str) -> None:
    system, derivation = derive(scene, formulation)
    assert [step.id for step in derivation.steps() if not step.verified] == []
    assert multipliers(system) is None
    assert system.effort.left_out["multipliers"] == system.effort.left_out["equilibria"] == "dependent"
    assert scene.degrees_of_freedom == freedoms
    *_, augmented, last = constraints(system)
    assert (augmented.id, augmented.about) == ("augmented-system", {"outcome": "dependent"})
    assert (last.id, last.about) == ("left-out:multipliers", {"outcome": "multipliers-dependent"})


@pytest.mark.parametrize("language", ["de", "en"])
def test_the_answer_says_what_is_determined_and_what_is_not(language: str) -> None:
    told = derive_request({"scene": write_scene(platform(3)), "lang": language})
    texts = {each["part"]: each["text"] for each in told["left_out"] if each["reason"] == "dependent"}
    assert texts.keys() == {"multipliers", "equilibria"}
    assert {"de": "nicht aber jeder einzelne", "en": "but not each multiplier"}[language] in texts["multipliers"]
    result = told["result"]
    assert (result["degrees_of_freedom"], result["equilibria"], result["equilibrium_search"]) == (1, [], None)
    assert [each["reaction"] for each in result["constraints"]] == [None] * 3
    (step,) = (s for chapter in told["chapters"] for s in chapter["steps"] if s["id"] == "augmented-system")
    assert {"de": "mehrere", "en": "several"}[language] in step["text"]


def test_two_rods_have_multipliers_and_equilibria() -> None:
    """They are independent wherever the platform does not lie in line with them."""
    told = derive_request({"scene": write_scene(platform(2)), "lang": "en"})
    assert told["result"]["degrees_of_freedom"] == 1
    assert len(told["result"]["equilibria"]) == 4
    assert "dependent" not in {each["reason"] for each in told["left_out"]}


def test_an_impact_has_no_closed_form_in_rows_that_depend_on_one_another() -> None:
    document: Document = write_scene(platform(3))
    document["events"] = [{"name": "wall", "value": "x + 0.2", "then": "bounce", "restitution": "1"}]
    (contact,) = contacts(System(read_scene(document)))
    assert contact.impact is None
