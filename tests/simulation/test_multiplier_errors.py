"""The errors told of multipliers, against motions in extended precision."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.simulation.bound_kinds import KINDS, SKATE, TURNED
from tests.simulation.bound_motions import Kind
from tests.simulation.multiplier_errors import Compared, compared
from tests.simulation.test_impacts_with_constraints import G, dumbbell, hung, moved

from deltaq.mechanics.library import load_scene
from deltaq.simulation.consistency import consistent
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

OTHERS = [kind for kind in KINDS if kind not in (SKATE, TURNED)]


def judged(kind: Kind) -> list[Compared]:
    return list(compared(kind, "test", 5, samples=41))


@pytest.mark.parametrize("kind", [SKATE, TURNED], ids=lambda kind: kind.name)
def test_errors_of_multipliers_are_what_is_told(kind: Kind) -> None:
    """A skate's force may be far smaller than what it is a difference of, and the bead begins at y = 0."""
    found = judged(kind)
    assert len(found) >= 4
    assert [each for each in found if not each.is_within] == []


@pytest.mark.one_in(4)
@pytest.mark.parametrize("kind", OTHERS, ids=lambda kind: kind.name)
def test_so_are_those_of_other_kinds(kind: Kind) -> None:
    """How many of all kinds lie within a factor of 100 the command tells; of a few motions of each none is far off."""
    found = judged(kind)
    assert found
    assert [each for each in found if each.short > 10.0 or each.excess > 100.0] == []


@pytest.mark.parametrize("scale", [0.97, 1.0, 1.02, 1.05])
def test_errors_that_turn_from_one_step_to_the_next_are_told(scale: float) -> None:
    """Both runs of a pair may err by about the same; truth is a far finer run by another method."""
    given = problem_of(load_scene("four-bar"), 10.0, 251)
    problem = consistent(replace(given, rates=tuple(scale * rate for rate in given.rates)))
    found = simulate(problem, get_method("gauss-4"), tolerance=1e-3)
    true = simulate(problem, get_method("dop853"), tolerance=1e-10)
    assert found.estimate is not None
    assert found.estimate.multipliers is not None
    assert found.reactions is not None
    assert true.reactions is not None
    assert (np.abs(found.values - true.values).max(axis=1) <= found.estimate.errors + 1e-10).all()
    wrong = np.abs(found.reactions.multipliers - true.reactions.multipliers)
    assert (wrong <= found.estimate.multipliers + 1e-10 * np.abs(true.reactions.multipliers).max()).all()


def test_errors_are_told_in_every_mode() -> None:
    """A block that slips, then sticks on its string, and a rod that falls freely, then turns: λ is known in each."""
    stuck = moved(hung(0.8), 2.0, samples=81)
    times, force, told = (
        np.array(column) for column in (stuck["t"], stuck["multipliers"]["S"], stuck["error"]["multipliers"]["S"])
    )
    stop = 0.5 * 3.0 / (0.6 * G)
    behind = np.arange(len(times)) > np.searchsorted(times, stop * (1.0 - 1e-9))
    wrong = np.abs(np.abs(force) - np.where(behind, G, G + 0.2 * G))
    assert told.shape == times.shape
    assert (wrong <= told).all()
    assert (told < 1e-11).all()
    fallen = moved(dumbbell(0.6, 0.5, 2.0), 2e-3, samples=5)
    spin = np.array(fallen["rates"]["x2"]) - np.array(fallen["rates"]["x1"])
    spin = np.hypot(spin, np.array(fallen["rates"]["y2"]) - np.array(fallen["rates"]["y1"]))
    wrong = np.abs(np.abs(fallen["multipliers"]["S"]) - 0.75 * spin**2)  # m/2 for either end, about the middle
    assert spin.max() > 1.0
    assert (wrong <= np.array(fallen["error"]["multipliers"]["S"]) + 1e-12).all()
