"""What holds rods with mass, and bodies where a length puts them, against the laws of Newton and Euler."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy as sp
from tests.simulation.constrained import G
from tests.simulation.planar import Body, Floats, Pin, newton_euler

from deltaq.derivation.engine import derive
from deltaq.derivation.system import System
from deltaq.errors import UnknownNameError
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.release import held
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.model.reactions import reactions
from deltaq.narration.derive import derive_request
from deltaq.simulation.service import run

Values = Mapping[str, float]
STATES = 40
PARAMETERS: Any = write_scene(load_scene("physical-pendulum"))["parameters"]


def along(angle: float) -> Floats:
    return np.array([np.cos(angle), np.sin(angle)])


def reaction(scene: Scene, name: str, state: Values, accelerations: Values, multipliers: tuple[float, ...]) -> float:
    """Z as the model says it, at given accelerations and multipliers."""
    free = [coordinate.name for coordinate in scene.free]
    values = {**scene.parameter_values, **state}
    row = [values[q] for q in free] + [values[f"dot({q})"] for q in free] + [0.0]
    row += [values[parameter.name] for parameter in scene.parameters]
    row += [accelerations[q] for q in free] + list(multipliers)
    return float(reactions(scene, (name,)).at_states.table(np.array([row]))[0, 0])


def double_rod(rng: np.random.Generator) -> tuple[Values, Values, tuple[float, ...], Values]:
    """y upwards here, so that turning counts as the angles from the downward vertical do."""
    m1, m2, l1, l2, g = rng.uniform(0.3, 2.0, 5)
    phi1, phi2, w1, w2 = rng.uniform(-3.0, 3.0, 4)
    e1, e2 = (np.array([np.sin(phi), -np.cos(phi)]) for phi in (phi1, phi2))
    bodies = [Body(m1, m1 * l1**2 / 12, w1, (0.0, -m1 * g)), Body(m2, m2 * l2**2 / 12, w2, (0.0, -m2 * g))]
    found = newton_euler(bodies, [Pin(0, -l1 / 2 * e1), Pin(1, -l2 / 2 * e2, 0, l1 / 2 * e1)])
    state = {"m1": m1, "m2": m2, "l1": l1, "l2": l2, "g": g, "phi1": phi1, "phi2": phi2}
    state |= {"dot(phi1)": w1, "dot(phi2)": w2}
    turning = {"phi1": found.accelerations[0, 2], "phi2": found.accelerations[1, 2]}
    return state, turning, (), {"l1": found.forces[0] @ e1, "l2": found.forces[1] @ e2}


def four_bar(rng: np.random.Generator) -> tuple[Values, Values, tuple[float, ...], Values]:
    a, b, c, s = 0.3 + rng.uniform(-0.1, 0.1), 0.9, 0.6, 0.9 + rng.uniform(-0.05, 0.1)
    mu, g, phi1, w1 = rng.uniform(0.5, 2.0), rng.uniform(1.0, 20.0), rng.uniform(-3.0, 3.0), rng.uniform(-9.0, 9.0)
    way = np.array([s, 0.0]) - a * along(phi1)  # from the crank pin to the right bearing; then the law of cosines
    apart, heading = np.hypot(*way), np.arctan2(way[1], way[0])
    phi2 = heading + np.arccos((b**2 + apart**2 - c**2) / (2 * b * apart))
    e1, e2, joint = along(phi1), along(phi2), a * along(phi1) + b * along(phi2) - np.array([s, 0.0])
    phi3 = np.arctan2(joint[1], joint[0])
    e3, turned = along(phi3), lambda e: np.array([-e[1], e[0]])
    w2, w3 = np.linalg.solve(np.column_stack([b * turned(e2), -c * turned(e3)]), -a * w1 * turned(e1))
    lengths, rates = (a, b, c), (w1, w2, w3)
    bodies = [Body(mu * l, mu * l**3 / 12, w, (0.0, -mu * l * g)) for l, w in zip(lengths, rates, strict=True)]
    ends = [l / 2 * e for l, e in zip(lengths, (e1, e2, e3), strict=True)]
    pins = [Pin(0, -ends[0]), Pin(1, -ends[1], 0, ends[0]), Pin(2, -ends[2]), Pin(1, ends[1], 2, ends[2])]
    found = newton_euler(bodies, pins)
    state = {"a": a, "b": b, "c": c, "s": s, "mu": mu, "g": g, "phi1": phi1, "phi2": phi2, "phi3": phi3}
    state |= {f"dot(phi{k + 1})": rate for k, rate in enumerate(rates)}
    turning = {f"phi{k + 1}": found.accelerations[k, 2] for k in range(3)}
    forces = {name: found.forces[k] @ e for k, (name, e) in enumerate(zip("abc", (e1, e2, e3), strict=True))}
    return state, turning, tuple(found.forces[3]), forces


def slider_crank(rng: np.random.Generator) -> tuple[Values, Values, tuple[float, ...], Values]:
    r, l, inertia, m, heavy, k = 0.3, rng.uniform(0.6, 1.2), 0.2, *rng.uniform(0.5, 3.0, 2), rng.uniform(0.0, 30.0)
    phi, rate = rng.uniform(-3.0, 3.0), rng.uniform(-6.0, 6.0)
    psi = np.arcsin(r * np.sin(phi) / l)  # the rod points down by ψ
    w = r * np.cos(phi) * rate / (l * np.cos(psi))
    x, e, rod = r * np.cos(phi) + l * np.cos(psi), along(phi), along(-psi)
    push = -k * (x - (l + 2 * r))
    bodies = [
        Body(m, inertia, rate, (0.0, 0.0)),
        Body(m, m * l**2 / 12, -w, (0.0, 0.0)),
        Body(heavy, 1.0, 0.0, (push, 0.0)),
    ]
    pins = [Pin(0, np.zeros(2)), Pin(1, -l / 2 * rod, 0, r * e), Pin(1, l / 2 * rod, 2, np.zeros(2))]
    found = newton_euler(bodies, pins, [(2, 1), (2, 2)])
    state = {"r": r, "l": l, "J": inertia, "m": m, "M": heavy, "k": k, "phi": phi, "psi": psi, "x": x}
    state |= {"dot(phi)": rate, "dot(psi)": w, "dot(x)": -r * np.sin(phi) * rate - l * np.sin(psi) * w}
    turning = {"phi": found.accelerations[0, 2], "psi": -found.accelerations[1, 2], "x": found.accelerations[2, 0]}
    bolt = found.forces[2]  # on the rod; N works through r sin φ − l sin ψ, H through x − r cos φ − l cos ψ
    return state, turning, (bolt[1], -bolt[0]), {"r": found.forces[1] @ e, "l": found.forces[1] @ rod}


MECHANISMS = {"double-rod-pendulum": double_rod, "four-bar": four_bar, "slider-crank": slider_crank}


@pytest.mark.parametrize("scene", MECHANISMS)
def test_what_holds_a_rod_is_the_force_in_the_joint_at_its_near_end(scene: str) -> None:
    rng, given = np.random.default_rng(7), load_scene(scene)
    for _ in range(STATES):
        state, accelerations, multipliers, forces = MECHANISMS[scene](rng)
        for name, force in forces.items():
            found = reaction(given, name, state, accelerations, multipliers)
            assert found == pytest.approx(force, rel=1e-9, abs=1e-9 * max(1.0, *map(abs, forces.values())))


@pytest.mark.parametrize("scene", MECHANISMS)
def test_a_motion_has_the_same_forces_in_its_joints(scene: str) -> None:
    """At the states of a motion, the forces that Newton's and Euler's laws demand there."""
    rng, given = np.random.default_rng(11), load_scene(scene)
    state, _, _, forces = MECHANISMS[scene](rng)
    parameters = {p.name: state[p.name] for p in given.parameters}
    initial = {c.name: {"value": state[c.name], "rate": state[f"dot({c.name})"]} for c in given.coordinates}
    asked = {"scene": scene, "parameters": parameters, "initial": initial, "t_end": 0.2, "samples": 3}
    found: Any = run({**asked, "tolerance": 1e-11, "release": list(forces)})
    for name, force in forces.items():
        assert found["multipliers"][name][0] == pytest.approx(force, rel=1e-8, abs=1e-8)
        assert found["reactions"][name] == {"unit": "N", "of_rod": True}


@pytest.mark.parametrize(("scene", "name"), [("rolling-disc-in-space", "R"), ("bead-on-free-hoop", "R")])
def test_what_holds_a_body_away_is_its_mass_times_acceleration_less_its_weight(scene: str, name: str) -> None:
    """Z = (m r̈ − m g)·∂r/∂R by Newton's law, whatever the accelerations are; R turns and weighs as before."""
    given, rng = load_scene(scene), np.random.default_rng(3)
    symbols, t, body = System(given).symbols, sp.Symbol("time"), given.bodies[0]
    moving = {symbols.name(c.name): sp.Function(c.name)(t) for c in given.free}
    r = sp.Matrix([to_sympy(part.tree, symbols) for part in body.position])
    weight = sp.Matrix([to_sympy(part.tree, symbols) for part in given.loads[0].acceleration])  # type: ignore[attr-defined]
    law = symbols.name("m") * (r.subs(moving).diff(t, 2) - weight.subs(moving)).dot(
        r.diff(symbols.name(name)).subs(moving)
    )
    for _ in range(10):
        jets = {c.name: rng.uniform(-1.0, 1.0, 3) for c in given.free}
        at = {
            **{f.diff(t, order): jets[q.name][order] for order in (2, 1) for q, f in moving.items()},
            **{f: jets[q.name][0] for q, f in moving.items()},
        }
        values = {symbols.name(p): value for p, value in given.parameter_values.items()}
        expected = float(law.subs(at).subs(values))
        state = {q: jet[0] for q, jet in jets.items()} | {f"dot({q})": jet[1] for q, jet in jets.items()}
        accelerations = {q: jet[2] for q, jet in jets.items()}
        found = reaction(given, name, state, accelerations, tuple(rng.uniform(-1.0, 1.0, len(given.constraints))))
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)


def rod_scene(**changes: Any) -> Scene:
    """A uniform rod on a pivot in the plane, y downwards; a part of the document may be another."""
    document: Any = write_scene(load_scene("physical-pendulum"))
    return read_scene({**document, **changes})


def held_in(scene: Scene) -> dict[str, str]:
    return {each.name: each.kind for each in held(scene)}


PLANE = {"phi": 0.7, "dot(phi)": 1.9, "m": 1.3, "l": 0.8, "g": G}
PIVOT = -1.3 * (0.4 * 1.9**2 + G * np.cos(0.7))  # −m (l φ̇²/2 + g cos φ)


@pytest.mark.parametrize(
    "bodies",
    [
        pytest.param(
            [
                {"kind": "rigid", "name": "rod", "mass": "m", "inertia": "m*l^2/12", "angle": "phi"}
                | {"position": ["l/2*sin(phi)", "l/2*cos(phi)"]}
            ],
            id="its centre of mass at the middle",
        ),
        pytest.param(
            [
                {"kind": "rigid", "name": "rod", "mass": "m/2", "inertia": "m*l^2/100", "angle": "phi"}
                | {"position": ["l*sin(phi)/3", "l*cos(phi)/3"]},
                {"kind": "particle", "name": "bob", "mass": "m/3", "position": ["l*sin(phi)", "l*cos(phi)"]},
            ],
            id="its centre of mass at a third, and a bob at its end",
        ),
        pytest.param(
            [
                {"kind": "continuum", "name": "rod", "material": [{"name": "s", "from": "0", "to": "l"}]}
                | {"density": "m/l", "position": ["s*sin(phi)", "s*cos(phi)"]}
            ],
            id="a continuum",
        ),
    ],
)
def test_a_rod_is_held_by_its_pivot_however_it_is_written(bodies: list[dict[str, Any]]) -> None:
    scene = rod_scene(bodies=bodies)
    assert held_in(scene) == {"l": "rod"}
    several = len(bodies) == 2  # m/2 at l/3 and m/3 at l: again m l/2 in all, but 5/6 of the weight
    expected = PIVOT + several * 1.3 / 6 * G * np.cos(0.7)
    assert reaction(scene, "l", PLANE, {"phi": 5.0}, ()) == pytest.approx(expected, rel=1e-12)


def test_a_rod_in_space_is_held_by_its_pivot() -> None:
    """Z = −m (l/2 (θ̇² + ψ̇² sin²θ) + g cos θ)."""
    e = ["sin(theta)*cos(psi)", "sin(theta)*sin(psi)", "cos(theta)"]
    scene = rod_scene(
        dimension=3,
        coordinates=[{"name": name, "unit": "rad", "value": 0.4, "rate": 0.1} for name in ("theta", "psi")],
        points=[
            {"name": "pivot", "position": ["0", "0", "0"]},
            {"name": "tip", "position": [f"l*{part}" for part in e]},
        ],
        bodies=[
            {"kind": "continuum", "name": "rod", "material": [{"name": "s", "from": "0", "to": "l"}]}
            | {"density": "m/l", "position": [f"s*{part}" for part in e]}
        ],
        loads=[{"kind": "gravity", "name": "weight", "acceleration": ["0", "0", "g"]}],
        drawing={"elements": [{"kind": "rod", "from": "pivot", "to": "tip", "label": "l"}]},
    )
    state = {"theta": 0.7, "psi": 2.0, "dot(theta)": 1.9, "dot(psi)": -1.1, "m": 1.3, "l": 0.8, "g": G}
    expected = -1.3 * (0.4 * (1.9**2 + 1.1**2 * np.sin(0.7) ** 2) + G * np.cos(0.7))
    assert held_in(scene) == {"l": "rod"}
    assert reaction(scene, "l", state, {"theta": 1.0, "psi": -2.0}, ()) == pytest.approx(expected, rel=1e-12)


def test_a_rod_bound_at_its_middle_is_not_taken_for_one_bound_at_its_end() -> None:
    """A sliding rod between x on one axis and y on the other, of which a condition says no more than half."""
    ends = {"points": [{"name": "a", "position": ["x", "0"]}, {"name": "b", "position": ["0", "y"]}]}
    body = {"kind": "rigid", "name": "rod", "mass": "m", "inertia": "m*l^2/12", "angle": "phi"}
    end = {"kind": "particle", "name": "end", "mass": "m/3", "position": ["0", "y"]}
    scene = rod_scene(
        **ends,
        parameters=[*PARAMETERS, {"name": "h", "unit": "m", "value": 0.6}],
        labels={},
        coordinates=[
            {"name": "phi", "unit": "rad", "value": 0.6, "rate": 0.0},
            {"name": "x", "unit": "m", "value": 1.2 * np.sin(0.6), "rate": 0.0},
            {"name": "y", "unit": "m", "value": 1.2 * np.cos(0.6), "rate": 0.0},
        ],
        bodies=[{**body, "position": ["x - l*sin(phi)/2", "l*cos(phi)/2"]}, end],
        constraints=[
            {"kind": "equation", "name": "across", "equation": "x = l*sin(phi)"},
            {"kind": "equation", "name": "up", "equation": "2*y = l*cos(phi) + y"},
        ],
        drawing={"elements": [{"kind": "rod", "from": "a", "to": "b", "label": "l"}]},
    )
    assert held_in(scene) == {"l": "rod"}
    halves = [
        {"kind": "equation", "name": "across", "equation": "x = l*sin(phi)/2 + h*sin(phi)"},
        {"kind": "equation", "name": "up", "equation": "y = l*cos(phi)/2 + h*cos(phi)"},
    ]
    document: Any = write_scene(scene)
    assert held_in(read_scene({**document, "constraints": halves})) == {"l": "place"}


def test_a_rod_on_a_blade_is_not_taken_for_one_that_its_near_end_alone_holds() -> None:
    """A condition on the rate of its far end holds it there as well, and so Z is told as that of places."""
    start = [{"name": name, "unit": "m", "value": 0.0, "rate": 0.0} for name in "xy"]
    at = ["x + {0}*sin(phi)", "y + {0}*cos(phi)"]
    body = {"kind": "rigid", "name": "rod", "mass": "m", "inertia": "m*l^2/12", "angle": "phi"}
    blade = "dot(x)*cos(phi) - dot(y)*sin(phi) + l*dot(phi) = 0"
    scene = rod_scene(
        coordinates=[*start, {"name": "phi", "unit": "rad", "value": 0.6, "rate": 0.0}],
        points=[
            {"name": "pivot", "position": ["x", "y"]},
            {"name": "tip", "position": [part.format("l") for part in at]},
        ],
        bodies=[{**body, "position": [part.format("l/2") for part in at]}],
        constraints=[{"kind": "equation", "name": "edge", "equation": blade}],
    )
    assert held_in(scene) == {"l": "place"}
    assert held_in(replace(scene, constraints=())) == {"l": "rod"}


NOT_A_ROD = [
    pytest.param({"drawing": {"elements": []}}, id="not drawn"),
    pytest.param(
        {
            "parameters": [*PARAMETERS, {"name": "w", "unit": "m", "value": 3.0}],
            "bodies": [
                {"kind": "continuum", "name": "rod", "material": [{"name": "s", "from": "0", "to": "l"}]}
                | {"density": "m/l", "position": ["s*sin(phi + s/w)", "s*cos(phi + s/w)"]}
            ],
        },
        id="bent",
    ),
    pytest.param(
        {
            "bodies": [
                {"kind": "continuum", "name": "rod", "material": [{"name": "s", "from": "0", "to": "l"}]}
                | {"density": "m/l", "position": ["2*s*sin(phi)", "2*s*cos(phi)"]}
            ]
        },
        id="twice as long as drawn",
    ),
]


@pytest.mark.parametrize("changes", NOT_A_ROD)
def test_the_limit_of_a_continuum_that_is_no_drawn_rod_is_refused(changes: dict[str, Any]) -> None:
    with pytest.raises(UnknownNameError) as caught:
        reactions(rod_scene(**changes), ("l",))
    (problem,) = caught.value.problems
    is_drawn = "drawing" not in changes
    code = "cannot-release-drawn-limit" if is_drawn else "cannot-release-limit"
    assert (problem.code, problem.pointer) == (code, "/release/0")
    told = dict(problem.parameters)
    assert (told["name"], told["body"]) == ("l", "rod")


def test_what_that_refusal_advises_says_what_holds_the_rod() -> None:
    """The place at which it is held gets a coordinate, which is frozen and released."""
    p = {"name": "p", "unit": "m", "value": 0.0, "rate": 0.0}
    document: Any = write_scene(load_scene("physical-pendulum"))
    rod = {**document["bodies"][0], "position": ["(p + s)*sin(phi)", "(p + s)*cos(phi)"]}
    scene = rod_scene(coordinates=[*document["coordinates"], p], bodies=[rod], drawing={"elements": []})
    asked = {"t_end": 1.0, "samples": 11, "tolerance": 1e-10}
    found: Any = run({"scene": write_scene(scene), "freeze": ["p"], "release": ["p"], **asked})
    drawn: Any = run({"scene": "physical-pendulum", "release": ["l"], **asked})
    np.testing.assert_allclose(found["multipliers"]["p"], drawn["multipliers"]["l"], rtol=1e-8)


def test_a_length_in_a_load_that_names_no_place_is_refused() -> None:
    weight = {"kind": "potential", "name": "weight", "energy": "-m*g*l/2*cos(phi)"}
    body = {"kind": "rigid", "name": "rod", "mass": "m", "inertia": "m*l^2/12", "angle": "phi"}
    body |= {"position": ["l/2*sin(phi)", "l/2*cos(phi)"]}  # type: ignore[dict-item]
    with pytest.raises(UnknownNameError) as caught:
        reactions(rod_scene(bodies=[body], loads=[weight]), ("l",))
    (problem,) = caught.value.problems
    assert (problem.code, dict(problem.parameters)["load"]) == ("cannot-release-of-load", "weight")


def test_a_displacement_is_called_what_nothing_else_is() -> None:
    scene = load_scene("physical-pendulum")
    taken = replace(scene, parameters=(*scene.parameters, replace(scene.parameters[0], name="u")))
    (found,) = held(taken)
    assert found.shift is not None
    assert found.shift.displacement == "u_1"
    assert reaction(taken, "l", {**PLANE, "u": 3.0}, {"phi": 5.0}, ()) == pytest.approx(PIVOT, rel=1e-12)


def test_a_rod_is_held_at_the_end_that_does_not_move_however_it_is_drawn() -> None:
    turned = rod_scene(drawing={"elements": [{"kind": "rod", "from": "tip", "to": "pivot", "label": "l"}]})
    (found,) = held(turned)
    assert found.kind == "rod"
    assert found.shift is not None
    assert found.shift.rod is not None
    assert (found.shift.rod.start, found.shift.rod.end) == ("pivot", "tip")
    assert reaction(turned, "l", PLANE, {"phi": 5.0}, ()) == pytest.approx(PIVOT, rel=1e-12)


def material(*position: str, upper: str) -> dict[str, Any]:
    """A rod whose particles are told by a coordinate of the material that ends there."""
    limits = {"name": "s", "from": "0", "to": upper}
    return {"kind": "continuum", "name": "rod", "material": [limits], "density": "m", "position": list(position)}


# The pivot force m (l φ̇²/2 + g cos φ) where places move by as much as l; its share where they move by another amount.
MATERIALS = [
    pytest.param(material("s*l*sin(phi)", "s*l*cos(phi)", upper="1"), "place", 2 / 3, 0.5, id="by a part of l"),
    pytest.param(
        material("(l/2 + s - 1/2)*sin(phi)", "(l/2 + s - 1/2)*cos(phi)", upper="1"), "rod", 1, 1, id="beside l/2"
    ),
]


@pytest.mark.parametrize(("body", "kind", "centripetal", "weight"), MATERIALS)
def test_material_coordinates_stand_beside_the_length_in_places(
    body: dict[str, Any], kind: str, centripetal: float, weight: float
) -> None:
    """Z δl = −∫ (l s φ̇² + g cos φ) δr dm: each particle is displaced by s δl, or all of them by u."""
    scene = rod_scene(bodies=[body])
    assert held_in(scene) == {"l": kind}
    assert derive(scene)[1].chapters
    expected = -1.3 * (centripetal * 0.4 * 1.9**2 + weight * G * np.cos(0.7))
    assert reaction(scene, "l", PLANE, {"phi": 5.0}, ()) == pytest.approx(expected, rel=1e-12)


# A body whose centre is half of l away: Z by δl is half of what the pivot exerts, and is told as no rod's.
SCALED = [
    pytest.param({"inertia": "J"}, "scaled", id="the inertia is a number of its own"),
    pytest.param({"inertia": "m*l^2/12"}, "place", id="the inertia has the length as well"),
]


@pytest.mark.parametrize(("body", "kind"), SCALED)
def test_a_place_that_moves_by_a_part_of_the_length_is_held_by_no_rod(body: dict[str, str], kind: str) -> None:
    rigid = {"kind": "rigid", "name": "rod", "mass": "m", "angle": "phi", **body}
    place = {"position": ["l/2*sin(phi)", "l/2*cos(phi)"]}
    values = [*PARAMETERS, {"name": "J", "unit": "kg*m^2", "value": 0.1}]
    scene = rod_scene(bodies=[{**rigid, **place}], parameters=values, drawing={"elements": []})
    assert held_in(scene) == {"l": kind}
    assert reaction(scene, "l", {**PLANE, "J": 0.1}, {"phi": 5.0}, ()) == pytest.approx(PIVOT / 2, rel=1e-12)
    asked = {"scene": write_scene(scene), "release": ["l"]}
    for language, word in (("en", "generalized reaction"), ("de", "verallgemeinerte Reaktion")):
        found: Any = derive_request({**asked, "lang": language})
        assert found["result"]["reactions"][0]["force"] is None
        (step,) = (each for chapter in found["chapters"] for each in chapter["steps"] if each["id"] == "reaction:l")
        assert word in step["text"]
    told: Any = run({**asked, "t_end": 0.5, "samples": 3})
    assert told["reactions"]["l"]["of_rod"] is False
