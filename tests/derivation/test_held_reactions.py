"""What holds a released quantity beside friction that sticks, contacts that rest, and at impacts."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random
from typing import Any

import numpy as np
import pytest
import sympy as sp
from tests.simulation.rods import ASKED, block, friction, hinged, rod, wind
from tests.simulation.test_impact import contact

from deltaq.derivation.engine import reactions
from deltaq.derivation.held_reactions import held_reactions, reaction_impulses, rivals
from deltaq.derivation.released import Release
from deltaq.derivation.system import System
from deltaq.language.parser import parse
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.document import read_scene
from deltaq.narration.derive import derive_request
from deltaq.simulation.service import run

WALL = contact("wall", "l*sin(phi) + 0.3", 0.5)
ARC = friction("l*phi", 1.0, 8.0)


def release(scene: dict[str, Any], name: str) -> Release:
    return Release.of(System(read_scene(scene)), name)


def is_same(found: Release, value: sp.Expr | None, expected: str) -> bool:
    system = found.system
    return value is not None and system.is_zero(
        value - to_sympy(parse(expected, system.scene.names).tree, system.symbols)
    )


# By hand: the weight G = 9.81 m along the rod is m G cos φ, and along the arc m G sin φ, which friction takes at rest.
BY_HAND = [
    pytest.param(rod(ARC), "friction", "-9.81*m*(cos(phi) + phi*sin(phi))", id="friction along the arc"),
    pytest.param(rod(events=(WALL,)), "contact", "-9.81*m/cos(phi)", id="a wall takes what is across"),
    pytest.param(rod(wind(-7.0), events=(WALL,)), "contact", "-9.81*m/cos(phi)", id="the wall takes the wind as well"),
]


@pytest.mark.parametrize(("scene", "kind", "expected"), BY_HAND)
def test_reactions_at_rest_are_those_of_statics(scene: dict[str, Any], kind: str, expected: str) -> None:
    found = release(scene, "l")
    (beside,) = held_reactions(found)
    assert beside.kind == kind
    assert is_same(found, beside.value, expected)


def test_the_impulse_in_a_rod_is_that_of_the_wall_along_it() -> None:
    """Λ = −(1 + e) m l φ̇/cos φ at a wall across, of which the rod takes −Λ sin φ."""
    found = release(rod(events=(WALL,)), "l")
    (impulse,) = reaction_impulses(found)
    assert is_same(found, impulse.value, "1.5*m*l*dot(phi)*sin(phi)/cos(phi)")


def test_friction_without_a_part_in_it_changes_nothing() -> None:
    assert list(held_reactions(release(rod(friction("phi", 1.0, 2.0)), "l"))) == []


def test_nothing_tells_what_friction_takes_of_what_a_guide_holds_at_rest() -> None:
    still, moved = (release(block({"x": guide, "y": "0"}), "x") for guide in ("0", "sin(t)"))
    assert (rivals(still), rivals(moved)) == (("dry",), ())


SCENES = [
    pytest.param(rod(ARC), "l", {"held-reaction:l:dry": "friction"}, id="friction"),
    pytest.param(
        rod(ARC, events=(WALL,)),
        "l",
        {"held-reaction:l:dry": "friction", "held-reaction:l:wall": "contact", "reaction-impulse:l:wall": None},
        id="friction and a wall",
    ),
    pytest.param(
        hinged(Random(1))[0],
        "l",
        {
            "held-reaction:l:dry": "friction",
            "held-reaction:l:right": "contact",
            "held-reaction:l:left": "contact",
            "reaction-impulse:l:right": None,
            "reaction-impulse:l:left": None,
        },
        id="a cart with friction, and walls",
    ),
    pytest.param(block({"x": "0", "y": "0"}), "x", {}, id="friction on what is held at rest"),
    pytest.param(
        rod(ARC, {**friction("phi^2", 1.0, 2.0), "name": "more"}),
        "l",
        {"held-reaction:l:dry": "friction"},
        id="friction without a part in it",
    ),
]


@pytest.mark.parametrize(("scene", "name", "expected"), SCENES)
def test_every_step_is_verified(scene: dict[str, Any], name: str, expected: dict[str, str | None]) -> None:
    chapter = reactions(release(scene, name))
    steps = [step for each in chapter.steps for step in each.walk()]
    assert [step.id for step in steps if not step.verified] == []
    assert {each.id: each.about.get("outcome") for each in chapter.steps[3:]} == expected


def steps_of(scene: dict[str, Any], name: str, language: str) -> list[dict[str, Any]]:
    found: Any = derive_request({"scene": scene, "release": [name], "lang": language})
    (chapter,) = (each for each in found["chapters"] if each["id"] == "reactions")
    return list(chapter["steps"])


@pytest.mark.parametrize("language", ["de", "en"])
def test_steps_say_when_each_expression_holds(language: str) -> None:
    told = {each["id"]: each["text"] for each in steps_of(rod(ARC, events=(WALL,)), "l", language)}
    slipping, resting = told["held-reaction:l:dry"], told["held-reaction:l:wall"]
    assert {"en": "that of slipping", "de": "gilt beim Gleiten"}[language] in slipping
    assert {"en": "that of an open contact", "de": "gilt bei offenem Kontakt"}[language] in resting


def test_constraints_leave_the_expression_of_sticking_out_and_say_so() -> None:
    scene = hinged(Random(1))[1]
    scene["parameters"].append({"name": "h", "value": 0.0, "positive": False})
    scene["bodies"][1]["position"][1] += " + h"
    scene["loads"][2]["coordinate"] = "x + h"
    (step,) = (each for each in steps_of(scene, "h", "en") if each["id"] == "held-reaction:h:dry")
    assert step["latex"] == "\\begin{aligned}\\end{aligned}" or not step["latex"]
    assert "constraints have a part in it" in step["text"]


def test_motions_have_one_of_the_expressions_at_all_times() -> None:
    """Z of slipping or of sticking at the samples of motions without walls; some do both."""
    both = 0
    for seed in range(6):
        scene = hinged(Random(seed))[0] | {"events": []}
        asked = {"scene": scene, "t_end": 3.0, "samples": 61}
        found: Any = run({**asked, "release": ["l"], **ASKED})
        between = np.array([all(abs(t - each["time"]) > 1e-6 for each in found["events"]) for t in found["t"]])
        slipping, sticking = (gap[between] for gap in gaps(scene, found))
        np.testing.assert_array_less(np.minimum(slipping, sticking), 1e-6)
        both += bool((slipping < sticking).any() and (slipping > sticking).any())
    assert both > 0


def gaps(scene: dict[str, Any], found: dict[str, Any]) -> Iterator[np.ndarray]:
    """How far Z of a motion is from the expression of slipping, and of sticking."""
    held = release(scene, "l")
    (sticking,) = held_reactions(held)
    symbols = [*map(held.system.q, ("x", "phi")), *map(held.system.rate, ("x", "phi"))]
    values = {held.system.q(each["name"]): each["value"] for each in scene["parameters"]}
    states = [np.array(found[part][name]) for part in ("coordinates", "rates") for name in ("x", "phi")]
    for expression in (held.closed, sticking.value):
        assert expression is not None
        told = sp.lambdify(symbols, expression.xreplace(values), "numpy")(*states)
        yield np.abs(told - np.array(found["multipliers"]["l"]))
