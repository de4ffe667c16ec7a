"""The period of scenes that are driven periodically, and what is no period."""

from __future__ import annotations

import math

import pytest

from deltaq.errors import Problem, SceneError
from deltaq.lab.period import period
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene


def driven(force: str, energy: str = "0") -> Scene:
    """A particle on a line, driven by a force and held by a potential."""
    return read_scene(
        {
            "id": "driven",
            "coordinates": [{"name": "x"}],
            "parameters": [{"name": name, "value": value} for name, value in {"m": 1, "a": 1, "w": 3, "v": 2}.items()],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
            "loads": [
                {"kind": "force", "name": "push", "at": "bob", "force": [f"a*({force})", "0"]},
                {"kind": "potential", "name": "well", "energy": f"a*({energy})"},
            ],
        }
    )


PERIODS = [
    pytest.param("sin(w*t)", "0", math.tau / 3, id="one frequency"),
    pytest.param("cos(w*t + 1) + sin(t*w)", "0", math.tau / 3, id="with a phase"),
    pytest.param("sin(w*t)^2", "0", math.tau / 3, id="squared: a multiple of the shortest"),
    pytest.param("sin(w*t) + cos(v*t)", "0", math.tau, id="ratio 3 : 2"),
    pytest.param("sin(2*w*t)", "cos(w*t)*x", math.tau / 3, id="in force and potential"),
    pytest.param("sin(t/5)", "0", 5 * math.tau, id="a slow one"),
    pytest.param("sin(w*t)*sin(x)", "0", math.tau / 3, id="times a function of a coordinate"),
]


@pytest.mark.parametrize(("force", "energy", "seconds"), PERIODS)
def test_period(force: str, energy: str, seconds: float) -> None:
    assert period(driven(force, energy)) == pytest.approx(seconds, rel=1e-12)


def test_period_at_other_values() -> None:
    assert period(driven("sin(w*t)"), {"w": 7.0}) == pytest.approx(math.tau / 7, rel=1e-12)


REFUSED = [
    pytest.param("1", "no-period", id="constant"),
    pytest.param("t", "not-periodic", id="growing"),
    pytest.param("t*sin(w*t)", "not-periodic", id="growing oscillation"),
    pytest.param("sin(w*t^2)", "not-periodic", id="chirp"),
    pytest.param("exp(-t)", "not-periodic", id="decay"),
    pytest.param("sin(w*t + x)", "not-periodic", id="phase by a coordinate"),
    pytest.param("sin(w*t) + sin(sqrt(2)*w*t)", "not-periodic", id="irrational ratio"),
]


@pytest.mark.parametrize(("force", "code"), REFUSED)
def test_what_has_no_period_is_refused(force: str, code: str) -> None:
    with pytest.raises(SceneError) as caught:
        period(driven(force))
    assert caught.value.problems == (Problem(code, "/guides"),)
