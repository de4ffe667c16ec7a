"""Motions that are followed by steps that see thin forces, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erf
from tests.simulation.scenes import oscillator

from deltaq.simulation.audited import AuditedMotion, audited_motion
from deltaq.simulation.kernels.motion import CANCELLED, FINE
from deltaq.simulation.library import get_method
from deltaq.simulation.run import Steps
from deltaq.simulation.service import problem_of


def followed(force: str, times: np.ndarray, start: tuple[float, float], longest: float, flag: int = 0) -> AuditedMotion:
    """A mass of 1 kg on a line from x and ẋ under a force, by steps up to half a second."""
    problem = problem_of(oscillator(force, x=start[0], u=start[1]), float(times[-1]))
    cancelled = np.full(1, flag, dtype=np.int64)
    return audited_motion(problem, get_method("taylor"), times, Steps(0.5, 1e-13), 1e-11, longest, cancelled)


@pytest.mark.parametrize("longest", [0.7, 30.0])
@pytest.mark.parametrize("width", [0.05, 5e-3, 1e-3])
def test_a_hill_is_seen(width: float, longest: float) -> None:
    """U = e^(−(x/w)²)/8: a mass that comes with u = 1 goes on as fast, later by ∫ 1/√(u² − 2U) − 1/u dx."""
    times = np.array([0.0, 0.5, 1.5, 4.0, 10.0])
    found = followed(f"m*x/(4*{width}^2)*exp(-(x/{width})^2)", times, (-1.0, 1.0), longest)
    delay = width * quad(lambda y: 1.0 / np.sqrt(1.0 - 0.25 * np.exp(-(y**2))) - 1.0, -9.0, 9.0)[0]
    np.testing.assert_allclose(found.states[:, 0], -1.0 + times - delay * (times > 1.0), atol=1e-10)
    np.testing.assert_allclose(found.states[:, 1], 1.0, atol=1e-10)
    assert found.outcome == FINE


@pytest.mark.parametrize("width", [0.05, 5e-3, 1e-3])
def test_pulses_are_seen(width: float) -> None:
    """ẍ = Σ e^(−((t − c)/w)²) gives ẋ = Σ w √π/2 (1 + erf((t − c)/w)), for each time c."""
    times, pulses = np.linspace(0.0, 12.0, 5), np.array([1.3, 4.1, 4.7, 11.2])
    force = " + ".join(f"m*exp(-((t - {each})/{width})^2)" for each in pulses)
    found = followed(force, times, (0.0, 0.0), 4.0)
    rates = 0.5 * width * np.sqrt(np.pi) * (1.0 + erf((times[:, None] - pulses) / width)).sum(axis=1)
    np.testing.assert_allclose(found.states[:, 1], rates, atol=1e-11)


def test_what_is_behind_the_end_of_a_motion_is_not_a_number() -> None:
    found = followed("-k*x", np.linspace(0.0, 3.0, 4), (1.0, 0.0), 0.7, flag=1)
    assert found.outcome == CANCELLED
    np.testing.assert_array_equal(found.states[0], [1.0, 0.0])
    assert np.isnan(found.states[1:]).all()
