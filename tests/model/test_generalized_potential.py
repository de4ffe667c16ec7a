"""Generalized potentials, linear in the rates: motion, energy, L and what is conserved, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.derivation.conservation import is_energy, jacobi_energy_rate
from deltaq.derivation.engine import derive
from deltaq.derivation.system import System
from deltaq.language.plain_printer import plain
from deltaq.mechanics.changes import change
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

# A particle of mass m in the plane, seen from a frame that turns with ω(t): U = −m ω (x ẏ − y ẋ) − m ω² r²/2.
TURNING: dict[str, object] = {
    "format": 1,
    "id": "turning",
    "title": "turning frame",
    "dimension": 2,
    "coordinates": [{"name": "x", "value": 1.0}, {"name": "y", "rate": 0.3}],
    "parameters": [{"name": "m", "value": 2.0}, {"name": "a", "value": 0.4}, {"name": "b", "value": 0.3}],
    "bodies": [{"name": "p", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
    "loads": [
        {
            "kind": "generalized-potential",
            "name": "frame",
            "energy": "-m*(a + b*t)*(x*dot(y) - y*dot(x)) - m*(a + b*t)^2*(x^2 + y^2)/2",
        }
    ],
}


def test_cyclotron() -> None:
    """x = (v₀ − u) sin(ωt)/ω + u t, y = (v₀ − u) (cos(ωt) − 1)/ω with ω = eB/m, u = E₀/B (Landau, Lifshitz, §22)."""
    scene = load_scene("charged-particle")
    problem, (omega, drift) = problem_of(scene, 20.0), (2.0, 0.25)
    found = simulate(problem, get_method("dop853"), tolerance=1e-10)
    t, size = found.times, (1.0 - drift) / omega
    truth = np.column_stack([size * np.sin(omega * t) + drift * t, size * (np.cos(omega * t) - 1.0)])
    assert found.estimate is not None
    errors = np.abs(found.values - truth).max(axis=1)
    assert (errors <= found.estimate.errors).all()
    assert errors.max() < 1e-10
    seen = problem.model.observe(problem.inputs(t, np.hstack([found.values, found.rates])))
    assert np.ptp(seen.kinetic + seen.potential) < 1e-10


def test_a_free_particle_in_a_frame_that_turns_faster_and_faster() -> None:
    """Seen from outside it goes straight on; its energy in the frame changes by the explicit time in U."""
    scene = read_scene(TURNING)
    problem = problem_of(scene, 5.0)
    found = simulate(problem, get_method("dop853"), tolerance=1e-11)
    t = found.times
    angle = 0.4 * t + 0.15 * t**2
    straight = np.exp(-1j * angle) * (1.0 + t * 1j * (0.3 + 0.4))  # v = q̇ + iω q at t = 0
    assert np.abs(found.values[:, 0] + 1j * found.values[:, 1] - straight).max() < 1e-10
    seen = problem.model.observe(problem.inputs(t, np.hstack([found.values, found.rates])))
    balance = seen.kinetic + seen.potential - found.work
    assert np.ptp(seen.kinetic + seen.potential) > 1.0
    assert np.ptp(balance) < 1e-9


def test_lagrange_function_and_momentum() -> None:
    system = System(load_scene("charged-particle"))
    assert plain(system.momentum("x") - system.time_derivative(system.q("x")) * system.q("m")) == "-B*e*y/2"
    assert plain(system.potential_energy) == "-E_0*e*y"
    assert system.nonconservative_force("x") == system.nonconservative_force("y") == 0
    assert is_energy(system)
    assert system.is_zero(jacobi_energy_rate(system))


def test_of_a_generalized_potential_only_what_does_not_move_is_energy() -> None:
    system = System(read_scene(TURNING))
    assert system.is_zero(system.potential_energy + system.q("m") * (system.q("a") + system.q("b") * system.t) ** 2
                          * (system.q("x") ** 2 + system.q("y") ** 2) / 2)  # fmt: skip
    assert is_energy(system)


@pytest.mark.parametrize("guides", [[], [{"coordinate": "y", "value": "a*sin(3*t)"}]], ids=["free", "guided"])
@pytest.mark.parametrize("formulation", ["dalembert-lagrange", "hamilton"])
def test_every_step_is_verified(formulation: str, guides: list[dict[str, str]]) -> None:
    for scene in (load_scene("charged-particle"), read_scene(TURNING)):
        _, found = derive(change(scene, guides, parameters={"a": 0.1} if guides else {}), formulation)
        assert [step.id for chapter in found.chapters for step in chapter.steps if not step.verified] == []
