"""Minimal coordinates instead of constraints: found where there are such, exact, and what multipliers are held to."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.lab.ladder.climbing import climbed
from tests.simulation.constrained import G, platform

from deltaq.lab.ladder.ending import known
from deltaq.lab.ladder.measurement import full_run, seen
from deltaq.lab.ladder.minimal import Minimal, minimal
from deltaq.lab.ladder.multipliers import beside, compared
from deltaq.mechanics.changes import change
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.model.minimal import kept_positions
from deltaq.model.symbols import Symbols
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

FLAG = np.zeros(1, dtype=np.int64)


def in_minimal_coordinates(scene: Scene, span: float) -> Minimal:
    run = full_run(scene, span, FLAG)
    return minimal(scene, seen(run).until(len(known(run, 0.01)[0].times)))


def bead(
    constraint: Mapping[str, object], coordinates: Mapping[str, float], vertical: str = "up", **more: Any
) -> Scene:
    """A particle under gravity that keeps to a constraint."""
    names = list(coordinates)
    down = ["0"] * (len(names) - 1) + ["-g" if vertical == "up" else "g"]
    return read_scene(
        {
            "dimension": len(names),
            "coordinates": [{"name": n, "unit": "m", "value": v} for n, v in coordinates.items()],
            "parameters": [
                {"name": "m", "unit": "kg", "value": 1.3},
                {"name": "g", "unit": "m/s^2", "value": 9.81},
                {"name": "l", "unit": "m", "value": 1.0},
                {"name": "b", "unit": "m", "value": 2.0},
            ],
            "points": [{"name": "pivot", "position": ["0"] * len(names)}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": names}],
            "loads": [{"kind": "gravity", "name": "weight", "acceleration": down}],
            "constraints": [constraint],
            "drawing": {"vertical": vertical},
        }
        | more
    )


ROD = {"kind": "distance", "name": "rod", "from": "pivot", "to": "bob", "length": "l"}
ELLIPSE = {"kind": "equation", "name": "wire", "equation": "x^2/b^2 + y^2/l^2 = 1"}
PARABOLA = {"kind": "equation", "name": "wire", "equation": "l*y = x^2"}
HYPERBOLA = {"kind": "equation", "name": "wire", "equation": "y^2 - x^2 = l^2"}
CUBIC = {"kind": "equation", "name": "wire", "equation": "y^3 + x^2*y - l^3/8 = x^3"}


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        pytest.param(load_scene("cartesian-pendulum"), ("phi",), id="rod"),
        pytest.param(load_scene("double-pendulum-by-rods"), ("phi1", "phi2"), id="two rods"),
        pytest.param(load_scene("slider-crank"), ("phi",), id="slider-crank: linear, and a wave"),
        pytest.param(bead(ROD, {"x": 0.36, "y": 0.48, "z": -0.8}), ("theta", "psi"), id="sphere"),
        pytest.param(bead(ROD, {"x": 0.0, "y": 0.3, "z": -math.sqrt(0.91)}), ("theta", "psi"), id="through the pole"),
        pytest.param(bead(ELLIPSE, {"x": 2.0, "y": 0.0}), ("phi",), id="ellipse"),
        pytest.param(bead(PARABOLA, {"x": 0.5, "y": 0.25}), ("x",), id="parabola"),
        pytest.param(bead(HYPERBOLA, {"x": 0.5, "y": math.sqrt(1.25)}), ("x",), id="root"),
    ],
)
def test_a_scene_moves_alike_in_minimal_coordinates(scene: Scene, expected: tuple[str, ...]) -> None:
    """As the scene itself, in all its coordinates and rates; as one with constraints does, within both estimates."""
    below = in_minimal_coordinates(scene, 3.0)
    assert tuple(each.name for each in below.scene.free) == expected
    assert not below.scene.constraints
    pair = beside(scene, 3.0, 0.01, FLAG)
    assert pair is not None
    found = compared(pair, FLAG)
    assert found is not None
    assert np.all(found.apart <= found.estimate)
    assert found.apart.max() < 1e-8
    for name, errors in found.errors.items():
        assert errors.max() < 1e-7
        assert np.mean(errors <= found.estimates[name] + 1e-12) > 0.99


def test_the_angle_of_a_pendulum_is_the_textbook_s() -> None:
    """φ̈ = −(g/ℓ) sin φ, by SciPy; its λ is the force in the rod, m(ℓφ̇² + g cos φ)."""
    scene = load_scene("cartesian-pendulum")
    below = in_minimal_coordinates(scene, 4.0)
    (angle,) = below.scene.free
    assert (angle.latex, angle.value) == (r"\varphi", pytest.approx(math.atan2(0.6, 0.8), abs=1e-15))
    found = simulate(problem_of(below.scene, 4.0, 101), get_method("dop853"), tolerance=1e-11)
    truth = solve_ivp(
        lambda _t, y: [y[1], -9.81 * math.sin(y[0])],
        (0.0, 4.0),
        [angle.value, angle.rate],
        "DOP853",
        found.times,
        rtol=1e-13,
        atol=1e-13,
    )
    assert np.abs(found.values[:, 0] - truth.y[0]).max() < 1e-9
    held = simulate(problem_of(scene, 4.0, 101), get_method("dop853"), tolerance=1e-11)
    assert held.reactions is not None
    force = truth.y[1] ** 2 + 9.81 * np.cos(truth.y[0])
    assert np.abs(held.reactions.multipliers[:, 0] - force).max() < 1e-8


def test_a_double_pendulum_by_rods_becomes_the_one_by_angles() -> None:
    below = in_minimal_coordinates(load_scene("double-pendulum-by-rods"), 3.0)
    known_one = load_scene("double-pendulum")
    values = {one.name: one.value for one in below.scene.parameters}
    same = change(
        known_one, parameters={k: v for k, v in values.items() if k in {p.name for p in known_one.parameters}}
    )
    begun = {own.name: (each.value, each.rate) for own, each in zip(same.free, below.scene.free, strict=True)}
    problems = [problem_of(below.scene, 3.0, 61), problem_of(_begun(same, begun), 3.0, 61)]
    one, other = (simulate(each, get_method("dop853"), tolerance=1e-10) for each in problems)
    assert np.abs(one.values - other.values).max() < 1e-8


def _begun(scene: Scene, values: Mapping[str, tuple[float, float]]) -> Scene:
    coordinates = tuple(
        replace(each, value=values[each.name][0], rate=values[each.name][1], min=None, max=None)
        for each in scene.coordinates
    )
    return replace(scene, coordinates=coordinates)


def disc(rolling: str, begin: Mapping[str, tuple[float, float]], **more: Any) -> Scene:
    """A disc that rolls down an incline, s along it: the rates are tied, not the positions."""
    return read_scene(
        {
            "dimension": 2,
            "coordinates": [{"name": q, "value": value, "rate": rate} for q, (value, rate) in begin.items()],
            "parameters": [
                {"name": name, "value": value}
                for name, value in {"m": 1.3, "R": 0.4, "g": 9.81, "alpha": 0.2, "u": 0.5}.items()
            ],
            "bodies": [
                {"name": "disc", "kind": "rigid", "mass": "m", "inertia": "m*R^2/2", "angle": "phi",
                 "position": ["s*cos(alpha)", "-s*sin(alpha)"]}
            ],
            "loads": [{"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}],
            "constraints": [{"kind": "equation", "name": "rolling", "equation": rolling}],
        }
        | more
    )  # fmt: skip


@pytest.mark.parametrize(
    ("rolling", "rate"),
    [
        pytest.param("dot(s) = R*dot(phi)", 1.0, id="on an incline at rest"),
        pytest.param("dot(s) = R*dot(phi) + u", 1.5, id="on one that moves along itself"),
    ],
)
def test_rolling_ties_positions_where_it_can_be_integrated(rolling: str, rate: float) -> None:
    """s̈ = ⅔ g sin α; the turn lags behind by what the scene begins with, and by what the incline runs."""
    scene = disc(rolling, {"s": (0.7, rate), "phi": (0.3, 2.5)})
    below = in_minimal_coordinates(scene, 2.0)
    assert len(below.scene.free) == scene.degrees_of_freedom == 1
    assert not below.scene.constraints
    ((name, (value, speed)),) = below.begins.items()
    run = simulate(problem_of(below.scene, 2.0, 21), get_method("dop853"), tolerance=1e-10)
    times = run.times
    wanted = 0.7 + rate * times + 9.81 * math.sin(0.2) * times**2 / 3
    belt = (rate - 1.0) * times
    turned = 0.3 + (wanted - 0.7 - belt) / 0.4
    column = run.values[:, 0]
    assert column == pytest.approx(wanted if name == "s" else turned, abs=1e-8)
    assert (value, speed) == pytest.approx((0.7, rate) if name == "s" else (0.3, 2.5))


def test_a_form_that_is_exact_is_integrated_and_another_is_not() -> None:
    """(1 + 2 s φ) ṡ + s² φ̇ is d/dt (s + s² φ); φ ṡ − s φ̇ is no rate of anything."""
    begin = {"s": (0.7, 0.0), "phi": (0.3, 0.0)}
    columns = {"s": np.array([0.7]), "phi": np.array([0.3]), "t": np.zeros(1)}
    bent, twisted = (
        kept_positions(disc(rolling, begin), columns)
        for rolling in ("(1 + 2*s*phi)*dot(s) + s^2*dot(phi) = 0", "phi*dot(s) - s*dot(phi) = 0")
    )
    assert twisted is None
    assert bent is not None
    symbols = Symbols.of(disc("dot(s) = 0", begin))
    there = bent[0].subs({symbols.values["s"]: 2.0, symbols.values["phi"]: 0.5})
    assert float(there) == pytest.approx(2.0 + 2.0 - (0.7 + 0.49 * 0.3))


@pytest.mark.parametrize("rods", [3, 4])
def test_constraints_that_follow_from_others_need_not_be_solved(rods: int) -> None:
    """A platform on parallel rods is a pendulum in its angle: φ̈ = −g sin φ."""
    scene = platform(rods)
    below = in_minimal_coordinates(scene, 2.0).scene
    assert (len(below.free), len(below.constraints), scene.degrees_of_freedom) == (1, 0, 1)
    exact = solve_ivp(
        lambda _, y: [y[1], -G * math.sin(y[0])], (0.0, 2.0), [math.asin(0.6), 0.0], rtol=1e-12, atol=1e-13
    )
    run = simulate(problem_of(below, 2.0, 21), get_method("dop853"), tolerance=1e-10)
    assert abs(run.values[-1, 0]) == pytest.approx(abs(exact.y[0, -1]), abs=1e-9)


def test_multipliers_that_are_not_unique_are_held_to_nothing() -> None:
    pair = beside(platform(3), 2.0, 1e-8, FLAG)
    assert pair is not None
    found = compared(pair, FLAG)
    assert found is not None
    assert (found.errors, found.estimates) == ({}, {})
    assert found.apart.max() < 1e-6


@pytest.mark.parametrize(
    ("scene", "code"),
    [
        pytest.param(load_scene("chaplygin-sleigh"), "ladder-nonholonomic", id="rates alone"),
        pytest.param(load_scene("four-bar"), "ladder-minimal-long", id="loop: too long"),
        pytest.param(bead(CUBIC, {"x": 0.0, "y": 0.5}), "ladder-minimal", id="no closed form"),
    ],
)
def test_a_rung_that_cannot_be_says_why(scene: Scene, code: str) -> None:
    found = climbed(scene, 1.0)
    full, refused = found.ladder.rungs
    assert (refused.id, refused.scene, [each.code for each in refused.problems]) == ("minimal", None, [code])
    assert full.degrees == scene.degrees_of_freedom
    assert found.least.rung == "full"


def test_minimal_coordinates_are_the_least_rung_and_lead_further_down() -> None:
    found = climbed(load_scene("slider-crank"), 2.0)
    assert [rung.id for rung in found.ladder.rungs] == ["full", "minimal", "minimal+linearized"]
    assert {rung.degrees for rung in found.ladder.rungs} == {1}
    assert found.least.rung == "minimal"
    assert found.measured["minimal"].survives
    assert found.relative("minimal") < 1e-6
    assert found.relative("minimal+linearized") > 0.01
    document = cast("dict[str, Any]", found.ladder.rungs[1].scene)
    piston = next(body for body in document["bodies"] if body["name"] == "piston")
    assert piston["position"][0] == "l*sqrt(1 - r^2*sin(phi)^2/l^2) + r*cos(phi)"


def test_a_dumbbell_that_flies_past_has_the_extent_that_it_has_at_rest() -> None:
    """Two masses on a rod, turning: their common velocity is no extent, though single coordinates are held."""

    def turning(speed: float) -> float:
        scene = read_scene(
            {
                "coordinates": [
                    {"name": "x1", "value": 0.0, "rate": speed},
                    {"name": "y1", "value": 0.0, "rate": 1.0},
                    {"name": "x2", "value": 1.0, "rate": speed},
                    {"name": "y2", "value": 0.0, "rate": -1.0},
                ],
                "parameters": [{"name": "m", "value": 1.0}, {"name": "l", "value": 1.0}],
                "bodies": [
                    {"name": f"b{k}", "kind": "particle", "mass": "m", "position": [f"x{k}", f"y{k}"]} for k in (1, 2)
                ],
                "constraints": [{"kind": "distance", "name": "rod", "from": "b1", "to": "b2", "length": "l"}],
            }
        )
        return known(full_run(scene, 4.0, FLAG), 0.01)[0].extent

    assert turning(7.0) == pytest.approx(turning(0.0), rel=1e-6)
    assert turning(0.0) == pytest.approx(1.0, rel=1e-3)  # each mass half a metre from the middle: across at most
