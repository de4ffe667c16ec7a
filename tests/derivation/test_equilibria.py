"""Equilibria and their stability, against what textbooks state."""

from __future__ import annotations

import math

import pytest
import sympy as sp
from tests.derivation.model_scenes import model_steps, particle, rotating_hoop
from tests.derivation.random_scenes import random_scene
from tests.derivation.scenes import chain, spring_in_space

from deltaq.derivation.equilibria import search
from deltaq.derivation.linearization import linearizations
from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request


def found(scene: Scene) -> list[tuple[dict[str, str], str]]:
    """Equilibria as text, with their stability."""
    return [
        ({q.name: str(value) for q, value in each.equilibrium.values.items()}, each.stability)
        for each in linearizations(System(scene))
    ]


EQUILIBRIA = [
    pytest.param(load_scene("pendulum"), [({"phi": "0"}, "stable"), ({"phi": "pi"}, "unstable")], id="pendulum"),
    pytest.param(
        load_scene("base-pendulum"),
        [({"y": "g*m/k", "phi": "0"}, "stable"), ({"y": "g*m/k", "phi": "pi"}, "unstable")],
        id="base pendulum",
    ),
    pytest.param(
        rotating_hoop(4.0), [({"phi": "0"}, "stable"), ({"phi": "pi"}, "unstable")], id="hoop slower than √(g/r)"
    ),
    pytest.param(
        rotating_hoop(5.0),
        [
            ({"phi": "acos(g/(Omega**2*r))"}, "stable"),
            ({"phi": "-acos(g/(Omega**2*r))"}, "stable"),
            ({"phi": "0"}, "unstable"),
            ({"phi": "pi"}, "unstable"),
        ],
        id="hoop faster than √(g/r)",
    ),
    pytest.param(
        particle(
            ["x"], {"k": 2.0, "c": 0.1}, ["x", "0"], {"kind": "force", "at": "bob", "force": ["-c*dot(x)-k*x", "0"]}
        ),
        [({"x": "0"}, "stable")],
        id="damped oscillator",
    ),
    pytest.param(
        particle(["x"], {"k": 2.0}, ["x", "0"], {"kind": "potential", "energy": "-k*x^2/2"}),
        [({"x": "0"}, "unstable")],
        id="hill",
    ),
    pytest.param(
        particle(["x"], {"k": 2.0}, ["x", "0"], {"kind": "potential", "energy": "k*x^4/4"}),
        [({"x": "0"}, "stable")],
        id="singular K",
    ),
    pytest.param(
        particle(["x"], {"a": 1.0, "b": 1.0}, ["x", "0"], {"kind": "potential", "energy": "-a*x^2/2 + b*x^4/4"}),
        [({"x": "sqrt(a)/sqrt(b)"}, "stable"), ({"x": "-sqrt(a)/sqrt(b)"}, "stable"), ({"x": "0"}, "unstable")],
        id="both wells of two",
    ),
    pytest.param(
        particle(["x", "y"], {"k": 2.0}, ["x", "y"], {"kind": "force", "at": "bob", "force": ["-k*y", "k*x"]}),
        [({"x": "0", "y": "0"}, "unstable")],
        id="circulatory force",
    ),
    pytest.param(
        particle(["x", "y"], {"g": 9.81}, ["x", "y"], {"kind": "gravity", "acceleration": ["0", "-g"]}),
        [],
        id="free fall has none",
    ),
    pytest.param(particle(["x"], {}, ["x", "0"]), [({}, "undecided")], id="free particle: every position"),
    pytest.param(load_scene("guided-pendulum"), [], id="explicit time"),
]


@pytest.mark.parametrize(("scene", "expected"), EQUILIBRIA)
def test_equilibria(scene: Scene, expected: list[tuple[dict[str, str], str]]) -> None:
    assert found(scene) == expected


def test_follower_force_moves_the_equilibrium() -> None:
    system = System(load_scene("elastic-pendulum"))
    below, above = linearizations(system)
    m, g, k, force = (system.q(name) for name in ("m", "g", "k", "F0"))
    assert below.equilibrium.values[system.q("phi")] == sp.asin(force / (m * g))
    assert above.equilibrium.values[system.q("phi")] == sp.pi - sp.asin(force / (m * g))
    assert system.is_zero(below.equilibrium.values[system.q("y")] - (m * g - force**2 / (m * g)) / k)
    assert (below.stability, above.stability) == ("undecided", "unstable")


def watched(force: str, **event: str) -> Scene:
    """A mass on a line under a force, and one event."""
    document = write_scene(particle(["x"], {"k": 2.0, "g": 9.81, "h": 0.5}, ["x", "0"], push(force)))
    return read_scene(document | {"events": [{"name": "event", **event}]})


def push(force: str) -> dict[str, object]:
    return {"kind": "force", "at": "bob", "force": [force, "0"]}


BOUNCE = {"then": "bounce", "restitution": "1/2"}


@pytest.mark.parametrize(
    ("scene", "places", "outcomes"),
    [
        pytest.param(
            watched("-k*x", value="h - x", **BOUNCE),
            ["0"],
            ["text", "contacts-all"],
            id="beside a wall that is not reached",
        ),
        pytest.param(
            watched("-k*x", value="x - h", **BOUNCE),
            [],
            ["none-within", "contacts-all", "equilibria-ended"],
            id="behind",
        ),
        pytest.param(watched("-k*x", value="x", **BOUNCE), ["0"], ["text", "contacts-all"], id="just touching"),
        pytest.param(watched("-m*g", value="x", **BOUNCE), [], ["none-open", "contacts-all"], id="a ball on a floor"),
        pytest.param(watched("-k*x", value="x - h"), [], ["none-within", "equilibria-ended"], id="where it has ended"),
        pytest.param(watched("-k*x", value="h - x"), ["0"], ["text"], id="before it ends"),
        pytest.param(watched("-k*x", value="h + dot(x)^2 - x"), ["0"], ["text"], id="an event that hangs on the rate"),
        pytest.param(watched("-k*x", value="h*t - x"), ["0"], ["text"], id="one that hangs on the time is not asked"),
        pytest.param(watched("-m*g", value="h - x"), [], ["none"], id="no rest anywhere"),
        pytest.param(watched("(k - 2)*m*g", value="h - x"), [""], ["everywhere-at-values"], id="numbers that balance"),
    ],
)
def test_equilibria_are_where_the_scene_holds(scene: Scene, places: list[str], outcomes: list[str]) -> None:
    """Behind a contact or an end of the motion nothing rests, and rest on a closed contact is not denied."""
    assert [values.get("x", "") for values, _ in found(scene)] == places
    steps = model_steps(scene)
    told = [steps[name].about["outcome"] for name in ("equilibrium-condition", "equilibrium-search") if name in steps]
    told += [step.about["outcome"] for name, step in steps.items() if name == "left-out:equilibria"]
    assert told == outcomes


@pytest.mark.parametrize(
    ("language", "title"), [("de", "Lagen, die nicht zählen"), ("en", "Positions that do not count")]
)
def test_positions_where_the_scene_does_not_hold_are_told_under_a_title_of_their_own(language: str, title: str) -> None:
    """They are not something that is missing."""
    behind = write_scene(watched("-k*x", value="x - h"))
    told = derive_request({"scene": behind, "lang": language})["chapters"]
    titles = {step["id"]: str(step["title"]) for chapter in told for step in chapter["steps"]}  # type: ignore[attr-defined]
    assert titles["left-out:equilibria"] == title


def test_a_string_does_not_stand_on_its_head() -> None:
    """l φ̇² + g cos φ > 0 is what keeps it taut."""
    assert found(load_scene("string-pendulum")) == [({"phi": "0"}, "stable")]


def test_a_contact_keeps_equilibria_of_a_constrained_scene_out_as_well() -> None:
    """A pendulum in x and y hangs; upright it would be behind the ceiling at the height of its pivot."""
    document = write_scene(load_scene("cartesian-pendulum"))
    ceiling = {"name": "ceiling", "value": "y", **BOUNCE}
    (hanging,) = found(read_scene(document | {"events": [ceiling]}))
    assert (hanging[0]["y"], hanging[1]) == ("l", "stable")


def test_numbers_where_there_is_no_closed_form() -> None:
    load = {"kind": "potential", "energy": "k*x^2/2 - F*cos(x/s)*s"}
    scene = particle(["x"], {"k": 1.0, "F": 0.5, "s": 1.0, "P": 0.7}, ["x", "0"], load, {
        "kind": "force", "at": "bob", "force": ["P", "0"],
    })  # fmt: skip
    system = System(scene)
    (each,) = linearizations(system)
    (x,) = each.equilibrium.values.values()
    assert not each.equilibrium.exact
    assert float(x) + 0.5 * math.sin(float(x)) == pytest.approx(0.7, rel=1e-14)
    assert each.stability == "stable"
    assert all(step.verified for step in model_steps(scene).values())


def test_a_continuum_of_equilibria_is_told_once() -> None:
    (each,) = linearizations(System(spring_in_space()))
    assert sum(float(x) ** 2 for x in each.equilibrium.values.values()) == pytest.approx(1.0)
    assert each.equilibrium.free == ("x", "y")
    assert (each.stability, each.verdict.kind) == ("stable", "family")


def test_all_equilibria_are_counted_and_those_not_told_in_full_stand_below() -> None:
    known = search(System(chain(6)))
    assert known is not None
    assert (len(known.found), known.count, known.complete) == (32, 64, True)
    steps = model_steps(chain(4))
    assert len([step for step in steps if step.startswith("equilibrium:")]) == 16
    assert len([step for step in steps if step.startswith("linearization:")]) == 4
    assert steps["equilibrium-search"].about == {"outcome": "everywhere", "shown": "4", "count": "16", "listed": "16"}
    assert len(steps["equilibrium-search"].substeps) == 12


@pytest.mark.parametrize(
    ("names", "energy", "count", "free"),
    [
        pytest.param("u w", "k*cos(u)", 2, 1, id="a coordinate that no force depends on"),
        pytest.param("x y", "k*(x-y)^2/2", 1, 1, id="two masses and a spring: one family"),
        pytest.param("u v w", "k*(cos(u)+cos(v))", 4, 1, id="two angles and a free coordinate"),
        pytest.param("x y z", "k*((x-y)^2+(y-z)^2)/2", 1, 1, id="three masses in a row: one family"),
        pytest.param("u w", "k*cos(u)*cos(u)", 4, 1, id="four angles in a turn, each with a free coordinate"),
    ],
)
def test_families_are_counted_as_families(names: str, energy: str, count: int, free: int) -> None:
    """A family is one, however many positions are in it; the answer says how many there are, and what is free."""
    scene = in_a_row(names, energy)
    known = search(System(scene))
    assert known is not None
    assert (known.count, len(known.found), known.complete) == (count, count, True)
    assert all(each.is_family and len(each.free) == free for each in known.found)
    result = derive_request({"scene": write_scene(scene)})["result"]
    assert result["equilibrium_search"]["count"] == len(result["equilibria"]) == count  # type: ignore[index]
    assert {len(each["free"]) for each in result["equilibria"]} == {free}  # type: ignore[index]


def test_families_that_are_not_all_found_are_no_complete_search() -> None:
    """u − v = 0 and u − v = π: two lines of rest on a torus."""
    known = search(System(in_a_row("u v", "k*cos(u-v)")))
    assert known is not None
    assert known.complete or known.left_out == "continuum"
    assert known.count <= 2
    assert all(each.is_family for each in known.found)


def in_a_row(names: str, energy: str) -> Scene:
    """A mass for each coordinate, with this potential."""
    coordinates = names.split()
    bodies = [
        {"name": f"b{i}", "kind": "particle", "mass": "m", "position": [q, "0"]} for i, q in enumerate(coordinates)
    ]
    return read_scene(
        {
            "id": "families",
            "dimension": 2,
            "coordinates": [{"name": q, "value": 0.3} for q in coordinates],
            "parameters": [{"name": "m", "value": 1.0}, {"name": "k", "value": 2.0}],
            "bodies": bodies,
            "loads": [{"kind": "potential", "energy": energy}],
        }
    )


def test_a_pole_of_the_coordinates_is_no_rest_where_a_force_acts_along_the_surface() -> None:
    """Two rods in space pulled aside, one of them tied to the pivot by a spring: refinement ends beside the poles."""
    scene = random_scene(9100096)
    system = System(scene)
    for found in result_of(system).equilibria:
        values = [float(value) for value in found.linear.equilibrium.values.values()]
        assert min(abs(math.sin(values[0])), abs(math.sin(values[2]))) > 1e-6


KINKS = [
    pytest.param("k*abs(x^2-1) + c*x", 1, 2, "kinks-all", id="two wells with a kink at the bottom of each"),
    pytest.param("k*abs(x) + c*x", 0, 1, "kinks-all", id="a valley with a kink"),
    pytest.param("c*abs(x) + k*x", 0, 0, "kinks-without", id="a bend in a slope"),
    pytest.param("max(k*x, -c*x)", 0, 1, "kinks-all", id="two slopes"),
    pytest.param("k*abs(x)^3/3 + c*x", 1, 0, "in-range", id="a force that bends and does not jump"),
    pytest.param("k*(x-c)*abs(x-c)/2 + 3*m*x^2", 1, 0, "in-range", id="a modulus beside its own zero"),
    pytest.param("k*(x-1)^2", 1, 0, "everywhere", id="no switch"),
]


@pytest.mark.parametrize(("energy", "count", "kinks", "outcome"), KINKS)
def test_positions_beside_jumps_are_counted_and_those_at_jumps_as_well(
    energy: str, count: int, kinks: int, outcome: str
) -> None:
    """Least energy at a kink, with a force on either side: |x² − 1| at ±1, k|x| + cx at 0 for k > c."""
    scene = particle(["x"], {"k": 2.0, "c": 0.5}, ["x", "0"], {"kind": "potential", "energy": energy})
    answer = derive_request({"scene": write_scene(scene)})["result"]
    told = answer["equilibrium_search"]  # type: ignore[index]
    assert (told["count"], told["complete"], told["left_out"]) == (count, True, None)
    assert len(answer["kink_equilibria"]) == kinks  # type: ignore[index]
    step = model_steps(scene).get("equilibrium-search")
    assert (step.about["outcome"] if step else "everywhere") == outcome


def test_a_ball_above_a_floor_rests_at_a_kink_of_its_potential() -> None:
    """A valley of slope 2 m g with a kink at a height of 1/2, above a floor on which nothing presses it."""
    document = write_scene(load_scene("bouncing-ball"))
    document["loads"].append({"kind": "potential", "name": "V", "energy": "m*g*abs(z - 1/2)*2"})  # type: ignore[attr-defined]
    answer = derive_request({"scene": document})["result"]
    (kink,) = answer["kink_equilibria"]  # type: ignore[index]
    assert (kink["values"]["z"]["number"], kink["stability"]) == (0.5, "stable")
    assert answer["equilibrium_search"]["complete"]  # type: ignore[index]
