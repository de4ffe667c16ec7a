"""Energy drift: a band for symplectic methods, linear growth for others."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.errors import RequestError
from deltaq.lab.drift import Departure, sample_times
from deltaq.lab.experiments.energy_drift import run
from deltaq.simulation.library import get_method


@pytest.fixture(scope="module")
def lines() -> dict[str, dict[str, object]]:
    found = list(run({"scene": "pendulum", "steps": 20_000}))[-1].result["lines"]
    assert isinstance(found, list)
    return {line["method"]: line for line in found}


@pytest.mark.parametrize("method", ["symplectic-euler", "stormer-verlet", "implicit-midpoint", "gauss-4"])
def test_symplectic_methods_keep_the_energy_in_a_band(lines: dict[str, dict[str, object]], method: str) -> None:
    line = lines[method]
    assert line["symplectic"] is True
    assert line["growth"] == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("method", ["rk4", "heun"])
def test_other_methods_lose_or_win_energy_with_the_time(lines: dict[str, dict[str, object]], method: str) -> None:
    growth = lines[method]["growth"]
    assert isinstance(growth, float)
    assert growth > 0.7


def test_explicit_euler_runs_away(lines: dict[str, dict[str, object]]) -> None:
    errors = lines["explicit-euler"]["error"]
    assert isinstance(errors, list)
    assert max(errors) > 1.0


def test_steps_are_variable_where_it_is_said(lines: dict[str, dict[str, object]]) -> None:
    assert [name for name, line in lines.items() if line["variable"]] == ["dormand-prince-54", "dop853", "radau-5"]
    assert all(get_method(name).is_adaptive for name, line in lines.items() if line["variable"])


@pytest.mark.parametrize(
    ("power", "expected"), [pytest.param(0.0, 0.0, id="band"), pytest.param(1.0, 1.0, id="linear")]
)
def test_the_exponent_of_growth(power: float, expected: float) -> None:
    times = np.geomspace(1.0, 1e4, 200)
    assert Departure(times, 1e-6 * times**power).growth == pytest.approx(expected, abs=1e-6)


def test_rounding_has_no_growth() -> None:
    assert Departure(np.geomspace(1.0, 1e4, 200), np.full(200, 1e-17)).growth is None


def test_samples_stand_at_whole_steps_inside_the_span() -> None:
    times = sample_times(1000.0, 0.1)
    assert times[0] == 0.0
    assert times[-1] == 1000.0
    assert np.abs(times / 0.1 - np.round(times / 0.1)).max() < 1e-9
    assert np.all(np.diff(times) > 0.0)


@pytest.mark.parametrize("steps", [pytest.param(10, id="too few"), pytest.param(10**7, id="too many")])
def test_the_number_of_steps_is_bounded(steps: int) -> None:
    with pytest.raises(RequestError) as caught:
        next(run({"scene": "pendulum", "steps": steps}))
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer) == ("request-outside", "/steps")
    assert problem.parameters["max"] == 1_000_000
