"""All solutions of systems of equations, against systems that were made of their solutions."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from itertools import product

import pytest
import sympy as sp

from deltaq.derivation.enclosure import Budget, enclosed
from deltaq.derivation.solving import Domain, Solutions, Solver
from deltaq.language import canonical
from deltaq.language.names import Names
from deltaq.language.symbols import Symbols

X, Y, Z = sp.symbols("x y z", real=True)


def solved(
    equations: list[sp.Expr],
    unknowns: list[sp.Symbol],
    operations: int = 600_000,
    *,
    angles: bool = False,
    is_zero: Callable[[sp.Expr], bool] = lambda e: sp.simplify(e) == 0,
) -> Solutions:
    domain = Domain(
        dict.fromkeys(unknowns, (-10.0, 10.0)),
        frozenset(unknowns if angles else ()),
        dict.fromkeys(unknowns, sp.Rational(1, 3)),
    )
    return Solver(domain, is_zero, Budget(operations)).solve(equations, unknowns)


def canonical_zero(e: sp.Expr) -> bool:
    return canonical.is_zero(e, Symbols(Names(()))) is True


def places(found: Solutions, unknowns: list[sp.Symbol]) -> list[tuple[float, ...]]:
    return sorted(tuple(round(each.values[q], 7) + 0.0 for q in unknowns) for each in found.found)


@pytest.mark.parametrize("seed", range(8))
def test_every_crossing_of_two_mixed_curves_is_found(seed: int) -> None:
    """A (p(x), q(y)) = 0 with an invertible A has the zeros of p times those of q; what never vanishes adds none."""
    draw = random.Random(seed)
    zeros = [sorted({sp.Rational(draw.randint(-80, 80), 10) for _ in range(3)}) for _ in range(2)]
    p, q = (sp.prod(u - zero for zero in own) for u, own in zip((X, Y), zeros, strict=True))
    p *= sp.exp(draw.randint(-2, 2) * X / 10)
    found = solved([p + 2 * q, q - p / 3], [X, Y])
    assert found.complete
    assert places(found, [X, Y]) == sorted((float(x), float(y)) for x, y in product(*zeros))


@pytest.mark.parametrize("seed", range(6))
def test_every_zero_of_coupled_waves_is_found(seed: int) -> None:
    """sin(x − a) and sin(y − b), mixed: four zeros in a turn of each."""
    draw = random.Random(seed)
    a, b = (sp.Rational(draw.randint(-31, 31), 10) for _ in range(2))
    found = solved(
        [sp.sin(X - a) + sp.sin(Y - b) / 2, sp.sin(Y - b) - sp.sin(X - a) * sp.Rational(2, 3)], [X, Y], angles=True
    )
    assert found.complete
    expected = {(a + i * sp.pi, b + k * sp.pi) for i in range(2) for k in range(2)}
    assert len(found.found) == 4
    for x, y in expected:
        gaps = [
            max(abs(math.remainder(each.values[q] - float(v), 2 * math.pi)) for q, v in ((X, x), (Y, y)))
            for each in found.found
        ]
        assert min(gaps) < 1e-9


@pytest.mark.parametrize(
    ("equations", "free"),
    [
        pytest.param([X + Y - 1, 2 * X + 2 * Y - 2, Z], 1, id="a line"),
        pytest.param([(X**2 + Y**2 + Z**2 - 4) * q for q in (X, Y, Z)], 2, id="a sphere"),
        pytest.param([X * Y, X * Z, X * sp.exp(X)], 2, id="a plane"),
    ],
)
def test_a_family_is_told_once_with_its_free_unknowns(equations: list[sp.Expr], free: int) -> None:
    found = solved(equations, [X, Y, Z])
    assert max(len(each.free) for each in found.found) == free
    assert sum(1 for each in found.found if each.free) == 1


CROSSING = {
    "two lines": ([X * Y], [X, Y]),
    "a rhombus of four bars": ([sp.cos(X) + sp.cos(Y) - sp.cos(Z) - 1, sp.sin(X) + sp.sin(Y) - sp.sin(Z)], [X, Y, Z]),
    "a figure of eight": ([(X**2 + Y**2) ** 2 - X**2 + Y**2], [X, Y]),
    "a cubic with a double point": ([Y**2 - X**2 * (X + 1)], [X, Y]),
}


@pytest.mark.parametrize("start", ["0", "1/3", "0.7"])
@pytest.mark.parametrize("named", CROSSING)
def test_where_branches_of_a_family_cross_is_not_all_of_it(named: str, start: str) -> None:
    """Nothing may be chosen there; a root that stands for the family is elsewhere."""
    equations, unknowns = CROSSING[named]
    angles = frozenset(unknowns if "bars" in named else ())
    domain = Domain(dict.fromkeys(unknowns, (-10.0, 10.0)), angles, dict.fromkeys(unknowns, sp.Rational(start)))
    found = Solver(domain, lambda e: sp.simplify(e) == 0, Budget(600_000)).solve(equations, unknowns)
    assert any(each.free for each in found.found)


def test_a_point_that_fewer_equations_have_is_not_told_as_all() -> None:
    """x² + y² = 0 has one: whether a family is elsewhere is not known."""
    found = solved([X**2 + Y**2 + X**4], [X, Y])
    assert not found.complete
    assert [each.free for each in found.found] == [()]


def test_the_middle_of_a_sphere_is_no_part_of_it() -> None:
    found = solved([(X**2 + Y**2 - 4) * q for q in (X, Y)], [X, Y])
    assert sorted(len(each.free) for each in found.found) == [0, 1]


def test_a_spent_budget_is_told() -> None:
    hard = [sp.sin(7 * X * Y) + Y / 9 - X / 11, sp.cos(5 * X + Y * X) - Y / 10]
    assert not solved(hard, [X, Y], 20_000).complete


def test_poles_and_ends_of_domains_hide_nothing() -> None:
    assert places(solved([1 / (X - 1) - 2 / (X - 1) ** 2 * sp.exp(X - 3)], [X]), [X]) == [(1.4063757,), (3.0,)]
    found = solved([sp.sqrt(4 - X**2) - sp.exp(X)], [X])
    assert found.complete
    assert len(found.found) == 2


def test_a_root_on_a_common_face_is_proved_once() -> None:
    cut = -1 + 0.4871 * 2
    found = enclosed([sp.sin(X - sp.Rational(cut)) + (X - sp.Rational(cut)) ** 3], [X], ((-1.0, 1.0),), Budget(10**5))
    assert found.complete
    assert [root[0] for root in found.roots] == pytest.approx([cut])


@pytest.mark.parametrize(
    "gap",
    [
        pytest.param(sp.sin(Y) ** 2 + sp.cos(Y) ** 2 - X, id="zero by an identity"),
        pytest.param((Y + Z) ** 2 - X * (Y**2 + 2 * Y * Z + Z**2), id="zero when expanded"),
    ],
)
def test_a_branch_on_which_an_equation_divides_by_zero_has_no_solutions(gap: sp.Expr) -> None:
    """With X = 1 the ends of a spring meet, whatever Y and Z are; with X = −1 they do not."""
    found = solved([X**2 - 1, Z + Y**2 + Y / sp.sqrt(gap)], [X, Y, Z], is_zero=canonical_zero)
    assert {each.values[X] for each in found.found} == {-1.0}
