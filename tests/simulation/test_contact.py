"""The forces of contacts in answers: of strings, tables and the corners of blocks, against closed forms."""

from __future__ import annotations

import base64
import json
from typing import Any

import numpy as np
import pytest
from tests.simulation.scenes import document
from tests.simulation.test_impact import G, box, contact

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.service import run


def answered(scene: object, t_end: float, **asked: object) -> dict[str, Any]:
    return dict(run({"scene": scene, "t_end": t_end, "include": ["coordinates", "rates", "loads"], **asked}))


def written(scene: dict[str, object]) -> object:
    return json.loads(json.dumps(write_scene(read_scene(scene))))


def ball(table: str, **load: object) -> dict[str, object]:
    """A ball of mass 2 at rest on a table whose height is given."""
    weight = {"kind": "gravity", "name": "weight", "acceleration": ["0", f"-{G}"]}
    found = document({"y": (0.0, 0.0)}, {"m": 2.0}, {"ball": ("m", ["0", "y"])}, [weight])
    return found | {"events": [contact("floor", f"y - ({table})", 0.0)]}


@pytest.mark.parametrize("method", ["dop853", "rk4", "gauss-4", "bogacki-shampine-32"])
def test_tension_of_a_string_is_that_of_newtons_law(method: str) -> None:
    found = answered("catching-pendulum", 4.0, samples=201, method=method)
    coordinates, rates = found["coordinates"], found["rates"]
    x, y, u, v = (np.array(each[name]) for each in (coordinates, rates) for name in ("x", "y"))
    scene = {each["name"]: each["value"] for each in write_scene_of("catching-pendulum")["parameters"]}
    length, mass, pull = scene["l"], scene["m"], scene["g"]
    told = found["contacts"]["taut"]
    tension = 2.0 * length * np.array(told["force"])  # λ works through l² − x² − y², of which 2l is the slope
    radius = np.hypot(x, y)
    taut = tension > 0.0
    assert told["unit"] == "N/m"
    assert taut.any()
    assert not taut.all()
    assert radius[taut] == pytest.approx(np.full(taut.sum(), length), abs=1e-6)
    expected = mass * ((u**2 + v**2) - pull * y) / length
    assert tension[taut] == pytest.approx(expected[taut], abs=1e-5)
    assert (radius[~taut] <= length + 1e-9).all()


def write_scene_of(name: str) -> dict[str, Any]:
    from deltaq.mechanics.library import load_scene

    return dict(write_scene(load_scene(name)))


@pytest.mark.parametrize("columns", ["numbers", "base64"])
def test_a_table_that_sinks_pushes_less(columns: str) -> None:
    found = answered(written(ball("-0.5*t^2")), 1.0, samples=11, columns=columns)
    told = found["contacts"]["floor"]["force"]
    force = told if columns == "numbers" else np.frombuffer(base64.b64decode(told), "<f8")
    assert list(force) == pytest.approx([2.0 * (G - 1.0)] * 11, rel=1e-9)


def test_corners_of_a_block_share_its_weight() -> None:
    found = answered(written(box(0.5, 0.0, rise=0.8)), 1.0, samples=11)
    for name in ("left", "right"):
        force = found["contacts"][name]["force"]
        assert force[0] == 0.0
        assert force[-1] == pytest.approx(G / 2.0, rel=1e-9)


def test_contacts_that_share_without_a_law_have_no_force() -> None:
    scene = ball("0")
    events = scene["events"]
    assert isinstance(events, list)
    found = answered(written(scene | {"events": [*events, contact("again", "2*y", 0.0)]}), 1.0, samples=11)
    assert found["indeterminate"]
    assert {tuple(each["force"]) for each in found["contacts"].values()} == {(None,) * 11}


def test_contacts_are_told_with_the_loads() -> None:
    scene = written(ball("0"))
    assert "contacts" not in run({"scene": scene, "t_end": 1.0, "include": ["coordinates"]})
    assert "contacts" not in answered("pendulum", 1.0)
