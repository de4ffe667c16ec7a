"""Energy drift: bands, drifts and losses that are known in closed form, over all methods."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from deltaq.errors import RequestError
from deltaq.lab.charts.energy_drift import charts
from deltaq.lab.charts.words import words
from deltaq.lab.drift import LOST, Departure, sample_times
from deltaq.lab.experiments.energy_drift import EXPERIMENT
from deltaq.narration.catalog import text
from deltaq.simulation.library import get_method, method_ids

OSCILLATOR = {
    "id": "oscillator",
    "coordinates": [{"name": "x", "value": 1.0}],
    "parameters": [{"name": "m", "value": 1.0}, {"name": "k", "value": 1.0}],
    "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
    "loads": [{"kind": "potential", "name": "spring", "energy": "k*x^2/2"}],
}
# On an oscillator energy is multiplied by |R(ihω)|² in each step: what a method loses or wins in one is known.
FACTORS = {
    "explicit-euler": lambda z: 1.0 + z**2,
    "heun": lambda z: 1.0 + z**4 / 4.0,
    "bogacki-shampine-32": lambda z: 1.0 - z**4 / 12.0 + z**6 / 36.0,
    "rk4": lambda z: 1.0 - z**6 / 72.0 + z**8 / 576.0,
}
QUADRATIC = ("implicit-midpoint", "variational-midpoint", "newmark", "gauss-4", "gauss-6")  # keep quadratic energies
KEEPING = (*QUADRATIC, "symplectic-euler", "stormer-verlet")
LOSING = tuple(sorted(set(method_ids()) - set(KEEPING)))
STEPS, STEP = 6_000, 0.1

Lines = dict[str, dict[str, Any]]


def lines_of(scene: object, **more: object) -> Lines:
    found = list(EXPERIMENT.run({"scene": scene, "methods": list(method_ids()), **more}))[-1].result["lines"]
    assert isinstance(found, list)
    return {line["method"]: line for line in found}


@pytest.fixture(scope="module")
def oscillator() -> Lines:
    return lines_of(OSCILLATOR, steps=STEPS, step=STEP)


@pytest.fixture(scope="module")
def pendulum() -> Lines:
    return lines_of("pendulum", steps=6_000)


@pytest.mark.parametrize("method", sorted(FACTORS))
def test_what_an_oscillator_loses_is_that_of_the_stability_function(oscillator: Lines, method: str) -> None:
    line, rate = oscillator[method], math.log(FACTORS[method](STEP)) / STEP  # E grows like e^(rate·t)
    lost_at = math.log1p(LOST * math.copysign(1.0, rate)) / rate
    if lost_at > STEPS * STEP:
        assert line["verdict"] == "linear"
        assert line["largest"] == pytest.approx(abs(math.expm1(rate * STEPS * STEP)), rel=0.05)
    else:
        assert line["verdict"] == "lost"
        assert line["lost_at"] == pytest.approx(lost_at, rel=0.1)
    assert line["growth_interval"][0] <= line["growth"] <= line["growth_interval"][1]
    assert line["growth"] == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize("method", QUADRATIC)
def test_methods_that_keep_quadratic_energies_leave_rounding(oscillator: Lines, method: str) -> None:
    assert oscillator[method]["verdict"] == "rounding"


@pytest.mark.parametrize("method", ["symplectic-euler", "stormer-verlet"])
def test_a_band_has_the_width_of_the_modified_energy(oscillator: Lines, method: str) -> None:
    line = oscillator[method]  # H̃ = H ∓ h p q / 2 + …: of order h; Störmer–Verlet h²/8 of x² at once
    width = {"symplectic-euler": STEP / 2, "stormer-verlet": STEP**2 / 4}[method]
    assert line["verdict"] == "bounded"
    assert line["largest"] == pytest.approx(width, rel=0.2)


@pytest.mark.parametrize("method", method_ids())
def test_a_pendulum_keeps_its_energy_with_symmetric_and_symplectic_methods_only(pendulum: Lines, method: str) -> None:
    allowed = {"bounded", "rounding"} if method in KEEPING else {"linear", "grows", "lost"}
    assert pendulum[method]["verdict"] in allowed


@pytest.mark.parametrize("scene", ["pendulum", "elastic-pendulum", "double-pendulum"])
def test_what_is_larger_than_the_energy_is_never_said_to_grow_little(scene: str) -> None:
    for line in lines_of(scene, steps=1_000).values():
        if max(line["error"], default=0.0) > LOST:
            assert line["verdict"] == "lost"
            assert line["lost_at"] <= line["t"][-1]
            assert line["growth"] is None or line["growth"] > 0.3
        else:
            assert line["lost_at"] is None


def test_the_legend_tells_the_size(pendulum: Lines) -> None:
    result = {"lines": list(pendulum.values()), "t_end": 1.0, "step": 1.0, "steps": 1, "tolerance": 1e-6}
    (chart,) = charts(result, words(text, "en"))
    told = {trace["legendgroup"]: trace["name"] for trace in chart["data"]}
    assert "lost from" in told["explicit-euler"]
    assert "grows like t, to" in told["rk4"]
    assert "stays in a band of 0.0105" in told["stormer-verlet"]


def test_steps_are_variable_where_it_is_said(pendulum: Lines) -> None:
    assert {name for name, line in pendulum.items() if line["variable"]} == {"dormand-prince-54", "dop853", "radau-5"}
    assert all(get_method(name).is_adaptive for name, line in pendulum.items() if line["variable"])


def made(envelope: object, trend: object = 0.0) -> Departure:
    """A departure with an envelope and a mean over the time."""
    times = np.geomspace(1.0, 1e4, 120)
    return Departure(times, np.asarray(envelope(times)), np.asarray(trend * times), 100_000)  # type: ignore[operator]


@pytest.mark.parametrize("size", [1e-9, 1e-5, 1e-2])
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("power", "kind"), [(0.0, "bounded"), (0.5, "grows"), (1.0, "linear"), (2.0, "grows")])
def test_growth_by_a_power_is_found_and_its_interval_covers(size: float, seed: int, power: float, kind: str) -> None:
    noise = np.random.default_rng(seed).uniform(0.9, 1.0, 120)
    found = made(lambda t: size * (t / 1e4) ** power * noise)
    assert found.kind == kind
    growth = found.growth
    assert growth is not None
    assert growth.lower - 0.02 <= power <= growth.upper + 0.02


@pytest.mark.parametrize("saturated", [0.5, 1.0, 243.0, 1e30])
def test_an_error_that_has_saturated_is_lost_and_its_growth_is_that_before(saturated: float) -> None:
    found = made(lambda t: np.minimum(1e-3 * t, saturated))
    assert found.kind == "lost"
    assert found.lost_at == pytest.approx(LOST / 1e-3, rel=0.1)
    assert found.growth is not None
    assert found.growth.power == pytest.approx(1.0, abs=0.05)


def test_what_is_no_number_is_lost() -> None:
    assert made(lambda t: np.where(t > 100.0, np.nan, 1e-6)).kind == "lost"


def test_a_drift_beneath_a_band_is_seen() -> None:
    assert made(lambda t: 1e-6 + 5e-11 * t, 5e-11).kind == "linear"


def test_rounding_has_no_growth() -> None:
    found = made(lambda t: np.full_like(t, 1e-17))
    assert found.growth is None
    assert found.kind == "rounding"


def test_samples_stand_at_whole_steps_inside_the_span() -> None:
    times = sample_times(1000.0, 0.1)
    assert times[0] == 0.0
    assert times[-1] == 1000.0
    assert np.abs(times / 0.1 - np.round(times / 0.1)).max() < 1e-9
    assert np.all(np.diff(times) > 0.0)


@pytest.mark.parametrize("steps", [pytest.param(10, id="too few"), pytest.param(10**7, id="too many")])
def test_the_number_of_steps_is_bounded(steps: int) -> None:
    with pytest.raises(RequestError) as caught:
        next(EXPERIMENT.run({"scene": "pendulum", "steps": steps}))
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer) == ("request-outside", "/steps")
    assert problem.parameters["max"] == 1_000_000
