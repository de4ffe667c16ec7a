"""Impacts and sticking as steps, against textbooks' closed forms: collisions, a rod that strikes a floor, friction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import pytest
import sympy as sp

from deltaq.derivation.engine import derive
from deltaq.derivation.formula import Named
from deltaq.derivation.linearization import linearizations
from deltaq.derivation.step import Derivation
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
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


def test_a_wrong_impulse_is_not_verified(monkeypatch: pytest.MonkeyPatch) -> None:
    """With 1 − e in the place of 1 + e, neither the rebound nor the loss is that of the law."""
    from deltaq.derivation import impacts

    plain = impacts.restitution
    monkeypatch.setattr(impacts, "restitution", lambda system, event: -plain(system, event))
    event = {"name": "hit", "value": "y - x", "then": "bounce", "restitution": "e"}
    _, derivation = derived(on_line(events=[event]))
    (step,) = (step for step in derivation.steps() if step.rule == "impact-law")
    assert not step.verified
