"""Factors by FLINT against SymPy's, and where SymPy's search does not end."""

from __future__ import annotations

import random
import re
import resource
from collections.abc import Iterator
from pathlib import Path

import pytest
import sympy as sp

from deltaq.derivation.engine import derive
from deltaq.derivation.factoring import factor_list
from deltaq.mechanics.document import read_scene

LETTERS = sp.symbols("a b c x y", positive=True)
x, y = LETTERS[3:]


def drawn(source: random.Random) -> sp.Expr:
    """A product of up to three small factors, multiplied out; some letters stand in a function."""
    things = [*LETTERS, sp.sin(x), sp.exp(y / LETTERS[0]), sp.sqrt(x**2 + 1)]

    def term() -> sp.Expr:
        chosen = source.choices(things, k=source.randint(0, 2))
        return sp.Rational(source.randint(-6, 6), source.randint(1, 3)) * sp.Mul(*chosen)

    factors = [sp.Add(*(term() for _ in range(source.randint(1, 3)))) for _ in range(source.randint(1, 3))]
    return sp.expand(sp.Mul(*factors)) + 12 * LETTERS[0]


@pytest.mark.parametrize("seed", range(40))
def test_the_same_factors_as_sympy(seed: int) -> None:
    expression = drawn(random.Random(seed))
    (number, found), (known, expected) = factor_list(expression), sp.factor_list(expression)
    assert (number, set(found)) == (known, set(expected))


@pytest.mark.parametrize(
    ("expression", "number", "factors"),
    [
        pytest.param(sp.Integer(-5), -5, [], id="a number"),
        pytest.param(sp.sqrt(2) * x**2 - x, 1, [(x, 1), (sp.sqrt(2) * x - 1, 1)], id="roots of numbers"),
        pytest.param(sp.expand((x - y) ** 2 * (x + 1)), 1, [(x + 1, 1), (x - y, 2)], id="a square"),
        pytest.param(3 * sp.sqrt(x) * (x * y - x), 3, [(x, sp.Rational(3, 2)), (y - 1, 1)], id="a product with a root"),
    ],
)
def test_known_ones(expression: sp.Expr, number: int, factors: list[tuple[sp.Expr, int]]) -> None:
    known, found = factor_list(expression)
    assert (known, set(found)) == (number, set(factors))


@pytest.fixture
def limited() -> Iterator[None]:
    """A gigabyte more than there is now, and what takes longer than seconds fails by it."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    used = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + 2**30, hard))
    yield
    resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def test_a_quotient_is_no_polynomial() -> None:
    with pytest.raises(sp.PolynomialError, match=f"^{re.escape('a quotient: x/y + 1')}$"):
        factor_list(1 + x / y)


def test_many_letters() -> None:
    """The force of two Morse potentials and a softened pole: SymPy looks for its factors for minutes."""
    a, b, c, d, k, m, s = sp.symbols("a b c d k m s", positive=True)
    morse = [k * (1 - sp.exp(-x / s)) ** 2, m * (1 - sp.exp(-x / d)) ** 2]
    force = sp.diff(-a / sp.sqrt(x**2 + b**2) + c * sp.Add(*morse), x)
    upper = sp.numer(sp.together(force))
    number, factors = factor_list(upper)
    assert sp.expand(number * sp.Mul(*(factor**power for factor, power in factors)) - upper) == 0


def test_powers_of_a_million_are_left_as_they_are(limited: None) -> None:
    """As of exp(−v/v₀) with a small v₀: their factors are more than any memory holds."""
    for steep in (x**1_000_000 * y - x**1_000_000 - y + 1, sp.exp(x / sp.Rational(3, 10**7)) - y):
        number, found = factor_list(steep * (x + 1))
        assert (number, set(found)) == (1, {(steep, 1), (x + 1, 1)})


def test_a_small_speed_in_a_friction_is_derived(limited: None) -> None:
    """Sliding friction that falls over a small speed: displayed, searched for equilibria, verified."""
    scene = read_scene(
        {
            "format": 1, "id": "falling", "title": "falling", "dimension": 2,
            "coordinates": [{"name": "x"}],
            "parameters": [{"name": "m", "value": 1.0}, {"name": "v_s", "value": 0.30000001}],
            "bodies": [{"name": "p", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
            "loads": [
                {"kind": "friction", "name": "belt", "coordinate": "x", "force": "m*(1 + exp(-abs(dot(x))/v_s))"},
                {"kind": "potential", "name": "spring", "energy": "(1 - exp(-x/0.000003))^2 + x^2"},
            ],
        }
    )  # fmt: skip
    _, found = derive(scene)
    assert all(step.verified for chapter in found.chapters for step in chapter.steps)
