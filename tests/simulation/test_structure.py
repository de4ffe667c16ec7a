"""What methods keep: the symplectic form, the direction of time, the energy, the stationary discrete action."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.simulation.flow import jacobian, stepped, symplectic_defect
from tests.simulation.references import simulated
from tests.simulation.scenes import get_scene, oscillator

from deltaq.mechanics.library import load_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.integration import Flag
from deltaq.simulation.kernels.implicit_runge_kutta import integrate_implicit
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.method import Partitioned
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of

METHODS = method_ids()
SYMPLECTIC = [identifier for identifier in METHODS if get_method(identifier).is_symplectic]


def moving(name: str) -> Problem:
    """A scene in full motion."""
    problem = problem_of(get_scene(name), 1.0)
    return replace(problem, rates=tuple(0.7 + 0.4 * k for k in range(problem.degrees)))


def test_the_symplectic_ones() -> None:
    expected = ["symplectic-euler", "implicit-midpoint", "stormer-verlet", "variational-midpoint", "gauss-4", "gauss-6"]
    assert expected == SYMPLECTIC


def test_the_symmetric_ones() -> None:
    symmetric = [identifier for identifier in METHODS if get_method(identifier).is_symmetric]
    expected = ["implicit-midpoint", "newmark", "stormer-verlet", "variational-midpoint", "gauss-4", "gauss-6"]
    assert symmetric == expected


@pytest.mark.parametrize("name", ["double-pendulum", "guided-pendulum", "spherical-pendulum"])
@pytest.mark.parametrize("identifier", METHODS)
def test_symplectic_methods_keep_the_symplectic_form(identifier: str, name: str) -> None:
    """Jᵀ Ω J = Ω for one step in (q, p), also with a mass matrix that depends on q, and with a guide."""
    h = 0.1 if get_method(identifier).order < 6 else 0.3
    defect = symplectic_defect(jacobian(moving(name), identifier, h))
    assert defect < 3e-9 if get_method(identifier).is_symplectic else defect > 1e-8


@pytest.mark.parametrize("name", ["double-pendulum", "spherical-pendulum"])
@pytest.mark.parametrize("identifier", METHODS)
def test_symmetric_methods_run_backwards(identifier: str, name: str) -> None:
    """A step, the velocities turned round, another step: back where it began."""
    problem = moving(name)
    q, v = np.array(problem.values), np.array(problem.rates)
    there, speed = stepped(problem, identifier, 0.1, q, v)
    back, turned = stepped(problem, identifier, 0.1, there, -speed)
    gap = max(np.abs(back - q).max(), np.abs(turned + v).max())
    assert gap < 1e-11 if get_method(identifier).is_symmetric else gap > 1e-11


def energy_error(identifier: str, periods: int, step: float) -> np.ndarray:
    """Relative energy error at 4001 samples of a pendulum let go at 1 rad, of period 2.14 s."""
    swing = load_scene("pendulum")
    swing = replace(swing, coordinates=(replace(swing.coordinates[0], value=1.0),))
    problem = replace(problem_of(swing, 2.1398 * periods, 4001), step_limit=10**8)
    found = simulate(problem, get_method(identifier), step=step, with_error=False)
    assert found.outcome.status == "ok"
    seen = problem.model.observe(problem.inputs(found.times, np.hstack([found.values, found.rates])))
    total = seen.kinetic + seen.potential
    return np.abs(total - total[0]) / np.ptp(seen.kinetic)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("identifier", [*SYMPLECTIC, "newmark"])
def test_energy_over_a_hundred_thousand_periods(identifier: str) -> None:
    """Bounded: the last tenth is no worse than the first."""
    errors = energy_error(identifier, 100_000, 0.1)
    assert 1e-9 < errors[:400].max() < 0.2
    assert errors[-400:].max() < 1.1 * errors[:400].max() + 1e-9


@pytest.mark.parametrize("step", [0.02, 0.1, 0.3, 0.8])
@pytest.mark.parametrize("identifier", ["implicit-midpoint", "variational-midpoint", "newmark", "gauss-4", "gauss-6"])
def test_energy_of_linear_motions_is_kept_to_rounding_by_steps_of_any_size(identifier: str, step: float) -> None:
    """These methods keep what is quadratic: half a period a step, and more, with springs of 7 s⁻¹."""
    problem = replace(problem_of(load_scene("two-mass-oscillator"), 400 * step, 401), step_limit=10**6)
    found = simulate(problem, get_method(identifier), step=step, with_error=False)
    assert found.outcome.status == "ok"
    seen = problem.model.observe(problem.inputs(found.times, np.hstack([found.values, found.rates])))
    total = seen.kinetic + seen.potential
    assert np.ptp(total) < 3e-13 * total[0]


def test_other_methods_lose_energy() -> None:
    errors = energy_error("rk4", 10_000, 0.1)
    assert errors[-1] > 0.5


@pytest.mark.parametrize("name", ["double-pendulum", "guided-pendulum"])
def test_discrete_action_is_stationary(name: str) -> None:
    """D₂L_d(q₀, q₁) + D₁L_d(q₁, q₂) = 0 for the energies of the scene at the midpoints, by differences."""
    problem, h = moving(name), 0.02
    n = problem.degrees
    found = simulated(get_scene(name), "variational-midpoint", 2 * h, 3, step=h)
    q0, q1, q2 = found.values

    def action(a: np.ndarray, b: np.ndarray, t: float) -> float:
        row = problem.inputs(np.array([t + h / 2]), np.concatenate([(a + b) / 2, (b - a) / h])[None])
        seen = problem.model.observe(row)
        return float(h * (seen.kinetic - seen.potential)[0])

    for e in 1e-5 * np.eye(n):
        change = action(q0, q1 + e, 0) + action(q1 + e, q2, h) - action(q0, q1 - e, 0) - action(q1 - e, q2, h)
        scale = abs(action(q0, q1 + e, 0) - action(q0, q1 - e, 0))
        assert abs(change) < 1e-7 * scale


@pytest.mark.parametrize("name", ["double-pendulum", "driven-by-everything", "damped-oscillator"])
def test_variational_midpoint_is_the_midpoint_rule(name: str) -> None:
    """With driving, damping and follower forces, too: the discrete forces are those of the rule."""
    one, two = (simulated(get_scene(name), m, 1.0, step=0.01) for m in ("implicit-midpoint", "variational-midpoint"))
    np.testing.assert_allclose(one.values, two.values, atol=1e-12)


@pytest.mark.parametrize("identifier", ["symplectic-euler", "stormer-verlet"])
def test_kick_and_drift_are_the_general_scheme(identifier: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where positions and momenta separate, the explicit kernel and the implicit one give the same motion."""
    explicit = simulated(oscillator("-k*x^3 + F0*cos(omega*t)"), identifier, 10.0, step=0.01)
    scheme = get_method(identifier).scheme
    general = replace(get_method(identifier), scheme=replace(scheme, kicks=(), drifts=()))
    implicit = simulate(problem_of(oscillator("-k*x^3 + F0*cos(omega*t)"), 10.0), general, step=0.01)
    np.testing.assert_allclose(explicit.values, implicit.values, atol=1e-11)
    assert isinstance(scheme, Partitioned)
    assert explicit.cost.run_evaluations < implicit.cost.run_evaluations


@pytest.mark.parametrize("identifier", SYMPLECTIC)
@pytest.mark.parametrize("t_end", [1.0, 0.95, 1.0 / 3.0])
def test_fixed_steps_stay_fixed(identifier: str, t_end: float) -> None:
    """The end does not shorten a step: what comes before it does not depend on it."""
    sought = get_scene("double-pendulum")
    found = simulated(sought, identifier, t_end, 20, step=0.05)
    assert found.cost.steps == int(np.ceil(t_end / 0.05 - 1e-9))
    longer = simulated(sought, identifier, 2 * t_end, 39, step=0.05)
    np.testing.assert_allclose(found.values, longer.values[: len(found.values)], atol=1e-12)


def test_one_kernel_serves_all_implicit_methods() -> None:
    flag: Flag = np.zeros(1, dtype=np.int64)
    for identifier in ("gauss-4", "radau-5"):
        simulate(problem_of(get_scene("double-pendulum"), 0.1), get_method(identifier), step=0.01, cancelled=flag)
    assert len(integrate_implicit.compiled.signatures) == 1
