"""Ensembles: each run is the motion that it would be alone, with its own status and error; and what is refused."""

from __future__ import annotations

from base64 import b64decode
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipj
from scipy.stats import norm
from tests.simulation.scenes import document, oscillator

from deltaq.errors import Problem, RequestError
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.ensemble import Ensemble, in_lanes, needs_single_runs, run_ensemble
from deltaq.simulation.ensemble_answer import run
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem as Motion
from deltaq.simulation.run import Steps
from deltaq.simulation.run import run as run_alone
from deltaq.simulation.series.engine import code_of_neighbours, code_of_steps
from deltaq.simulation.service import problem_of

ONE = {"p": ("m", ["x", "0"])}
PUSH = {"kind": "force", "name": "push", "at": "p"}


def cloud(problem: Motion, count: int, seed: int = 3) -> Ensemble:
    """Initial values and parameters scattered by a few percent."""
    random = np.random.default_rng(seed)
    start = problem.state[None, : 2 * problem.degrees] + 0.05 * random.normal(size=(count, 2 * problem.degrees))
    numbers = np.array(problem.parameters) * random.uniform(0.95, 1.05, (count, len(problem.parameters)))
    return Ensemble(problem, start, numbers)


@pytest.mark.parametrize("name", ["double-pendulum", "elastic-pendulum", "heavy-top", "chain-pendulum"])
def test_each_run_is_the_motion_alone(name: str) -> None:
    """More runs than lanes, so that lanes take up others; each within its estimate of a much finer motion."""
    ensemble = cloud(problem_of(load_scene(name), 3.0, 31), 21)
    found = run_ensemble(ensemble, 1e-9)
    assert {outcome.status for outcome in found.outcomes} == {"ok"}
    for index in range(0, 21, 4):
        alone = simulate(ensemble.member(index), get_method("dop853"), tolerance=1e-12)
        true = np.abs(found.values[index] - alone.values)
        assert np.all(true <= found.errors[index] + alone.estimate.errors[:, None])
        assert true.max() <= 1e-9


@pytest.mark.parametrize("name", ["bouncing-ball", "catching-pendulum", "stick-slip", "string-pendulum"])
def test_each_run_behind_events_is_the_motion_alone_at_the_same_times(name: str) -> None:
    """Alone a motion tells its states at events, too; a run of an ensemble is told at its samples."""
    problem = problem_of(load_scene(name), 6.0, 61)
    ensemble = Ensemble(
        problem, np.repeat([problem.state[: 2 * problem.degrees]], 3, axis=0), np.array([problem.parameters] * 3)
    )
    ensemble.states[:, -1] += [0.0, 0.01, 0.02]
    found = run_ensemble(ensemble, 1e-9)
    for index, outcome in enumerate(found.outcomes):
        alone = simulate(ensemble.member(index), get_method("dop853"), tolerance=1e-9)
        assert outcome.status == alone.outcome.status
        reached = found.times[found.times <= alone.times[-1] + 1e-9]
        same = [int(np.flatnonzero(np.abs(alone.times - time) < 1e-9)[-1]) for time in reached]
        np.testing.assert_allclose(found.values[index, : len(same)], alone.values[same], atol=1e-7)
        assert np.isnan(found.values[index, len(same) :]).all()
        assert np.isfinite(found.errors[index, : len(same)]).all()


def test_balls_of_an_ensemble_bounce_on_a_floor_as_they_do() -> None:
    """From the height h the first fall takes τ = √(2h/g), each flight behind it e times as long as the one before."""
    problem = problem_of(load_scene("bouncing-ball"), 3.0, 301)
    names = problem.model.layout.parameters
    values = dict(zip(names, problem.parameters, strict=True)) | {"a": 0.0}
    heights = np.array([0.5, 0.8, 1.3])
    starts = np.column_stack([heights, np.zeros(3)])
    found = run_ensemble(Ensemble(problem, starts, np.array([[values[name] for name in names]] * 3)), 1e-9)
    g, e = values["g"], values["e"]
    for index, height in enumerate(heights):
        fall = np.sqrt(2.0 * height / g)
        ends = fall * np.concatenate([[-1.0, 1.0], 1.0 + 2.0 * np.cumsum(e ** np.arange(1, 40))])  # of flights
        flight = np.searchsorted(ends, found.times, side="right") - 1
        since = found.times - ends[flight]
        true = e**flight * g * fall * since - 0.5 * g * since**2
        rest = fall * (1.0 + 2.0 * e / (1.0 - e))
        np.testing.assert_allclose(found.values[index, :, 0], np.where(found.times < rest, true, 0.0), atol=1e-8)


@pytest.mark.parametrize("tolerance", [1e-5, 1e-8])
def test_errors_told_cover_the_true_ones_and_are_not_far_from_them(tolerance: float) -> None:
    """ẍ = −sin x from 0 with the rate u is x = 2 asin(k sn(t, k)), k = u/2 < 1."""
    rates = np.linspace(0.3, 1.95, 40)
    problem = problem_of(oscillator("-m*sin(x)", x=0.0, u=1.0), 20.0, 41)
    starts = np.column_stack([np.zeros(40), rates])
    found = run_ensemble(Ensemble(problem, starts, np.repeat([problem.parameters], 40, axis=0)), tolerance)
    sn = np.array([ellipj(found.times, (0.5 * rate) ** 2)[0] for rate in rates])
    true = np.abs(found.values[:, :, 0] - 2.0 * np.arcsin(0.5 * rates[:, None] * sn))[:, 1:]
    told = found.errors[:, 1:, 0]
    assert np.all(true <= told + 1e-13)
    assert np.median(told / true) <= 10.0
    assert np.all(found.worst >= told.max(axis=1) / np.pi)


@pytest.mark.parametrize("width", [0.016, 5e-3, 1e-3, 1e-4])
def test_a_hill_that_is_thinner_than_a_step_is_seen(width: float) -> None:
    """U = e^(−(x/w)²)/8: a mass that comes with u = 1 goes on as fast, later by ∫ 1/√(u² − 2U) − 1/u dx."""
    starts = np.linspace(-1.4, -0.6, 41)
    force = f"m*x/(4*{width}^2)*exp(-(x/{width})^2)"
    problem = problem_of(oscillator(force, x=-1.0, u=1.0), 10.0, 11)
    states = np.column_stack([starts, np.ones(41)])
    found = run_ensemble(Ensemble(problem, states, np.repeat([problem.parameters], 41, axis=0)), 1e-8)
    delay = width * quad(lambda y: 1.0 / np.sqrt(1.0 - 0.25 * np.exp(-(y**2))) - 1.0, -9.0, 9.0)[0]
    true = np.abs(found.values[:, -1, 0] - (starts + 10.0 - delay))
    assert true.max() <= 1e-8
    assert np.all(true <= found.errors[:, -1, 0] + 1e-13)


@pytest.mark.parametrize("before", [0.3, 2.0, 1000.0])
@pytest.mark.parametrize("width", [0.02, 1e-3])
def test_a_hill_on_a_long_way_is_seen(width: float, before: float) -> None:
    """U = e^(−((x − c)/w)²)/8 some seconds before the end of 6000 steps, which are those of ÿ = −25 y beside it."""
    t_end, hill = 2000.0, {"w": width, "c": 2000.0 - before}
    load = {"kind": "potential", "name": "hill", "energy": "m*k*y^2/2 + m*exp(-((x - c)/w)^2)/8"}
    body = {"p": ("m", ["x", "y"])}
    scene = read_scene(document({"x": (0.0, 1.0), "y": (1.0, 0.0)}, {"m": 1.0, "k": 25.0, **hill}, body, [load]))
    problem, starts = problem_of(scene, t_end, 3), np.linspace(0.0, 0.2, 5)
    states = np.column_stack([starts, *np.tile([[1.0], [1.0], [0.0]], 5)])
    found = run_ensemble(Ensemble(problem, states, np.repeat([problem.parameters], 5, axis=0)), 1e-8)
    delay = width * quad(lambda y: 1.0 / np.sqrt(1.0 - 0.25 * np.exp(-(y**2))) - 1.0, -9.0, 9.0)[0]
    true = np.abs(found.values[:, -1, 0] - (starts + t_end - delay))
    is_told = np.array([outcome.status != "ok" for outcome in found.outcomes])
    assert np.all((true <= found.errors[:, -1, 0] + 1e-12) | is_told)


@pytest.mark.parametrize("capacity", [3, 8])
def test_no_motion_depends_on_when_its_steps_are_looked_at(capacity: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """All lanes wait while some are looked at: bit for bit, they go on as if they had not."""
    ensemble = cloud(problem_of(load_scene("double-pendulum"), 3.0, 31), 21)
    whole = run_ensemble(ensemble, 1e-9)
    monkeypatch.setattr("deltaq.simulation.ensemble.MESH", capacity)
    parted = run_ensemble(ensemble, 1e-9)
    for name in ("values", "rates", "errors", "worst", "steps"):
        np.testing.assert_array_equal(getattr(parted, name), getattr(whole, name))
    assert parted.outcomes == whole.outcomes


def pulled(force: str, **parameters: float) -> Motion:
    """A mass at rest in the origin, under a force in units of its mass, for 10 s."""
    push = {**PUSH, "force": [f"m*({force})", "0"]}
    return problem_of(read_scene(document({"x": (0.0, 0.0)}, {"m": 1.0, **parameters}, ONE, [push])), 10.0, 11)


def varied(problem: Motion, name: str, values: np.ndarray) -> Ensemble:
    """The same start with other values of a parameter."""
    parameters = np.repeat([problem.parameters], len(values), axis=0)
    parameters[:, [one.name for one in problem.model.scene.parameters].index(name)] = values
    return Ensemble(problem, np.repeat(problem.state[None, :2], len(values), axis=0), parameters)


PULSES = [
    pytest.param({"A": 0.0, "c": 3.3}, "A", [0.0, 0.5, 2.0], id="none in the scene itself"),
    pytest.param({"A": 1.0, "c": -50.0}, "c", [-50.0, 3.3, 7.1], id="before the scene's own motion"),
    pytest.param({"A": 1.0, "c": 3.3}, "c", [1.7, 3.3, 7.1], id="at other times"),
]


@pytest.mark.parametrize("width", [0.1, 0.01, 1e-3])
@pytest.mark.parametrize(("parameters", "name", "values"), PULSES)
def test_a_pulse_of_some_of_the_motions_is_seen(
    width: float, parameters: dict[str, float], name: str, values: list[float]
) -> None:
    """ẍ = A e^(−((t − c)/w)²) moves a mass at rest by A w √π (10 − c) until t = 10, if it comes within that time."""
    problem = pulled("A*exp(-((t - c)/w)^2)", **parameters, w=width)
    found = run_ensemble(varied(problem, name, np.array(values)), 1e-9)
    strength, at = ((parameters | {name: np.array(values)})[each] for each in ("A", "c"))
    true = strength * width * np.sqrt(np.pi) * np.maximum(10.0 - at, 0.0) * (at > 0.0)
    np.testing.assert_array_less(np.abs(found.values[:, -1, 0] - true), found.errors[:, -1, 0] + 1e-14)
    assert {outcome.status for outcome in found.outcomes} == {"ok"}


@pytest.mark.parametrize(("frequency", "strength"), [(1.7, 1.0), (25.0, 100.0)])
@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-12])
def test_driven_motions_go_side_by_side(tolerance: float, frequency: float, strength: float) -> None:
    """ẍ = −x + a cos wt from rest: x = a (cos wt − cos t)/(1 − w²); the phase of a fast drive is rounded, too."""
    frequencies = frequency * np.linspace(0.9, 1.1, 40)
    problem = pulled("-x + a*cos(w*t)", a=strength, w=frequency)
    ensemble = varied(problem, "w", frequencies)
    assert not needs_single_runs(ensemble)
    found = run_ensemble(ensemble, tolerance)
    times, each = np.longdouble(found.times), np.longdouble(frequencies[:, None])
    true = strength * (np.cos(each * times) - np.cos(times)) / (1.0 - each**2)
    error = np.abs(found.values[:, :, 0] - true)
    assert np.all(error <= found.errors[:, :, 0] + 4e-16)
    assert error.max() <= max(tolerance, 1e-13)


def test_code_for_steps_is_made_once_for_a_shape_and_that_of_errors_only_where_they_are_told() -> None:
    """ẍ = −k x³ and ẍ = −k sin x have one shape: the second one, a new model, compiles its series alone.

    Motions from rest with the rate u have ẋ²/2 + V = u²/2, with V = k x⁴/4 and k (1 − cos x).
    """
    ends = []
    for force, energy in (("-k*m*x^3", lambda x: x**4 / 4.0), ("-k*m*sin(x)", lambda x: 1.0 - np.cos(x))):
        scene = read_scene(document({"x": (0.0, 0.5)}, {"m": 1.0, "k": 1.3}, ONE, [{**PUSH, "force": [force, "0"]}]))
        problem = problem_of(scene, 3.0, 4)
        ensemble = cloud(problem, 9)
        for near in (0, 5):
            before = code_of_steps.cache_info().misses, code_of_neighbours.cache_info().misses
            found = in_lanes(
                ensemble, np.linspace(0.0, 3.0, 4), Steps(1.0, 1e-14), np.zeros(1, dtype=np.int64), near=near
            )
            after = code_of_steps.cache_info().misses, code_of_neighbours.cache_info().misses
            ends.append((after[0] - before[0], after[1] - before[1]))
            k, (x, v) = ensemble.parameters[:, 1, None], np.moveaxis(found.samples[:, :, :2], 2, 0)
            kept = v**2 / 2.0 + k * energy(x)
            np.testing.assert_allclose(kept, np.repeat(kept[:, :1], 4, axis=1), atol=1e-13)
            assert np.abs(np.diff(x, axis=1)).min() > 1e-3
    assert ends[0][1] == 0
    assert ends[2:] == [(0, 0), (0, 0)]


def test_runs_do_not_depend_on_their_neighbours() -> None:
    ensemble = cloud(problem_of(load_scene("double-pendulum"), 2.0, 5), 20)
    together, apart = run_ensemble(ensemble, 1e-9), run_ensemble(ensemble.chosen(np.array([17])), 1e-9)
    np.testing.assert_array_equal(together.values[17], apart.values[0])
    np.testing.assert_array_equal(together.errors[17], apart.errors[0])


@pytest.mark.parametrize("name", ["double-pendulum", "spherical-pendulum"])
def test_steps_are_those_of_the_motion_alone(name: str) -> None:
    """Vectors of lanes choose them by logarithms of their own, and a run alone by those of the C library."""
    ensemble, times, flag = (
        cloud(problem_of(load_scene(name), 10.0, 2), 9),
        np.array([0.0, 10.0]),
        np.zeros(1, np.int64),
    )
    for tolerance in (1e-7, 1e-12):
        steps = Steps(0.5, tolerance)
        found = in_lanes(ensemble, times, steps, flag)
        for index in range(9):
            alone = run_alone(ensemble.member(index), get_method("taylor"), times, flag, steps)
            assert found.steps[index] == alone.result.steps
            np.testing.assert_allclose(found.samples[index, 1], alone.states[-1], rtol=1e-9, atol=1e-9)


def test_finer_runs_of_a_motion_do_not_depend_on_longer_ones_beside_it() -> None:
    """Motions with very many steps are compared with finer runs, which end after twice as many or so: here too soon."""
    problem = problem_of(oscillator("-k*m*x^3", x=1.0, u=0.0), 1000.0, 101)
    place = [one.name for one in problem.model.scene.parameters].index("k")
    parameters = np.repeat([problem.parameters], 2, axis=0)
    parameters[:, place] = [3e3, 1e5]
    ensemble = Ensemble(problem, np.repeat(problem.state[None, :2], 2, axis=0), parameters)
    together = run_ensemble(ensemble, 0.1)
    assert [each.status for each in together.outcomes] == ["step_limit", "step_limit"]
    for index in range(2):
        alone = run_ensemble(ensemble.chosen(np.array([index])), 0.1)
        np.testing.assert_array_equal(together.values[index], alone.values[0])
        np.testing.assert_array_equal(together.errors[index], alone.errors[0])
        assert together.outcomes[index] == alone.outcomes[0]


def test_one_run_may_fail_and_the_others_not() -> None:
    """x″ = x³ runs away where it begins far out; a mass that is thrown does not."""
    problem = problem_of(oscillator("m*x^3", x=0.1, u=0.0), 3.0, 11)
    states = np.array([[0.1, 0.0], [2.0, 3.0], [0.2, 0.0]])
    found = run_ensemble(Ensemble(problem, states, np.repeat([problem.parameters], 3, axis=0)), 1e-8)
    assert [outcome.status for outcome in found.outcomes] == ["ok", "diverged", "ok"]
    assert np.isfinite(found.values[[0, 2]]).all()
    assert np.isfinite(found.worst).tolist() == [True, False, True]
    np.testing.assert_array_equal(np.isnan(found.errors[1]), np.isnan(found.values[1]))


@pytest.mark.parametrize("force", ["m*x^3", "m*x^3 + m*abs(x)"], ids=["in lanes", "one by one"])
def test_no_error_is_told_of_a_run_that_runs_away(force: str) -> None:
    """x″ = x³ from x = 2, u = 3: the singularity lies within the span."""
    told = {"vary": {"initial.x.value": [0.0, 2.0], "initial.x.rate": [0.0, 3.0]}, "combine": "together"}
    found = ask(scene=write_scene(oscillator(force)), t_end=3.0, samples=11, tolerance=1e-8, **told)
    assert found["status"] == ["ok", "diverged"]
    assert [one is None for one in found["error"]] == [False, True]
    packed = ask(scene=write_scene(oscillator(force)), t_end=3.0, columns="base64", **told)
    assert np.isnan(np.frombuffer(b64decode(packed["error"]))).tolist() == [False, True]


@pytest.mark.parametrize("rate", [1e2, 1e3])
def test_fast_motions_begin_with_short_steps(rate: float) -> None:
    """The longest step is a part of the span, and holds many turns of x″ = −ω²x, whose coefficients overflow there."""
    problem = problem_of(oscillator(f"-{rate * rate}*m*x", x=1.0, u=0.0), 20.0 * 100.0 / rate, 11)
    states = np.array([[1.0, 0.0], [0.0, rate], [1e-3, 0.0]])
    states = np.vstack([states, [[1.0, 0.0]] * 9])  # more than lanes: others take up where these end
    found = run_ensemble(Ensemble(problem, states, np.repeat([problem.parameters], 12, axis=0)), 1e-8)
    assert {outcome.status for outcome in found.outcomes} == {"ok"}
    phases = rate * found.times
    for index, truth in enumerate((np.cos(phases), np.sin(phases), 1e-3 * np.cos(phases))):
        np.testing.assert_allclose(found.values[index, :, 0], truth, atol=1e-8)
    np.testing.assert_array_equal(found.values[3:, :, 0], found.values[[0] * 9, :, 0])


def test_what_no_number_of_steps_reaches_is_given_up_early_and_nothing_else() -> None:
    """ω = 10⁸ for 20 s is out of reach; (x, u) = 0 beside it rests; x″ = −(W/(t + ε))² x slows down, and comes."""
    fast = problem_of(oscillator("-1e16*m*x", x=1.0, u=0.0), 20.0, 3)
    both = Ensemble(fast, np.array([[1.0, 0.0], [0.0, 0.0]]), np.repeat([fast.parameters], 2, axis=0))
    found = run_ensemble(both, 1e-6)
    assert [outcome.code for outcome in found.outcomes] == ["out_of_reach", "ok"]
    assert found.steps[0] <= fast.step_limit / 16
    rate, late = 3e4, 1e-3
    slowing = problem_of(oscillator(f"-m*{rate}^2*x/(t + {late})^2", x=1.0, u=0.5 / late), 10.0, 11)
    some = Ensemble(slowing, slowing.state[None, :2].copy(), np.array([slowing.parameters]))
    found = run_ensemble(some, 1e-3)
    assert found.outcomes[0].status == "ok"
    assert found.steps[0] > slowing.step_limit / 16
    s = (found.times + late) / late
    true = np.sqrt(s) * np.cos(np.sqrt(rate**2 - 0.25) * np.log(s))
    np.testing.assert_array_less(np.abs(found.values[0, :, 0] - true), found.errors[0, :, 0] + 1e-12)


def test_forces_that_jump_are_run_one_by_one() -> None:
    problem = problem_of(oscillator("-m*sign(x)", x=0.5, u=0.0), 4.0, 5)
    found = run_ensemble(
        Ensemble(problem, np.array([[0.5, 0.0], [2.0, 0.0]]), np.repeat([problem.parameters], 2, 0)), 1e-9
    )
    np.testing.assert_allclose(
        found.values[:, :, 0], [[0.5, 0.0, -0.5, 0.0, 0.5], [2.0, 1.5, 0.0, -1.5, -2.0]], atol=1e-9
    )


def ask(**fields: Any) -> dict[str, Any]:
    return run({"scene": write_scene(oscillator("-m*x")), "t_end": 2.0, "samples": 3, "tolerance": 1e-10} | fields)


def test_a_grid_has_every_value_with_every_other() -> None:
    vary = {"initial.x.value": [1.0, 2.0], "initial.x.rate": {"from": 0.0, "to": 1.0, "count": 3}}
    found = ask(vary=vary)
    assert found["quantities"] == {
        "initial.x.value": [1.0, 1.0, 1.0, 2.0, 2.0, 2.0],
        "initial.x.rate": [0.0, 0.5, 1.0, 0.0, 0.5, 1.0],
    }
    x, u = (np.array(column) for column in found["quantities"].values())
    times = np.array(found["t"])[None, :]
    np.testing.assert_allclose(
        found["coordinates"]["x"], x[:, None] * np.cos(times) + u[:, None] * np.sin(times), atol=1e-10
    )
    assert found["status"] == ["ok"] * 6


def test_statistics_of_a_cloud() -> None:
    """x(t) = x₀ cos t: mean and deviation of what was drawn, times cos t."""
    drawn = {"initial.x.value": {"normal": [3.0, 0.1], "count": 2001, "seed": 5}}
    found = ask(vary=drawn, statistics=["mean", "quantiles"], runs=False)
    again = ask(vary=drawn, statistics=["mean", "quantiles"], runs=False)
    values = np.array(found["quantities"]["initial.x.value"])
    assert "coordinates" not in found
    assert (abs(values.mean() - 3.0), abs(values.std() - 0.1)) < (0.01, 0.01)
    np.testing.assert_allclose(found["mean"]["x"], values.mean() * np.cos([0.0, 1.0, 2.0]), atol=1e-10)
    median = found["quantiles"]["values"]["x"][found["quantiles"]["levels"].index(0.5)]
    np.testing.assert_allclose(median, np.median(values) * np.cos([0.0, 1.0, 2.0]), atol=1e-10)
    assert again["mean"] == found["mean"]


def test_the_density_of_a_cloud_over_time() -> None:
    """x = x₀ cos t of normal x₀ is normal, with mean and deviation times |cos t|; each density is one of all runs."""
    drawn = {"initial.x.value": {"normal": [3.0, 0.5], "count": 4000, "seed": 5}}
    found = ask(vary=drawn, statistics=["density"], runs=False)["density"]["x"]
    edges, values = np.array(found["edges"]), np.array(found["values"])
    assert edges.shape == (65,)
    assert values.shape == (3, 64)
    np.testing.assert_allclose((values * np.diff(edges)).sum(axis=1), 1.0, rtol=1e-12)
    for row, time in zip(values, (0.0, 1.0, 2.0), strict=True):
        spread = norm(3.0 * np.cos(time), 0.5 * abs(np.cos(time)))
        parts, true = np.cumsum(row * np.diff(edges)), spread.cdf(edges[1:])
        assert np.abs(parts - true).max() < 1.63 / np.sqrt(4000)  # Kolmogorov, 1 %


def test_a_density_of_runs_that_are_all_alike_and_of_some_that_end_early() -> None:
    alike = ask(vary={"initial.x.value": [0.0, 0.0]}, statistics=["density"])["density"]["x"]
    np.testing.assert_allclose((np.array(alike["values"]) * np.diff(alike["edges"])).sum(axis=1), 1.0, rtol=1e-9)
    scene = write_scene(oscillator("m*x^3", x=0.1, u=0.0))
    found = ask(scene=scene, t_end=3.0, vary={"initial.x.value": [0.1, 5.0]}, statistics=["density"])
    rows = np.array(found["density"]["x"]["values"])
    np.testing.assert_allclose((rows * np.diff(found["density"]["x"]["edges"])).sum(axis=1), 1.0, rtol=1e-9)
    assert (rows > 0.0).sum(axis=1).tolist() == [2, 1, 1]


def test_what_a_motion_tells_does_not_depend_on_others_that_missed_their_tolerance() -> None:
    """Runs that missed it are repeated by finer steps: as fine as each needs, not as the worst of all does."""
    problem = problem_of(load_scene("double-pendulum"), 12.0, 13)
    starts = np.array([[0.4, 0.3, 0.0, 0.0], [2.9, 3.0, 0.0, 0.0], [1.9, 2.0, 0.0, 0.0], [2.4, 1.0, 3.0, 0.0]])
    ensemble = Ensemble(problem, starts, np.repeat([problem.parameters], 4, axis=0))
    together = run_ensemble(ensemble, 1e-9)
    assert len(set(together.steps.tolist())) > 1
    for index in range(4):
        alone = run_ensemble(ensemble.chosen(np.array([index])), 1e-9)
        np.testing.assert_array_equal(together.values[index], alone.values[0])
        np.testing.assert_array_equal(together.errors[index], alone.errors[0])
        assert together.outcomes[index] == alone.outcomes[0]


X, L = "initial.x.value", "parameters.l"
KNOWN = "initial.x.value, initial.x.rate, " + ", ".join(f"parameters.{name}" for name in ("m", "k", "c", "F0", "omega"))
REFUSED = [
    pytest.param({"vary": {}}, "request-too-few", "/vary", id="nothing varies"),
    pytest.param({"vary": {X: [1.0, "a"]}}, "request-not-number", f"/vary/{X}/1", id="no number"),
    pytest.param(
        {"vary": {X: {"from": -1.7e308, "to": 1.0, "count": 3}}}, "request-too-small", f"/vary/{X}/from", id="far"
    ),
    pytest.param(
        {"vary": {X: {"normal": [0.0, -1.0], "count": 3}}}, "request-too-small", f"/vary/{X}/normal/1", id="σ"
    ),
    pytest.param(
        {"vary": {X: {"normal": [1e308, 1.0], "count": 3}}}, "request-too-large", f"/vary/{X}/normal/0", id="μ"
    ),
    pytest.param(
        {"scene": "pendulum", "vary": {L: [1.0, -1.0]}}, "not-positive", f"/vary/{L}/1", id="a length below zero"
    ),
    pytest.param(
        {"scene": "pendulum", "vary": {L: {"from": 0.0, "to": 1.0, "count": 3}}},
        "not-positive",
        f"/vary/{L}/from",
        id="from zero",
    ),
    pytest.param(
        {"scene": "pendulum", "vary": {L: {"from": 1.0, "to": -1.0, "count": 3}}},
        "not-positive",
        f"/vary/{L}/to",
        id="to less",
    ),
    pytest.param(
        {"scene": "pendulum", "vary": {L: {"normal": [1.0, 1.0], "count": 100}}},
        "not-positive",
        f"/vary/{L}/normal",
        id="drawn below zero",
    ),
    pytest.param(
        {"scene": "bouncing-ball", "vary": {"initial.z.value": [1.0, -1.0]}}, "event-at-start", "/vary", id="below"
    ),
    *(
        pytest.param(
            {"vary": {X: drawn}}, "initial-too-large", f"/vary/{X}/{place}", id=f"{place} of what is too large"
        )
        for place, drawn in (
            ("from", {"from": -3e15, "to": 2e15, "count": 3}),
            ("to", {"from": 0.0, "to": 2e15, "count": 3}),
            ("normal", {"normal": [0.0, 1e15], "count": 50}),
            ("1", [1.0, 1e17]),
        )
    ),
    pytest.param({"vary": {X: {"from": 1.0, "to": 2.0}}}, "missing-field", f"/vary/{X}/count", id="how many"),
    pytest.param({"vary": {"parameters.q": [1.0]}}, "ensemble-quantity", "/vary/parameters.q", id="unknown"),
    pytest.param({"vary": {X: [1.0]}, "t_end": 0.0}, "request-outside", "/t_end", id="no time"),
    pytest.param(
        {"vary": {X: [1.0], "parameters.k": [1.0, 2.0]}, "combine": "together"}, "ensemble-unlike", "/vary", id="unlike"
    ),
    pytest.param(
        {"vary": {X: {"from": 0.0, "to": 1.0, "count": 60000}, "parameters.k": [1.0, 2.0]}},
        "ensemble-too-large",
        "/vary",
        id="too many",
    ),
    pytest.param(
        {"vary": {X: {"from": 0.0, "to": 1.0, "count": 50000}}, "t_end": 20.0},
        "ensemble-too-large",
        "/vary",
        id="too long",
    ),
]


@pytest.mark.parametrize(("fields", "code", "pointer"), REFUSED)
def test_what_cannot_be_run_is_refused_before_anything_runs(fields: dict[str, Any], code: str, pointer: str) -> None:
    with pytest.raises(RequestError) as caught:
        ask(**fields)
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]


def test_an_unknown_quantity_is_told_with_those_there_are() -> None:
    with pytest.raises(RequestError) as caught:
        ask(vary={"initial.x": [1.0]})
    parameters = {"name": "initial.x", "known": KNOWN}
    assert caught.value.problems == (Problem("ensemble-quantity", "/vary/initial.x", parameters=parameters),)
