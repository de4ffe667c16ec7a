"""Sections of ensembles: times by closed forms and by SciPy, errors that cover, and how each search ends."""

from __future__ import annotations

import gc
from base64 import b64decode
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from typing import Any

import numpy as np
import pytest
from mpmath import mp
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipk
from tests.simulation.scenes import oscillator

from deltaq.errors import InputError
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation import ensemble_parts
from deltaq.simulation.derivatives import accelerations
from deltaq.simulation.ensemble_answer import run
from deltaq.simulation.march import March
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps
from deltaq.simulation.series.marching import marching
from deltaq.simulation.service import problem_of

Floats = NDArray[np.float64]
SPRING, RUNAWAY = (write_scene(oscillator(force)) for force in ("-m*k*x", "m*x^3"))
X, U, K = "initial.x.value", "initial.x.rate", "parameters.k"


def ask(**fields: Any) -> dict[str, Any]:
    return run({"scene": SPRING, "t_end": 20.0, "samples": 2, "initial": {"x": {"rate": 0.0}}} | fields)


def covered(found: dict[str, Any], index: int, times: Floats, *, rounding: float = 2e-15) -> None:
    """All points of a run are there, each within its own error, and no error is a thousand times too large."""
    told, errors = np.array(found["section"]["t"][index]), np.array(found["section"]["t_error"][index], dtype=float)
    assert len(told) == len(times)
    true = np.abs(told - times)
    np.testing.assert_array_less(true, errors + rounding * (1.0 + times))
    assert errors.max(initial=0.0) < 1e-11


WAYS = [
    pytest.param("rising", [-1.0], id="rising"),
    pytest.param("falling", [1.0], id="falling"),
    pytest.param("both", [1.0, -1.0], id="both"),
]


@pytest.mark.parametrize(("direction", "signs"), WAYS)
def test_an_oscillator_passes_a_value_of_its_own(direction: str, signs: list[float]) -> None:
    """x = x₀ cos ωt is c where ωt = 2πn ± arccos(c/x₀); k and c, a parameter in the section, vary with the run."""
    asked = {X: [0.5, 1.0, 2.0], K: [1.0, 4.0], "parameters.c": [0.0, 0.25]}
    found = ask(vary=asked, section={"value": "x - c", "direction": direction})
    assert set(found["section"]["status"]) == {"ok"}
    for index, (x, k, c) in enumerate(zip(*found["quantities"].values(), strict=True)):
        omega, turns = np.sqrt(k), 2.0 * np.pi * np.arange(-1, 20)
        times = np.sort(np.concatenate([turns + sign * np.arccos(c / x) for sign in signs])) / omega
        times = times[(times > 0.0) & (times < 20.0)]
        covered(found, index, times)
        rates, error = np.array(found["section"]["rates"]["x"][index]), np.array(found["section"]["error"][index])
        true = -x * omega * np.sin(omega * times)
        np.testing.assert_array_less(np.abs(rates - true) / np.maximum(1.0, np.abs(true)), error + 1e-14)
        np.testing.assert_allclose(found["section"]["coordinates"]["x"][index], c, atol=1e-14)


def test_a_pendulum_passes_its_lowest_point() -> None:
    """It swings with the period 4 K(k²)/ω, k = u/2ω < 1, and turns over in 4 K(1/k²)/u beyond; it begins there."""
    lengths, rates = [0.5, 1.0], [1.0, 5.0, 9.0, 12.0]
    found = run(
        {
            "scene": "pendulum",
            "t_end": 15.0,
            "initial": {"phi": {"value": 0.0}},
            "vary": {"parameters.l": lengths, "initial.phi.rate": rates},
            "section": {"value": "phi"},
        }
    )
    gravity = next(one.value for one in load_scene("pendulum").parameters if one.name == "g")
    for index, (length, u) in enumerate(zip(*found["quantities"].values(), strict=True)):
        omega = np.sqrt(gravity / length)
        modulus = (0.5 * u / omega) ** 2
        period = 4.0 * ellipk(modulus) / omega if modulus < 1.0 else 4.0 * ellipk(1.0 / modulus) / u
        covered(found, index, period * np.arange(int(15.0 / period) + 1))
        np.testing.assert_allclose(found["section"]["rates"]["phi"][index], u, rtol=1e-12)


def test_a_drive_is_looked_at_once_in_each_of_its_periods() -> None:
    """ẍ = −x + F cos wt from rest: x = F (cos wt − cos t)/(1 − w²), at t = 2πn/w."""
    scene = write_scene(oscillator("-m*x + m*F0*cos(omega*t)", x=0.0, u=0.0))
    found = ask(scene=scene, vary={"parameters.omega": [0.6, 1.7, 2.3]}, section={"value": "sin(omega*t)"})
    strength = next(one["value"] for one in scene["parameters"] if one["name"] == "F0")
    for index, omega in enumerate(found["quantities"]["parameters.omega"]):
        times = 2.0 * np.pi * np.arange(int(20.0 * omega / (2.0 * np.pi)) + 1) / omega
        covered(found, index, times)
        true = strength * (1.0 - np.cos(times)) / (1.0 - omega**2)
        apart = np.abs(np.array(found["section"]["coordinates"]["x"][index]) - true)
        np.testing.assert_array_less(apart, np.array(found["section"]["error"][index]) + 1e-14)


def test_double_pendulums_pass_where_scipy_finds_them() -> None:
    """Each of its own length, an expression of both angles and a rate."""
    vary = {"parameters.l1": [0.8, 1.0, 1.3], "initial.phi1.value": [0.3, 0.9]}
    asked = {"scene": "double-pendulum", "t_end": 8.0, "vary": vary}
    found = run(asked | {"section": {"value": "sin(phi1) + l1*phi2 - dot(phi2)/10", "direction": "both"}})
    problem = problem_of(load_scene("double-pendulum"), 8.0, 2)
    names = [one.name for one in problem.model.scene.parameters]
    for index, (length, angle) in enumerate(zip(*found["quantities"].values(), strict=True)):
        numbers = np.array(problem.parameters)
        numbers[names.index("l1")] = length

        own = replace(problem, parameters=tuple(numbers.tolist()))

        def law(t: float, state: Floats, own: Problem = own) -> Floats:
            return np.concatenate([state[2:], accelerations(own, np.array([t]), state[None, :])[0]])

        def plane(_: float, state: Floats, length: float = length) -> float:
            return float(np.sin(state[0]) + length * state[1] - state[3] / 10.0)

        begin = problem.state[:4].copy()
        begin[0] = angle
        true = solve_ivp(law, (0.0, 8.0), begin, "DOP853", events=plane, rtol=1e-13, atol=1e-13)
        times, states = true.t_events[0], true.y_events[0]
        assert len(found["section"]["t"][index]) == len(times) > 3
        np.testing.assert_allclose(found["section"]["t"][index], times, atol=1e-9)
        for place, name in enumerate(("phi1", "phi2")):
            np.testing.assert_allclose(found["section"]["coordinates"][name][index], states[:, place], atol=1e-9)
            np.testing.assert_allclose(found["section"]["rates"][name][index], states[:, 2 + place], atol=1e-8)


ENDS = [
    pytest.param({}, {"value": "x - 1.5"}, ["never_met", "ok"], [0, 3], id="too far for one of them"),
    pytest.param({}, {"value": "x", "points": 2}, ["full", "full"], [2, 2], id="as often as wanted"),
    pytest.param({}, {"value": "x^2 + dot(x)^2 - 1"}, ["contained", "never_met"], [0, 0], id="a constant of motion"),
    pytest.param({}, {"value": "log(x - 5)"}, ["never_met", "never_met"], [0, 0], id="nowhere defined"),
    pytest.param(
        {"scene": RUNAWAY, "vary": {X: [0.0, 3.0]}},
        {"value": "x - 4"},
        ["never_met", "diverged"],
        [0, 1],
        id="one runs away",
    ),
]


@pytest.mark.parametrize(("fields", "section", "statuses", "counts"), ENDS)
def test_how_a_search_ends_is_told_with_a_remedy(
    fields: dict[str, Any], section: dict[str, Any], statuses: list[str], counts: list[int]
) -> None:
    found = ask(**({"vary": {X: [1.0, 2.0]}, "parameters": {"k": 1.0}} | fields), section=section)
    assert found["section"]["status"] == statuses
    assert [len(one) for one in found["section"]["t"]] == counts
    assert found["outcomes"].keys() == {*found["status"], *statuses}


def test_points_end_where_no_digit_of_them_is_left() -> None:
    """Chaotic motions lose 16 digits; others beside them do not."""
    vary = {"initial.phi1.value": [0.05, 2.8], "initial.phi2.value": [0.05, 3.0]}
    found = run(
        {"scene": "double-pendulum", "t_end": 150.0, "samples": 2, "vary": vary, "combine": "together"}
        | {"section": {"value": "phi2", "points": 1000}}
    )
    section = found["section"]
    assert section["status"] == ["ok", "horizon_reached"]
    assert max(section["error"][0]) < 1e-9
    assert section["t"][1][-1] < 100.0
    assert 1e-4 < sorted(section["error"][1])[-2] < 0.1  # one by itself may be farther away


def test_a_motion_that_touches_the_section_tells_no_error_that_is_too_small() -> None:
    """x = cos t touches 1 at 2πn: rounding decides whether these are points, and moves them by its root."""
    found = ask(vary={X: [1.0]}, parameters={"k": 1.0}, section={"value": "x - 1", "direction": "both"})["section"]
    for time, error in zip(found["t"][0], found["t_error"][0], strict=True):
        away = abs(time - 2.0 * np.pi * round(time / (2.0 * np.pi)))
        assert error is None or away <= error + 1e-15


def test_packed_points_are_those_in_numbers() -> None:
    asked = {"vary": {X: [0.5, 3.0]}, "section": {"value": "x - 1"}}
    numbers, packed = ask(**asked)["section"], ask(**asked, columns="base64")["section"]
    for name in ("t", "error", "t_error"):
        assert [np.frombuffer(b64decode(one)).tolist() for one in packed[name]] == numbers[name]
    assert [np.frombuffer(b64decode(one)).tolist() for one in packed["rates"]["x"]] == numbers["rates"]["x"]


def test_points_found_by_other_processes_are_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ensemble_parts, "OF_CLUSTER", 4)
    asked = {"scene": "pendulum", "t_end": 5.0, "vary": {"parameters.l": {"from": 0.5, "to": 1.5, "count": 10}}}
    asked |= {"section": {"value": "phi - l/10"}}
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as cluster:
        found = run(asked, cluster=cluster)
    here = run(asked)
    assert {**found, "wall_time": 0.0} == {**here, "wall_time": 0.0}
    assert min(map(len, here["section"]["t"])) > 1


REFUSED = [
    pytest.param({"value": "y"}, "unknown-name", "/section/value", id="unknown"),
    pytest.param({"value": "x +"}, "unexpected-end", "/section/value", id="unfinished"),
    pytest.param({"value": ""}, "request-text-too-short", "/section/value", id="nothing"),
    pytest.param({"value": "ddot(x)"}, "section-derivative", "/section/value", id="acceleration"),
    pytest.param({"value": "x = 0"}, "not-scalar", "/section/value", id="equation"),
    pytest.param({"value": "1"}, "section-plane-constant", "/section/value", id="number"),
    pytest.param({"value": "k*m"}, "section-plane-constant", "/section/value", id="parameters, one that varies"),
    pytest.param({"value": "x + 1/(k - k)"}, "not-computable", "/section/value", id="nowhere a number"),
    pytest.param({"value": "x", "direction": "up"}, "request-not-one-of", "/section/direction", id="direction"),
    pytest.param({"value": "x", "points": 0}, "request-too-small", "/section/points", id="no points"),
    pytest.param({"value": "x", "points": 20_000}, "ensemble-section-too-large", "/section/points", id="too many"),
    pytest.param({}, "missing-field", "/section/value", id="no value"),
]


@pytest.mark.parametrize(("section", "code", "pointer"), REFUSED)
def test_a_section_that_makes_no_sense_is_refused_at_its_field(
    section: dict[str, Any], code: str, pointer: str
) -> None:
    with pytest.raises(InputError) as caught:
        ask(vary={K: {"from": 1.0, "to": 2.0, "count": 20}}, section=section)
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]


ONE_BY_ONE = [
    pytest.param("bouncing-ball", "z", id="impacts"),
    pytest.param("stick-slip", "x", id="dry friction"),
    pytest.param(write_scene(oscillator("-m*sign(x)")), "x", id="a jump"),
    pytest.param(write_scene(oscillator("-m*abs(x)")), "x", id="a kink"),
]


@pytest.mark.parametrize(("scene", "name"), ONE_BY_ONE)
def test_motions_that_lanes_cannot_do_are_refused(scene: Any, name: str) -> None:
    section = {"value": f"{name} - 1"}
    with pytest.raises(InputError) as caught:
        run({"scene": scene, "t_end": 1.0, "vary": {f"initial.{name}.value": [1.0]}, "section": section})
    assert [(one.code, one.pointer) for one in caught.value.problems] == [("ensemble-section-events", "/section")]


def test_code_of_steps_is_kept_while_motions_go_by_it() -> None:
    """Where threads begin at once, each may have made its own, of which the next one finds only the last."""
    problem = problem_of(load_scene("pendulum"), 5.0, 2)
    march = March(problem, problem.state[None, :2], Steps(0.25, 1e-16, order=36), 4)
    marching.cache_clear()
    gc.collect()
    while march.goes_on:
        gone = march.go()
        march.settle(gone, np.zeros(gone.taken.shape, dtype=bool))
    assert march.reached().tolist() == [5.0]


def test_errors_told_cover_the_true_ones_on_long_ways() -> None:
    """Pendulums of many lengths through their lowest point, at n·4K(k²)/ω: the hundredth is as honest as the first."""
    asked = {"parameters.l": np.linspace(0.3, 2.0, 12).tolist(), "initial.phi.rate": [0.7, 4.0, 15.0]}
    motions = {"scene": "pendulum", "t_end": 60.0, "samples": 2, "initial": {"phi": {"value": 0.0}}, "vary": asked}
    found = run(motions | {"parameters": {"g": 9.81}, "section": {"value": "phi", "points": 400}})
    told = list[bool]()
    with mp.workdps(30):
        for index, (length, u) in enumerate(zip(*found["quantities"].values(), strict=True)):
            omega = mp.sqrt(mp.mpf(9.81) / mp.mpf(length))
            modulus = (mp.mpf(u) / (2 * omega)) ** 2
            period = 4 * mp.ellipk(modulus) / omega if modulus < 1 else 4 * mp.ellipk(1 / modulus) / u
            points = zip(found["section"]["t"][index], found["section"]["t_error"][index], strict=True)
            told += [abs(mp.mpf(time) - n * period) <= error for n, (time, error) in enumerate(points)]
    assert len(told) > 1500
    assert np.mean(told) >= 0.995
