"""What an expression says of itself."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from tests.language.scene_names import NAMES

from deltaq.errors import ExpressionError, Problem
from deltaq.language.expression import Expression
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.tree import (
    NOWHERE,
    Call,
    Differential,
    Equation,
    Name,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Power,
    Product,
    Quotient,
    Rate,
    Span,
    Sum,
    TimeDerivative,
    Variation,
    Vector,
    walk,
)


def parsed(text: str) -> Expression:
    return parse(text, NAMES)


@pytest.mark.parametrize(
    ("text", "names", "rates", "functions", "scalar", "derivatives"),
    [
        pytest.param("m*l*sin(phi)", {"m", "l", "phi"}, set(), {"sin"}, True, False, id="product"),
        pytest.param("dot(phi)^2 + x", {"phi", "x"}, {"phi"}, set(), True, False, id="rate"),
        pytest.param("delta(phi)", {"phi"}, set(), set(), False, False, id="variation"),
        pytest.param("d(phi)", {"phi"}, set(), set(), False, False, id="differential"),
        pytest.param("[x, y]", {"x", "y"}, set(), set(), False, False, id="vector"),
        pytest.param("x = y", {"x", "y"}, set(), set(), False, False, id="equation"),
        pytest.param("dot(x^2)", {"x"}, set(), set(), True, True, id="derivative by the time"),
        pytest.param("diff(abs(x), x)", {"x"}, set(), {"abs"}, True, True, id="partial derivative"),
    ],
)
def test_what_it_depends_on(
    text: str, names: set[str], rates: set[str], functions: set[str], *, scalar: bool, derivatives: bool
) -> None:
    found = parsed(text)
    assert (found.names, found.rates, found.functions) == (names, rates, functions)
    assert (found.is_scalar, found.has_derivatives) == (scalar, derivatives)


def test_equal_trees_are_equal_expressions() -> None:
    assert parsed("m l") == parsed("m*l")
    assert hash(parsed("m l")) == hash(parsed("m*l"))
    assert parsed("m*l") != parsed("l*m")
    assert parsed("m") != "m"


def test_too_many_names() -> None:
    symbols = tuple(Symbol(f"p{n}", "parameter") for n in range(65))
    text = "+".join(symbol.name for symbol in symbols)
    with pytest.raises(ExpressionError) as caught:
        parse(text, Names(symbols))
    assert caught.value.problems == (Problem("too-many-names", "", 0, len(text), {"count": 65, "limit": 64}),)
    assert len(parse(text.removesuffix("+p64"), Names(symbols)).names) == 64


NODES = [
    Number(Fraction(1, 2)), Name("x"), Rate("x", 1), Variation("x"), Differential("x"), Sum((Name("x"),)),
    Product((Name("x"),)), Quotient(Name("x"), Name("y")), Negation(Name("x")), Power(Name("x"), Name("y")),
    Call("sin", (Name("x"),)), TimeDerivative(Name("x")), PartialDerivative(Name("x"), Name("y")), Vector((Name("x"),)),
    Equation(Name("x"), Name("y")),
]  # fmt: skip


@pytest.mark.parametrize("node", NODES, ids=[type(node).__name__ for node in NODES])
def test_a_node_is_the_same_wherever_it_stands(node: Node) -> None:
    elsewhere = replace(node, span=Span(3, 4))
    assert node.span == NOWHERE == Span(0, 0)
    assert (elsewhere, hash(elsewhere), elsewhere.span) == (node, hash(node), Span(3, 4))
    assert list(walk(Equation(node, Name("z"))))[1:] == [*walk(node), Name("z")]


def test_nodes_of_other_kinds_or_parts_differ() -> None:
    assert len(set(NODES)) == len(NODES)
    assert Variation("x") == Variation("x", 0) != Variation("x", 1)
