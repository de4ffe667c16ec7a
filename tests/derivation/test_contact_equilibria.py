"""Rest on closed contacts, against closed forms, SciPy's constrained minima, and balls that come to rest."""

from __future__ import annotations

import math
from random import Random
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import minimize

from deltaq.derivation.contact_equilibria import ContactSearch, contact_search
from deltaq.derivation.engine import derive
from deltaq.derivation.optional import contact_search_of
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request
from deltaq.simulation.service import run

Row = tuple[dict[str, str], list[str], list[str], str]
WEIGHT = {"kind": "gravity", "acceleration": ["0", "-g"]}
AIR = {"kind": "dissipation", "function": "c*(dot(x)^2 + dot(y)^2)/2"}
PUSH = {"kind": "force", "at": "ball", "force": ["-y", "x"]}
DRY = {"kind": "friction", "coordinate": "x", "force": "m*g/5"}


def gap(value: str, name: str = "floor") -> dict[str, object]:
    return {"name": name, "value": value, "then": "bounce", "restitution": "1/2"}


def plane(*gaps: dict[str, object], loads: tuple[dict[str, object], ...] = (WEIGHT,), **values: float) -> Scene:
    """A ball in the plane, with contacts."""
    numbers = {"m": 1.0, "g": 9.81, "b": 0.7, "c": 0.3, "s": 0.5} | values
    return read_scene({
        "format": 1, "id": "rest", "title": "rest", "dimension": 2,
        "coordinates": [{"name": "x", "value": 0.3}, {"name": "y", "value": 1.0}],
        "parameters": [{"name": name, "value": value} for name, value in numbers.items()],
        "bodies": [{"name": "ball", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
        "loads": [{"name": f"load{k}", **load} for k, load in enumerate(loads)], "events": list(gaps),
    })  # fmt: skip


def with_events(name: str, *gaps: dict[str, object], **values: float) -> Scene:
    """A built-in scene with these contacts, and other values of its parameters."""
    document: dict[str, Any] = write_scene(load_scene(name)) | {"events": list(gaps)}
    for parameter in document["parameters"]:
        parameter["value"] = values.get(parameter["name"], parameter["value"])
    return read_scene(document)


def rows(system: System, search: ContactSearch) -> list[Row]:
    """Places, the contacts that are closed, their reactions, and the stability."""
    return [
        (
            {q.name: str(value) for q, value in each.equilibrium.values.items()},
            [event.name for event in each.contacts],
            [str(sp.factor(value)) for value in each.reactions],
            each.stability,
        )
        for each in search.found
    ]


ON = ["floor"]
ORIGIN = {"x": "0", "y": "0"}
CASES = [
    pytest.param(plane(gap("y")), [({"y": "0"}, ON, ["g*m"], "stable")], id="flat: x may be chosen"),
    pytest.param(plane(gap("y - b*x^2")), [(ORIGIN, ON, ["g*m"], "stable")], id="valley"),
    pytest.param(plane(gap("y + b*x^2")), [(ORIGIN, ON, ["g*m"], "unstable")], id="hill"),
    pytest.param(plane(gap("y - b*x^4")), [(ORIGIN, ON, ["g*m"], "undecided")], id="a valley without curvature"),
    pytest.param(plane(gap("y - s*x")), [], id="a slope"),
    pytest.param(plane(gap("-y")), [], id="a ceiling would have to pull"),
    pytest.param(plane(gap("y - b*x^2"), loads=(WEIGHT, AIR)), [(ORIGIN, ON, ["g*m"], "stable")], id="with drag"),
    pytest.param(
        plane(gap("y - s*x", "right"), gap("y + 2*x", "left")),
        [(ORIGIN, ["right", "left"], ["2*g*m/(s + 2)", "g*m*s/(s + 2)"], "stable")],
        id="between two slopes",
    ),
    pytest.param(
        plane(gap("y - s*x", "right"), gap("y + 2*x", "left"), gap("y + x", "flatter")),
        [(ORIGIN, ["right", "left"], ["2*g*m/(s + 2)", "g*m*s/(s + 2)"], "stable")],
        id="a corner of three is told once",
    ),
    pytest.param(
        plane(gap("y - s*x", "right"), gap("y + 2*x", "left"), gap("y - 1/10", "shelf"), s=0.2),
        [({"y": "1/10"}, ["shelf"], ["g*m"], "stable")],
        id="a corner behind a shelf",
    ),
    pytest.param(
        plane(gap("y - b*x^2"), gap("x", "wall")), [(ORIGIN, ON, ["g*m"], "stable")], id="a valley beside a wall"
    ),
    pytest.param(
        plane(gap("y + b*x^2"), gap("x", "wall")), [(ORIGIN, ON, ["g*m"], "undecided")], id="a hill beside a wall"
    ),
    pytest.param(plane(gap("y - s*x", "one"), gap("y - 2*x", "two")), [], id="in a corner that is open to one side"),
    pytest.param(
        plane(gap("y", "floor"), gap("x + 1", "wall")),
        [({"y": "0"}, ON, ["g*m"], "stable")],
        id="a wall that nothing pushes against",
    ),
    pytest.param(
        plane(gap("y - b*x^2"), gap("y - 1", "shelf")),
        [({"y": "1"}, ["shelf"], ["g*m"], "stable")],
        id="a shelf above a valley",
    ),
    pytest.param(
        load_scene("catching-pendulum"),
        [({"x": "0", "y": "-l"}, ["taut"], ["g*m/(2*l)"], "stable")],
        id="a string bears the weight: λ times the slope 2l of the gap is mg",
    ),
    pytest.param(
        with_events("pendulum", gap("phi - pi/6", "stop")),
        [({"phi": "pi/6"}, ["stop"], ["g*l*m/2"], "stable")],
        id="a pendulum leans on a stop: λ is the moment m g l sin φ",
    ),
    pytest.param(
        with_events("pendulum", gap("phi^2 - 64", "stop")),
        [
            ({"phi": "8"}, ["stop"], ["g*l*m*sin(8)/16"], "stable"),
            ({"phi": "-8"}, ["stop"], ["g*l*m*sin(8)/16"], "stable"),
        ],
        id="a stop behind more than a turn",
    ),
    pytest.param(with_events("pendulum", gap("phi + pi/6", "stop")), [], id="one that hangs does not touch its stop"),
    pytest.param(
        with_events("double-pendulum", gap("phi1 - 1/5", "stop")),
        [
            ({"phi1": "1/5", "phi2": "0"}, ["stop"], ["g*l1*(m1 + m2)*sin(1/5)"], "stable"),
            ({"phi1": "1/5", "phi2": "pi"}, ["stop"], ["g*l1*(m1 + m2)*sin(1/5)"], "unstable"),
        ],
        id="the lower of two pendulums hangs or stands while the upper leans",
    ),
    pytest.param(
        with_events("cartesian-pendulum", gap("x - l/2", "wall")),
        [({"x": "l/2", "y": "sqrt(3)*l/2"}, ["wall"], ["sqrt(3)*g*m/3"], "stable")],
        id="a rod leans on a wall: λ = m g tan 30°",
    ),
]


@pytest.mark.parametrize(("scene", "expected"), CASES)
def test_what_rests_on_contacts(scene: Scene, expected: list[Row]) -> None:
    system = System(scene)
    search = contact_search(system)
    assert search is not None
    assert rows(system, search) == expected
    assert search.complete


def test_nothing_is_at_rest_where_forces_only_jump_over_balance() -> None:
    """Under V = mg max(x, y) the force along the floor changes its sign at x = 0 and is zero nowhere."""
    kinked = {"kind": "potential", "energy": "m*g*max(x, y)"}
    search = contact_search(System(plane(gap("y - b*x^2"), loads=(kinked,))))
    assert search is not None
    assert (search.found, search.complete) == ((), False)


@pytest.mark.one_in(4)
@pytest.mark.parametrize("seed", range(12))
def test_minima_on_uneven_floors_are_those_of_scipy(seed: int) -> None:
    """Two waves and a valley: the stable positions are the minima that SciPy descends to from many starts."""
    source = Random(f"floor {seed}")
    a, b, p, q = (round(source.uniform(low, high), 3) for low, high in ((0.1, 0.4), (0.1, 0.4), (1.0, 3.0), (1.0, 3.0)))
    scene = plane(gap(f"y - {a}*sin({p}*x) - {b}*cos({q}*x) - x^2/10"))
    search = contact_search(System(scene))
    assert search is not None
    assert search.complete
    height = {"type": "ineq", "fun": lambda z: z[1] - a * math.sin(p * z[0]) - b * math.cos(q * z[0]) - z[0] ** 2 / 10}
    starts = [(x, 9.0) for x in np.linspace(-8.0, 8.0, 33)]
    runs = [minimize(lambda z: z[1], start, constraints=[height], tol=1e-12) for start in starts]
    minima = {round(float(each.x[0]), 4) for each in runs if each.success and np.ptp(np.abs(each.jac)) > 0.5}
    found = {round(float(each.equilibrium.values[sp.Symbol("x", real=True)]), 4): each for each in search.found}
    stable = {place for place, each in found.items() if each.stability == "stable"}
    assert {place for place in minima if min(abs(place - other) for other in stable) > 2e-3} == set()
    assert stable
    slopes = [abs(a * p * math.cos(p * x) - b * q * math.sin(q * x) + x / 5) for x in found]
    assert max(slopes) < 1e-3


def test_a_ball_with_drag_comes_to_rest_where_it_is_said() -> None:
    scene = plane(gap("y - b*x^2"), loads=(WEIGHT, AIR), c=2.0)
    (found,) = contact_search(System(scene)).found  # type: ignore[union-attr]
    moved = run({"scene": write_scene(scene), "t_end": 60.0, "samples": 3, "tolerance": 1e-8})
    ended = {name: values[-1] for name, values in moved["coordinates"].items()}  # type: ignore[index]
    assert ended == pytest.approx({q.name: float(value) for q, value in found.equilibrium.values.items()}, abs=1e-4)


@pytest.mark.parametrize(
    ("scene", "complete"),
    [
        pytest.param(load_scene("bouncing-ball"), True, id="a table that moves is no place to rest"),
        pytest.param(plane(gap("y"), loads=(WEIGHT, DRY)), False, id="dry friction makes families"),
    ],
)
def test_what_is_not_found_is_not_denied(scene: Scene, complete: bool) -> None:
    search = contact_search(System(scene))
    assert search is not None
    assert (search.found, search.complete) == ((), complete)


@pytest.mark.parametrize(
    ("value", "place"), [("z - a*sin(omega*t)", "0"), ("z - 1/2 - a*sin(omega*t)^2*cos(omega*t)", "1/2")]
)
def test_a_table_whose_amplitude_is_zero_carries_a_ball_and_it_is_said_that_it_may_move(value: str, place: str) -> None:
    scene = with_events("bouncing-ball", gap(value), a=0.0)
    system = System(scene)
    search = contact_search(system)
    assert search is not None
    assert rows(system, search) == [({"z": place}, ON, ["g*m"], "stable")]
    assert (search.complete, search.found[0].is_only_here) == (True, True)
    steps = [step for step in derive(scene)[1].steps() if step.rule == "contact-equilibrium"]
    assert [(step.about["outcome"], step.verified) for step in steps] == [("stable-at-values", True)]
    moving = contact_search(System(with_events("bouncing-ball", gap(value), a=0.1)))
    assert moving is not None
    assert (moving.found, moving.complete) == ((), True)


def test_a_search_that_is_too_long_is_left_out_and_named() -> None:
    """Magnets' forces are fractions with long roots."""
    scene = with_events("magnetic-pendulum", gap("x - 1/20", "one"), gap("y - 1/10", "two"))
    system = System(scene)
    assert contact_search_of(system) is None
    assert system.effort.left_out["contact-equilibria"] == "budget"
    told = [step for step in derive(scene)[1].steps() if step.id == "left-out:contact-equilibria"]
    assert len(told) == 1


@pytest.mark.parametrize(
    ("gaps", "loads"),
    [
        pytest.param([gap("y - b*x^2")], (WEIGHT, PUSH), id="in a valley"),
        pytest.param([gap("y - b*x^2")], (WEIGHT, AIR, PUSH), id="in a valley, where small motions decay along it"),
        pytest.param([gap("y - s*x", "right"), gap("y + 2*x", "left")], (WEIGHT, PUSH), id="in a corner"),
    ],
)
def test_forces_that_feed_energy_leave_the_stability_open(gaps: Any, loads: Any) -> None:
    search = contact_search(System(plane(*gaps, loads=loads)))
    assert search is not None
    assert [each.stability for each in search.found] == ["undecided"]


def test_steps_are_verified_and_answers_tell_them() -> None:
    scene = plane(gap("y - s*x", "right"), gap("y + 2*x", "left"))
    _, derivation = derive(scene)
    steps = [step for step in derivation.steps() if step.rule == "contact-equilibrium"]
    assert [(step.about["outcome"], step.verified) for step in steps] == [("stable", True)]
    assert steps[0].premises[:2] == ("contact-gap:right", "contact-gap:left")
    answer: Any = derive_request({"scene": write_scene(scene)})["result"]
    (told,) = answer["contact_equilibria"]
    assert {name: value["number"] for name, value in told["values"].items()} == {"x": 0.0, "y": 0.0}
    reactions = {each["contact"]: each["reaction"]["number"] for each in told["contacts"]}
    assert reactions == pytest.approx({"right": 9.81 * 0.8, "left": 9.81 * 0.2})
    assert (told["exact"], told["stability"]) == (True, "stable")
    assert answer["equilibrium_search"] == {"complete": True, "count": 0, "range": {}, "left_out": None}
