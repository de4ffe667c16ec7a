"""The exported program computes the motion that δq shows."""

from __future__ import annotations

import ast
import builtins
import random
import runpy
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.derivation.scenes import constrained
from tests.simulation.carts import Cart, Train
from tests.simulation.carts import drawn as carts
from tests.simulation.constrained import G, platform
from tests.simulation.rods import block, friction, rod, wind
from tests.simulation.test_impact import contact
from tests.simulation.test_reactions import hanging

from deltaq.handout.script import comment, script
from deltaq.handout.service import export_request
from deltaq.language.functions import SPELLINGS
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.toml import read_toml
from deltaq.mechanics.user_text import UserText
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.service import run

T_END = 2.0
SCENES = Path(__file__).parents[1] / "simulation" / "scenes"
AGREEMENT = 1e-6


def document_of(name: str) -> dict[str, Any]:
    """A built-in scene, or one of the simulation tests' own."""
    own = SCENES / f"{name}.toml"
    return read_toml(own.read_text(encoding="utf-8")) if own.is_file() else write_scene(load_scene(name))


def executed(text: str, folder: Path) -> dict[str, Any]:
    """What the program defines, run as a user would but for printing."""
    file = folder / "motion.py"
    file.write_text(text, encoding="utf-8")
    return runpy.run_path(str(file))


def same_times(times: Any, shown: dict[str, Any]) -> list[int]:
    """Where δq has the program's samples: it adds the moments of events."""
    found = [int(np.argmin(np.abs(np.array(shown["t"]) - time))) for time in times]
    np.testing.assert_allclose(times, np.array(shown["t"])[found], atol=1e-12)
    return found


@pytest.mark.one_in(12)
@pytest.mark.parametrize("identifier", scene_ids())
def test_program_agrees_with_the_simulation(identifier: str, tmp_path: Path) -> None:
    program = executed(script(load_scene(identifier), "en", T_END), tmp_path)
    times, q, v = program["solve"]()
    request = {"scene": identifier, "t_end": T_END, "samples": program["SAMPLES"], "tolerance": 1e-9}
    shown = run({**request, "include": ["coordinates", "rates", "positions"]})
    assert len(times) == program["SAMPLES"] or shown["status"] == "event"
    at = same_times(times, shown)
    for name, values, rates in zip(program["COORDINATES"], q, v, strict=True):
        np.testing.assert_allclose(values, np.array(shown["coordinates"][name])[at], atol=AGREEMENT, rtol=AGREEMENT)
        np.testing.assert_allclose(rates, np.array(shown["rates"][name])[at], atol=100 * AGREEMENT, rtol=AGREEMENT)
    for body, position in program["positions"](times[-1], q[:, -1]).items():
        np.testing.assert_allclose(position, shown["positions"][body][at[-1]], atol=10 * AGREEMENT)


def test_program_of_a_scene_with_constraints_keeps_them(tmp_path: Path) -> None:
    (sleigh,) = (scene for scene in constrained() if scene.id == "sleigh")
    (rod,) = (scene for scene in constrained() if scene.id == "particle-on-a-rod")
    program = executed(script(rod, "en", T_END), tmp_path)
    times, q, v = program["solve"]()
    assert np.abs(np.hypot(*q) - 1.0).max() < 1e-14
    tension = v[0] ** 2 + v[1] ** 2 + q[1] * 1.0  # m (l φ̇² + g cos φ), all parameters 1
    np.testing.assert_allclose(program["multipliers"](times, q, v)[0], tension, atol=1e-12)
    start = replace(sleigh, coordinates=tuple(replace(c, rate=1.0) for c in sleigh.coordinates))
    program = executed(script(start, "en", T_END), tmp_path)
    times, q, v = program["solve"]()
    assert np.abs(v[1] * np.cos(q[2]) - v[0] * np.sin(q[2])).max() < 1e-14  # though the start was not so


@pytest.mark.parametrize("rods", [2, 3, 4])
@pytest.mark.parametrize("begin", [(0.6, -0.8), (0.7, -0.9)], ids=["fits", "is moved"])
def test_program_of_rods_that_follow_from_others(begin: tuple[float, float], rods: int, tmp_path: Path) -> None:
    """A platform swings as a pendulum: E = m (v²/2 + g y), and all rods together pull as that of the pendulum does."""
    program = executed(script(platform(rods, begin=begin), "en", T_END), tmp_path)
    times, q, v = program["solve"]()
    assert np.abs(np.hypot(*q[:2]) - 1.0).max() < 1e-14
    assert np.abs(q[2]).max() < 1e-13
    np.testing.assert_allclose(0.5 * (v[:2] ** 2).sum(axis=0) + G * (q[1] - q[1, 0]), 0.0, atol=1e-10)
    pull = 2.0 * ((v[:2] ** 2).sum(axis=0) - G * q[1])
    np.testing.assert_allclose(program["multipliers"](times, q, v).sum(axis=0), pull, atol=1e-8)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", ["bouncing-ball", "braked-oscillator", "catching-pendulum", "stick-slip"])
def test_program_goes_on_behind_impacts_and_sticking(name: str, tmp_path: Path) -> None:
    """It rebounds, rests, sticks and slips when δq's motion does."""
    scene = document_of(name)
    program = executed(str(export_request({"form": "python", "scene": scene, "t_end": T_END})["text"]), tmp_path)
    times, q, v = program["solve"]()
    request = {"scene": scene, "t_end": T_END, "samples": len(times), "tolerance": 1e-10}
    shown = run({**request, "include": ["coordinates", "rates"]})
    assert len(shown["events"]) >= 2
    at = same_times(times, shown)
    for coordinate, values, rates in zip(program["COORDINATES"], q, v, strict=True):
        np.testing.assert_allclose(values, np.array(shown["coordinates"][coordinate])[at], atol=1e-9)
        np.testing.assert_allclose(rates, np.array(shown["rates"][coordinate])[at], atol=1e-8)


TWO_WALLS = [
    pytest.param("x", "y", "", id="walls at a right angle"),
    pytest.param("x", "y + x/2", "Several contacts at once", id="walls at an acute angle"),
]


@pytest.mark.parametrize(("one", "other", "refused"), TWO_WALLS)
def test_program_of_contacts_at_once_goes_on_where_their_order_does_not_matter(
    one: str, other: str, refused: str, tmp_path: Path
) -> None:
    """A point runs into a corner at rates (−1, −1): each wall alone would take a part of them."""
    walls = [
        {"name": name, "value": value, "then": "bounce", "restitution": "1"}
        for name, value in (("first", one), ("second", other))
    ]
    for events in (walls, walls[::-1]):
        scene = on_plane("corner") | {"events": events}
        program = executed(str(export_request({"form": "python", "scene": scene, "t_end": 2.0})["text"]), tmp_path)
        if refused:
            with pytest.raises(SystemExit, match=refused):
                program["solve"]()
            continue
        _, q, v = program["solve"]()
        np.testing.assert_allclose([*q[:, -1], *v[:, -1]], [1.0, 1.0, 1.0, 1.0], atol=1e-9)


def test_program_of_a_friction_that_would_drive_ends(tmp_path: Path) -> None:
    scene = on_plane("rubbed") | {"loads": [{"kind": "friction", "name": "R", "coordinate": "x", "force": "1 - t"}]}
    program = executed(str(export_request({"form": "python", "scene": scene, "t_end": 2.0})["text"]), tmp_path)
    with pytest.raises(SystemExit, match="A friction becomes negative"):
        program["solve"]()


def on_plane(name: str) -> dict[str, object]:
    """A point at (1, 1) with the rates (−1, −1)."""
    return {
        "format": 1,
        "id": name,
        "title": {"en": name},
        "coordinates": [{"name": each, "value": 1.0, "rate": -1.0} for each in ("x", "y")],
        "parameters": [],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "1", "position": ["x", "y"]}],
    }


def drawn_at_random(seed: int) -> dict[str, object]:
    """A particle on a spring, or one coupled to a fall; it rubs on a belt and hits a wall or a table."""
    draw = random.Random(seed)
    low, high = (
        {"k": 5.0, "e": 0.1, "mu": 0.0, "b": 0.0, "w": 1.0},
        {"k": 40.0, "e": 1.0, "mu": 0.5, "b": 0.3, "w": 8.0},
    )
    parameters = [{"name": name, "value": draw.uniform(low[name], high[name])} for name in low]
    coordinates = [{"name": "x", "value": draw.uniform(-1, 1), "rate": draw.uniform(-2, 2)}]
    position, energy, wall = ["x", "0"], "k*x^2/2", "1.2 - x"
    if draw.random() < 0.5:
        coordinates.append({"name": "y", "value": draw.uniform(0.2, 1), "rate": draw.uniform(-2, 2)})
        position, energy = ["x + 0.3*y", "y"], "k*x^2/2 + 9.81*y"
        wall = draw.choice(["y", "y - 0.05*b*sin(w*t)", "y + 0.1*x + 1"])
    surface, static = draw.choice(["0", "b*cos(w*t)", "0.2"]), draw.choice(["15*mu", "10*mu"])
    rubbing = {"kind": "friction", "coordinate": "x", "force": "10*mu", "static": static, "surface_rate": surface}
    return {
        "format": 1,
        "id": f"drawn-{seed}",
        "title": {"en": "Drawn"},
        "coordinates": coordinates,
        "parameters": parameters,
        "bodies": [{"name": "bob", "kind": "particle", "mass": "1", "position": position}],
        "loads": [{"kind": "potential", "energy": energy}, *([rubbing] if draw.random() < 0.8 else [])],
        "events": [{"name": "hit", "value": wall, "then": "bounce", "restitution": "e"}],
    }


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", range(8))
def test_program_and_simulation_agree_on_random_jumps(seed: int, tmp_path: Path) -> None:
    """Both find the events, in equations of their own."""
    scene = drawn_at_random(seed)
    program = executed(str(export_request({"form": "python", "scene": scene, "t_end": 1.5})["text"]), tmp_path)
    times, q, _ = program["solve"]()
    shown = run({"scene": scene, "t_end": 1.5, "samples": len(times), "tolerance": 1e-10, "include": ["coordinates"]})
    at = same_times(times, shown)
    for name, values in zip(program["COORDINATES"], q, strict=True):
        np.testing.assert_allclose(values, np.array(shown["coordinates"][name])[at], atol=1e-9)


@pytest.mark.one_in(4)
@pytest.mark.parametrize("seed", range(16))
def test_program_of_carts_that_rub_and_touch(seed: int, tmp_path: Path) -> None:
    """Several at rest together, held against SciPy's integrator with rules of its own."""
    train = carts(random.Random(f"carts {seed}"))
    times, q, _ = executed(script(train.scene, "en", T_END), tmp_path)["solve"]()
    np.testing.assert_allclose(q.T, train.along(times), atol=1e-8)


def test_program_of_more_rests_than_are_determined(tmp_path: Path) -> None:
    """Two carts stick and touch: both are pushed over their frictions' sum at once."""
    pushed, other = Cart(2.0, 0.5, amplitude=3.0, omega=0.5, friction=0.9), Cart(1.0, 0.5, friction=0.6)
    times, q, _ = executed(script(Train([pushed, other], [(0, 1)]).scene, "en", 1.5), tmp_path)["solve"]()
    later = np.maximum(times, begin := np.pi / 3.0)
    moved = 6.0 * np.cos(0.5 * begin) * (later - begin) - 12.0 * (np.sin(0.5 * later) - np.sin(0.5 * begin))
    np.testing.assert_allclose(q.T, 0.5 + (moved - 0.75 * (later - begin) ** 2)[:, None] / 3.0 * [1.0, 1.0], atol=1e-9)


def test_friction_on_a_surface_at_a_rate_in_numbers(tmp_path: Path) -> None:
    """Derivations may write the sign of x' - 1/5 as that of 5 x' - 1. It slips with g/20 until it goes along."""
    scene = {
        "format": 1,
        "id": "belt",
        "title": {"en": "Belt"},
        "coordinates": [{"name": "x"}],
        "parameters": [{"name": "m", "value": 2.0}, {"name": "g", "value": 10.0}],
        "bodies": [{"name": "block", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
        "loads": [{"kind": "friction", "coordinate": "x", "force": "m*g/20", "surface_rate": "0.2"}],
    }
    text = str(export_request({"form": "python", "scene": scene, "t_end": 1.0})["text"])
    times, (x,), (v,) = executed(text, tmp_path)["solve"]()
    np.testing.assert_allclose(v, np.minimum(0.5 * times, 0.2), atol=1e-11)
    np.testing.assert_allclose(x, np.where(times < 0.4, 0.25 * times**2, 0.2 * times - 0.04), atol=1e-11)


def test_a_ball_that_comes_to_rest_stays_there(tmp_path: Path) -> None:
    """The rebounds from h = g/2 with e = 1/2 end at 1 + 2 e/(1 − e) = 3 s; none of the names is the program's own."""
    names = ("friction", "rows", "settled", "a")
    scene = {
        "format": 1,
        "id": "ball",
        "title": {"en": "Ball"},
        "coordinates": [{"name": "watched", "value": 5.0}],
        "parameters": [{"name": name, "value": 10.0} for name in names],
        "bodies": [{"name": "ball", "kind": "particle", "mass": "rows", "position": ["0", "watched"]}],
        "loads": [{"kind": "gravity", "acceleration": ["0", "-a"]}],
        "events": [{"name": "pushed", "value": "watched", "then": "bounce", "restitution": "settled/20"}],
    }
    text = str(export_request({"form": "python", "scene": scene, "t_end": 4.0})["text"])
    times, (z,), _ = executed(text, tmp_path)["solve"]()
    falling, resting = times <= 1.0, times > 3.0
    np.testing.assert_allclose(z[falling], 5.0 - 5.0 * times[falling] ** 2, atol=1e-10)
    np.testing.assert_allclose(z[~falling & (times <= 2.0)].max(), 1.25, atol=1e-2)
    np.testing.assert_allclose(z[resting], 0.0, atol=1e-10)


ON_ONE_SIDE = {"kind": "force", "at": "bob", "force": ["-50*min(l*sin(phi)-0.2,0)", "0"]}
RELEASED = [
    pytest.param({"scene": "pendulum"}, "l", id="a rod"),
    pytest.param({"scene": "double-pendulum"}, "l1", id="a rod that carries another"),
    pytest.param({"scene": "base-pendulum", "guides": [{"coordinate": "y", "value": "0.1*t^2"}]}, "y", id="a guide"),
    pytest.param({"scene": "slider-crank"}, "r", id="a crank among constraints"),
    pytest.param({"scene": hanging(ON_ONE_SIDE)}, "l", id="a rod beside a kink"),
    pytest.param({"scene": "wind-on-rod"}, "l", id="a continuum at its pivot"),
    pytest.param({"scene": "four-bar"}, "b", id="a rod with mass among constraints"),
    pytest.param({"scene": "rolling-disc-in-space"}, "R", id="the place of a body that rolls"),
    pytest.param({"scene": "cartesian-pendulum"}, "l", id="a rod that is a constraint"),
]


@pytest.mark.parametrize(("request_", "name"), RELEASED)
def test_program_tells_what_holds_the_released(request_: dict[str, object], name: str, tmp_path: Path) -> None:
    asked = {**request_, "t_end": 0.5, "release": [name]}
    program = executed(str(export_request({"form": "python", **asked})["text"]), tmp_path)
    times, q, v = program["solve"]()
    shown = run({**asked, "samples": len(times), "tolerance": 1e-10, "include": ["multipliers"]})
    assert program["HELD"] == [name]
    np.testing.assert_allclose(program["reactions"](times, q, v)[0], shown["multipliers"][name], atol=1e-7)


JUMPING = [
    pytest.param(rod(friction("l*phi", 1.0, 8.0)), {"stick", "turn"}, id="friction along the arc"),
    pytest.param(rod(events=(contact("wall", "l*sin(phi) + 0.3", 0.5),)), {"impact"}, id="a wall"),
    pytest.param(
        rod(wind(-30.0), friction("l*phi", 1.0, 1.5), events=(contact("wall", "l*sin(phi) + 0.3", 0.0),)),
        {"rest"},
        id="pressed to a wall, with friction",
    ),
]


@pytest.mark.parametrize(("scene", "kinds"), JUMPING)
def test_program_tells_what_holds_where_motions_jump(scene: dict[str, Any], kinds: set[str], tmp_path: Path) -> None:
    asked = {"scene": scene, "t_end": 8.0, "release": ["l"]}
    program = executed(str(export_request({"form": "python", **asked})["text"]), tmp_path)
    times, q, v = program["solve"]()
    shown: Any = run({**asked, "samples": len(times), "tolerance": 1e-10, "include": ["multipliers"]})
    known = np.array(shown["multipliers"]["l"], dtype=float)[same_times(times, shown)]
    away = np.array([all(abs(t - each["time"]) > 1e-6 for each in shown["events"]) for t in times])
    compared = away & ~np.isnan(known)
    assert {each["kind"] for each in shown["events"]} >= kinds
    assert compared.sum() > 10
    np.testing.assert_allclose(program["reactions"](times, q, v)[0][compared], known[compared], rtol=1e-6, atol=1e-6)


def test_program_says_that_friction_holds_what_a_guide_does(tmp_path: Path) -> None:
    text = str(export_request({"form": "python", "scene": block({"x": "0", "y": "0"}), "release": ["x"]})["text"])
    assert "in the direction in which it grows; with it what friction holds: dry" in text
    program = executed(text, tmp_path)
    np.testing.assert_allclose(program["reactions"](*program["solve"]())[0], -5.0)


@pytest.mark.parametrize("curve", ["y = 1/cos(x)", "y = x*(1 + t)", "y = sin(2*x) + 1"])
def test_program_begins_where_the_motion_does(curve: str, tmp_path: Path) -> None:
    """Of a start that does not keep the constraints both take the nearest that does."""
    scene = names_in_use({"k": 2.0}) | {"constraints": [{"name": "wire", "kind": "equation", "equation": curve}]}
    program = executed(str(export_request({"form": "python", "scene": scene, "t_end": 1.0})["text"]), tmp_path)
    times, q, v = program["solve"]()
    shown = run({"scene": scene, "t_end": 1.0, "samples": len(times), "tolerance": 1e-9})
    assert abs(q[1, 0] - 0.2) > 0.01
    for name, values, rates in zip("xy", q, v, strict=True):
        np.testing.assert_allclose(values, shown["coordinates"][name], atol=AGREEMENT)
        np.testing.assert_allclose(rates, shown["rates"][name], atol=100 * AGREEMENT)


@pytest.mark.parametrize("seconds", [1e-250, 1e-9, 0.02])
@pytest.mark.parametrize("scene", ["pendulum", "stick-slip", "bouncing-ball", "four-bar"])
def test_program_of_a_short_time_has_both_ends(scene: str, seconds: float, tmp_path: Path) -> None:
    program = executed(str(export_request({"form": "python", "scene": scene, "t_end": seconds})["text"]), tmp_path)
    times, q, _ = program["solve"]()
    assert list(times) == [0.0, seconds]
    assert np.isfinite(q).all()


def test_changes_of_a_request_reach_the_program(tmp_path: Path) -> None:
    changes: dict[str, object] = {"parameters": {"l": 0.5}, "initial": {"phi": {"value": 1.2, "rate": -0.3}}}
    text = export_request({"form": "python", "scene": "pendulum", "t_end": 1.0, **changes})["text"]
    times, q, _ = executed(str(text), tmp_path)["solve"]()
    shown = run({"scene": "pendulum", "t_end": 1.0, "samples": len(times), "tolerance": 1e-9, **changes})
    np.testing.assert_allclose(q[0], shown["coordinates"]["phi"], atol=AGREEMENT)


def test_guide_and_frozen_coordinate_reach_the_program(tmp_path: Path) -> None:
    guided: dict[str, object] = {
        "guides": [{"coordinate": "y", "value": "y0*sin(omega*t)"}],
        "parameters": {"y0": 0.1, "omega": 12.0},
    }
    program = executed(str(export_request({"form": "python", "scene": "base-pendulum", **guided})["text"]), tmp_path)
    assert program["COORDINATES"] == ["phi"]
    frozen = export_request({"form": "python", "scene": "base-pendulum", "freeze": ["y"]})["text"]
    assert executed(str(frozen), tmp_path)["COORDINATES"] == ["phi"]


def test_names_that_mean_something_in_python_stay_apart(tmp_path: Path) -> None:
    """A parameter may be called lambda, a coordinate t_end, and another one like its rate."""
    document = {
        "format": 1,
        "id": "names",
        "title": {"en": "Names"},
        "summary": {"en": "Names"},
        "coordinates": [{"name": "q", "value": 0.3}, {"name": "solve", "value": 0.1}],
        "parameters": [{"name": "lambda", "value": 2.0}, {"name": "np", "value": 3.0}, {"name": "q_dot", "value": 1.0}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "lambda", "position": ["q", "solve"]}],
        "loads": [{"kind": "potential", "energy": "np*q^2/2 + q_dot*solve^2/2"}],
    }
    text = str(export_request({"form": "python", "scene": document, "t_end": 1.0})["text"])
    times, q, _ = executed(text, tmp_path)["solve"]()
    np.testing.assert_allclose(q[0], 0.3 * np.cos(np.sqrt(1.5) * times), atol=1e-9)
    np.testing.assert_allclose(q[1], 0.1 * np.cos(np.sqrt(0.5) * times), atol=1e-9)


FORCES = {
    "max": ("max(x, y, 0.1)", lambda x, y: np.maximum(np.maximum(x, y), 0.1)),
    "min": ("min(x, 0.2)", lambda x, y: np.minimum(x, 0.2)),
    "step": ("step(y - x)", lambda x, y: 0.5 * (1 + np.sign(y - x))),
    "abs": ("abs(x)", lambda x, y: np.abs(x)),
    "exp(1)": ("exp(1)*x", lambda x, y: np.e * x),
    "sec": ("sec(x)", lambda x, y: 1 / np.cos(x)),
}


@pytest.mark.parametrize("name", FORCES)
def test_functions_of_the_language_in_a_program(name: str, tmp_path: Path) -> None:
    """f = (F(x, y) − 2 x, 0) with each function; a parameter is called e."""
    text, force = FORCES[name]
    scene = names_in_use({"e": 2.0}, force=text)
    forcing = executed(str(export_request({"form": "python", "scene": scene})["text"]), tmp_path)["forcing"]
    for x, y in ((0.3, 0.2), (-0.4, 0.5), (0.05, -0.7)):
        np.testing.assert_allclose(forcing(0.0, [x, y], [0.0, 0.0]), [force(x, y) - 2.0 * x, 0.0], rtol=1e-15)


@pytest.mark.parametrize("energy", ["x^2*step(x)", "x*abs(x)", "max(x, 0)^2"])
def test_a_spring_on_one_side_in_a_program(energy: str, tmp_path: Path) -> None:
    """The derivative of a step is no force: it stands where x² or x is zero."""
    scene = names_in_use({"e": 2.0}, energy=energy)
    text = str(export_request({"form": "python", "scene": scene, "t_end": 1.5})["text"])
    times, q, _ = executed(text, tmp_path)["solve"]()
    shown = run({"scene": scene, "t_end": 1.5, "samples": len(times), "tolerance": 1e-9})
    np.testing.assert_allclose(q[0], np.array(shown["coordinates"]["x"])[same_times(times, shown)], atol=AGREEMENT)


def names_in_use(parameters: dict[str, float], *, force: str = "0", energy: str = "0") -> dict[str, Any]:
    """A particle of mass 1 at (x, y) on a spring along x, whose stiffness is the first of the parameters."""
    spring = f"{next(iter(parameters))}*x^2/2"
    return {
        "format": 1,
        "id": "names",
        "title": {"en": "Names"},
        "coordinates": [{"name": "x", "value": 0.3, "rate": -0.5}, {"name": "y", "value": 0.2}],
        "parameters": [{"name": name, "value": value} for name, value in parameters.items()],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "1", "position": ["x", "y"]}],
        "loads": [
            {"kind": "potential", "energy": f"{spring} + {energy}"},
            {"kind": "force", "at": "bob", "force": [force, "0"]},
        ],
    }


# Programs that have everything a program may have, each with what calls its own functions and those of NumPy.
SPRINGS = names_in_use({"k": 2.0}, energy="max(x, y, 0)^2*x*step(x)")["loads"]
BOUNCE = {"name": "hit", "value": "2 + x", "then": "bounce", "restitution": "0.5"}
RUBBING = {"kind": "friction", "name": "rubbing", "coordinate": "y", "force": "0.1*max(1 + x, 0)"}
BOUND = {"kind": "equation", "equation": "x = 2*y"}
ENDING = {"name": "far", "value": "2 - x"}
WHOLE: dict[str, dict[str, Any]] = {
    "free": {"events": [ENDING]},
    "jumps": {"events": [BOUNCE, ENDING], "loads": [*SPRINGS, RUBBING]},
    "bound": {"constraints": [{"name": "line", **BOUND}], "events": [ENDING]},
    "redundant": {
        "constraints": [{"name": "line", **BOUND}, {"name": "again", **BOUND, "equation": "x^2 = 4*y^2"}],
    },
}


def given_names(block: ast.Module | ast.FunctionDef | ast.If) -> Counter[str]:
    """How often a module or function gives each name a meaning, the functions within left out."""
    given = Counter(argument.arg for argument in block.args.args) if isinstance(block, ast.FunctionDef) else Counter()
    for statement in block.body:
        match statement:
            case ast.FunctionDef():
                given[statement.name] += 1
            case ast.Import() | ast.ImportFrom():
                given.update(alias.asname or alias.name for alias in statement.names)
            case ast.If():
                given.update(given_names(statement))
            case ast.Assign(targets=[target]) | ast.For(target=target):
                stored = (part for part in ast.walk(target) if isinstance(getattr(part, "ctx", None), ast.Store))
                given.update(part.id for part in stored if isinstance(part, ast.Name))
    return given


@pytest.mark.parametrize("whole", WHOLE)
@pytest.mark.parametrize("as_what", ["parameters", "coordinates"])
def test_every_name_means_one_thing(as_what: str, whole: str) -> None:
    """Whatever a program calls a function or quantity of its own, a scene may call a parameter or coordinate so."""
    scene = names_in_use({"k": 2.0}, energy="max(x, y, 0)^2*x*step(x)") | WHOLE[whole]
    plain = ast.parse(str(export_request({"form": "python", "scene": scene})["text"]))
    parts = [part for part in ast.walk(plain) if isinstance(part, ast.Name | ast.FunctionDef)]
    names = {part.id if isinstance(part, ast.Name) else part.name for part in parts} - {"x", "y", "k", "t", *SPELLINGS}
    wanted = sorted(name for name in names if not name.startswith(("_", "x_", "y_", "event_")))
    for begin in range(0, len(wanted), 20):
        check_names(with_names(scene, as_what, wanted[begin : begin + 20]))


def with_names(scene: dict[str, Any], as_what: str, names: list[str]) -> dict[str, Any]:
    """The scene with further parameters or coordinates of these names, all of which matter."""
    more: dict[str, list[Any]] = {as_what: [{"name": name, "value": 1.0} for name in names]}
    more["loads"] = [{"kind": "potential", "energy": f"x*{name}"} for name in names]
    if as_what == "coordinates":
        more["bodies"] = [
            {"name": f"body_{number}", "kind": "particle", "mass": "1", "position": [name, "0"]}
            for number, name in enumerate(names)
        ]
    return scene | {part: [*scene[part], *added] for part, added in more.items()}


def check_names(scene: dict[str, Any]) -> None:
    """Raises AssertionError where one name of the scene's program means two things."""
    module = ast.parse(str(export_request({"form": "python", "scene": scene})["text"]))
    given = given_names(module)
    assert {name for name, count in given.items() if count > 1 or name in dir(builtins)} == set()
    for function in module.body:
        if isinstance(function, ast.FunctionDef) and "[x, y" in ast.unparse(function):
            own = given_names(function)
            calls = (part.func for part in ast.walk(function) if isinstance(part, ast.Call))
            called = {part.id for part in calls if isinstance(part, ast.Name)} | {"np", *dir(builtins)}
            assert {name for name, count in own.items() if count > 1 or name in called} == set(), function.name


HOSTILE = [
    "Pendulum\nimport os; os.system('true')",
    'Pendulum""" + print(1) + """',
    "Pendulum\r\x0b\x0c\x85\u2028import os",
    "{functions}",
]


@pytest.mark.parametrize("title", HOSTILE)
def test_title_stays_a_comment(title: str, tmp_path: Path) -> None:
    scene = replace(load_scene("pendulum"), title={"en": UserText(title)})
    text = script(scene, "en", 1.0)
    assert text.splitlines()[0] == f"# {comment(UserText(title).line)}"
    assert text.splitlines()[1:] == script(load_scene("pendulum"), "en", 1.0).splitlines()[1:]


def test_program_prints_a_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "motion.py"
    file.write_text(script(load_scene("pendulum"), "en", 1.0), encoding="utf-8")
    runpy.run_path(str(file), run_name="__main__")
    head, first, *rest = capsys.readouterr().out.splitlines()
    assert head == "t,phi"
    assert [float(value) for value in first.split(",")] == [0.0, load_scene("pendulum").free[0].value]
    assert len(rest) == 30
