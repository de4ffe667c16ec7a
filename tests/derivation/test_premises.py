"""What a relation gives a value to, and which steps a step therefore rests on."""

from __future__ import annotations

import pytest
import sympy as sp

from deltaq.derivation.formula import (
    Called,
    Directional,
    Equation,
    Explicit,
    Formula,
    Gateaux,
    Named,
    Partial,
    Plus,
    Quantity,
    Rate,
    Term,
    Times,
    minus,
)
from deltaq.derivation.premises import Names, Signature, concluded, parts, premises, signature
from deltaq.derivation.step import Relation, Step

X, Y, H = (sp.Symbol(name, real=True) for name in ("x", "y", "h"))
ENERGY, WORK, MOMENTUM = (Quantity(kind) for kind in ("kinetic-energy", "work", "momentum"))
E, W, P = (Named(quantity, X) for quantity in (ENERGY, WORK, MOMENTUM))
VALUE = Explicit(X**2)
OF_E, OF_W, OF_P = (("of", quantity) for quantity in (ENERGY, WORK, MOMENTUM))


def step(name: str, *relations: Relation, sources: tuple[str, ...] = (), rests_on: tuple[str, ...] = ()) -> Step:
    return Step(name, "", relations, sources=sources, premises=rests_on)


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        (E, OF_E),
        (Called(WORK, VALUE), OF_W),
        (Rate(E), ("Rate", OF_E)),
        (Gateaux(E), ("Gateaux", OF_E)),
        (Partial(E, Y), ("Partial", OF_E, "y")),
        (Rate(Partial(E, Y)), ("Rate", ("Partial", OF_E, "y"))),
        (Plus((Term(E), minus(W))), ("Plus", (1, OF_E), (-1, OF_W))),
        (Plus((Term(E),)), None),
        (Plus((Term(E), Term(VALUE))), None),
        (Rate(VALUE), None),
        (Gateaux(VALUE), None),
        (Partial(VALUE, X), None),
        (VALUE, None),
        (Times((E, W)), None),
    ],
)
def test_what_a_formula_is_called(formula: Formula, expected: Signature | None) -> None:
    assert signature(formula) == expected


@pytest.mark.parametrize(
    ("relation", "expected"),
    [
        (Relation((P, Partial(E, X), VALUE)), (OF_P, ("Partial", OF_E, "x"))),
        (Relation((VALUE, E)), ()),
        (Relation((E, VALUE, W)), (OF_E,)),
        (Relation((Equation(Rate(P), VALUE), Equation(E, VALUE)), "⇔"), (("Rate", OF_P),)),
        (Relation((E, VALUE), "≈"), (OF_E,)),
        (Relation((E, VALUE), "≠"), ()),
        (Relation((E, VALUE), "<"), ()),
        (Relation((E, VALUE), "≤"), ()),
        (Relation((E,)), ()),
    ],
)
def test_what_a_relation_gives_a_value_to(relation: Relation, expected: tuple[Signature, ...]) -> None:
    assert concluded(relation) == expected


def test_names_that_mean_the_same_are_one_also_inside() -> None:
    names = Names()
    slope = ("Partial", OF_E, "x")
    assert names.join((OF_P, slope)) == OF_P
    assert names.join(()) is None
    assert names.one(slope) == OF_P
    assert names.one(("Rate", slope)) == ("Rate", OF_P)
    assert names.one(("Partial", slope, "y")) == ("Partial", OF_P, "y")
    assert names.one(("Plus", (1, slope), (-1, OF_W))) == ("Plus", (1, OF_P), (-1, OF_W))
    assert names.join((slope, OF_W)) == OF_P
    assert names.one(OF_W) == OF_P
    assert names.join((OF_P, OF_P)) == OF_P
    assert names.one(OF_P) == OF_P


def test_parts_are_one_level_down() -> None:
    assert list(parts(Plus((Term(Rate(E)), minus(W))))) == [Rate(E), W]
    assert list(parts(Directional(Equation(E, W), {X: Y}, H))) == [Equation(E, W)]
    assert list(parts(Times((E, VALUE)))) == [E, VALUE]
    assert list(parts(E)) == []


KNOWN: dict[Signature, str] = {OF_E: "energy", ("Rate", OF_P): "rate", OF_P: "momentum", ("body:bob",): "position"}


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        pytest.param(step("new", Relation((W, Times((E, E, P))))), ("energy", "momentum"), id="each once, in order"),
        pytest.param(step("new", Relation((W, Plus((Term(Rate(P)), Term(VALUE)))))), ("rate",), id="the outermost"),
        pytest.param(step("new", Relation((W, Rate(E)))), ("energy",), id="inside what is not known"),
        pytest.param(step("new", Relation((E, Plus((Term(P), Term(E)))))), ("momentum",), id="not what it says itself"),
        pytest.param(step("new", Relation((E, VALUE))), ("energy",), id="what is said again rests on the first time"),
        pytest.param(step("energy", Relation((W, E)), sources=("body:bob",)), ("position",), id="not on itself"),
        pytest.param(
            step("new", Relation((W, VALUE)), sources=("body:bob", "load:weight")), ("position",), id="bodies"
        ),
        pytest.param(step("position", Relation((W, VALUE)), sources=("body:bob",)), (), id="the first of a body"),
        pytest.param(
            step("new", Relation((W, P)), rests_on=("rate", "new")), ("rate", "momentum"), id="what is stated"
        ),
        pytest.param(step("new", Relation((W, P)), sources=("body:bob",)), ("momentum",), id="a name before a body"),
    ],
)
def test_a_step_rests_on_what_gave_values(asked: Step, expected: tuple[str, ...]) -> None:
    assert premises(asked, Names(), KNOWN) == expected
