"""Trusted solutions and short ways to run."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.special import ellipj
from tests.simulation.scenes import get_scene

from deltaq.mechanics.scene import Scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.reference import Reference, reference
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory


def trusted(scene: Scene, t_end: float, samples: int = 501) -> Trajectory:
    """The best that order 8 can do."""
    return simulate(problem_of(scene, t_end, samples), get_method("dop853"), tolerance=1e-13)


@cache
def reference_of(name: str) -> Reference:
    """The reference of a scene for ten seconds at 501 samples."""
    return reference(problem_of(get_scene(name), 10.0, 501))


def simulated(scene: Scene, method: str, t_end: float, samples: int = 501, **accuracy: float) -> Trajectory:
    return simulate(problem_of(scene, t_end, samples), get_method(method), **accuracy)


def true_errors(trajectory: Trajectory, reference: Trajectory) -> np.ndarray:
    """The largest error of any coordinate at each sample that both have."""
    count = min(len(trajectory.times), len(reference.times))
    return np.abs(trajectory.values[:count] - reference.values[:count]).max(axis=1)


def pendulum_angle(times: np.ndarray, amplitude: float, frequency: float) -> np.ndarray:
    """The pendulum let go at `amplitude`: sin(φ/2) = k cd(ω₀t, k), k = sin(amplitude/2) (Whittaker, §44)."""
    k = np.sin(amplitude / 2)
    _, cn, dn, _ = ellipj(frequency * times, k**2)
    return 2 * np.arcsin(k * cn / dn)


def shifted(problem: Problem, **changes: object) -> Problem:
    from dataclasses import replace

    return replace(problem, **changes)  # type: ignore[arg-type]
