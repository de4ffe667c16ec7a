"""How fast a motion is, and what drives it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.simulation.scenes import get_scene, oscillator

from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of
from deltaq.simulation.stiffness import drive, spectrum

OMEGA = 1.7  # of the oscillator's scene


@pytest.mark.parametrize("span", [20.0, 100.0])
@pytest.mark.parametrize(
    ("force", "expected"),
    [
        pytest.param("-k*x", 0.0, id="nothing"),
        pytest.param("-k*x + F0*cos(omega*t)", OMEGA, id="a sine"),
        pytest.param("-1e6*x - 1e4*dot(x) + F0*cos(omega*t)", OMEGA, id="a sine beside a large force"),
        pytest.param("-k*x + F0*cos(40*omega*t)", 40 * OMEGA, id="a fast one"),
        pytest.param("-k*x + F0*cos(omega*t) + F0*cos(3*omega*t)", OMEGA * np.sqrt(5), id="two: the root mean square"),
    ],
)
def test_what_drives_a_scene(force: str, expected: float, span: float) -> None:
    problem = problem_of(oscillator(force), span)
    assert drive(problem, problem.state) == pytest.approx(expected, rel=0.15, abs=1e-6)


def test_what_hardly_changes_is_no_drive() -> None:
    """A force that grows evenly: its rate counts by the span, however long that is."""
    problem = problem_of(oscillator("-k*x + 3*t"), 50.0)
    assert drive(problem, problem.state) < 5.0 / problem.t_end


@pytest.mark.parametrize("scene", ["kapitza", "guided-pendulum", "quarter-car"])
def test_guides_drive_as_well(scene: str) -> None:
    problem = problem_of(get_scene(scene), 20.0)
    assert drive(problem, problem.state) > 1.0


def test_what_dies_out_does_not_last() -> None:
    def at(span: float) -> tuple[float, float]:
        problem: Problem = replace(problem_of(oscillator("-k*x - 100*dot(x)"), 1.0), t_end=span)
        found = spectrum(problem, 0.0, problem.state)
        return found.size, found.lasting

    assert at(0.1) == pytest.approx((99.96, 99.96), rel=1e-3)
    assert at(10.0) == pytest.approx((99.96, 0.04), rel=1e-3)
