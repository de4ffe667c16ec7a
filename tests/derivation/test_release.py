"""Reactions by release: what holds a length or a guided coordinate, in all scenes, against Newton's law."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp

from deltaq.derivation.engine import reactions
from deltaq.derivation.released import Release
from deltaq.derivation.system import System
from deltaq.errors import UnknownNameError
from deltaq.language.parser import parse
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.changes import change
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.release import held
from deltaq.narration.derive import derive_request
from deltaq.simulation.service import run

HELD = [
    pytest.param(scene, each.name, id=f"{scene} {each.name}")
    for scene in scene_ids()
    for each in held(load_scene(scene))
]


@pytest.mark.one_in(5)
@pytest.mark.parametrize(("scene", "name"), HELD)
def test_every_step_holds_exactly(scene: str, name: str) -> None:
    chapter = reactions(Release.of(System(load_scene(scene)), name))
    steps = [step for each in chapter.steps for step in each.walk()]
    assert [step.id for step in steps if not step.verified] == []
    assert {step.evidence.kind for step in steps} == {"exact"}
    assert len({step.id for step in steps}) == len(steps)


# Z by Newton's law, in the direction in which what is released grows; a string or rod in tension has Z < 0.
REACTIONS = [
    # Towards the pivot: m l φ̇² is what the circle needs, m g cos φ what the weight takes of it.
    pytest.param("pendulum", "l", "-m*(l*dot(phi)^2 + g*cos(phi))"),
    pytest.param("string-pendulum", "l", "-m*(l*dot(phi)^2 + g*cos(phi))"),
    pytest.param("conical-pendulum", "l", "-m*(g*cos(theta) + l*(dot(theta)^2 + sin(theta)^2*dot(psi)^2))"),
    # m₂ falls with a = (m₂ − m₁) g/(m₁ + m₂ + J/R²): the string holds m₂ (g − a).
    pytest.param("atwood", "l", "-m2*(g - (m2 - m1)*g/(m1 + m2 + J/R^2))"),
    # The pivot has no mass: the spring force k y is what the rod has in its direction.
    pytest.param("elastic-pendulum", "l", "-k*y/cos(phi)"),
    # In the frame of the pivot the weight is m (g − ÿ), with y downwards: y = y₀ sin ωt.
    pytest.param("guided-pendulum", "l", "-m*(l*dot(phi)^2 + (g + y0*omega^2*sin(omega*t))*cos(phi))"),
    # The guide holds what the rod pulls down with, S cos φ.
    pytest.param("guided-pendulum", "y", "-m*(l*dot(phi)^2 + (g + y0*omega^2*sin(omega*t))*cos(phi))*cos(phi)"),
    # Bead on a hoop of radius R, θ from below; its normal force is outwards where R Ω² sin²θ + R θ̇² + g cos θ < 0.
    pytest.param("bead-on-rotating-hoop", "R", "-m*(R*dot(theta)^2 + R*Omega^2*sin(theta)^2 + g*cos(theta))"),
    # The moment that keeps the hoop turning evenly is the rate of angular momentum, d/dt (m R² sin²θ Ω).
    pytest.param("bead-on-rotating-hoop", "psi", "m*R^2*Omega*2*sin(theta)*cos(theta)*dot(theta)"),
    # The rod of a pendulum on a cart pulls with M m (l φ̇² + g cos φ)/(M + m sin²φ).
    pytest.param("cart-pendulum", "l", "-M*m*(l*dot(phi)^2 + g*cos(phi))/(M + m*sin(phi)^2)"),
    # What lifts the top's centre of mass along its axis: m g cos θ less m l times the square of the axis' turning.
    pytest.param("heavy-top", "l", "m*(g*cos(theta) - l*(dot(theta)^2 + sin(theta)^2*dot(psi)^2))"),
    # A rod's centre of mass is at l/2, and the pivot carries all of it.
    pytest.param("physical-pendulum", "l", "-m*(l*dot(phi)^2/2 + g*cos(phi))"),
    # The wind blows to the side with w l²/2 in all.
    pytest.param("wind-on-rod", "l", "-m*(l*dot(phi)^2/2 + g*cos(phi)) - w*l^2/2*sin(phi)"),
    # What the hoop exerts on the bead; the hoop's own moment of inertia has nothing to do with it.
    pytest.param("bead-on-free-hoop", "R", "-m*(R*dot(theta)^2 + R*dot(psi)^2*sin(theta)^2 + g*cos(theta))"),
    # The plane carries the disc.
    pytest.param("rolling-disc", "R", "m*g*cos(alpha)"),
    # Strings hang straight down; nothing pulls the masses apart.
    pytest.param("atwood", "R", "0"),
    pytest.param("swinging-atwood", "a", "0"),
    # A rod that is a constraint has the force that its multiplier is.
    pytest.param("cartesian-pendulum", "l", "-m*(g*y + (x*dot(y) - y*dot(x))^2/(x^2 + y^2))/sqrt(x^2 + y^2)"),
    pytest.param("double-pendulum-by-rods", "l1", "-S1"),
    pytest.param("double-pendulum-by-rods", "l2", "-S2"),
    # The wheel follows the road through its tyre.
    pytest.param("quarter-car", "w", "k1*(w0*sin(omega*t) - z1)"),
]


@pytest.mark.parametrize(("scene", "name", "expected"), REACTIONS)
def test_reactions_are_the_forces_of_newtons_law(scene: str, name: str, expected: str) -> None:
    system = System(load_scene(scene))
    found = Release.of(system, name).closed
    assert found is not None
    assert system.is_zero(found - to_sympy(parse(expected, system.scene.names).tree, system.symbols))


def test_the_lower_rod_of_a_double_pendulum_pulls_the_upper_bob() -> None:
    """S₁ and S₂ at rest, hanging straight down and turned by 90°: weights alone."""
    system = System(load_scene("double-pendulum"))
    still = {f"dot(phi{k})": 0.0 for k in (1, 2)}
    forces = {name: -Release.of(system, name).value for name in ("l1", "l2")}
    hanging = {"phi1": 0.0, "phi2": 0.0, **still, "m1": 2.0, "m2": 3.0, "l1": 1.0, "l2": 0.5, "g": 9.81}
    assert [_at(force, hanging) for force in forces.values()] == pytest.approx([5.0 * 9.81, 3.0 * 9.81])
    # Let go with both rods horizontal everything falls freely at the outer end; nothing pulls along the rods.
    level = {**hanging, "phi1": float(sp.pi / 2), "phi2": float(sp.pi / 2)}
    assert [_at(force, level) for force in forces.values()] == pytest.approx([0.0, 0.0], abs=1e-12)


def _at(value: sp.Expr, point: dict[str, float]) -> float:
    return float(value.xreplace({symbol: point[symbol.name] for symbol in value.free_symbols}))


def test_a_frozen_coordinate_has_a_reaction_too() -> None:
    """The pivot held at y₀ by the spring k y₀, by the rod, and by what freezes it: Z = k y₀ − S cos φ."""
    system = System(change(load_scene("elastic-pendulum"), freeze=["y"]))
    found = Release.of(system, "y").closed
    expected = parse("k*y_0 - m*(l*dot(phi)^2 + g*cos(phi))*cos(phi)", system.scene.names).tree
    assert found is not None
    assert system.is_zero(found - to_sympy(expected, system.symbols))


def test_what_is_too_long_without_accelerations_keeps_them() -> None:
    system = System(load_scene("triple-pendulum"))
    release = Release.of(system, "l1")
    assert release.closed is None
    assert release.value == release.in_motion
    assert release.value.has(system.acceleration("phi2"))


def test_motion_and_freedom_stay_those_of_the_scene() -> None:
    plain, released = (derive_request({"scene": "pendulum", "lang": "en", **more}) for more in ({}, {"release": ["l"]}))
    assert {**released["result"], "reactions": []} == plain["result"]  # type: ignore[dict-item]
    assert [chapter["id"] for chapter in released["chapters"]][-2:] == ["reactions", "model"]  # type: ignore[attr-defined]
    (reaction,) = released["result"]["reactions"]  # type: ignore[index]
    assert (reaction["name"], reaction["kind"], reaction["closed"]) == ("l", "length", True)
    assert reaction["reaction"]["plain"] == "-m*(l*dot(phi)^2 + g*cos(phi))"
    assert reaction["force"]["plain"] == "m*(l*dot(phi)^2 + g*cos(phi))"


@pytest.mark.parametrize(
    ("scene", "name", "known"),
    [
        pytest.param("pendulum", "m", "l", id="no length"),
        pytest.param("pendulum", "phi", "l", id="free"),
        pytest.param("pendulum", "nothing", "l", id="unknown"),
        pytest.param("charged-particle", "m", "", id="of nothing that is held"),
    ],
)
def test_what_nothing_holds_is_refused_at_its_place(scene: str, name: str, known: str) -> None:
    with pytest.raises(UnknownNameError) as caught:
        derive_request({"scene": scene, "release": ["l", name] if known else [name]})
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer) == ("cannot-release", f"/release/{1 if known else 0}")
    assert dict(problem.parameters) == {"name": name, "known": known}


DRAWN = [
    pytest.param(scene, dict(element.options)["label"], id=f"{scene} {dict(element.options)['label']}")
    for scene in scene_ids()
    for element in load_scene(scene).drawing.elements
    if element.kind in ("rod", "string") and "label" in dict(element.options)
]


@pytest.mark.parametrize(("scene", "length"), DRAWN)
def test_every_rod_and_string_that_is_drawn_can_be_asked_what_holds_it(scene: str, length: str) -> None:
    """All but the string that is a contact, whose force is that of the contact, and what is a coordinate."""
    given = load_scene(scene)
    told = {each.name for each in held(given)} | {coordinate.name for coordinate in given.coordinates}
    contacts = {name for event in given.events if event.bounces for name in event.value.names}
    assert length in told | contacts


@pytest.mark.parametrize("language", ["de", "en"])
@pytest.mark.parametrize("scene", scene_ids())
def test_what_is_held_is_told_with_all_names_put_in(scene: str, language: str) -> None:
    """By its kind: of a rod with mass, at which end, what moves, and by how much."""
    names = [each.name for each in held(load_scene(scene)) if each.shift is not None]
    if not names:
        return
    derived = derive_request({"scene": scene, "lang": language, "release": names})
    (steps,) = (chapter["steps"] for chapter in derived["chapters"] if chapter["id"] == "reactions")  # type: ignore[attr-defined]
    for step in steps:
        assert not {"{", "}"} & set(_words(step["text"]))
        assert "_{}" not in step["latex"]
    labels = load_scene(scene).labels
    for found in derived["result"]["reactions"]:  # type: ignore[index]
        (step,) = (step for step in steps if step["id"] == f"release:{found['name']}")
        assert (found["at"] is not None) is (found["kind"] == "rod") is (found["force"] is not None)
        if found["at"]:
            assert f"({labels[found['at']][language].plain})" in step["text"]


def _words(text: str) -> str:
    """A sentence without its mathematics."""
    return "".join(text.split("$")[::2])


@pytest.mark.parametrize(
    ("scene", "kind", "has_force"),
    [
        pytest.param("pendulum", "length", True, id="one rod"),
        pytest.param("string-pendulum", "length", True, id="one string"),
        pytest.param("coupled-pendulums", "lengths", False, id="two rods of the same length"),
    ],
)
@pytest.mark.parametrize("language", ["de", "en"])
def test_what_holds_a_length_of_several_rods_is_no_force_of_one(
    scene: str, kind: str, language: str, *, has_force: bool
) -> None:
    """At rest each of two rods carries m g, and Z is −2 m g."""
    derived = derive_request({"scene": scene, "lang": language, "release": ["l"]})
    (found,) = derived["result"]["reactions"]  # type: ignore[index]
    (step,) = (
        step
        for chapter in derived["chapters"]  # type: ignore[attr-defined]
        for step in chapter["steps"]
        if step["rule"] == "reaction"
    )
    assert found["kind"] == kind
    assert (found["force"] is not None) is has_force
    assert ("S = -Z" in step["text"]) is has_force
    assert ({"de": "Summe", "en": "sum"}[language] in step["text"]) is not has_force
    told = run({"scene": scene, "t_end": 1.0, "release": ["l"]})["reactions"]
    assert told == {"l": {"unit": "N", "of_rod": has_force}}


# ∂r/∂l of the places that move: where a force that works on it alone may act.
DISPLACEMENTS = [
    pytest.param("pendulum", "l", {"bob": ("sin(phi)", "cos(phi)")}, id="a rod"),
    pytest.param(
        "guided-pendulum", "y", {"pivot": ("0", "1"), "bob": ("0", "1")}, id="a guide moves all that hangs on it"
    ),
    pytest.param(
        "double-pendulum",
        "l1",
        {"upper": ("sin(phi1)", "cos(phi1)"), "lower": ("sin(phi1)", "cos(phi1)")},
        id="a rod that carries another",
    ),
]


@pytest.mark.parametrize(("scene", "name", "expected"), DISPLACEMENTS)
def test_a_result_says_which_places_move_with_the_released(
    scene: str, name: str, expected: dict[str, tuple[str, ...]]
) -> None:
    found: Any = derive_request({"scene": scene, "release": [name]})["result"]
    (reaction,) = found["reactions"]
    assert {place: tuple(along) for place, along in reaction["displacements"].items()} == expected
