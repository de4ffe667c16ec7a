"""Experiments that linearize or move starts take scenes with constraints in coordinates that keep them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from deltaq.errors import RequestError
from deltaq.lab.charts.chaos import charts
from deltaq.lab.library import get_experiment


def test_a_pendulum_by_a_rod_fails_where_the_one_by_an_angle_does() -> None:
    """λ = ±i √(g/l), and |R(ih√(g/l))| = 1 of RK4 at h √(g/l) = 2√2."""
    request = {"scene": "cartesian-pendulum", "methods": ["rk4"], "at": "rest", "t_end": 4.0}
    *_, last = get_experiment("stability").run(request)
    result: Any = last.result
    assert result["minimal"] == ["phi"]
    turning = math.sqrt(9.81)
    assert sorted(result["eigenvalues"]) == [
        [0.0, pytest.approx(-turning, rel=1e-5)],
        [0.0, pytest.approx(turning, rel=1e-5)],
    ]
    (row,) = result["methods"]
    assert row["predicted"] == pytest.approx(2 * math.sqrt(2) / turning, rel=0.01)
    assert result["rest"]


def last_of(name: str, **request: object) -> Any:
    *_, last = get_experiment(name).run(request)
    return last.result


def test_orbits_of_rods_begin_on_them_with_the_energy_of_all() -> None:
    """Each start is told in x and y: lengths and rates along the rods, and m g and m v²/2 by hand."""
    found = last_of("poincare-section", scene="double-pendulum-by-rods", t_end=10.0, count=6, crossings=10)
    assert found["minimal"] == ["phi1", "phi2"]
    assert len(found["orbits"]) > 3
    for orbit in found["orbits"]:
        x1, y1, x2, y2 = (orbit["initial"][name]["value"] for name in ("x1", "y1", "x2", "y2"))
        u1, v1, u2, v2 = (orbit["initial"][name]["rate"] for name in ("x1", "y1", "x2", "y2"))
        for x, y, u, v in ((x1, y1, u1, v1), (x2 - x1, y2 - y1, u2 - u1, v2 - v1)):
            assert math.hypot(x, y) == pytest.approx(1.0, abs=1e-12)
            assert x * u + y * v == pytest.approx(0.0, abs=1e-12)
        energy = (u1**2 + v1**2 + u2**2 + v2**2) / 2 - 9.81 * (y1 + y2)
        assert energy == pytest.approx(found["energy"], abs=1e-6)


def test_floquet_multipliers_of_a_rod_on_a_moving_pivot() -> None:
    """Mathieu's equation l φ̈ = −(g − a ω² sin ωt) φ over one period, by SciPy; the pendulum hangs at rest."""
    pivot = {"name": "pivot", "position": ["0", "a*sin(w*t)"]}
    scene = {
        "id": "own",
        "coordinates": [{"name": "x"}, {"name": "y", "value": -1.0, "rate": 2.0}],
        "parameters": [
            {"name": n, "value": v} for n, v in (("m", 1.0), ("l", 1.0), ("g", 9.81), ("a", 0.2), ("w", 10.0))
        ],
        "points": [pivot],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
        "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "-g"]}],
        "constraints": [{"name": "rod", "kind": "distance", "from": "pivot", "to": "bob", "length": "l"}],
    }
    sides = {
        "x": {"parameter": "a", "from": 0.05, "to": 0.3, "count": 8},
        "y": {"parameter": "w", "from": 5.0, "to": 9.0, "count": 8},
    }
    found = last_of("stability-map", scene=scene, t_end=2.0, **sides)
    assert found["minimal"] == ["phi"]
    truth = [[growth(a, w) for a in found["x"]["values"]] for w in found["y"]["values"]]
    assert np.array(truth).max() > 1.5
    assert np.abs(np.array(found["growth"]) - truth).max() < 1e-3


def growth(a: float, w: float) -> float:
    """The largest Floquet multiplier."""

    def rates(t: float, y: Any) -> list[float]:
        return [y[1], -(9.81 - a * w**2 * math.sin(w * t)) * y[0]]

    columns = [solve_ivp(rates, (0.0, math.tau / w), y, rtol=1e-10, atol=1e-12).y[:, -1] for y in np.eye(2)]
    return float(np.abs(np.linalg.eigvals(np.column_stack(columns))).max())


def test_a_pendulum_by_a_rod_is_as_regular_and_as_uncertain_as_by_its_angle() -> None:
    chaos = last_of("chaos", scene="cartesian-pendulum", t_end=5.0, map=True)
    assert (chaos["minimal"], chaos["exponent"]["verdict"]) == (["phi"], "regular")
    assert chaos["map"] == {"missing": "constraints"}
    drawn = charts(chaos, lambda key, **_: key)
    assert [chart["id"] for chart in drawn] == ["chaos-twins", "chaos-exponent", "chaos-horizon"][: len(drawn)]
    assert "labs.minimal" in drawn[0]["caption"]
    assert "labs.chaos.no-map" in drawn[1]["caption"]
    spread = last_of("uncertainty", scene="cartesian-pendulum", t_end=2.0, runs=30, uncertain="values", tolerance=1e-3)
    assert (spread["minimal"], spread["tolerances"]) == (["phi"], {"initial.phi.value": 1e-3})


@pytest.mark.parametrize("name", ["stability", "chaos", "uncertainty", "poincare-section"])
def test_what_has_no_closed_solution_is_refused_with_what_to_do(name: str) -> None:
    with pytest.raises(RequestError) as caught:
        next(iter(get_experiment(name).run({"scene": "four-bar", "t_end": 1.0})))
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer, dict(problem.parameters)) == ("lab-constraints", "/scene", {"count": 2})
