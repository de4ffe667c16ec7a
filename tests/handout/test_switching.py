"""Programs of motions that stick, slip and touch: in any units, with no number for what nothing determines."""

from __future__ import annotations

import ast
import runpy
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from tests.simulation.rods import friction, rod
from tests.simulation.scenes import document
from tests.simulation.test_impact import contact

from deltaq.handout.service import export_request
from deltaq.simulation.service import run

T_END = 3.0
MAGNITUDES = (1e-6, 1e-3, 1.0, 1e3, 1e6)


class Moved(NamedTuple):
    """What a program tells: times, the coordinate, its rate, and Z of l, shape (samples,) each."""

    t: Any
    q: Any
    v: Any
    reaction: Any


def moved(scene: dict[str, Any], folder: Path) -> Moved:
    """What the scene's program gives with l released."""
    asked = {"form": "python", "scene": scene, "t_end": T_END, "release": ["l"]}
    file = folder / "motion.py"
    file.write_text(str(export_request(asked)["text"]), encoding="utf-8")
    program = runpy.run_path(str(file))
    times, q, v = program["solve"]()
    return Moved(times, q[0], v[0], program["reactions"](times, q, v)[0])


def pendulum(length: float, mass: float) -> dict[str, Any]:
    """A pendulum with dry friction in its pivot, 0.25 m g l: it turns, and then sticks."""
    values = {"l": length, "m": mass, "g": 9.81 * length, "N": 0.25 * 9.81 * mass * length**2}
    loads = [
        {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]},
        {"kind": "friction", "name": "dry", "coordinate": "phi", "force": "N", "static": "1.5*N"},
    ]
    return document({"phi": (1.0, 0.0)}, values, {"bob": ("m", ["l*sin(phi)", "-l*cos(phi)"])}, loads)


def block(length: float, mass: float) -> dict[str, Any]:
    """A block of length l pushed against a wall, from which it rebounds with e = 1/2 until it rests there."""
    values = {"l": length, "m": mass, "F": 2.0 * mass * length, "w": 0.5 * length}
    push = {"kind": "force", "name": "push", "at": "bob", "force": ["F", "0"]}
    scene = document({"s": (-length, 0.0)}, values, {"bob": ("m", ["s + l", "0"])}, [push])
    return scene | {"events": [contact("wall", "w - s - l", 0.5)]}


def rubbing_block(length: float, mass: float) -> dict[str, Any]:
    """A block on a spring that rubs on a belt: it sticks to it and slips on it by turns."""
    values = {"l": length, "m": mass, "k": 4.0 * mass, "R": mass * length, "b": 0.4 * length}
    spring = {"kind": "potential", "name": "spring", "energy": "k*s^2/2"}
    dry = {"kind": "friction", "name": "dry", "coordinate": "s", "force": "R", "static": "1.5*R", "surface_rate": "b"}
    return document({"s": (0.0, 0.0)}, values, {"bob": ("m", ["s + l", "0"])}, [spring, dry])


SCENES = {"pendulum": (pendulum, 0), "block": (block, 1), "rubbing-block": (rubbing_block, 1)}  # power of a length


def of_size(name: str, length: float, mass: float, folder: Path) -> Moved:
    """The motion with lengths in l and forces in m l, per second squared."""
    make, power = SCENES[name]
    found = moved(make(length, mass), folder)
    return Moved(found.t, found.q / length**power, found.v / length**power, found.reaction / (mass * length))


@pytest.fixture(scope="module")
def of_size_one(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Moved]:
    return {name: of_size(name, 1.0, 1.0, tmp_path_factory.mktemp(name)) for name in SCENES}


@pytest.mark.one_in(9)
@pytest.mark.parametrize(("length", "mass"), [*product(MAGNITUDES, repeat=2)])
@pytest.mark.parametrize("name", SCENES)
def test_program_in_other_units_tells_the_same(
    name: str, length: float, mass: float, of_size_one: dict[str, Moved], tmp_path: Path
) -> None:
    """Lengths and masses may be counted in whatever they like: the motion in l, and Z in m l, are the same numbers."""
    found, known = of_size(name, length, mass, tmp_path), of_size_one[name]
    np.testing.assert_allclose(found.q, known.q, atol=1e-9)
    np.testing.assert_allclose(found.v, known.v, atol=1e-8)
    away = np.abs(np.gradient(known.reaction)) < 0.5  # where it jumps, a sample may be on either side of it
    np.testing.assert_allclose(found.reaction[away], known.reaction[away], atol=1e-7)
    assert away.sum() > len(known.t) / 2


@pytest.mark.parametrize("name", SCENES)
def test_program_of_size_one_is_that_of_the_simulation(name: str, tmp_path: Path) -> None:
    """So that all other sizes are right as well; each of the motions has events."""
    make, _ = SCENES[name]
    shown, found = simulated(make(1.0, 1.0)), moved(make(1.0, 1.0), tmp_path)
    at = samples_at(found.t, shown)
    assert len(shown["events"]) >= 2
    np.testing.assert_allclose(found.q, np.array(next(iter(shown["coordinates"].values())))[at], atol=1e-8)


def simulated(scene: dict[str, Any]) -> dict[str, Any]:
    parts = ["coordinates", "rates", "multipliers"]
    asked = {"scene": scene, "t_end": T_END, "samples": 91, "release": ["l"]}
    return dict(run({**asked, "tolerance": 1e-10, "include": parts}))


def samples_at(times: Any, shown: dict[str, Any]) -> list[int]:
    """Where the simulation has these times: it adds the moments of events."""
    return [int(np.argmin(np.abs(np.array(shown["t"]) - time))) for time in times]


def pressed(push: float, *, gap: str, share: str) -> dict[str, Any]:
    """A block pressed on a wall by −F, with friction along the coordinate."""
    values = {"l": 1.0, "m": 1.0, "F": push, "w": 1.0}
    loads = [
        {"kind": "force", "name": "push", "at": "bob", "force": ["-F", "0"]},
        {"kind": "friction", "name": "dry", "coordinate": share, "force": "1"},
    ]
    scene = document({"s": (0.5, 0.0)}, values, {"bob": ("m", ["s + l", "0"])}, loads)
    return scene | {"events": [contact("wall", gap, 0.0)]}


def in_one_pivot(coordinate: str) -> dict[str, Any]:
    """Two frictions on a pendulum that comes to rest, of which the second is along another name for the turning."""
    second = {**friction(coordinate, 0.5, 0.9), "name": "further"}
    return rod(friction("phi", 2.0, 4.0), second, start=(0.3, 0.0))


OPEN = [
    pytest.param(pressed(3.0, gap="s + l - w", share="s"), True, id="a wall that l moves, a friction that it does not"),
    pytest.param(pressed(3.0, gap="s + l - w", share="s + l"), False, id="both along the end of l"),
    pytest.param(pressed(3.0, gap="s - w/4", share="s"), False, id="neither along l"),
    pytest.param(in_one_pivot("phi"), False, id="two frictions in a pivot, no share of l"),
    pytest.param(in_one_pivot("l*phi"), True, id="two frictions in a pivot, one along the arc"),
]


@pytest.mark.parametrize(("scene", "is_open"), OPEN)
def test_program_has_no_number_for_what_nothing_determines(
    scene: dict[str, Any], is_open: bool, tmp_path: Path
) -> None:
    """Where friction and contact hold together, Z is one number only if their shares do not change it."""
    shown, found = simulated(scene), moved(scene, tmp_path)
    known = np.array(shown["multipliers"]["l"], dtype=float)[samples_at(found.t, shown)]
    assert np.isnan(known).any() == is_open
    np.testing.assert_array_equal(np.isnan(found.reaction), np.isnan(known))
    given = ~np.isnan(known)
    np.testing.assert_allclose(found.reaction[given], known[given], atol=1e-6)


def test_program_tells_the_same_whatever_parameters_are_called(tmp_path: Path) -> None:
    """Names that the program gives what it computes reactions from may be those of a mass."""
    scene = rod(friction("l*phi", 1.0, 8.0))
    known = moved(scene, tmp_path).reaction
    tree = ast.parse((tmp_path / "motion.py").read_text(encoding="utf-8"))
    (function,) = (each for each in tree.body if isinstance(each, ast.FunctionDef) and each.name == "reaction")
    stored = {each.id for each in ast.walk(function) if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Store)}
    names = sorted((stored | {each.arg for each in function.args.args}) - {"t", "phi", "phi_dot", "phi_ddot"})
    assert len(names) > 5
    for name in names:
        parameters = [{**each, "name": name} if each["name"] == "m" else each for each in scene["parameters"]]
        bodies = [{**each, "mass": name} for each in scene["bodies"]]
        found = moved({**scene, "parameters": parameters, "bodies": bodies}, tmp_path)
        np.testing.assert_allclose(found.reaction, known, rtol=1e-12, err_msg=name)
