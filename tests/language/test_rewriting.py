"""Trees written out and read back, and names exchanged for other expressions."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
import sympy as sp

from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.rewriting import Exchange, Shift, exchanged, expression_of, written
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.language.tree import Call, Name, Negation, Node, Number, Power, Product, Quotient, Sum

NAMES = Names(
    (Symbol("x", "coordinate"), Symbol("y", "coordinate"), Symbol("a", "parameter"), Symbol("b", "parameter"))
)
SYMBOLS = Symbols(NAMES)


def value(tree: Node) -> sp.Expr:
    return to_sympy(tree, SYMBOLS)


def tree(source: random.Random, depth: int) -> Node:
    """A random tree of operations."""
    if depth == 0:
        return source.choice((Name("x"), Name("a"), Number(Fraction(2)), Number(Fraction(3, 2)), Number(Fraction(5))))

    def below() -> Node:
        return tree(source, depth - source.randint(1, depth))

    made = (
        lambda: Sum((below(), Negation(below()), below())),
        lambda: Product((below(), below())),
        lambda: Quotient(below(), Sum((Power(below(), Number(Fraction(2))), Number(Fraction(1))))),
        lambda: Power(below(), Number(Fraction(source.choice((2, 3))))),
        lambda: Negation(below()),
        lambda: Call(source.choice(("sin", "cos")), (below(),)),
    )
    return source.choice(made)()


@pytest.mark.parametrize("seed", range(120))
def test_what_is_written_is_read_back_as_the_same(seed: int) -> None:
    given = tree(random.Random(seed), 4)
    again = parse(written(given), NAMES, "plain").tree
    point = {symbol: sp.Rational(random.Random(seed).randint(3, 17), 7) for symbol in value(given).free_symbols}
    assert abs(sp.N(value(given).subs(point) - value(again).subs(point), 20)) < 1e-12, written(given)


@pytest.mark.parametrize(
    ("shift", "source", "after"),
    [
        (Shift("x", -1), "a*sin(x) + dot(x)", "-a*sin(x) - dot(x)"),
        (Shift("x", 1, 1), "sin(x)*dot(x)", "cos(x)*dot(x)"),
        (Shift("x", -1, 1), "cos(x)*ddot(x)", "-sin(x)*ddot(x)"),
        (Shift("x", 1, 2), "a*cos(x)", "-a*cos(x)"),
        (Shift("x", 1, 3), "sin(x) + cos(x)", "-cos(x) + sin(x)"),
        (Shift("x", 1, 0, Name("b")), "x^2 + y", "(x + b)^2 + y"),
        (Shift("x", -1, 0, Name("b")), "x^2*dot(x)", "-(b - x)^2*dot(x)"),
        (Shift("x", -1, 1), "delta(x) + d(x)", "-delta(x) - d(x)"),
    ],
)
def test_a_coordinate_counted_otherwise(shift: Shift, source: str, after: str) -> None:
    found = exchanged(parse(source, NAMES, "plain"), Exchange({"x": shift}))
    difference = value(found.tree) - value(parse(after, NAMES, "plain").tree)
    assert sp.simplify(difference) == 0, found.source


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("shift", [Shift("x", sign, quarters) for sign in (1, -1) for quarters in range(4)])
def test_an_exchange_is_a_substitution(shift: Shift, seed: int) -> None:
    """SymPy puts the same in."""
    given = tree(random.Random(seed), 3)
    found = value(exchanged(expression_of(given), Exchange({"x": shift})).tree)
    x = value(Name("x"))
    wanted = value(given).subs(x, shift.sign * x + shift.quarters * sp.pi / 2)
    point = {symbol: sp.Rational(seed + 3, 11) for symbol in found.free_symbols | wanted.free_symbols}
    assert abs(sp.N(found.subs(point) - wanted.subs(point), 20)) < 1e-12


def test_what_speaks_of_none_of_the_names_stays_as_it_was_written() -> None:
    given = parse("a* (y+ b )", NAMES, "plain")
    assert exchanged(given, Exchange({"x": Shift("x", -1)})) is given
