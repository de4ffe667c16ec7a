"""Impacts and sticking as steps, against textbooks' closed forms: collisions, a rod that strikes a floor, friction."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pytest
import sympy as sp

from deltaq.derivation.engine import derive
from deltaq.derivation.formula import Equation, Inserted, MatrixTimes, Named
from deltaq.derivation.linearization import linearizations
from deltaq.derivation.step import Derivation
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request


def derived(document: Mapping[str, Any]) -> tuple[System, Derivation]:
    names = {"format": 1, "id": "contact", "title": "contact", "dimension": 2}
    return derive(read_scene({**names, **document}))


def parameters(*names: str) -> list[dict[str, object]]:
    return [{"name": name, "value": 1.0, "positive": name != "e"} for name in names]


def quantities(derivation: Derivation, rule: str) -> dict[tuple[str, str], sp.Expr]:
    """What the steps of a rule say: the last member of each line that names a quantity first. All is verified."""
    steps = [step for step in derivation.steps() if step.rule == rule]
    assert steps
    assert all(step.verified for step in derivation.steps())
    lines = [line for step in steps for line in step.relations if isinstance(line.before, Named)]
    return {(line.before.quantity.kind, line.before.quantity.of): line.after.value for line in lines}


def same(system: System, found: sp.Expr, expected: str, *names: str) -> bool:
    """Whether a result is what a textbook has, in the scene's own names; ẋ is written dx."""
    letters = {name: system.q(name) for name in names} | {f"d{q}": system.rate(q) for q in system.free}
    return sp.simplify(found - sp.sympify(expected, locals={**letters, "e": letters.get("e", sp.Symbol("e"))})) == 0


def on_line(loads: Sequence[Mapping[str, object]] = (), events: Sequence[Mapping[str, object]] = ()) -> dict[str, Any]:
    """Two masses on a line."""
    bodies = [
        {"name": name, "kind": "particle", "mass": mass, "position": [place, "0"]}
        for name, mass, place in (("a", "m", "x"), ("b", "M", "y"))
    ]
    coordinates = [{"name": "x"}, {"name": "y", "value": 1.0}]
    return {
        "coordinates": coordinates, "parameters": parameters("m", "M", "e", "k", "F", "S", "u"), "bodies": bodies,
        "loads": list(loads), "events": list(events),
    }  # fmt: skip


def test_two_masses_that_collide() -> None:
    """Δp = (1 + e) m M/(m + M) (ẋ − ẏ), and ½ (1 − e²) m M/(m + M) (ẋ − ẏ)² is lost (Szabó)."""
    event = {"name": "hit", "value": "y - x", "then": "bounce", "restitution": "e"}
    system, derivation = derived(on_line(events=[event]))
    found, names = quantities(derivation, "impact-law"), ("m", "M", "e")
    reduced = "m*M/(m + M)"
    assert same(system, found["impulse", ""], f"(1 + e)*{reduced}*(dx - dy)", *names)
    assert same(system, found["momentum-jump", "x"], f"-(1 + e)*{reduced}*(dx - dy)", *names)
    assert same(system, found["rate-jump", "y"], "(1 + e)*m/(m + M)*(dx - dy)", *names)
    assert same(system, found["gap-rate-behind", ""], "-e*(dy - dx)", *names)
    assert same(system, found["impact-loss", ""], f"(1 - e**2)*{reduced}*(dx - dy)**2/2", *names)


def test_a_rod_strikes_a_floor_with_its_end() -> None:
    """Λ = −(1 + e) ġ/(1/m + (l cos φ)²/J) with g = y − l sin φ: the rod turns where its end is stopped."""
    rod = {"name": "rod", "kind": "rigid", "mass": "m", "position": ["0", "y"], "inertia": "J", "angle": "phi"}
    system, derivation = derived(
        {
            "coordinates": [{"name": "y", "value": 2.0}, {"name": "phi", "unit": "rad", "value": 0.5}],
            "parameters": parameters("m", "J", "l", "g", "e"),
            "bodies": [rod],
            "loads": [{"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}],
            "events": [{"name": "floor", "value": "y - l*sin(phi)", "then": "bounce", "restitution": "e"}],
        }
    )
    found, names = quantities(derivation, "impact-law"), ("m", "J", "l", "e", "phi")
    impulse = "-(1 + e)*(dy - l*cos(phi)*dphi)/(1/m + l**2*cos(phi)**2/J)"
    assert same(system, found["impulse", ""], impulse, *names)
    assert same(system, found["rate-jump", "phi"], f"-({impulse})*l*cos(phi)/J", *names)
    loss = "(1 - e**2)*(dy - l*cos(phi)*dphi)**2/(1/m + l**2*cos(phi)**2/J)/2"
    assert same(system, found["impact-loss", ""], loss, *names)


def test_a_wall_that_moves_may_feed_energy() -> None:
    """A ball at rest that a wall of speed u meets leaves with (1 + e) u, and has ½ m (1 + e)² u²."""
    event = {"name": "wall", "value": "x - u*t", "then": "bounce", "restitution": "e"}
    system, derivation = derived(on_line(events=[event]))
    found, names = quantities(derivation, "impact-law"), ("m", "e", "u")
    at_rest = {system.rate("x"): 0}
    assert same(system, found["rate-jump", "x"].subs(at_rest), "(1 + e)*u", *names)
    assert same(system, found["impact-loss", ""].subs(at_rest), "-m*(1 + e)**2*u**2/2", *names)


def test_a_gap_that_only_guides_change_has_no_impact() -> None:
    """It has no direction for one; a contact beside it keeps its own, and its name."""
    wall, hit = ({"name": name, "value": value, "then": "bounce", "restitution": "e"}
                 for name, value in (("wall", "2*y + 3"), ("hit", "y - x")))  # fmt: skip
    guided = {**on_line(events=[wall, hit]), "guides": [{"coordinate": "y", "value": "1 + u*sin(t)"}]}
    system, derivation = derived(guided)
    contact = [step.id for step in derivation.steps() if step.rule in ("contact-gap", "impact-law")]
    assert contact == ["contact-gap:hit", "impact-law:hit"]
    found = quantities(derivation, "impact-law")
    rate = "dx - u*cos(t)"
    assert same(system, found["momentum-jump", "x"], f"-(1 + e)*m*({rate})", "m", "e", "u", "t")


def test_what_holds_a_block_and_how_long() -> None:
    """A block on a belt of speed u is held by k (x − y), up to S, while another block slips by itself."""
    friction = {"kind": "friction", "name": "belt", "coordinate": "x", "force": "F", "static": "S", "surface_rate": "u"}
    spring = {"kind": "potential", "name": "spring", "energy": "k*(x - y)^2/2"}
    system, derivation = derived(on_line([friction, spring]))
    found, names = quantities(derivation, "sticking-condition"), ("k", "S", "x", "y")
    assert same(system, found["holding-force", "belt"], "k*(x - y)", *names)
    assert same(system, found["largest-holding-force", "belt"], "S", *names)


def test_a_belt_that_speeds_up_takes_its_block_along() -> None:
    """R = m u̇: what the inertia of a block that is carried needs."""
    friction = {"kind": "friction", "name": "belt", "coordinate": "x", "force": "F", "surface_rate": "u*t^2"}
    system, derivation = derived(on_line([friction]))
    held = quantities(derivation, "sticking-condition")["holding-force", "belt"]
    assert sp.simplify(held - 2 * system.q("m") * system.q("u") * system.t) == 0


def test_results_tell_contacts_and_what_holds() -> None:
    """As plain expressions, for programs."""
    ball, belt = (derive_request({"scene": name, "lang": "en"})["result"] for name in ("bouncing-ball", "stick-slip"))
    (contact,) = ball["contacts"]
    assert contact["gap"]["plain"] == "z - a*sin(omega*t)"
    assert contact["restitution"]["plain"] == "e"
    assert [(each["coordinate"], each["plain"]) for each in contact["impact"]["rate_jumps"]] == [
        ("z", "-(e + 1)*(dot(z) - a*omega*cos(omega*t))")
    ]
    assert (ball["sticking"], belt["contacts"]) == ([], [])
    assert [(each["load"], each["holding"]["plain"], each["largest"]["plain"]) for each in belt["sticking"]] == [
        ("friction", "k*x", "m*g*mu_s")
    ]


def test_a_belt_whose_speed_may_be_zero_is_linearized_where_it_is_not() -> None:
    """The slope of sgn(ẋ − u) is 2δ(ẋ − u), which is zero beside the jump and stands in no formula."""
    friction = {"kind": "friction", "name": "belt", "coordinate": "x", "force": "F*(1 + dot(x)^2)", "surface_rate": "u"}
    document = on_line([friction, {"kind": "potential", "name": "spring", "energy": "k*(x^2 + y^2)/2"}])
    for parameter in document["parameters"]:
        parameter["positive"] = False
    system, derivation = derived(document)
    assert [step.rule for step in derivation.steps()].count("linearization") == 1
    matrices = [m for each in linearizations(system) for m in (each.mass, each.damping, each.stiffness)]
    assert matrices
    assert not any(matrix.has(sp.DiracDelta) for matrix in matrices)


def bound_pendulum(scene: str, gap: str) -> tuple[System, Derivation]:
    """A pendulum by rods that strikes an upright wall at the distance w."""
    document: dict[str, Any] = write_scene(load_scene(scene))
    document["parameters"] += [{"name": "e", "value": 0.7, "positive": False}, {"name": "w", "value": 2.0, "unit": "m"}]
    document["events"] = [{"name": "wall", "value": gap, "then": "bounce", "restitution": "e"}]
    return derive(read_scene(document))


def test_a_rod_answers_the_wall_as_the_angle_says() -> None:
    """With x = l sin φ, y = l cos φ the rate φ̇ jumps by −(1 + e) φ̇; the rod's impulse is what is left along it."""
    system, derivation = bound_pendulum("cartesian-pendulum", "x + w")
    found = quantities(derivation, "impact-law")
    phi, spin, m, length, e = sp.symbols("phi spin m l e", positive=True)
    on_circle = {
        system.q("x"): length * sp.sin(phi), system.q("y"): length * sp.cos(phi),
        system.rate("x"): length * spin * sp.cos(phi), system.rate("y"): -length * spin * sp.sin(phi),
        system.q("m"): m, system.q("l"): length, system.q("e"): e,
    }  # fmt: skip
    expected = {
        ("rate-jump", "x"): -(1 + e) * length * spin * sp.cos(phi),
        ("rate-jump", "y"): (1 + e) * length * spin * sp.sin(phi),
        # Λ = Δp_φ/(∂x/∂φ), and m Δẋ = Λ − Λ_rod sin φ as the rod pulls inwards.
        ("impulse", ""): -(1 + e) * m * spin * length / sp.cos(phi),
        ("constraint-impulse", "rod"): -(1 + e) * m * spin * length * sp.tan(phi),
    }
    for name, value in expected.items():
        assert sp.simplify(found[name].subs(on_circle) - value) == 0, name
    (step,) = (step for step in derivation.steps() if step.rule == "impact-law")
    loss = step.relations[-1].after
    assert isinstance(loss, Inserted)
    assert sp.simplify(loss.of.value.subs(on_circle) - (1 - e**2) * m * length**2 * spin**2 / 2) == 0
    assert (step.verified, step.evidence.kind) == (True, "exact")


def test_two_rods_answer_together() -> None:
    """Too long in closed form: solved in numbers, against M(φ) Δφ̇ = w Λ of the double pendulum in angles."""
    system, derivation = bound_pendulum("double-pendulum-by-rods", "x2 + w")
    (step,) = (step for step in derivation.steps() if step.rule == "impact-system")
    assert (step.verified, step.evidence.kind) == (True, "exact")
    (a, b), (da, db), (m1, m2, l1, l2, e) = (-0.4, -1.1), (-0.8, 1.9), (1.3, 0.6, 0.9, 1.2, 0.7)
    (sa, ca), (sb, cb) = ((math.sin(x), math.cos(x)) for x in (a, b))
    rates = {"x1": l1 * ca * da, "y1": -l1 * sa * da}
    rates |= {"x2": rates["x1"] + l2 * cb * db, "y2": rates["y1"] - l2 * sb * db}
    places = {"x1": l1 * sa, "y1": l1 * ca, "x2": l1 * sa + l2 * sb, "y2": l1 * ca + l2 * cb}
    known = {system.q(name): value for name, value in (*places.items(), ("m1", m1), ("m2", m2), ("e", e))}
    known |= {system.rate(q): value for q, value in rates.items()}
    written = step.relations[0].after
    assert isinstance(written, Equation)
    assert isinstance(written.left, MatrixTimes)
    matrix, right = (
        np.array(sp.Matrix(v.value).subs(known), dtype=float) for v in (written.left.matrix, written.right)
    )
    jumps = np.linalg.solve(matrix, right)[:, 0]
    coupling = m2 * l1 * l2 * math.cos(a - b)
    mass = np.array([[(m1 + m2) * l1**2, coupling], [coupling, m2 * l2**2]])
    along = np.array([l1 * ca, l2 * cb])
    turned = np.linalg.solve(mass, along)
    impulse = -(1 + e) * (along @ np.array([da, db])) / (along @ turned)
    spins = turned * impulse
    expected = [l1 * ca * spins[0], -l1 * sa * spins[0]]
    expected += [expected[0] + l2 * cb * spins[1], expected[1] - l2 * sb * spins[1]]
    assert list(jumps[:4]) == pytest.approx(expected, rel=1e-12)
    assert -jumps[-1] == pytest.approx(impulse, rel=1e-12)


def test_an_impact_that_constraints_do_not_answer_is_not_verified(monkeypatch: pytest.MonkeyPatch) -> None:
    """M Δq̇ = Λ ∂g/∂q alone leaves the circle."""
    from deltaq.derivation import impacts

    def free(system: System) -> impacts._Mobility:
        inverse = sp.ImmutableMatrix(impacts.mass_matrix(system).inv())
        return impacts._Mobility(inverse, sp.ImmutableMatrix.zeros(1, len(system.free)))

    monkeypatch.setattr(impacts, "_mobility", free)
    _, derivation = bound_pendulum("cartesian-pendulum", "x + y + w")
    (step,) = (step for step in derivation.steps() if step.rule == "impact-law")
    assert not step.verified


def test_a_wrong_impulse_is_not_verified(monkeypatch: pytest.MonkeyPatch) -> None:
    """With 1 − e in the place of 1 + e, neither the rebound nor the loss is that of the law."""
    from deltaq.derivation import impacts

    plain = impacts.restitution
    monkeypatch.setattr(impacts, "restitution", lambda system, event: -plain(system, event))
    event = {"name": "hit", "value": "y - x", "then": "bounce", "restitution": "e"}
    _, derivation = derived(on_line(events=[event]))
    (step,) = (step for step in derivation.steps() if step.rule == "impact-law")
    assert not step.verified


def wall(name: str, gap: str) -> dict[str, object]:
    return {"name": name, "value": gap, "then": "bounce", "restitution": "e"}


@pytest.mark.parametrize(
    ("walls", "is_told"),
    [
        pytest.param([wall("left", "x + 1")], False, id="one contact"),
        pytest.param([wall("left", "x + 1"), wall("right", "2 - y")], True, id="two contacts"),
    ],
)
@pytest.mark.parametrize(
    ("language", "sentence"),
    [
        ("en", "Several contacts that close at once push one after the other"),
        ("de", "Mehrere Kontakte, die sich zugleich schließen, stoßen nacheinander"),
    ],
)
def test_what_several_contacts_do_at_once_is_told(
    walls: Sequence[Mapping[str, object]], language: str, sentence: str, *, is_told: bool
) -> None:
    names = {"format": 1, "id": "contact", "title": "contact", "dimension": 2}
    found = derive_request({"scene": {**names, **on_line(events=walls)}, "lang": language})
    steps = [step for chapter in found["chapters"] for step in chapter["steps"] if step["rule"] == "impact-law"]
    assert len(steps) == len(walls)
    assert all((sentence in step["text"]) is is_told for step in steps)
