"""sin² + cos² = 1 in kinetic energies."""

from __future__ import annotations

import random

import pytest
import symengine as se

from deltaq.mechanics.library import load_scene
from deltaq.model.operations import operations
from deltaq.model.trigonometry import MOST_TERMS, shortened

a, b, m, n, u, v = se.symbols("a b m n u v")
sin, cos = se.sin, se.cos


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        pytest.param(sin(a) ** 2 + cos(a) ** 2, 1, id="one pair"),
        pytest.param(m * u * (sin(a) ** 2 + cos(a) ** 2) + v, m * u + v, id="with a factor"),
        pytest.param((u * sin(a)) ** 2 + (u * cos(a) + v) ** 2, u**2 + 2 * u * v * cos(a) + v**2, id="a square"),
        pytest.param(
            (cos(a) * cos(b) * u - sin(a) * sin(b) * v) ** 2
            + (cos(a) * sin(b) * u + sin(a) * cos(b) * v) ** 2
            + sin(a) ** 2 * u**2,
            u**2 + sin(a) ** 2 * v**2,
            id="a point on a sphere: one angle's pairs make the other's",
        ),
        pytest.param((m + n) * sin(a) ** 2 + m * cos(a) ** 2, m + n * sin(a) ** 2, id="a lone square keeps its sine"),
        pytest.param(2 * sin(a) ** 2 + cos(a) ** 2, 2 * sin(a) ** 2 + cos(a) ** 2, id="numbers that differ"),
        pytest.param(sin(a) ** 2 + cos(b) ** 2, sin(a) ** 2 + cos(b) ** 2, id="angles that differ"),
        pytest.param(m * (u + v) ** 2, m * (u + v) ** 2, id="nothing to find: not even expanded"),
        pytest.param(m * sin(a) ** 2, m * sin(a) ** 2, id="a single term"),
        pytest.param(se.Integer(0), 0, id="zero"),
        pytest.param(
            sin(a) ** 4 + sin(a) ** 2 * cos(a) ** 2, sin(a) ** 4 + sin(a) ** 2 * cos(a) ** 2, id="a fourth power"
        ),
    ],
)
def test_pairs_go_and_nothing_else(given: se.Expr, expected: se.Expr) -> None:
    assert shortened(given) == expected


def test_what_is_too_large_to_look_through_is_left_alone() -> None:
    long = sum(se.symbols("x0:80")) ** 2 * (sin(a) ** 2 + cos(a) ** 2)
    assert MOST_TERMS < 80 * 81
    assert shortened(long) is long


@pytest.mark.parametrize("seed", range(20))
def test_the_value_stays(seed: int) -> None:
    """Squares of sums of products at random, as velocities are."""
    chance = random.Random(seed)
    factors = [sin(a), cos(a), sin(b), cos(b), u, v, m]
    squares = [
        sum((chance.choice((-1, 1)) * se.Mul(*chance.sample(factors, 3)) for _ in range(3)), se.Integer(0)) ** 2
        for _ in range(4)
    ]
    given = sum(squares, se.Integer(0))
    values = {symbol: chance.uniform(-2.0, 2.0) for symbol in (a, b, m, n, u, v)}
    assert float(shortened(given).subs(values)) == pytest.approx(float(given.subs(values)), rel=1e-12)


@pytest.mark.parametrize(
    ("scene", "most"), [("pendulum", 8), ("double-pendulum", 70), ("spherical-pendulum", 30), ("heavy-top", 70)]
)
def test_scenes_need_few_operations(scene: str, most: int) -> None:
    assert operations(load_scene(scene)).total - operations(load_scene(scene)).solving <= most
