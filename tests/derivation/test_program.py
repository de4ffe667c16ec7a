"""Numbers for expressions: a place that was moved says the same as one that never was."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
import sympy as sp
from flint import arb, ctx

from deltaq.derivation.points import Place, along_motion, moved, pair, shifted
from deltaq.derivation.program import number
from deltaq.derivation.verification import BITS

VALUES = {"x": arb(0.75), "dot(x)": arb(0.5), "ddot(x)": arb(-1.25), "y": arb(1.5), "t": arb(0.25)}
X, Y, V, T = sp.symbols("x y dot(x) t", real=True)
MIXED = X * sp.sin(Y) + Y**2 * sp.cos(X - Y) + sp.pi * V
EXPRESSIONS = [
    pytest.param(sp.Rational(3, 7) + sp.pi, id="a number"),
    pytest.param(X, id="a symbol"),
    pytest.param(sp.sin(Y), id="without what moves"),
    pytest.param(sp.sin(X), id="of what moves alone"),
    pytest.param(MIXED, id="of both"),
    pytest.param(MIXED**2 + sp.exp(MIXED) * sp.sqrt(Y), id="one part in several places"),
]
MOVES = [
    pytest.param(lambda place: moved(place, {"x": arb(2)}), id="another value"),
    pytest.param(lambda place: shifted(place, {"x": arb(0.125)}), id="shifted"),
    pytest.param(lambda place: along_motion(place, arb(0.5)), id="later"),
    pytest.param(lambda place: shifted(along_motion(place, arb(0.5)), {"dot(x)": arb(1)}), id="later and shifted"),
    pytest.param(lambda place: moved(moved(place, {"x": arb(2)}), {"x": arb(0.75), "y": arb(3)}), id="there and back"),
]


@pytest.fixture(autouse=True)
def _precision() -> Iterator[None]:
    with ctx.workprec(BITS):
        yield


def same(a: arb, b: arb) -> bool:
    return (a.mid(), a.rad()) == (b.mid(), b.rad())


@pytest.mark.parametrize("expression", EXPRESSIONS)
@pytest.mark.parametrize("move", MOVES)
def test_what_is_remembered_is_what_is_computed_anew(expression: sp.Expr, move: Callable[[Place], Place]) -> None:
    place = Place(VALUES)
    before = number(expression, place)
    there = move(place)
    assert same(number(expression, there), number(expression, dict(there)))
    assert same(number(expression, place), before)


@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_a_moved_place_does_not_need_its_origin_to_know(expression: sp.Expr) -> None:
    there = moved(Place(VALUES), {"x": arb(2)})
    assert same(number(expression, there), number(expression, VALUES | {"x": arb(2)}))


def test_places_beside_are_made_once_and_lie_on_both_sides() -> None:
    place = Place(VALUES)
    ahead, behind = pair(place, "x", lambda h: shifted(place, {"x": h}))
    assert pair(place, "x", lambda h: shifted(place, {"y": h})) == (ahead, behind)
    assert pair(place, "y", lambda h: shifted(place, {"y": h})) != (ahead, behind)
    assert behind["x"] < place["x"] < ahead["x"]
    assert same(ahead["y"], place["y"])
