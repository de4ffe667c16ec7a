"""Cyclic coordinates, the Jacobi energy and Routh's function, against what textbooks state."""

from __future__ import annotations

import pytest
import sympy as sp
from tests.derivation.model_scenes import heavy_top, model_steps, particle, rotating_hoop, spherical_pendulum
from tests.simulation.scenes import scene

from deltaq.derivation.conservation import cyclic, is_energy, jacobi_energy, jacobi_energy_rate, reduction
from deltaq.derivation.equilibria import free_coordinates
from deltaq.derivation.system import System
from deltaq.homework.statement import task_document
from deltaq.homework.workbook import Workbook
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request


def test_cyclic_coordinates() -> None:
    assert cyclic(System(spherical_pendulum())) == ("psi",)
    assert cyclic(System(heavy_top())) == ("psi", "phi")
    assert cyclic(System(load_scene("elastic-pendulum"))) == ()
    assert free_coordinates(System(spherical_pendulum())) == ("psi",)


def test_a_force_on_a_cyclic_coordinate_spoils_its_momentum() -> None:
    drag = {"kind": "force", "at": "bob", "force": ["-c*dot(x)", "0"]}
    assert cyclic(System(particle(["x", "y"], {"c": 0.1}, ["x", "y"], drag))) == ("y",)


def test_jacobi_energy_of_the_hoop_is_not_the_energy() -> None:
    system = System(rotating_hoop(5.0))
    r, m, g, speed = (system.q(name) for name in ("r", "m", "g", "Omega"))
    phi, rate = system.q("phi"), system.rate("phi")
    expected = m * r**2 * (rate**2 - speed**2 * sp.sin(phi) ** 2) / 2 - m * g * r * sp.cos(phi)
    assert system.is_zero(jacobi_energy(system) - expected)
    assert not is_energy(system)
    assert jacobi_energy_rate(system) == 0
    assert model_steps(rotating_hoop(5.0))["jacobi-energy"].about["outcome"] == "conserved"


@pytest.mark.parametrize(
    ("scene", "outcome"),
    [
        pytest.param("pendulum", "energy-conserved", id="pendulum"),
        pytest.param("elastic-pendulum", "energy-changes", id="follower force"),
        pytest.param("guided-pendulum", "changes", id="guide"),
        pytest.param("bead-on-rotating-hoop", "conserved", id="a hoop that has to be driven"),
        pytest.param("foucault", "both-conserved", id="a frame that turns takes no work"),
    ],
)
def test_what_is_said_of_the_jacobi_energy(scene: str, outcome: str) -> None:
    assert model_steps(load_scene(scene))["jacobi-energy"].about["outcome"] == outcome


REASONS = [
    pytest.param("damped-pendulum", "forces-work", id="drag"),
    pytest.param("guided-pendulum", "time-enters", id="a guide that oscillates"),
    pytest.param("driven-pendulum", "forces-work, time-enters", id="drag, and a moment V(q, t)"),
    pytest.param("pendulum", "", id="nothing"),
]


@pytest.mark.parametrize(("scene", "reason"), REASONS)
def test_why_it_changes(scene: str, reason: str) -> None:
    assert model_steps(load_scene(scene))["jacobi-energy"].about["reason"] == reason


def test_a_constraint_that_moves_is_a_reason() -> None:
    document = write_scene(load_scene("cartesian-pendulum"))
    (rod,) = document["constraints"]  # type: ignore[misc]
    moving = {**rod, "kind": "equation", "equation": "x^2 + y^2 - (l + g*t^2)^2 = 0"}  # type: ignore[dict-item]
    moving = {key: value for key, value in moving.items() if key not in ("from", "to", "length")}
    steps = model_steps(read_scene(document | {"constraints": [moving]}))
    assert steps["jacobi-energy"].about["reason"] == "constraints-move"


@pytest.mark.parametrize(
    ("scene", "potential"),
    [pytest.param("foucault", "effective-potential", id="a frame that turns"), pytest.param("pendulum", "potential")],
)
def test_which_potential_decides(scene: str, potential: str) -> None:
    assert model_steps(load_scene(scene))["equilibrium:1"].about["potential"] == potential


def test_where_the_motion_is_too_long_nothing_is_said_of_its_work() -> None:
    """Four masses in a frame that turns: four accelerations are not written out."""
    names = ("a", "b", "c", "d")
    turning = {name: [f"{name}*cos(omega*t)", f"{name}*sin(omega*t)"] for name in names}
    masses = {name: ("m", position) for name, position in turning.items()}
    system = scene(dict.fromkeys(names, (1.0, 0.0)), {"m": 1.0, "omega": 2.0}, masses)
    assert model_steps(system)["jacobi-energy"].about["outcome"] == "conserved-at-least"


def test_a_force_without_power_leaves_the_energy() -> None:
    """The force on a charge in a magnetic field."""
    lorentz = {"kind": "force", "at": "bob", "force": ["b*dot(y)", "-b*dot(x)"]}
    assert jacobi_energy_rate(System(particle(["x", "y"], {"b": 1.0}, ["x", "y"], lorentz))) == 0


def test_routh_function_of_the_spherical_pendulum() -> None:
    system = System(spherical_pendulum())
    reduced = reduction(system)
    assert reduced is not None
    m, l, g, theta = (system.q(name) for name in ("m", "l", "g", "theta"))
    p, rate = reduced.momenta["psi"], system.rate("theta")
    expected = m * l**2 * rate**2 / 2 + m * g * l * sp.cos(theta) - p**2 / (2 * m * l**2 * sp.sin(theta) ** 2)
    assert system.is_zero(reduced.function - expected)


def test_routh_function_of_the_heavy_top_has_two_momenta() -> None:
    system = System(heavy_top())
    reduced = reduction(system)
    assert reduced is not None
    values = {p: system.momentum(q) for q, p in reduced.momenta.items()}
    work = sum(system.momentum(q) * system.rate(q) for q in reduced.momenta)
    assert system.is_zero(reduced.function.xreplace(values) - system.lagrangian + work)
    assert not reduced.function.has(system.rate("psi"), system.rate("phi"))


def test_no_routh_function_without_something_left_to_move() -> None:
    assert reduction(System(particle(["x"], {}, ["x", "0"]))) is None
    assert reduction(System(load_scene("pendulum"))) is None


def thrown(restitution: str, gap: str) -> dict[str, object]:
    """A ball thrown over a floor."""
    return {
        "id": "thrown",
        "coordinates": [{"name": "x", "rate": 1.0}, {"name": "y", "value": 1.0}],
        "parameters": [{"name": "m"}, {"name": "g"}, {"name": "e", "value": 0.8, "positive": False}],
        "bodies": [{"name": "ball", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
        "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "-g"]}],
        "events": [{"name": "floor", "value": gap, "then": "bounce", "restitution": restitution}],
    }


FLOOR = ("floor",)


@pytest.mark.parametrize(
    ("restitution", "gap", "momentum", "energy"),
    [
        pytest.param("e", "y", (), FLOOR, id="a loss: the energy only between impacts"),
        pytest.param("1", "y", (), (), id="nothing lost: both throughout"),
        pytest.param("1", "y - sin(t)/10", (), FLOOR, id="a table that moves feeds energy in"),
        pytest.param("1", "y - x/10", FLOOR, (), id="a slope takes momentum"),
        pytest.param("0", "2 - sqrt(x^2 + y^2)", FLOOR, FLOOR, id="a string"),
    ],
)
def test_between_which_impacts_quantities_are_conserved(
    restitution: str, gap: str, momentum: tuple[str, ...], energy: tuple[str, ...]
) -> None:
    found = derive_request({"scene": thrown(restitution, gap), "lang": "en"})
    quantities = (each for each in found["result"]["conserved"] if each["kind"] != "symmetry")
    told = {each["kind"]: tuple(each.get("contacts", ())) for each in quantities}
    assert told == {"momentum": momentum, "energy": energy}
    texts = {step["rule"]: step["text"] for chapter in found["chapters"] for step in chapter["steps"]}
    for rule, contacts in (("cyclic-coordinate", momentum), ("jacobi-energy", energy)):
        assert ("as long as no contact acts" in texts[rule]) is bool(contacts)


@pytest.mark.parametrize(
    ("scene", "contact"), [("catching-pendulum", "taut"), ("bouncing-ball", "impact"), ("pendulum", None)]
)
@pytest.mark.parametrize(("language", "words"), [("en", "as long as no contact acts"), ("de", "solange kein Kontakt")])
def test_all_that_impacts_of_the_library_change_is_told_so(
    scene: str, contact: str | None, language: str, words: str
) -> None:
    answer = derive_request({"scene": scene, "lang": language})
    quantities = answer["result"]["conserved"]
    assert quantities
    assert {tuple(each.get("contacts", ())) for each in quantities} == ({(contact,)} if contact else {()})
    steps = {step["id"]: step["text"] for chapter in answer["chapters"] for step in chapter["steps"]}
    assert all((words in steps[each["step"]]) is bool(contact) for each in quantities)


def test_the_task_says_between_which_impacts() -> None:
    sheet = Workbook(load_scene("catching-pendulum"))
    wanted = [each for each in sheet.tasks if each.quantity.kind == "conserved"]
    assert wanted
    for language, words in (("en", "between impacts"), ("de", "zwischen Stößen")):
        assert all(words in str(task_document(each, sheet, language)["statement"]) for each in wanted)
