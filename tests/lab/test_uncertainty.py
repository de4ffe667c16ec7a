"""The lab of uncertainty against closed forms and SciPy's runs of the same starts; and what it refuses."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.simulation.scenes import document

from deltaq.errors import InputError
from deltaq.lab.cloud import deviations_of, drawn
from deltaq.lab.library import get_experiment
from deltaq.lab.propagation import propagated
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.simulation.service import problem_of


def line(energy: str, *loads: dict[str, Any], x: float = 1.0, v: float = 0.0, **parameters: float) -> dict[str, Any]:
    """A particle on a line, in a potential."""
    well = {"kind": "potential", "name": "well", "energy": energy}
    values = {"m": 1.0, "k": 4.0, "c": 0.0, **parameters}
    return document({"x": (x, v)}, values, {"p": ("m", ["x", "0"])}, [well, *loads])


OSCILLATOR = line("k*x^2/2")  # ω = 2
REPELLED = line("-k*x^2/2")  # λ = 2
DRAG = {"kind": "dissipation", "name": "drag", "function": "c*dot(x)^2/2"}
FRICTION = {"kind": "force", "name": "rubbing", "at": "p", "force": ["-c*sign(dot(x))", "0"]}


def ask(**fields: Any) -> dict[str, Any]:
    *_, last = get_experiment("uncertainty").run({"t_end": 5.0, "runs": 200, **fields})
    return last.result  # type: ignore[return-value]


def columns(found: dict[str, Any], *names: str) -> list[np.ndarray]:
    (one,) = found["coordinates"]
    return [np.array(one[name], dtype=float) for name in names]


# P = Φ P₀ Φᵀ by hand, the standard deviation of x: with x₀ cos ωt + v₀/ω sin ωt, with cosh and sinh where the force
# repels, and by ∂x/∂k of cos √k t, or of a fall from rest under 2k.
Sigma = Callable[[np.ndarray], np.ndarray]
SIGMAS: dict[str, Sigma] = {
    "vibration": lambda t: np.hypot(0.1 * np.cos(2 * t), 0.15 * np.sin(2 * t)),
    "unstable": lambda t: 1e-6 * np.hypot(np.cosh(2 * t), 1.5 * np.sinh(2 * t)),
    "free": lambda t: 0.1 * t,
    "stiffness": lambda t: 1e-3 * t / 4.0 * np.abs(np.sin(2 * t)),
    "fall": lambda t: np.hypot(0.1, 0.5 * t**2),
}
CLOSED_FORMS = [
    pytest.param(OSCILLATOR, {"x": 0.1, "dot(x)": 0.3}, SIGMAS["vibration"], id="vibration"),
    pytest.param(REPELLED, {"x": 1e-6, "dot(x)": 3e-6}, SIGMAS["unstable"], id="unstable"),
    pytest.param(line("0*k*x", v=2.0), {"dot(x)": 0.1}, SIGMAS["free"], id="free"),
    pytest.param(OSCILLATOR, {"k": 1e-3}, SIGMAS["stiffness"], id="stiffness"),
    pytest.param(line("-2*k*x"), {"k": 0.5, "x": 0.1}, SIGMAS["fall"], id="fall"),
]


@pytest.mark.parametrize(("scene", "tolerances", "sigma"), CLOSED_FORMS)
def test_linear_propagation_is_the_closed_form_and_the_cloud_agrees(
    scene: dict[str, Any], tolerances: dict[str, float], sigma: Sigma
) -> None:
    found = ask(scene=scene, tolerances=tolerances)
    t = np.array(found["t"])
    linear, deviation, low, high, unlike = columns(found, "linear", "deviation", "low", "high", "nonlinearity")
    true = sigma(t)
    np.testing.assert_allclose(linear, true, rtol=6e-6, atol=3e-7 * true.max())  # six digits are told
    np.testing.assert_allclose(deviation, true, rtol=0.25, atol=1e-3 * true.max())
    assert np.mean((low <= true * (1 + 1e-5)) & (true * (1 - 1e-5) <= high)) > 0.5
    assert np.nanmax(unlike) < 0.01
    assert found["coordinates"][0]["linear_until"] is None
    assert found["statuses"] == {"ok": 200}


def test_a_gaussian_cloud_of_a_linear_motion_stays_gaussian() -> None:
    """Quantiles of the normal distribution about the nominal motion, as far as 2000 runs tell: 1/√n of σ."""
    found = ask(scene=line("k*x^2/2", DRAG, c=0.4), tolerances={"x": 0.1, "dot(x)": 0.2}, runs=2000)
    linear, reference = columns(found, "linear", "reference")
    rows = np.array(found["coordinates"][0]["quantiles"], dtype=float)
    for level, row in zip(found["levels"], rows, strict=True):
        z = {0.05: -1.6449, 0.25: -0.6745, 0.5: 0.0, 0.75: 0.6745, 0.95: 1.6449}[level]
        assert np.abs((row - reference) / linear - z).max() < 0.15
    w = math.sqrt(4.0 - 0.04)
    t = np.array(found["t"])
    true = np.exp(-0.2 * t) * (np.cos(w * t) + 0.2 / w * np.sin(w * t))
    np.testing.assert_allclose(reference, true, atol=2e-6)


def test_an_even_distribution_of_half_width_a_has_the_deviation_a_over_root_three() -> None:
    """And no run beyond a; its quantiles are at (2 p − 1) a."""
    found = ask(scene=OSCILLATOR, tolerances={"x": 0.3}, distribution="uniform", runs=2000, t_end=1.0)
    linear, low, high = (column[0] for column in columns(found, "linear", "low", "high"))
    assert linear == pytest.approx(0.3 / math.sqrt(3.0), rel=1e-5)
    assert low < linear < high
    edges = np.array([row[0] for row in found["coordinates"][0]["quantiles"]]) - 1.0
    np.testing.assert_allclose(edges, 0.3 * (2.0 * np.array(found["levels"]) - 1.0), atol=0.02)


@pytest.mark.parametrize("shape", ["normal", "uniform", "skew"])
@pytest.mark.parametrize("runs", [40, 400])
def test_the_interval_covers_the_true_deviation(shape: str, runs: int) -> None:
    """Over 4000 clouds 95 % of the intervals hold it: σ, a/√3, and that of a square of a normal number, √2 about."""
    if shape == "skew":
        clouds = (5.0 + np.random.default_rng(5).normal(size=(runs, 4000))) ** 2
        true = math.sqrt(2.0 + 4.0 * 25.0)  # Var (μ + z)² = 2 + 4 μ²
    else:
        normal = shape == "normal"
        clouds = np.column_stack([drawn(np.array([0.3]), runs, seed, is_normal=normal) for seed in range(4000)])
        true = 0.3 if normal else 0.3 / math.sqrt(3.0)
    _, _, low, high = deviations_of(clouds)
    assert np.mean((low <= true) & (true <= high)) == pytest.approx(0.95, abs=0.02)


def test_clouds_of_many_seeds_cover_the_exact_spread() -> None:
    """The whole lab over seeds: the interval at the end holds σ(t) of the vibration in 95 % of the clouds."""
    true = math.hypot(0.1 * math.cos(3.0), 0.1 * math.sin(3.0))  # rates by ω = 2
    hits = 0
    for seed in range(40):
        found = ask(scene=OSCILLATOR, tolerances={"x": 0.1, "dot(x)": 0.2}, runs=40, seed=seed, t_end=1.5)
        low, high = (column[-1] for column in columns(found, "low", "high"))
        hits += low <= true <= high
    assert hits >= 33  # of 38: three and a half standard deviations


DOUBLE = {"scene": "double-pendulum", "initial": {"phi1": {"value": 2.0}, "phi2": {"value": 2.5}}, "t_end": 4.0}


def double_pendulum(values: dict[str, float]) -> Any:
    """q̈ of the plane double pendulum with point masses, as it stands in textbooks, angles from the vertical."""
    m1, m2, l1, l2, g = (values[name] for name in ("m1", "m2", "l1", "l2", "g"))

    def rates(_t: float, y: np.ndarray) -> list[float]:
        a, b, u, v = y
        d = a - b
        bottom = 2.0 * m1 + m2 - m2 * math.cos(2.0 * d)
        first = -g * (2 * m1 + m2) * math.sin(a) - m2 * g * math.sin(a - 2 * b)
        first -= 2.0 * math.sin(d) * m2 * (v * v * l2 + u * u * l1 * math.cos(d))
        second = u * u * l1 * (m1 + m2) + g * (m1 + m2) * math.cos(a) + v * v * l2 * m2 * math.cos(d)
        return [u, v, first / (l1 * bottom), 2.0 * math.sin(d) * second / (l2 * bottom)]

    return rates


def solved(values: dict[str, float], start: np.ndarray, t: np.ndarray) -> np.ndarray:
    return np.asarray(solve_ivp(double_pendulum(values), (0.0, t[-1]), start, "DOP853", t, rtol=1e-10, atol=1e-10).y)


@cache
def of_the_double_pendulum() -> dict[str, Any]:
    return ask(**DOUBLE, tolerance=0.01, runs=30, seed=3)


@cache
def runs_of_scipy() -> np.ndarray:
    """Shape (runs, 4, samples)."""
    found = of_the_double_pendulum()
    starts = np.array([2.0, 2.5, 0.0, 0.0]) + drawn(np.full(4, 0.01), 30, 3, is_normal=True)
    return np.array([solved(found["parameters"], start, np.array(found["t"])) for start in starts])


def test_the_cloud_is_that_of_scipy_from_the_same_starts() -> None:
    found = of_the_double_pendulum()
    runs = runs_of_scipy()
    for place, one in enumerate(found["coordinates"]):
        np.testing.assert_allclose(one["deviation"], runs[:, place].std(axis=0, ddof=1), rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(one["mean"], runs[:, place].mean(axis=0), rtol=1e-5, atol=1e-6)
        quantiles = np.quantile(runs[:, place], found["levels"], axis=0)
        np.testing.assert_allclose(one["quantiles"], quantiles, rtol=1e-5, atol=1e-5)


def test_linear_propagation_is_that_of_scipys_neighbours_and_ends_where_it_fails() -> None:
    """D by central differences of SciPy's runs; and linear deviations are right before the end told, wrong behind."""
    found = of_the_double_pendulum()
    t, middle = np.array(found["t"]), np.array([2.0, 2.5, 0.0, 0.0])
    by = [
        (solved(found["parameters"], middle + d, t) - solved(found["parameters"], middle - d, t)) / 2e-5
        for d in 1e-5 * np.eye(4)
    ]
    nominal = solved(found["parameters"], middle, t)
    deltas = drawn(np.full(4, 0.01), 30, 3, is_normal=True)
    runs = runs_of_scipy()
    for place, one in enumerate(found["coordinates"]):
        sigma = 0.01 * np.sqrt(sum(d[place] ** 2 for d in by))
        early = t < 3.0  # later the differences of SciPy's runs are no longer small
        np.testing.assert_allclose(np.array(one["linear"])[early], sigma[early], rtol=1e-3, atol=1e-4)
        left = runs[:, place] - nominal[place] - deltas @ np.array([d[place] for d in by])
        ratio = np.sqrt((left**2).mean(axis=0)) / sigma
        until = one["linear_until"]
        assert np.median(ratio[(t > 0.5 * until) & (t < 0.95 * until)]) < 0.3
        assert np.median(ratio[(t > 1.2 * until) & (t < 1.8 * until)]) > 0.3


def test_the_horizon_is_where_the_spread_is_a_share_of_the_range() -> None:
    """e^{λt} of a repelled particle: 1e-6 cosh 2t = share × range, the range that of cosh over the span."""
    found = ask(scene=REPELLED, tolerances={"x": 0.02}, share=0.01, runs=2000, t_end=3.0)
    horizon = found["coordinates"][0]["horizon"]
    extent = math.cosh(6.0) - 1.0
    assert found["coordinates"][0]["range"] == pytest.approx(extent, rel=1e-3)
    true = math.acosh(0.01 * extent / 0.02) / 2.0
    assert horizon["early"] < true < horizon["late"]
    assert horizon["t"] == pytest.approx(true, abs=0.02)
    assert horizon["late"] - horizon["early"] < 0.1


def test_what_the_tolerance_does_not_reach_and_what_numbers_decide_is_told() -> None:
    """At a tolerance of rounding the numbers decide from the start; so they do where nothing is coupled."""
    assert ask(scene="double-pendulum", tolerance=1e-16)["coordinates"][0]["error_from"] == 0.0
    plane = document(
        {"x": (1.0, 0.0), "y": (0.5, 0.0)},
        {"m": 1.0},
        {"p": ("m", ["x", "y"])},
        [{"kind": "potential", "name": "well", "energy": "m*(x^2 + 2*y^2)/2"}],
    )
    x, y = ask(scene=plane, tolerances={"x": 0.1})["coordinates"]
    assert (x["error_from"], x["linear_until"]) == (None, None)
    assert y["error_from"] == 0.0
    assert max(y["deviation"]) < 1e-12


def test_runs_that_end_early_count_as_far_as_they_came() -> None:
    """ẍ = 6 x² with v² = 4 x³ + …: from x = v/2 = 1, x = 1/(1 − t)², and half of the cloud is gone before t = 1."""
    found = ask(scene=line("-2*m*x^3", v=2.0), tolerances={"x": 0.05}, t_end=2.0, runs=40, seed=3)
    assert found["t"][-1] < 1.0
    assert found["reached"][0] == 40
    assert 20 <= found["reached"][-1] <= 40
    assert sum(found["statuses"].values()) == 40
    assert "ok" not in found["statuses"]
    whole = np.array(found["reached"]) == 40
    t = np.array(found["t"])[whole]
    options = {"method": "DOP853", "t_eval": t, "rtol": 1e-11, "atol": 1e-11}
    starts = 1.0 + drawn(np.array([0.05]), 40, 3, is_normal=True)[:, 0]
    runs = [solve_ivp(lambda _t, y: [y[1], 6.0 * y[0] ** 2], (0.0, t[-1]), [x, 2.0], **options).y[0] for x in starts]
    (deviation,) = columns(found, "deviation")
    assert np.std([run[-1] for run in runs]) > 5.0  # close to the pole
    np.testing.assert_allclose(deviation[whole], np.std(runs, axis=0, ddof=1), rtol=1e-4)


@pytest.mark.parametrize("t_end", [8.0, 20.0, 60.0, 150.0])
def test_a_pole_after_a_few_samples_leaves_what_is_before_it(t_end: float) -> None:
    """x = 1/(1 − t)², of which a span far beyond t = 1 sees a few samples only; a small cloud stays linear."""
    found = ask(scene=line("-2*m*x^3", v=2.0), tolerances={"x": 1e-6}, t_end=t_end, runs=40)
    t = np.array(found["t"])
    assert 2 <= len(t) <= 30
    (coordinate,) = found["coordinates"]
    np.testing.assert_allclose(coordinate["reference"], (1.0 - t) ** -2.0, rtol=1e-5)
    linear, deviation, unlike = columns(found, "linear", "deviation", "nonlinearity")
    assert len(linear) == len(deviation) == len(unlike) == len(t)
    np.testing.assert_allclose(deviation, linear, rtol=0.5)
    assert unlike.max() < 0.01


def test_forces_with_kinks_are_run_one_by_one() -> None:
    """In the well k |x| a mass falls by k t²/2 as far as it has come, and passes 0 at τ = √(2 x₀/k) with v = −k τ.

    Behind it x = v s + k s²/2 with s = t − τ, so that ∂x/∂x₀ = 1 − 2 (t − τ)/τ.
    """
    found = ask(scene=line("k*abs(x)"), tolerances={"x": 0.01}, t_end=1.0, runs=40, seed=3)
    (linear, deviation), t, fall = columns(found, "linear", "deviation"), np.array(found["t"]), math.sqrt(0.5)
    true = 0.01 * np.where(t < fall, 1.0, np.abs(1.0 - 2.0 * (t - fall) / fall))
    away = np.abs(t - fall) > 0.02  # some of the runs have passed already, others not yet
    np.testing.assert_allclose(linear[away], true[away], rtol=1e-5, atol=1e-7)
    starts = 1.0 + drawn(np.array([0.01]), 40, 3, is_normal=True)  # shape (runs, 1)
    turns = np.sqrt(starts / 2.0)
    behind = np.maximum(t - turns, 0.0)
    runs = starts - 2.0 * np.minimum(t, turns) ** 2 - 4.0 * turns * behind + 2.0 * behind**2
    np.testing.assert_allclose(deviation, runs.std(axis=0, ddof=1), rtol=1e-5, atol=1e-8)


def test_the_first_is_the_same_again_and_another_seed_is_another_cloud() -> None:
    one, again, other = (ask(scene=OSCILLATOR, seed=seed, runs=30) for seed in (1, 1, 2))
    assert one == again
    assert one["coordinates"][0]["deviation"] != other["coordinates"][0]["deviation"]


@pytest.mark.parametrize("scene", ["elastic-pendulum", "heavy-top", "kapitza"])
def test_propagation_keeps_what_hamiltonian_flows_keep(scene: str) -> None:
    """det Φ of (q, q̇) is det M(0)/det M(t), by Liouville: of (q, p) it is 1."""
    problem = problem_of(load_scene(scene), 2.0)
    n = problem.degrees
    flow = propagated(problem, 41, (), np.full(2 * n, 0.01))
    table = problem.model.motion.table(problem.inputs(flow.times, flow.states))
    rows, cols = np.tril_indices(n)
    masses = np.zeros((len(flow.times), n, n))
    masses[:, rows, cols] = masses[:, cols, rows] = table[:, : rows.size]
    found = np.linalg.det(flow.matrices) * np.linalg.det(masses) / np.linalg.det(masses[0])
    np.testing.assert_allclose(found, 1.0, atol=1e-5)


def plane(energy: str, x: tuple[float, float], y: tuple[float, float], **parameters: float) -> dict[str, Any]:
    """A particle of mass 1 in a plane, in a potential."""
    loads = [{"kind": "potential", "name": "field", "energy": energy}]
    return document({"x": x, "y": y}, {"m": 1.0, **parameters}, {"p": ("m", ["x", "y"])}, loads)


@pytest.mark.parametrize("width", [0.1, 0.01, 3e-3, 1e-3, 3e-4])
def test_linear_propagation_passes_over_no_hill(width: float) -> None:
    """A hill met off its middle scatters: deviations across the way grow with the slope of the angle."""
    hill = {"height": 0.05, "width": width, "place": 4.987}
    energy = "height*exp(-((x - place)^2 + y^2)/width^2)"
    found = ask(
        scene=plane(energy, (0.0, 1.0), (0.7 * width, 0.0), **hill), tolerances={"y": 1e-4 * width}, t_end=10.0, runs=40
    )

    def forces(_t: float, state: np.ndarray) -> list[float]:
        x, y, u, v = state
        push = 0.1 / width**2 * math.exp(-((x - 4.987) ** 2 + y**2) / width**2)
        return [u, v, (x - 4.987) * push, y * push]

    def y_at_end(start: float) -> float:
        beside, options = 4.987 - 8.0 * width, {"method": "DOP853", "rtol": 1e-12, "atol": 1e-15}
        span = (beside, beside + 16.0 * width)  # before it, and behind it, the motion is straight
        near = solve_ivp(forces, span, [beside, start, 1.0, 0.0], max_step=width, **options).y[:, -1]
        return float(near[1] + (10.0 - span[1]) * near[3])

    nudge = 1e-4 * width
    sigma = abs(y_at_end(0.7 * width + nudge) - y_at_end(0.7 * width - nudge)) / 2.0
    across = found["coordinates"][1]
    assert across["linear"][-1] == pytest.approx(sigma, rel=1e-4)
    assert across["linear_until"] is None
    np.testing.assert_allclose(across["nonlinearity"], 0.0, atol=0.02)


VIBRATIONS = {  # along x by ω = 1, across it by ω = 2, of places that are very far, very near, or at rest
    "at rest across": ("m*(x^2 + 4*y^2)/2", (1.0, 0.0), (0.0, 0.0), 1e-3),
    "both at rest": ("m*(x^2 + 4*y^2)/2", (0.0, 0.0), (0.0, 0.0), 1e-3),
    "far from the origin": ("m*((x - far)^2 + 4*(y - far)^2)/2", (1e5 + 1.0, 0.0), (1e5 + 0.5, 0.0), 1e-3),
    "much smaller than 1": ("m*(x^2 + 4*y^2)/2", (1e-9, 0.0), (1e-9, 0.0), 1e-12),
    "curved within its way": ("m*w^2*(cosh(x/w) + 4*cosh(y/w) - 5)/2*2", (0.0, 0.0), (0.0, 1e-14), 1e-14),
}


@pytest.mark.parametrize("name", VIBRATIONS)
@pytest.mark.parametrize("quantity", ["y", "dot(y)"])
def test_deviations_are_carried_whatever_the_motion_is_like(name: str, quantity: str) -> None:
    """δy = δy₀ cos 2t + δẏ₀ sin(2t)/2, though difference quotients have little to go by."""
    energy, x, y, size = VIBRATIONS[name]
    constants = {key: value for key, value in {"far": 1e5, "w": 1e-6}.items() if key in energy.replace("sqrt", "")}
    found = ask(scene=plane(energy, x, y, **constants), tolerances={quantity: size}, runs=40)
    t = np.array(found["t"])
    true = size * np.abs(np.cos(2 * t) if quantity == "y" else np.sin(2 * t) / 2)
    np.testing.assert_allclose(found["coordinates"][1]["linear"], true, rtol=1e-5, atol=1e-5 * size)


def test_a_wrong_order_of_the_propagation_would_show() -> None:
    """Φ of the damped vibration by its closed form, to the accuracy of difference quotients."""
    scene = read_scene(line("k*x^2/2", DRAG, c=0.4))
    flow = propagated(problem_of(scene, 5.0), 21, (), np.full(2, 0.01))
    w, t = math.sqrt(3.96), flow.times
    decay, cos, sin = np.exp(-0.2 * t), np.cos(w * t), np.sin(w * t)
    true = decay * np.array([[cos + 0.2 / w * sin, sin / w], [-4.0 / w * sin, cos - 0.2 / w * sin]])
    np.testing.assert_allclose(flow.matrices, true.transpose(2, 0, 1), atol=2e-8)


OSCILLATOR_OF_MASS = OSCILLATOR | {"parameters": [{"name": n, "value": v} for n, v in (("m", 1.0), ("k", 4.0))]}
KINK = OSCILLATOR | {"loads": [{"kind": "potential", "name": "w", "energy": "k*abs(x)"}]}
EMPTY = document({"x": (1.0, 0.0)}, {}, {"p": ("1", ["x", "0"])}, [{"kind": "potential", "name": "w", "energy": "x^2"}])
REFUSED = [
    pytest.param({"runs": 2000, "t_end": 100.0}, "uncertainty-too-large", "/runs", id="too long"),
    pytest.param({"scene": KINK, "runs": 2000}, "uncertainty-too-large-singly", "/runs", id="too long singly"),
    pytest.param({"runs": 1}, "request-outside", "/runs", id="too few"),
    pytest.param({"tolerance": 0.0}, "request-outside", "/tolerance", id="zero"),
    pytest.param({"tolerance": -1.0}, "request-outside", "/tolerance", id="negative"),
    pytest.param({"tolerance": math.nan}, "request-not-finite", "/tolerance", id="no number"),
    pytest.param({"tolerance": math.inf}, "request-not-finite", "/tolerance", id="infinite"),
    pytest.param({"tolerances": {"x": 0.0}}, "request-not-above", "/tolerances/x", id="one is zero"),
    pytest.param({"tolerances": {"x": math.inf}}, "request-not-finite", "/tolerances/x", id="one is infinite"),
    pytest.param({"tolerances": {"z": 0.1}}, "ensemble-quantity", "/tolerances/z", id="no such coordinate"),
    pytest.param({"tolerances": {"initial.x": 0.1}}, "ensemble-quantity", "/tolerances/initial.x", id="half a name"),
    pytest.param({"tolerances": {"m": 0.9}}, "uncertainty-sign", "/tolerances/m", id="a mass below zero"),
    pytest.param({"uncertain": "parameters", "tolerance": 0.8}, "uncertainty-sign", "/tolerance", id="all of them"),
    pytest.param({"uncertain": "rates"}, "request-not-one-of", "/uncertain", id="no such choice"),
    pytest.param({"scene": EMPTY, "uncertain": "parameters"}, "uncertainty-nothing", "/uncertain", id="no parameters"),
    pytest.param({"scene": "four-bar"}, "lab-constraints", "/scene", id="constraints"),
    pytest.param({"scene": "bouncing-ball"}, "lab-impacts", "/scene", id="impacts"),
    pytest.param({"scene": "stick-slip"}, "lab-friction", "/scene", id="dry friction"),
]


@pytest.mark.parametrize(("fields", "code", "pointer"), REFUSED)
def test_what_has_no_answer_is_told_before_anything_runs(fields: dict[str, Any], code: str, pointer: str) -> None:
    with pytest.raises(InputError) as caught:
        ask(**{"scene": OSCILLATOR_OF_MASS, **fields})
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]
