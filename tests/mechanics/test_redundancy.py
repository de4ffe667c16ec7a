"""How many constraints are independent where they hold: linkages whose mobility is known, and what leaves none."""

from __future__ import annotations

from typing import Any

import pytest
from tests.simulation.constrained import equation, four_bar, parallelogram, particle, platform, rod, scene, sleigh

from deltaq.errors import Problem, SceneError
from deltaq.mechanics.changes import change
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene

Document = dict[str, Any]


def beam(size: float = 1.0) -> Scene:
    """Three equal cranks carry one beam, told by the places of three particles: seven laws where five would do."""
    at = {"1": 0.6, "2": 1.6, "3": 1.1}
    begin = {f"{axis}{k}": ((x if axis == "x" else -0.8) * size, 0.0) for k, x in at.items() for axis in "xy"}
    laws = ["x1^2 + y1^2 = l^2", "(x2 - l)^2 + y2^2 = l^2", "(x3 - l/2)^2 + y3^2 = l^2"]
    laws += ["x2 - x1 = l", "y2 = y1", "x3 = (x1 + x2)/2", "y3 = (y1 + y2)/2"]
    return scene(
        begin,
        {"m": 1.0, "l": size, "g": 9.81},
        [particle(f"b{k}", f"x{k}", f"y{k}") for k in at],
        [equation(f"S{k}", law) for k, law in enumerate(laws)],
    )


def stay(*angles: float) -> Document:
    """A particle at (1, 0) on rods of 1 m whose other ends are at these angles from it."""
    return {
        "coordinates": {"x": (1.0, 0.0), "y": (0.0, 0.0)},
        "constraints": [rod(f"S{k}", f"o{k}", "bob") for k, _ in enumerate(angles)],
        "points": {f"o{k}": [f"1 + cos({angle})", f"sin({angle})"] for k, angle in enumerate(angles)},
    }


MOBILE = [
    pytest.param(platform(2), 2, 1, id="a platform on two rods"),
    pytest.param(platform(3), 2, 1, id="on three: as many as coordinates"),
    pytest.param(platform(4), 2, 1, id="on four: more than coordinates"),
    pytest.param(platform(4, positive=True), 2, 1, id="on four, of positive length"),
    pytest.param(platform(3, begin=(0.7, -0.9)), 2, 1, id="on three that do not fit yet"),
    pytest.param(platform(3, begin=(1.0, 0.0)), 2, 1, id="at its fork, where one row is left"),
    pytest.param(parallelogram(), 3, 1, id="a parallelogram"),
    pytest.param(four_bar(), 2, 1, id="a four-bar linkage"),
    pytest.param(beam(), 5, 1, id="a beam on three cranks"),
    pytest.param(beam(1e-3), 5, 1, id="a beam of a millimetre"),
    pytest.param(sleigh(), 1, 2, id="a sleigh: a rate"),
    pytest.param(platform(2, equation("C", "dot(p) = 0")), 2, 1, id="two rods and a rate that they keep"),
    pytest.param(platform(1, equation("C", "dot(p) = 0")), 2, 1, id="a rod and a rate that it does not keep"),
]


@pytest.mark.parametrize(("held", "independent", "freedoms"), MOBILE)
def test_constraints_that_follow_from_others_take_no_freedom(held: Scene, independent: int, freedoms: int) -> None:
    assert (len(held.independence.chosen), held.degrees_of_freedom) == (independent, freedoms)
    assert held.is_redundant == (independent < len(held.constraints))


def test_a_frozen_angle_that_rods_hold_anyway_leaves_the_motion() -> None:
    frozen = change(platform(3), freeze=["p"])
    assert (len(frozen.free), frozen.degrees_of_freedom) == (2, 1)


def told(held: Document) -> tuple[Problem, ...]:
    """What is wrong with a scene of a particle."""
    with pytest.raises(SceneError) as caught:
        scene(held["coordinates"], {"m": 1.0, "l": 1.0, "g": 9.81}, [particle("bob", "x", "y")], held["constraints"],
              points=held.get("points"))  # fmt: skip
    return caught.value.problems


def many(index: int, count: int, free: int) -> Problem:
    return Problem("too-many-constraints", f"/constraints/{index}", parameters={"count": count, "free": free})


def laws(*texts: str) -> Document:
    """A particle at (1, 0) with laws."""
    names = enumerate(texts)
    return {
        "coordinates": {"x": (1.0, 0.0), "y": (0.0, 0.0)},
        "constraints": [equation(f"S{k}", one) for k, one in names],
    }


FIXED = [
    pytest.param(stay(1.0, 2.0), many(1, 2, 2), id="two rods hold a point"),
    pytest.param(stay(1.0, 2.0, 3.0), many(1, 3, 2), id="three rods hold it"),
    pytest.param(stay(0.0, 3.141592653589793), many(1, 2, 2), id="stretched between two rods: no row, and no motion"),
    pytest.param(laws("x = l", "y = 0*l", "x + y = l"), many(1, 3, 2), id="one law follows"),
    pytest.param(
        laws("x = l", "y = 0*l", "x + y = 3*l"),
        Problem("constraint-not-met", "/constraints/2", parameters={"gap": 2.0}),
        id="one law contradicts",
    ),
    pytest.param(
        laws("y = l", "y = 2*l"),
        Problem(
            "contradictory-constraints", "/constraints/1", parameters={"name": "law_S1", "names": "law_S0, law_S1"}
        ),
        id="two laws contradict each other",
    ),
    pytest.param(
        laws("y = 0*l", "2*y = 0*l"),
        Problem("dependent-constraints", "/constraints/1", parameters={"name": "law_S1", "names": "law_S0, law_S1"}),
        id="one law twice",
    ),
]


@pytest.mark.parametrize(("held", "problem"), FIXED)
def test_what_leaves_nothing_is_refused_for_what_it_is(held: Document, problem: Problem) -> None:
    assert told(held) == (problem,)


@pytest.mark.parametrize(
    ("rods", "more", "problem"),
    [
        (2, equation("stop", "y = -0.8*l"), many(2, 3, 3)),
        (3, equation("stop", "y = -0.8*l"), many(2, 4, 3)),
        (4, equation("stop", "y = -0.8*l"), many(2, 5, 3)),
        (2, equation("stop", "p = 0.1"), many(2, 3, 3)),  # the rods crossed
        (3, equation("stop", "p = 0.1"), Problem("constraint-not-met", "/constraints/3", parameters={"gap": 0.1})),
        (
            3,
            rod("twin", "above0", "end0"),
            Problem(
                "dependent-constraints", "/constraints/3", parameters={"name": "rod_twin", "names": "rod_S0, rod_twin"}
            ),
        ),
    ],
)
def test_a_platform_that_is_held_fast_or_twice_is_refused(rods: int, more: Document, problem: Problem) -> None:
    with pytest.raises(SceneError) as caught:
        platform(rods, more)
    assert caught.value.problems == (problem,)


@pytest.mark.parametrize(
    ("length", "problem"),
    [
        pytest.param(1.5, "too-many-constraints at /constraints/2", id="it fits where the rods cross, and holds"),
        pytest.param(3.5, "constraint-not-met at /constraints/2", id="it fits nowhere"),
    ],
)
def test_a_rod_of_another_length_lets_nothing_move(length: float, problem: str) -> None:
    document: Document = write_scene(platform(3))
    document["parameters"].append({"name": "k", "value": 1.0})
    document["constraints"][2]["length"] = "k"
    fits = read_scene(document)
    assert fits.degrees_of_freedom == 1
    with pytest.raises(SceneError, match=problem):
        change(fits, parameters={"k": length})


def test_a_guide_that_drives_all_there_is_is_told_as_such() -> None:
    """x is prescribed, and y follows from the rod: both move, and no equation of motion is left."""
    free = scene(
        {"x": (0.6, 0.0), "y": (0.8, 0.0)},
        {"m": 1.0, "l": 1.0, "g": 9.81},
        [particle("bob", "x", "y")],
        [rod("S", "o", "bob")],
        points={"o": ["0", "0"]},
    )
    with pytest.raises(SceneError) as caught:
        change(free, guides=[{"coordinate": "x", "value": "0.6 + 0.1*sin(t)"}])
    parameters = {"count": 1, "free": 1}
    assert caught.value.problems == (Problem("too-many-constraints", "/guides/0", parameters=parameters),)
