"""Several carts at rest together: which of them go on to be held is known in closed form, or by SciPy and trial."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import numpy as np
import pytest
from tests.simulation.carts import Cart, Train, UndecidedError, drawn
from tests.simulation.scenes import scene

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

METHODS = ("dop853", "taylor", "dormand-prince-54", "rk4", "radau-5", "gauss-4")
FIRST_ORDER = 5e-3  # of time steps
TRUE = 3e-10  # SciPy is right to about as much


def motion(train: Train, method: str, t_end: float = 3.0, tolerance: float = 1e-8) -> Trajectory:
    return simulate(problem_of(train.scene, t_end, 41), get_method(method), tolerance=tolerance)


def in_two_parts(train: Train, random: Random) -> Scene:
    """The scene with one of the carts made of two, one metre apart, each with its part of mass and friction."""
    document, k = write_scene(train.scene), random.randrange(len(train.carts))
    cart, name, share = train.carts[k], f"x{k}", random.choice([0.3, 0.5, 0.9])
    (body,) = (each for each in document["bodies"] if each["name"] == f"b{name}")
    body["mass"] = repr(share * cart.mass)
    document["bodies"].append(
        body | {"name": "part", "mass": repr(cart.mass - share * cart.mass), "position": ["y", "0"]}
    )
    document["coordinates"].append({"name": "y", "value": cart.x + 1.0, "rate": cart.v})
    document["constraints"] = [{"kind": "equation", "name": "rod", "equation": f"y - {name} = 1"}]
    for load in [each for each in document["loads"] if each.get("coordinate") == name]:
        load["force"] = repr(share * cart.friction)
        document["loads"].append(
            load | {"name": "other", "coordinate": "y", "force": repr(cart.friction - share * cart.friction)}
        )
    return read_scene(document)


def is_covered(found: Trajectory, train: Train) -> bool:
    """By its estimate; to first order where a machine's rounding leaves undecided in which order rows let go."""
    assert found.estimate is not None
    try:
        known = train.along(found.times)
    except UndecidedError:
        return bool(np.abs(train.stepped(found.times, 4000) - found.values).max() < FIRST_ORDER)
    return bool((np.abs(known - found.values).max(axis=1) <= found.estimate.errors + TRUE).all())


@pytest.mark.parametrize("method", METHODS)
def test_what_sticks_is_let_go_by_an_impact(method: str) -> None:
    """m₀ with v meets m₁ at rest on dry ground; behind it both slow down by F/(m₀ + m₁)."""
    train = Train([Cart(1.0, 0.5, 2.0), Cart(3.0, 1.5, friction=0.8)], [(0, 1)])
    found = motion(train, method)
    behind = np.maximum(found.times - 0.5, 0.0)
    slowed = np.minimum(behind, 0.5 / 0.2)
    expected = 1.5 + 0.5 * slowed - 0.1 * slowed**2
    assert found.outcome.status == "ok"
    assert np.abs(found.values[:, 1] - expected).max() < 1e-9


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("friction", [0.0, 0.6], ids=["the first sticks", "both stick"])
def test_carts_that_touch_begin_to_slip_together(method: str, friction: float) -> None:
    """What pushes the first is A sin ωt ≈ the sum of both frictions at the start; each alone is held by less."""
    carts = [Cart(2.0, 0.5, amplitude=3.0, omega=0.5, friction=0.9), Cart(1.0, 0.5, friction=friction)]
    train = Train(carts, [(0, 1)])
    found = motion(train, method, 1.5)
    begin = 2.0 * np.arcsin((0.9 + friction) / 3.0)
    later = np.maximum(found.times, begin)
    pushed = 6.0 * np.cos(0.5 * begin) * (later - begin) - 12.0 * (np.sin(0.5 * later) - np.sin(0.5 * begin))
    expected = 0.5 + (pushed - 0.5 * (0.9 + friction) * (later - begin) ** 2) / 3.0
    assert found.outcome.status == "ok"
    assert np.abs(found.values - expected[:, None]).max() < 1e-9
    assert [each.kind for each in found.transitions] == ["slip"]
    assert found.transitions[0].time == pytest.approx(begin, abs=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_what_is_undetermined_does_not_stop_a_motion(method: str) -> None:
    """Four carts in a row touch each other and stick, one at the wall: eight rows hold four coordinates."""
    carts = [
        Cart(2.7, 0.5, spring=20.0, amplitude=1.6, omega=2.0, friction=1.75),
        Cart(2.2, 0.5, force=-0.1, amplitude=2.8, omega=3.0, friction=1.64),
        Cart(1.9, 0.5, friction=1.31),
        Cart(0.4, 0.5, force=-2.4, friction=0.78),
    ]
    train = Train(carts, [(-1, 0), (0, 1), (1, 2), (2, 3)])
    found = motion(train, method)
    assert found.outcome.status == "ok"
    assert np.abs(found.values - train.stepped(found.times, 3000)).max() < 2e-3


@pytest.mark.parametrize("method", METHODS)
def test_a_block_rubs_on_a_board(method: str) -> None:
    """Both move in the end: friction acts on how far one has slipped on the other, and one sticks to the other then.

    The block with v comes to the board's rate after t = v/(F/m + F/M); momentum is kept.
    """
    between = {"kind": "friction", "name": "between", "coordinate": "z - x", "force": "1.2"}
    blocks = scene(
        {"x": (0.0, 0.0), "z": (0.5, 2.0)}, {}, {"board": ("3", ["x", "0"]), "block": ("1", ["z", "0"])}, [between]
    )
    found = simulate(problem_of(blocks, 3.0, 41), get_method(method), tolerance=1e-8)
    together = 2.0 / (1.2 + 0.4)
    slipped = np.minimum(found.times, together)
    behind = 0.5 * (found.times - slipped)
    expected = np.array([0.2 * slipped**2 + behind, 0.5 + 2.0 * slipped - 0.6 * slipped**2 + behind]).T
    assert found.outcome.status == "ok"
    assert np.abs(found.values - expected).max() < 1e-9
    assert [(each.kind, each.name) for each in found.transitions] == [("stick", "between")]


@pytest.mark.parametrize("method", METHODS)
def test_a_row_of_carts_is_caught_at_once(method: str) -> None:
    """Momentum is kept: all go on with m₀ v/Σm. One pair after the other it takes more than a thousand impacts."""
    masses = (1.0, 3.0, 0.5, 4.0, 2.0, 0.2, 3.0, 1.3)
    carts = [Cart(mass, 1.0 if k else 0.2, 0.0 if k else 1.6) for k, mass in enumerate(masses)]
    found = motion(Train(carts, [(k, k + 1) for k in range(len(masses) - 1)]), method)
    assert found.outcome.status == "ok"
    behind = np.maximum(found.times - 0.5, 0.0) * 1.6 * masses[0] / sum(masses)
    assert np.abs(found.values[:, 1:] - 1.0 - behind[:, None]).max() < 1e-12
    assert np.abs(found.values[:, 0] - np.minimum(0.2 + 1.6 * found.times, 1.0) - behind).max() < 1e-12


@pytest.mark.parametrize("seed", range(24))
def test_random_carts(seed: int) -> None:
    train, method = drawn(Random(f"carts {seed}")), METHODS[seed % len(METHODS)]
    found = motion(train, method, 4.0)
    assert found.outcome.status == "ok"
    assert is_covered(found, train)


@pytest.mark.parametrize("seed", [0, 5, 9, 14, 21, 30])
def test_a_cart_in_two_parts_that_a_rod_links_moves_as_one(seed: int) -> None:
    """Both parts rub: a constraint and one friction hold what the other friction would hold, too."""
    train, found = linked(seed)
    assert is_covered(replace(found, values=found.values[:, :-1]), train)


def test_more_holds_parts_that_a_rod_links_than_is_determined() -> None:
    train, found = linked(7)
    assert np.abs(found.values[:, :-1] - train.stepped(found.times, 4000)).max() < FIRST_ORDER


def linked(seed: int) -> tuple[Train, Trajectory]:
    random = Random(f"parts {seed}")
    train, method = drawn(random), random.choice([each for each in METHODS if each != "taylor"])
    found = simulate(problem_of(in_two_parts(train, random), 4.0, 41), get_method(method), tolerance=1e-8)
    assert found.outcome.status == "ok"
    return train, found
