"""Motions against closed forms and references; statuses; what a tolerance means."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.simulation.references import pendulum_angle, reference_of, simulated, true_errors, trusted
from tests.simulation.scenes import double_pendulum, get_scene, oscillator, scene, spherical_pendulum, standstill

from deltaq.mechanics.changes import change
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import problem_of

ADAPTIVE = [identifier for identifier in method_ids() if get_method(identifier).is_adaptive]


def pendulum(amplitude: float) -> object:
    swing = load_scene("pendulum")
    return replace(swing, coordinates=(replace(swing.coordinates[0], value=amplitude),))


@pytest.mark.parametrize("amplitude", [0.1, 1.0, 2.5, 3.1])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-9])
def test_pendulum_is_the_elliptic_function(amplitude: float, tolerance: float) -> None:
    found = simulated(pendulum(amplitude), "dop853", 20.0, tolerance=tolerance)
    true = np.abs(found.values[:, 0] - pendulum_angle(found.times, amplitude, np.sqrt(9.81)))
    assert found.outcome.status == "ok"
    assert found.tolerance_reached
    assert true.max() <= tolerance
    assert np.all(true <= found.estimate.errors + 1e-14)


def test_pendulum_long_after() -> None:
    """A thousand seconds at the default tolerance: where solve_ivp at its defaults reports success and 260 % error."""
    found = simulated(pendulum(2.0), "dop853", 1000.0, 2001, tolerance=1e-6)
    true = np.abs(found.values[:, 0] - pendulum_angle(found.times, 2.0, np.sqrt(9.81)))
    assert found.outcome.status == "ok"
    assert true.max() <= 1e-6


@pytest.mark.parametrize("identifier", method_ids())
def test_damped_driven_oscillator_is_its_closed_form(identifier: str) -> None:
    """m x″ + c x′ + k x = F₀ cos ωt: every method reaches a moderate tolerance."""
    found = simulated(get_scene("damped-oscillator"), identifier, 10.0, tolerance=1e-3)
    k, c, force, omega = 4.0, 0.3, 2.0, 1.7
    response = force / complex(k - omega**2, c * omega)
    root = complex(-c / 2, np.sqrt(k - c**2 / 4))
    start, slope = 1.0 - response.real, -(1j * omega * response).real
    free = complex(start, (root.real * start - slope) / root.imag)
    expected = (response * np.exp(1j * omega * found.times) + free * np.exp(root * found.times)).real
    assert found.outcome.status == "ok"
    assert np.abs(found.values[:, 0] - expected).max() <= 1e-3


TOLERANCES = {
    "bogacki-shampine-32": [1e-2, 1e-4],
    "dormand-prince-54": [1e-3, 1e-6, 1e-9],
    "dop853": [1e-3, 1e-6, 1e-9],
    "radau-5": [1e-3, 1e-6, 1e-9],
    "taylor": [1e-6, 1e-9],
}
SCENES = (*scene_ids(), "driven-by-everything", "damped-oscillator", "fast-spherical-pendulum")
ALL = [
    (name, identifier, tolerance)
    for name in SCENES
    for identifier in ADAPTIVE
    for tolerance in TOLERANCES[identifier]
    if identifier != "taylor" or not get_scene(name).conditions  # which series cannot keep
]
CASES = [pytest.param(*case, id=f"{case[0]} {case[1]} {case[2]:g}") for case in ALL] + [
    pytest.param("wild-double-pendulum", identifier, tolerance, id=f"wild-double-pendulum {identifier} {tolerance:g}")
    for identifier in ADAPTIVE
    for tolerance in TOLERANCES[identifier]
    if tolerance > 1e-9  # which double precision cannot give here
]


@pytest.mark.one_in(16)
@pytest.mark.parametrize(("name", "identifier", "tolerance"), CASES)
def test_a_tolerance_is_the_error_of_the_answer(name: str, identifier: str, tolerance: float) -> None:
    """True error ≤ estimate ≤ tolerance at every sample, by a reference that knows its own error."""
    found, trusted = simulated(get_scene(name), identifier, 10.0, tolerance=tolerance), reference_of(name)
    assert found.outcome.status == "ok"
    assert found.tolerance_reached
    own, other = trusted.common(found.times)
    assert np.all(trusted.errors_of(found) <= found.estimate.errors[other] + trusted.errors[own])
    assert np.all(found.estimate.errors <= tolerance * np.maximum(1.0, np.abs(found.values).max()))


def test_the_estimate_is_rarely_a_hundred_times_too_large() -> None:
    """In at least nine of ten runs it is within a factor of 100 at the middle sample."""
    ratios = []
    for name, identifier, tolerance in ALL:
        trusted, found = reference_of(name), simulated(get_scene(name), identifier, 10.0, tolerance=tolerance)
        own, other = trusted.common(found.times)
        true = np.maximum(trusted.errors_of(found), trusted.errors[own])[1:]
        ratios.append(np.median(found.estimate.errors[other][1:] / true))
    assert np.mean(np.array(ratios) <= 100) >= 0.9


def test_what_double_precision_cannot_give_is_not_promised() -> None:
    """Ten seconds of chaos magnify rounding beyond 1e-9: the answer says so, and by how much."""
    found = simulated(double_pendulum(), "dop853", 10.0, tolerance=1e-9)
    assert found.outcome.status == "tolerance_missed"
    assert not found.tolerance_reached
    assert 1e-9 < found.estimate.worst < 1e-6


@pytest.mark.parametrize("identifier", method_ids())
def test_fixed_steps_know_their_error(identifier: str) -> None:
    for name in ("pendulum", "elastic-pendulum", "guided-pendulum"):
        sought = get_scene(name)
        found, reference = simulated(sought, identifier, 5.0, step=0.005), trusted(sought, 5.0)
        true, told = true_errors(found, reference), found.estimate.errors
        assert np.all(true <= told + 1e-13), name
        assert np.median(told[1:] / np.maximum(true[1:], np.finfo(float).eps)) <= 100, name


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_chaos_has_a_horizon_and_no_false_confidence(tolerance: float) -> None:
    """No run can follow the double pendulum for 100 s; up to the horizon the estimate holds, beyond it says so."""
    found = simulated(double_pendulum(), "dop853", 100.0, 1001, tolerance=tolerance)
    reference = trusted(double_pendulum(), 100.0, 1001)
    assert (found.outcome.status, found.outcome.code) == ("horizon_reached", "horizon_reached")
    assert found.tolerance_reached is False
    assert found.trusted_until == found.estimate.horizon
    assert 10 < found.estimate.horizon < 45
    assert reference.estimate.horizon >= found.estimate.horizon - 3
    known = found.times < min(found.estimate.horizon, reference.estimate.horizon)
    slack = reference.estimate.errors[known] + 1e-13
    assert np.all(true_errors(found, reference)[known] <= found.estimate.errors[known] + slack)
    assert np.all(found.estimate.errors[found.times > found.estimate.horizon] >= 0.5)


@pytest.mark.parametrize("name", [*scene_ids(), "driven-by-everything", "damped-oscillator", "fast-spherical-pendulum"])
def test_energy_balance_holds(name: str) -> None:
    """E + V − ∫P dt stays put, for guided, driven and damped scenes too."""
    problem = problem_of(get_scene(name), 10.0)
    found = simulate(problem, get_method("dop853"), tolerance=1e-10)
    seen = problem.model.observe(problem.inputs(found.times, np.hstack([found.values, found.rates])))
    balance = seen.kinetic + seen.potential - found.work
    turnover = np.abs(np.diff(found.work)).sum()  # what is fed in and taken out again
    assert np.ptp(balance) <= 1e-9 * (np.max(np.abs(seen.kinetic) + np.abs(seen.potential)) + turnover)
    if turnover > 1e-6:  # Foucault's floor turns under the pendulum and does no work
        assert np.ptp(seen.kinetic + seen.potential) > 1e-2


def kicked(force: str, x: float = 1.0) -> object:
    return oscillator(force, x=x)


STATUSES = [
    pytest.param(
        oscillator(), "explicit-euler", {"step": 1.1}, 200.0, "diverged", "diverged", id="grows with any step"
    ),
    pytest.param(kicked("m*x^3"), "dop853", {"tolerance": 1e-6}, 10.0, "diverged", "diverged", id="blow-up"),
    pytest.param(
        kicked("-m*sqrt(x)"), "dop853", {"tolerance": 1e-6}, 10.0, "singular", "singular", id="leaves the domain"
    ),
    pytest.param(
        kicked("-m/x"), "dormand-prince-54", {"tolerance": 1e-6}, 10.0, "singular", "singular", id="collision"
    ),
    pytest.param(
        kicked("m/x", x=0.0), "rk4", {"step": 0.1}, 1.0, "singular", "singular", id="nothing finite"
    ),
    pytest.param(
        standstill(), "dop853", {"tolerance": 1e-6}, 1.0, "singular_mass_matrix", "singular_mass_matrix", id="dead"
    ),
    pytest.param(
        spherical_pendulum(theta=0.0), "rk4", {"step": 0.01}, 1.0, "singular_mass_matrix", "singular_mass_matrix",
        id="at the pole",
    ),
    pytest.param(
        oscillator("-1e8*x - 1e6*dot(x)"), "dop853", {"tolerance": 1e-6}, 100.0, "stiff", "stiff", id="stiff, order 8"
    ),
    pytest.param(
        oscillator("-1e8*x - 1e6*dot(x)"), "bogacki-shampine-32", {"tolerance": 1e-4}, 1e3, "stiff", "stiff",
        id="stiff, order 3",
    ),
    pytest.param(
        double_pendulum(), "gauss-4", {"step": 1.0}, 10.0, "newton_failed", "newton_failed", id="giant step"
    ),
    pytest.param(
        double_pendulum(), "newmark", {"step": 2.0}, 10.0, "newton_failed", "newton_failed", id="giant leap"
    ),
    pytest.param(
        spherical_pendulum(theta=0.0), "gauss-6", {"step": 0.01}, 1.0, "singular_mass_matrix", "singular_mass_matrix",
        id="at the pole, implicitly",
    ),
    pytest.param(
        kicked("m/x", x=0.0), "newmark", {"step": 0.1}, 1.0, "singular", "singular", id="nothing finite, implicitly"
    ),
    pytest.param(
        oscillator(), "stormer-verlet", {"step": 1.1}, 200.0, "diverged", "unstable_step", id="step too large"
    ),
    pytest.param(
        oscillator(), "rk4", {"step": 1.5}, 900.0, "diverged", "unstable_step", id="step too large, order 4"
    ),
    pytest.param(
        oscillator(), "explicit-euler", {"tolerance": 1e-9}, 10.0, "tolerance_missed", "tolerance_missed", id="too much"
    ),
    pytest.param(
        oscillator(), "explicit-euler", {"step": 0.05}, 50.0, "horizon_reached", "horizon_reached", id="growing"
    ),
]  # fmt: skip


@pytest.mark.parametrize(("sought", "identifier", "accuracy", "t_end", "status", "code"), STATUSES)
def test_failures_are_results(
    sought: object, identifier: str, accuracy: dict[str, float], t_end: float, status: str, code: str
) -> None:
    found = simulated(sought, identifier, t_end, **accuracy)
    assert (found.outcome.status, found.outcome.code) == (status, code)
    assert len(found.times) == len(found.values) == len(found.estimate.errors) >= 1
    for array in (found.times, found.values, found.rates, found.work, found.estimate.errors):
        assert np.isfinite(array).all()


def test_an_unstable_step_is_told_with_the_largest_stable_one() -> None:
    """ω = 2: Störmer–Verlet is stable for h < 2/ω = 1."""
    found = simulated(oscillator(), "stormer-verlet", 200.0, step=1.1)
    assert found.outcome.parameters["step"] == 1.1
    assert found.outcome.parameters["bound"] == pytest.approx(1.0, rel=0.02)


@pytest.mark.parametrize("spin", [0.0, 1e-8, 1e-4, 1e-2, 0.1])
@pytest.mark.parametrize(
    ("identifier", "accuracy"),
    [
        ("dop853", {"tolerance": 1e-6}),
        ("radau-5", {"tolerance": 1e-4}),
        ("rk4", {"step": 0.01}),
        ("gauss-4", {"step": 0.01}),
    ],
)
def test_nothing_drifts_unseen_past_the_pole(spin: float, identifier: str, accuracy: dict[str, float]) -> None:
    """Close past the pole ψ turns by π at once: energy and momentum stay, or the answer says how far it holds."""
    found = simulated(spherical_pendulum(1.0, spin), identifier, 10.0, **accuracy)
    known = found.times < found.trusted_until
    (theta, _), (speed, turn) = found.values[known].T, found.rates[known].T
    energy = (speed**2 + np.sin(theta) ** 2 * turn**2) / 2 - 9.81 * np.cos(theta)
    momentum = np.sin(theta) ** 2 * turn
    assert found.outcome.status in {"ok", "diverged", "singular_mass_matrix", "newton_failed", "horizon_reached"}
    assert (found.outcome.status == "ok") == (len(found.times) == 501 and found.estimate.horizon is None)
    assert known.sum() >= 20
    assert np.ptp(energy) <= 2e-3
    assert np.ptp(momentum) <= 2e-3


STIFF = "-1e6*x - 1e4*dot(x) + F0*cos(omega*t)"


def test_radau_does_not_follow_what_has_died_out() -> None:
    """A stiff damped spring, which hangs an explicit method: after the start the mass follows its force."""
    found = simulated(oscillator(STIFF, x=0.0), "radau-5", 100.0, tolerance=1e-8)
    expected = 2.0 * np.cos(1.7 * found.times) / (1e6 - 1.7**2) + 2.0 * 1.7e4 * np.sin(1.7 * found.times) / 1e12
    assert found.outcome.status == "ok"
    assert found.cost.steps < 5000
    np.testing.assert_allclose(found.values[1:, 0], expected[1:], atol=1e-8)


def test_no_method_hangs_on_a_force_that_jumps() -> None:
    """Dry friction by sign, on which Radau hangs elsewhere: an answer in bounded time that owns up to its error."""
    for identifier in ("dormand-prince-54", "dop853", "radau-5", "gauss-4"):
        problem = replace(problem_of(oscillator("-k*x - c*sign(dot(x))"), 20.0), step_limit=100_000)
        found = simulate(problem, get_method(identifier), tolerance=1e-4)
        assert np.isfinite(found.values).all()
        assert found.outcome.status != "ok" or found.estimate.worst <= 1e-4
        assert np.abs(found.values[found.times <= found.trusted_until]).max() <= 1.0 + 1e-3


def test_blow_up_keeps_the_good_part() -> None:
    """x″ = 2x³ from x = x′ = 1 is x = 1/(1 − t)."""
    found = simulated(oscillator("2*m*x^3", u=1.0), "dop853", 2.0, 2001, tolerance=1e-6)
    good = found.times < 0.9
    np.testing.assert_allclose(found.values[good, 0], 1 / (1 - found.times[good]), rtol=1e-6)
    assert found.reached == pytest.approx(1.0, abs=1e-3)
    assert found.times[-1] < 1.0


def test_pole_at_speed_is_survived() -> None:
    """The spherical pendulum passes close to the pole; its angular momentum about the vertical is kept."""
    found = simulated(spherical_pendulum(theta=1.5, rate=1e-3), "dop853", 20.0, tolerance=1e-6)
    momentum = np.sin(found.values[:, 0]) ** 2 * found.rates[:, 1]
    np.testing.assert_allclose(momentum, momentum[0], rtol=1e-4)


def test_step_limit() -> None:
    problem = replace(problem_of(load_scene("pendulum"), 10.0), step_limit=100)
    found = simulate(problem, get_method("rk4"), step=0.01)
    assert found.outcome.status == "step_limit"
    assert dict(found.outcome.parameters) == {"method": "rk4", "t": 0.481, "t_end": 10.0, "steps": 100, "step": 0.01}
    assert found.reached == pytest.approx(0.4814, abs=1e-4)
    assert found.times[-1] == pytest.approx(0.48)


@pytest.mark.parametrize(("name", "method"), [("cartesian-pendulum", "radau-5"), ("pendulum", "dop853")])
def test_motions_that_come_nowhere_are_given_up_early(name: str, method: str) -> None:
    """A billion turns in ten seconds: all steps that are allowed make some thousand. What is returned is right."""
    of = load_scene(name)
    fast = replace(of, coordinates=(replace(of.coordinates[0], rate=1e9), *of.coordinates[1:]))
    problem = problem_of(fast, 10.0)
    for _ in range(2):  # the second time in code that is compiled thoroughly
        found = simulate(problem, get_method(method), tolerance=1e-6)
        assert (found.outcome.status, found.outcome.code) == ("step_limit", "out_of_reach")
        assert 0.0 < found.reached < 0.02
        assert found.cost.steps <= problem.step_limit / 16
        np.testing.assert_array_equal(found.values[0], problem.values)


def test_a_motion_that_slows_down_is_not_given_up() -> None:
    """x″ = −(W/(t + ε))² x turns evenly in the logarithm of time: x = s^½ cos(κ ln s), s = (t + ε)/ε, κ² = W² − ¼."""
    rate, late = 2e4, 1e-3
    slowing = scene(
        {"x": (1.0, 0.5 / late)}, {"m": 1.0, "W": rate, "c": late}, {"p": ("m", ["x", "0"])},
        [{"kind": "force", "name": "spring", "at": "p", "force": ["-m*W^2*x/(t + c)^2", "0"]}],
    )  # fmt: skip
    problem = problem_of(slowing, 10.0, 11)
    found = simulate(problem, get_method("dop853"), tolerance=1e-3)
    assert found.outcome.status == "ok"
    assert found.cost.steps > problem.step_limit / 16
    s = (found.times + late) / late
    np.testing.assert_allclose(found.values[:, 0], np.sqrt(s) * np.cos(np.sqrt(rate**2 - 0.25) * np.log(s)), atol=0.1)


def test_where_equations_end_no_run_looks_twice() -> None:
    """A mass of 1e-20 kg between two rods has no acceleration of its own when they are in line."""
    of = load_scene("double-pendulum-by-rods")
    light = replace(
        of, parameters=tuple(replace(p, value=1e-20, min=None) if p.name == "m1" else p for p in of.parameters)
    )
    found = simulate(problem_of(light, 10.0), get_method("dop853"), tolerance=1e-6)
    assert found.outcome.status in ("newton_failed", "singular_constraints")
    assert found.reached > 0.05
    assert found.cost.rhs_evaluations < 200_000


def test_cancelled() -> None:
    flag = np.ones(1, dtype=np.int64)
    found = simulate(problem_of(load_scene("pendulum"), 10.0), get_method("rk4"), step=0.01, cancelled=flag)
    assert (found.outcome.status, found.cost.steps) == ("cancelled", 0)


@pytest.mark.parametrize("samples", [2, 3, 7, 201, 1500])
def test_samples_do_not_change_the_motion(samples: int) -> None:
    few = simulated(double_pendulum(), "dormand-prince-54", 3.0, samples, step=0.01)
    assert few.times.tolist() == pytest.approx(np.linspace(0, 3, samples).tolist())
    np.testing.assert_array_equal(
        few.values[-1], simulated(double_pendulum(), "dormand-prince-54", 3.0, step=0.01).values[-1]
    )


def test_a_late_event_after_rest_is_not_jumped_over() -> None:
    """At rest for 5 s, then pushed for a moment: the steps must not have grown past it."""
    pushed = oscillator("F0*exp(-20*(omega*t - 8.5)^2)", x=0.0)
    found = simulated(pushed, "dop853", 10.0, tolerance=1e-8)
    momentum = 2.0 * np.sqrt(np.pi / (20 * 1.7**2))
    assert found.rates[-1, 0] == pytest.approx(momentum, abs=1e-6)


def test_freezing_and_guiding_agree() -> None:
    base = load_scene("base-pendulum")
    frozen = simulated(change(base, freeze=["y"]), "dop853", 5.0, tolerance=1e-9)
    guided = simulated(change(base, guides=[{"coordinate": "y", "value": "0.1"}]), "dop853", 5.0, tolerance=1e-9)
    np.testing.assert_allclose(frozen.values, guided.values, atol=1e-9)


def test_step_and_tolerance_exclude_each_other() -> None:
    with pytest.raises(ValueError, match="either a step or a tolerance"):
        simulated(scene({"x": (0, 1)}, {"m": 1}, {"b": ("m", ["x", "0"])}), "rk4", 1.0)
