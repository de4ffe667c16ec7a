"""What implicit methods guess first: short steps take few corrections, and long ones end no motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.benchmarks.bench_constraints import on_rods, on_springs

from deltaq.mechanics.library import load_scene
from deltaq.simulation.library import get_method
from deltaq.simulation.run import Run, Steps, run
from deltaq.simulation.service import problem_of

CORRECTIONS = 2  # the second shows how fast they fall: less is left than rounding takes


def moved(name: str, method: str, t_end: float, step: float) -> Run:
    scene = {"rods": on_rods, "springs": on_springs}[name]() if name in ("rods", "springs") else load_scene(name)
    problem = replace(problem_of(scene, t_end), step_limit=10**6)
    return run(problem, get_method(method), np.array([0.0, t_end]), np.zeros(1, dtype=np.int64), Steps(step))


@pytest.mark.parametrize("name", ["rods", "springs"])
@pytest.mark.parametrize(
    ("method", "stages"),
    [
        ("newmark", 1),
        ("implicit-midpoint", 1),
        ("variational-midpoint", 1),
        ("gauss-4", 2),
        ("gauss-6", 3),
        ("radau-5", 3),
    ],
)
def test_short_steps_take_two_corrections(method: str, stages: int, name: str) -> None:
    """A right-hand side for each stage and correction, one at the end, and now and then the matrix anew."""
    found = moved(name, method, 2.0, 1e-3)
    assert found.is_complete
    assert found.result.evaluations / found.result.steps < stages * CORRECTIONS + 1 + 0.5 * stages


@pytest.mark.parametrize(
    ("name", "method", "step"),
    [
        ("pendulum", "gauss-4", 0.8),
        ("damped-pendulum", "radau-5", 0.8),
        ("wind-on-rod", "implicit-midpoint", 0.8),
        ("wind-on-rod", "gauss-6", 0.8),
        ("slider-crank", "variational-midpoint", 0.3),
    ],
)
def test_a_guess_that_leads_nowhere_is_followed_by_another(name: str, method: str, step: float) -> None:
    """Steps of about a radian, where what was before says little."""
    found = moved(name, method, 40 * step, step)
    assert found.is_complete
    assert np.abs(found.states[-1]).max() < 100.0
