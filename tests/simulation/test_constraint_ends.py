"""Where constraints end a motion or let none begin: vanishing lengths, conditions without a gradient or a value."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from deltaq.errors import SceneError
from deltaq.simulation.service import run


def prescribed(length: str, *, plane: bool = False, **more: object) -> dict[str, Any]:
    """A particle at a length from the origin, on a line or in the plane, beside another that y measures."""
    bodies = {"bob": ["x", "y"]} if plane else {"bob": ["x", "0"], "other": ["0", "y"]}
    return {
        "format": 1,
        "id": "prescribed",
        "title": {"en": "Prescribed"},
        "coordinates": [{"name": "x", "value": 1.0}, {"name": "y", "value": 0.3, "rate": -0.5}],
        "parameters": [{"name": "m", "value": 1.0}],
        "points": [{"name": "origin", "position": ["0", "0"]}],
        "bodies": [{"name": n, "kind": "particle", "mass": "m", "position": place} for n, place in bodies.items()],
        "loads": [],
        "constraints": [{"name": "rod", "kind": "distance", "from": "origin", "to": "bob", "length": length}],
        **more,
    }


# A length, and when it is zero; y falls from 0.3 by 0.5 a second, less what the rod takes: (x + y)/2 goes on.
VANISHING = [
    pytest.param("cos(t)", False, np.pi / 2, id="in time"),
    pytest.param("1 - t/2", False, 2.0, id="evenly"),
    pytest.param("y", False, 2.6, id="with a coordinate"),
    pytest.param("cos(t)", True, np.pi / 2, id="in the plane"),
]


@pytest.mark.parametrize("method", ["auto", "dop853"])
@pytest.mark.parametrize(("length", "plane", "end"), VANISHING)
def test_a_motion_ends_where_a_length_comes_to_zero(length: str, plane: bool, end: float, method: str) -> None:
    found: Any = run({"scene": prescribed(length, plane=plane), "t_end": 3.0, "samples": 61, "method": method})
    assert (found["status"], found["reason"]["code"]) == ("singular_constraints", "length_vanishes")
    assert found["reason"]["parameters"]["name"] == "rod"
    assert found["reason"]["parameters"]["t"] == pytest.approx(end, rel=5e-3)
    assert found["t"][-1] <= end + 1e-9
    assert plane or min(found["coordinates"]["x"]) > -1e-9


@pytest.mark.parametrize("length", ["1 - t/4", "2 + cos(t)", "1"])
def test_one_that_stays_positive_does_not(length: str) -> None:
    assert run({"scene": prescribed(length), "t_end": 3.0, "samples": 61})["status"] == "ok"


def test_an_event_before_ends_it_as_such() -> None:
    near = {"name": "near", "value": "x - 0.1", "title": {"en": "near"}}
    found: Any = run({"scene": prescribed("1 - t/2", events=[near]), "t_end": 3.0, "samples": 61})
    assert found["status"] == "event"
    assert found["t"][-1] == pytest.approx(1.8, abs=1e-6)


def test_so_does_a_motion_that_goes_on_behind_kinks() -> None:
    push = {"kind": "force", "name": "push", "at": "other", "force": ["0", "max(-y, 0) - sign(dot(y))/10"]}
    found: Any = run({"scene": prescribed("1 - t/2", loads=[push]), "t_end": 3.0, "samples": 61})
    assert found["reason"]["code"] == "length_vanishes"
    assert found["reason"]["parameters"]["t"] == pytest.approx(2.0, rel=1e-3)


# A constraint that no motion can begin with, and why.
STARTS = [
    pytest.param("(x^2 + y^2 - 1)^2 = 0", "constraint-without-gradient", id="a square"),
    pytest.param("(x^2 + y^2 - 1)^3 = 0", "constraint-without-gradient", id="a cube"),
    pytest.param("(x - 1)^2*(y + 1) = 0", "constraint-without-gradient", id="a square among factors"),
    pytest.param("(x - 1)*y = 0", "constraints-locked", id="two lines that cross"),
    pytest.param("x^2 + y^2 = (1 + sqrt(t))^2", "constraint-not-finite", id="an infinite rate"),
    pytest.param("1/(x - 1) + y = 0", "constraint-not-finite", id="a pole"),
    pytest.param("x^2 + y^2 = -1", "constraint-not-met", id="nowhere"),
]


@pytest.mark.parametrize(("equation", "code"), STARTS)
def test_why_no_motion_begins_is_told(equation: str, code: str) -> None:
    start = [{"name": "x", "value": 1.0}, {"name": "y"}]
    track = {"name": "track", "kind": "equation", "equation": equation}
    with pytest.raises(SceneError) as caught:
        run({"scene": prescribed("1", plane=True, coordinates=start, constraints=[track]), "t_end": 1.0})
    assert [(each.code, each.pointer) for each in caught.value.problems] == [(code, "/scene/constraints/0")]
