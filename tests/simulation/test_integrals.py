"""Integrals of motion stay what they are along the motions that are simulated, from random starts in every scene."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray

from deltaq.derivation.result import result_of
from deltaq.derivation.steady import steady_motions
from deltaq.derivation.symmetry import integrals_of_the_lecture, symmetries
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.simulation.consistency import consistent
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

Floats = NDArray[np.float64]
SECONDS, TOLERANCE, CONSTANT = 2.0, 1e-10, 1e-7


def nearby(problem: Problem, name: str) -> Problem:
    """The problem from a random start near the scene's own, on its constraints."""
    source = random.Random(name)
    values = tuple(value + source.uniform(-0.1, 0.1) for value in problem.values)
    rates = tuple(rate + source.uniform(-0.3, 0.3) for rate in problem.rates)
    begun = replace(problem, values=values, rates=rates)
    return consistent(begun) if begun.is_constrained else begun


def integrals(system: System) -> list[sp.Expr]:
    """All that is found to be constant; with constraints, what is told to be so."""
    if system.scene.constraints:
        return [each.value for each in result_of(system).conserved]
    return [*integrals_of_the_lecture(system), *(each.value for each in symmetries(system))]


def along(system: System, value: sp.Expr, found: Trajectory) -> tuple[Floats, Floats]:
    """The expression at every sample, and the size of its terms."""
    moving = [system.t, *map(system.q, system.free), *map(system.rate, system.free)]
    columns = [found.times, *found.values.T, *found.rates.T]
    terms = [
        np.broadcast_to(
            sp.lambdify(moving, term.subs(dict(system.parameter_values)), "numpy")(*columns), found.times.shape
        )
        for term in sp.Add.make_args(value.expand())
    ]
    return np.sum(terms, axis=0), np.sum(np.abs(terms), axis=0)


def stretches(found: Trajectory) -> list[tuple[int, int]]:
    """First and last number of the samples between events, as far as no contact is at rest."""
    jumps = (np.flatnonzero(found.times[1:] == found.times[:-1]) + 1).tolist()
    if not found.transitions:
        return [(0, len(found.times))]
    opens = {"impact": True, "release": True, "rest": False}
    is_open = [found.transitions[0].kind == "impact", *(opens[each.kind] for each in found.transitions)]
    parts = list(pairwise([0, *jumps, len(found.times)]))
    assert len(parts) == len(is_open)
    return [part for part, flies in zip(parts, is_open, strict=True) if flies]


@pytest.mark.one_in(6)
@pytest.mark.parametrize("name", scene_ids())
def test_integrals_are_constant(name: str) -> None:
    scene = load_scene(name)
    found = simulate(nearby(problem_of(scene, SECONDS, 41), name), get_method("dop853"), tolerance=TOLERANCE)
    assert found.outcome.status in ("ok", "event")
    system = System(scene)
    for value in integrals(system):
        values, size = along(system, value, found)
        for first, last in stretches(found):
            part = values[first:last]
            assert np.abs(part - part[0]).max() < CONSTANT * (1 + size.max()), value


@pytest.mark.parametrize("name", ["conical-pendulum", "spherical-pendulum", "heavy-top", "bead-on-free-hoop"])
def test_steady_motions_stay(name: str) -> None:
    """What does not turn rests, as long as the disturbance of rounding is small."""
    scene = load_scene(name)
    system = System(scene)
    motions = steady_motions(system)
    assert motions
    for motion in motions:
        values, rates = zip(*(motion.initial[q] for q in system.free), strict=True)
        problem = replace(problem_of(scene, SECONDS, 41), values=values, rates=rates)
        found = simulate(problem, get_method("dop853"), tolerance=TOLERANCE)
        resting = system.free.index(motion.coordinate)
        assert np.ptp(found.values[:, resting]) < CONSTANT
        assert np.ptp(found.rates[:, system.free.index(motion.turning)]) < CONSTANT * (1 + abs(motion.number))
