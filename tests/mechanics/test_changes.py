"""Changes that requests apply to scenes."""

from __future__ import annotations

import pytest

from deltaq.errors import InputError, Problem
from deltaq.language.tree import Name
from deltaq.mechanics.changes import change
from deltaq.mechanics.library import load_scene

GUIDE = {"coordinate": "y", "value": "y0*sin(omega*t)"}


def test_a_guide_removes_a_degree_of_freedom_and_brings_its_parameters() -> None:
    base = load_scene("base-pendulum")
    guided = change(base, guides=[GUIDE], parameters={"y0": 0.1, "omega": 5.0})
    assert [c.name for c in guided.free] == ["phi"]
    assert guided.guides == load_scene("guided-pendulum").guides
    assert base.guides == ()


def test_freezing_makes_the_initial_value_a_parameter() -> None:
    frozen = change(load_scene("elastic-pendulum"), freeze=["y"])
    constant = frozen.parameters[-1]
    assert (constant.name, constant.value, constant.positive) == ("y_0", 0.1, False)
    assert frozen.guides[0].value.tree == Name("y_0")


def test_parameters_widen_their_range() -> None:
    changed = change(load_scene("pendulum"), parameters={"l": 30.0})
    length = next(p for p in changed.parameters if p.name == "l")
    assert (length.value, length.max) == (30.0, 30.0)


REFUSED = [
    pytest.param(
        {"parameters": {"mm": 1.0}},
        Problem("unknown-parameter", "/parameters/mm", parameters={"name": "mm", "known": "m, l, k, g"}),
        id="unknown parameter",
    ),
    pytest.param(
        {"parameters": {"a/b": 1.0}},
        Problem("unknown-parameter", "/parameters/a~1b", parameters={"name": "a/b", "known": "m, l, k, g"}),
        id="pointer is escaped",
    ),
    pytest.param(
        {"parameters": {"m": 0.0}},
        Problem("not-positive", "/parameters/m", parameters={"name": "m", "value": 0.0}),
        id="mass of zero",
    ),
    pytest.param({"parameters": {"m": float("nan")}}, Problem("not-finite", "/parameters/m"), id="mass NaN"),
    pytest.param(
        {"guides": [{"coordinate": "x", "value": "0"}]},
        Problem("unknown-coordinate", "/guides/0/coordinate", parameters={"name": "x", "known": "y, phi"}),
        id="guide of an unknown coordinate",
    ),
    pytest.param(
        {"guides": [{"coordinate": "y", "value": "phi"}]},
        Problem("guide-by-coordinate", "/guides/0/value", parameters={"name": "phi"}),
        id="guide by a coordinate",
    ),
    pytest.param(
        {"freeze": ["z"]},
        Problem("unknown-coordinate", "/freeze/0", parameters={"name": "z", "known": "y, phi"}),
        id="freezing an unknown coordinate",
    ),
    pytest.param({"freeze": ["y", "phi"]}, Problem("no-free-coordinate", "/freeze/1"), id="freezing everything"),
]


@pytest.mark.parametrize(("changes", "problem"), REFUSED)
def test_refused(changes: dict, problem: Problem) -> None:
    with pytest.raises(InputError) as caught:
        change(load_scene("base-pendulum"), **changes)
    assert caught.value.problems == (problem,)
