"""Taylor series: recurrences of all functions, one code or another, jumps of forces, closed forms, long times."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest
from tests.simulation.scenes import all_scenes, document, get_scene, oscillator

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.model.recurrences import Recurrences
from deltaq.simulation.driver import simulate
from deltaq.simulation.ensemble import Ensemble, in_lanes
from deltaq.simulation.kernels.taylor import MOST_ORDERS
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run
from deltaq.simulation.series.generated import Jet, jet_of
from deltaq.simulation.series.interpreter import interpreted
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

TAYLOR = get_method("taylor")
FREE = [name for name in all_scenes() if not get_scene(name).conditions]  # of constraints, which series cannot keep


def coefficients(problem: Problem, order: int, jet: Jet) -> np.ndarray:
    """The Taylor coefficients of (q, q̇) at the start, of all lanes: shape (order + 1, 2n, lanes)."""
    return rows(problem, order, jet)[: order + 1, : 2 * problem.degrees]


def rows(problem: Problem, order: int, jet: Jet) -> np.ndarray:
    """All that a jet tells, of all lanes: shape (MOST_ORDERS, components, lanes)."""
    lanes = jet.shape.lanes
    constants = problem.model.recurrences.constants(np.array(problem.parameters))
    given = np.repeat(np.array([1.0, *problem.state, 0.0, *constants]), lanes)
    out, work = np.zeros((MOST_ORDERS, jet.shape.components, lanes)), np.zeros(jet.work)
    program = np.array([order, *jet.program], dtype=np.int64)
    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)(jet.code.address)
    function(*(array.ctypes.data for array in (out, given, work, program)))
    return out


FORCES = {
    "sin(x)*cos(2*x)": lambda x, u, t: mp.sin(x) * mp.cos(2 * x),
    "sin(x)*cos(2*t) - cos(x)*sin(2*t)": lambda x, u, t: mp.sin(x - 2 * t),
    "cos(2*t)*sin(x) + sin(2*t)*cos(x)": lambda x, u, t: mp.sin(x + 2 * t),
    "3*cos(x)*sin(t) - 3*cos(t)*sin(x)": lambda x, u, t: 3 * mp.sin(t - x),
    "-cos(x)*cos(t) - sin(t)*sin(x)": lambda x, u, t: -mp.cos(x - t),
    "sin(x)*sin(t) - cos(t)*cos(x) + cos(t)": lambda x, u, t: mp.cos(t) - mp.cos(x + t),
    "tan(x/2) + t": lambda x, u, t: mp.tan(x / 2) + t,
    "exp(-x)*log(2 + x)": lambda x, u, t: mp.exp(-x) * mp.log(2 + x),
    "sqrt(1 + x^2) - x^3": lambda x, u, t: mp.sqrt(1 + x**2) - x**3,
    "(1 + x^2)^(-3/2)": lambda x, u, t: (1 + x**2) ** mp.mpf(-1.5),
    "1/(2 + x) - 3/(1 + x^2)^2": lambda x, u, t: 1 / (2 + x) - 3 / (1 + x**2) ** 2,
    "asin(x/2) + acos(x/3)": lambda x, u, t: mp.asin(x / 2) + mp.acos(x / 3),
    "atan(x)*dot(x)": lambda x, u, t: mp.atan(x) * u,
    "atan2(1 + t, x)": lambda x, u, t: mp.atan2(1 + t, x),
    "sinh(x) - cosh(t)": lambda x, u, t: mp.sinh(x) - mp.cosh(t),
    "tanh(x) + cot(1 + x)": lambda x, u, t: mp.tanh(x) + mp.cot(1 + x),
    "asinh(x) + acosh(2 + x)": lambda x, u, t: mp.asinh(x) + mp.acosh(2 + x),
    "atanh(x/2)*sec(x)": lambda x, u, t: mp.atanh(x / 2) * mp.sec(x),
    "abs(x)*sign(dot(x))": lambda x, u, t: abs(x) * mp.sign(u),
}


@pytest.mark.parametrize("force", FORCES)
@pytest.mark.parametrize("made", [interpreted, jet_of])
def test_series_solve_the_equation(made: Callable[[Recurrences], Jet], force: str) -> None:
    """x″ = F of the polynomial, put in at a small time with fifty digits, leaves no more than its own last terms do."""
    problem = problem_of(oscillator(f"m*({force})", x=0.3, u=0.4), 1.0)
    found = [mp.mpf(value) for value in coefficients(problem, 16, made(problem.model.recurrences))[:, 0, 0]]
    with mp.workdps(50):
        t = mp.mpf("0.01")
        x, u, bend = (mp.polyval([mp.mpf(c) for c in _derived(found, times)[::-1]], t) for times in range(3))
        assert abs(bend - FORCES[force](x, u, t)) < 1e-15 * max(1, abs(bend))


def _derived(rows: list[mp.mpf], times: int) -> list[mp.mpf]:
    for _ in range(times):
        rows = [k * c for k, c in enumerate(rows)][1:]
    return rows


@pytest.mark.parametrize("name", FREE)
def test_all_code_gives_the_same_digits(name: str) -> None:
    """Interpreted or compiled, alone or side by side with others: coefficients, conditions and pivots alike."""
    problem = problem_of(get_scene(name), 1.0)
    recurrences = problem.model.recurrences
    one = rows(problem, 18, interpreted(recurrences))
    for lanes in (1, 4, 8):
        found = rows(problem, 18, jet_of(recurrences, lanes))
        np.testing.assert_array_equal(found, np.repeat(one, lanes, axis=2))


def kepler(eccentricity: float, t_end: float) -> Problem:
    """An orbit of semi-major axis and gravitational parameter 1, from its perihelion."""
    force = {"kind": "potential", "name": "sun", "energy": "-mu*m/sqrt(x^2 + y^2)"}
    speed = np.sqrt((1 + eccentricity) / (1 - eccentricity))
    start = {"x": (1 - eccentricity, 0.0), "y": (0.0, speed)}
    scene = document(start, {"m": 1.0, "mu": 1.0}, {"planet": ("m", ["x", "y"])}, [force])
    return problem_of(read_scene(scene), t_end, 401)


def orbit(eccentricity: float, times: np.ndarray) -> np.ndarray:
    """The positions by Kepler's equation, E − e sin E = t, in thirty digits."""
    with mp.workdps(30):
        e, found = mp.mpf(1 - (1 - eccentricity)), []
        for t in map(mp.mpf, times):
            anomaly = mp.findroot(lambda angle, t=t: angle - e * mp.sin(angle) - t, t + e * mp.sin(t) / 2)
            found.append([mp.cos(anomaly) - e, mp.sqrt(1 - e * e) * mp.sin(anomaly)])
    return np.array(found, dtype=np.float64)


def test_an_orbit_is_kepler_s() -> None:
    """Ten revolutions at eccentricity 0.9."""
    problem = kepler(0.9, 20.0 * np.pi)
    found = simulate(problem, TAYLOR, tolerance=1e-9)
    true = np.abs(found.values - orbit(0.9, found.times)).max(axis=1)
    assert (found.outcome.status, found.tolerance_reached) == ("ok", True)
    assert np.all(true <= found.estimate.errors + 1e-13)
    assert true.max() <= 1e-9


def swing(tolerance: float) -> Trajectory:
    return simulate(replace(problem_of(oscillator("-m*x"), 1000.0, 1001)), TAYLOR, tolerance=tolerance)


def test_rounding_does_not_pile_up() -> None:
    """After 159 periods of a harmonic oscillator (x = 1, ẋ = 0 before) the error is a few units in the last place."""
    found = swing(1e-12)
    true = np.abs(
        found.values[:, 0] - found.values[0, 0] * np.cos(found.times) - found.rates[0, 0] * np.sin(found.times)
    )
    assert found.outcome.status == "ok"
    assert true.max() < 2e-13
    assert np.all(true <= found.estimate.errors + 1e-14)


def alone(problem: Problem, times: np.ndarray) -> np.ndarray:
    """A run of its own: its states at the times."""
    return run(problem, TAYLOR, times, np.zeros(1, dtype=np.int64), Steps(times[-1], 1e-15)).states


def side_by_side(problem: Problem, times: np.ndarray) -> np.ndarray:
    """One of several motions that run together."""
    states, parameters = (np.repeat([each], 3, axis=0) for each in (problem.state[:2], problem.parameters))
    motions = Ensemble(problem, states, parameters)
    return in_lanes(motions, times, Steps(times[-1], 1e-15), np.zeros(1, dtype=np.int64)).samples[1]


@pytest.mark.parametrize("computed", [alone, side_by_side])
def test_samples_are_of_the_times_that_are_meant(computed: Callable[[Problem, np.ndarray], np.ndarray]) -> None:
    """x = sin 8t attracts: errors of states die away, but a time as large as 1,000 s is rounded by 10⁻¹³ s."""
    force = "m*(-64*sin(8*t) - 4*(x - sin(8*t)) - 4*(dot(x) - 8*cos(8*t)))"
    times = np.linspace(0.0, 1000.0, 1001)
    found = computed(problem_of(oscillator(force, x=0.0, u=8.0), 1000.0), times)
    assert np.abs(found[:, 0] - np.sin(8.0 * times)).max() < 2e-14


def bouncing(t: float) -> float:
    """x″ = −sign x from x = 1/2 at rest: parabolas of one second."""
    phase = t % 4.0
    return (
        0.5 - phase**2 / 2 if phase < 1 else (-0.5 + (phase - 2) ** 2 / 2 if phase < 3 else 0.5 - (phase - 4) ** 2 / 2)
    )


def test_a_force_that_jumps_is_met_where_it_jumps() -> None:
    problem = problem_of(oscillator("-m*sign(x)", x=0.5, u=0.0), 40.0, 401)
    found = simulate(problem, TAYLOR, tolerance=1e-10)
    assert found.outcome.status == "ok"
    assert np.abs(found.values[:, 0] - [bouncing(t) for t in found.times]).max() < 1e-10


@pytest.mark.parametrize("scale", [1e-7, 1e9])
def test_series_stay_in_range(scale: float) -> None:
    """However fast or slow: ẍ = −ω² x, ω = 10⁷/s or 10⁻⁹/s."""
    problem = problem_of(oscillator(f"-m*{1 / scale**2!r}*x", x=1.0, u=0.0), 10.0 * scale)
    found = simulate(problem, TAYLOR, tolerance=1e-10)
    assert found.outcome.status == "ok"
    assert np.abs(found.values[:, 0] - np.cos(found.times / scale)).max() < 1e-10


def test_an_event_is_met_to_rounding() -> None:
    """A fall from 1 m at g = 9.81 ends at √(2/g)."""
    text = document(
        {"x": (1.0, 0.0)},
        {"m": 1.0},
        {"ball": ("m", ["x", "0"])},
        [{"kind": "force", "name": "weight", "at": "ball", "force": ["-m*9.81", "0"]}],
    )
    text["events"] = [{"name": "floor", "value": "x"}]
    found = simulate(problem_of(read_scene(text), 1.0), TAYLOR, tolerance=1e-10)
    assert found.outcome.status == "event"
    assert abs(found.event.time - np.sqrt(2 / 9.81)) < 1e-14


def test_orders_follow_the_tolerance() -> None:
    problem, times = problem_of(load_scene("double-pendulum"), 1.0), np.linspace(0.0, 1.0, 2)
    flag = np.zeros(1, dtype=np.int64)
    runs = [run(problem, TAYLOR, times, flag, Steps(1.0, tolerance)).result for tolerance in (1e-8, 1e-16)]
    orders = [(each.evaluations - 1) / (each.steps + 1) for each in runs]
    assert orders == [14.0, 26.0]
    assert runs[1].steps < 1.5 * runs[0].steps  # not more steps, but longer series
