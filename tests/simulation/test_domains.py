"""Motions through places where a root, a modulus or an angle bends: SciPy on a right-hand side written by hand."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.simulation.scenes import document

from deltaq.mechanics.document import read_scene
from deltaq.model.modes import modes_of
from deltaq.simulation.service import run

SPRING = {"kind": "potential", "name": "spring", "energy": "x^2/2"}
Law = Callable[[float, float, float], float]


def rubbing(force: str) -> dict[str, object]:
    return {"kind": "friction", "name": "rubbing", "coordinate": "x", "force": force}


def pushed(force: str) -> dict[str, object]:
    return {"kind": "force", "name": "push", "at": "mass", "force": [force, "0"]}


def lossy(function: str) -> dict[str, object]:
    return {"kind": "dissipation", "name": "loss", "function": function}


def angle_up(t: float) -> float:
    """The second derivative of atan2(t + 1, t)."""
    return (4 * t + 2) / (2 * t * t + 2 * t + 1) ** 2


# Loads of a unit mass from x = 1 at rest, a guide of y, on which it rides, and its acceleration on [0, 2.5], in which
# it passes x = 0 once and never turns back.
MOTIONS = [
    pytest.param((SPRING, rubbing("0.1*abs(x)^1.5")), "", lambda t, x, v: -x + 0.1 * abs(x) ** 1.5, id="friction 3/2"),
    pytest.param(
        (SPRING, rubbing("0.01 + abs(x)^2.5/10")), "", lambda t, x, v: -x + 0.01 + 0.1 * abs(x) ** 2.5,
        id="friction 5/2",
    ),
    pytest.param(
        (SPRING, rubbing("0.1*max(x, 0)^1.5")), "", lambda t, x, v: -x + 0.1 * max(x, 0.0) ** 1.5,
        id="friction on one side",
    ),
    pytest.param(
        (SPRING, rubbing("0.05"), pushed("-0.1*x*abs(x)^1.25")), "",
        lambda t, x, v: -x + 0.05 - 0.1 * x * abs(x) ** 1.25, id="force beside friction",
    ),
    pytest.param(
        (SPRING, pushed("-x*abs(x)^0.5")), "", lambda t, x, v: -x - x * abs(x) ** 0.5, id="force by a root"
    ),
    pytest.param(
        (SPRING, lossy("0.1*abs(x)^1.5*dot(x)^2")), "", lambda t, x, v: -x - 0.2 * abs(x) ** 1.5 * v, id="dissipation"
    ),
    pytest.param((SPRING,), "atan2(t + 1, t)", lambda t, x, v: -x - angle_up(t), id="guide by an angle"),
    pytest.param(
        (SPRING,), "abs(t - 1)^3", lambda t, x, v: -x - 6 * abs(t - 1), id="guide by the cube of a modulus"
    ),
]  # fmt: skip


def scene_of(loads: tuple[dict[str, object], ...], guide: str) -> dict[str, object]:
    coordinates = {"x": (1.0, 0.0), **({"y": (0.0, 0.0)} if guide else {})}
    position = ["x + y" if guide else "x", "0"]
    return document(coordinates, {}, {"mass": ("1", position)}, loads, {"y": guide} if guide else None)


@pytest.mark.parametrize(("loads", "guide", "law"), MOTIONS)
def test_motion_goes_on(loads: tuple[dict[str, object], ...], guide: str, law: Law) -> None:
    found = run({"scene": scene_of(loads, guide), "t_end": 2.5, "samples": 51, "tolerance": 1e-7})
    known = solve_ivp(
        lambda t, y: (y[1], law(t, *y)), (0.0, 2.5), (1.0, 0.0), "DOP853", t_eval=found["t"], rtol=1e-12, atol=1e-12,
        max_step=0.01,
    )  # fmt: skip
    assert found["status"] == "ok"
    assert len(found["t"]) == 51
    errors = np.abs(np.array(found["coordinates"]["x"]) - known.y[0])
    assert errors.max() <= 2e-7
    assert np.all(errors <= np.array(found["error"]["estimate"]) + 1e-9)


@pytest.mark.parametrize(
    "force", ["abs(x)^1.5", "sqrt(abs(x))", "max(x, 0)^0.5", "x*min(x^2, 1)^0.25", "log(1+abs(x))"]
)
def test_forces_have_values_behind_the_end_of_a_mode(force: str) -> None:
    """A step that ends behind x = 0 is shortened, but first its forces are asked for there, in the mode before."""
    modes = modes_of(read_scene(scene_of((SPRING, rubbing(f"1 + {force}")), "")))
    assert modes is not None
    count = len(modes.model.layout.parameters)
    for sides in np.ndindex(*[2] * len(modes.kinks)):
        signs = [1.0 - 2.0 * side for side in sides] + [1.0]
        rows = [[x, -1.0, 0.0, *signs, *([0.0] * (count - len(signs)))] for x in (-1e-3, 0.0, 1e-3)]
        assert np.isfinite(modes.model.motion.table(np.array(rows))).all()


# Loads and a guide with what has no value where the motion comes to; what comes to zero there, and when, where that is
# known in closed form.
ENDS = [
    pytest.param((pushed("-1/x"),), "", "x", math.sqrt(math.pi / 2), id="into a line"),
    pytest.param((pushed("-1/x^2"),), "", "x", math.pi / math.sqrt(8), id="into a sun"),
    pytest.param((pushed("-sqrt(x + 1/2)"),), "", "1/2 + x", None, id="out of a root"),
    pytest.param((pushed("-1 - log(x)^2"),), "", "x", None, id="out of a logarithm"),
    pytest.param((pushed("1/cos(x)^2"),), "", "cos(x)", None, id="into a pole"),
    pytest.param((pushed("-1/(x + dot(x))"),), "", "dot(x) + x", None, id="by a rate"),
    pytest.param((SPRING,), "sin(t)/t", "t", 0.0, id="a limit that the formula misses at first"),
    pytest.param((SPRING,), "sin(t - 1)/(t - 1)", "-1 + t", 1.0, id="a limit that the formula misses"),
    pytest.param((SPRING,), "sqrt(2 - t)", "2 - t", 2.0, id="guide out of a root"),
]  # fmt: skip


@pytest.mark.parametrize("method", ["auto", "dop853", "radau-5"])
@pytest.mark.parametrize(("loads", "guide", "name", "time"), ENDS)
def test_where_something_has_no_value_it_is_told_what_comes_to_zero(
    loads: tuple[dict[str, object], ...], guide: str, name: str, time: float | None, method: str
) -> None:
    asked = {"scene": scene_of(loads, guide), "t_end": 2.5, "samples": 51, "tolerance": 1e-6, "method": method}
    found = run(asked)
    told = found["reason"]["parameters"]
    assert (found["status"], found["reason"]["code"], told["name"]) == ("singular", "singular", name)
    assert time is None or told["t"] == pytest.approx(time, abs=0.01)
    assert found["t_reached"] < 2.5


@pytest.mark.parametrize(
    "force",
    [
        pytest.param("x^3", id="without a margin"),
        pytest.param("x^3 + 1/(1 + x^2)", id="with a margin that grows"),
        pytest.param("x^3 - 1/(x - 0.5) + 2", id="with one that is left behind"),
        pytest.param("exp(x)*sqrt(x)", id="with a root that has its values"),
    ],
)
def test_what_grows_beyond_all_bounds_has_nothing_that_comes_to_zero(force: str) -> None:
    found = run({"scene": scene_of((pushed(force),), ""), "t_end": 10.0, "samples": 51, "tolerance": 1e-6})
    assert found["status"] == "diverged"
    assert "name" not in found["reason"]["parameters"]
