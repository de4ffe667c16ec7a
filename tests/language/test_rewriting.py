"""Trees written out and read back, and names exchanged for other expressions."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
import sympy as sp

from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.rewriting import ZERO, Exchange, Shift, exchanged, expression_of, scaled, written
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
    assert sp.simplify(difference) == 0, found.text


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


# Text that is written as it is read, with no bracket more or less.
AS_IT_IS = [
    "a - (x - y)", "(a + b)*x", "a*(b + x)*y", "a*(b*x)", "a/(b*x)", "a/b/x", "a/(b/x)", "a*b/x", "a*(b/x)",
    "(a + b)/(x + y)", "-a", "-(a + b)", "a*(-b)", "-(-a)", "a - (-b)", "a - b*x", "a^2", "(-a)^2", "-a^2", "(a*b)^2",
    "a^(-1)", "(a^2)^3", "a^(1/2)", "(a + b)^2*x", "sin(x)", "atan2(x, y + 1)", "dot(x)", "ddot(x)", "dddot(x)",
    "ddddot(x)", "delta(x)", "diff(delta(x), t)", "diff(diff(delta(x), t), t)", "d(x)", "d(t)", "diff(x*y, t)",
    "diff(a*x, x)", "diff(x^2, dot(x))", "[x, a*y]", "x = a + b", "[x = a, y = b]",
]  # fmt: skip


@pytest.mark.parametrize("text", AS_IT_IS)
def test_a_text_is_written_with_the_brackets_it_needs(text: str) -> None:
    tree = parse(text, NAMES).tree
    assert written(tree) == text
    assert expression_of(tree).text == text


X, Y, A, B = (Name(name) for name in "xyab")
HALF, MINUS_THREE = Number(Fraction(1, 2)), Number(Fraction(-3))


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (HALF, "1/2"),
        (Number(Fraction(-1, 2)), "-1/2"),
        (MINUS_THREE, "-3"),
        (ZERO, "0"),
        (Product((HALF, X)), "1/2*x"),
        (Product((X, HALF)), "x*(1/2)"),
        (Product((MINUS_THREE, X)), "(-3)*x"),
        (Product((X, MINUS_THREE)), "x*(-3)"),
        (Product((Negation(A), B)), "(-a)*b"),
        (Power(MINUS_THREE, Number(Fraction(2))), "(-3)^2"),
        (Power(HALF, HALF), "(1/2)^(1/2)"),
        (Sum((A, MINUS_THREE)), "a - 3"),
        (Sum((MINUS_THREE, Negation(A), B)), "-3 - a + b"),
        (Quotient(MINUS_THREE, MINUS_THREE), "(-3)/(-3)"),
        (Quotient(HALF, Number(Fraction(3, 2))), "1/2/(3/2)"),
    ],
    ids=str,
)
def test_numbers_stand_in_brackets_where_their_sign_or_line_would_reach_further(node: Node, text: str) -> None:
    assert written(node) == text


TURNED, FROM_B = Shift("x", -1), Shift("x", 1, 0, B)
EXCHANGED = [
    # counted in the other sense
    (TURNED, "a*sin(x) + dot(x)", "a*(-sin(x)) - dot(x)"),
    (TURNED, "ddot(x) + delta(x) + d(x) + delta(dot(x))", "-ddot(x) - delta(x) - d(x) - diff(delta(x), t)"),
    (TURNED, "dot(y)*sin(y) + x + cos(x)", "dot(y)*sin(y) - x + cos(x)"),
    (TURNED, "-x", "x"),
    (TURNED, "[x, y] = [diff(x*y, t), y]", "[-x, y] = [diff((-x)*y, t), y]"),
    (TURNED, "diff(x*y, x)", "-diff((-x)*y, x)"),
    (TURNED, "diff(dot(x)^2, dot(x))", "-diff((-dot(x))^2, dot(x))"),
    (TURNED, "diff(x*y, y)", "diff((-x)*y, y)"),
    # from elsewhere
    (FROM_B, "x*sin(x) + dot(x)", "(x + b)*sin(x + b) + dot(x)"),
    (FROM_B, "diff(x^2, x)", "diff((x + b)^2, x)"),
    (Shift("x", -1, 0, B), "x", "-x + b"),
    (Shift("x", -1, 0, B), "diff(x^2, x)", "-diff((-x + b)^2, x)"),
    (Shift("x", -1, 1, B), "sin(x)", "sin(-x + 1/2*pi + b)"),
    # by quarter turns, which sines and cosines of x alone take up
    (Shift("x", 1, 1), "x", "x + 1/2*pi"),
    (Shift("x", 1, 2), "x", "x + pi"),
    (Shift("x", -1, 1), "x", "-x + 1/2*pi"),
    (Shift("x", 1, 0), "sin(x) + cos(x)", "sin(x) + cos(x)"),
    (Shift("x", 1, 1), "sin(x) + cos(x)", "cos(x) - sin(x)"),
    (Shift("x", 1, 2), "sin(x) + cos(x)", "-sin(x) - cos(x)"),
    (Shift("x", 1, 3), "sin(x) + cos(x)", "-cos(x) + sin(x)"),
    (Shift("x", -1, 0), "sin(x) + cos(x)", "-sin(x) + cos(x)"),
    (Shift("x", -1, 1), "sin(x) + cos(x)", "cos(x) + sin(x)"),
    (Shift("x", -1, 2), "sin(x) + cos(x)", "sin(x) - cos(x)"),
    (Shift("x", -1, 3), "sin(x) + cos(x)", "-cos(x) - sin(x)"),
    (Shift("x", 1, 1), "tan(x) + sin(2*x)", "tan(x + 1/2*pi) + sin(2*(x + 1/2*pi))"),
]  # fmt: skip


@pytest.mark.parametrize(("shift", "text", "after"), EXCHANGED)
def test_how_a_coordinate_counted_otherwise_is_written(shift: Shift, text: str, after: str) -> None:
    given = parse(text, NAMES)
    found = exchanged(given, Exchange({"x": shift}))
    assert found.text == after
    if given.is_scalar and not (given.has_derivatives or given.rates):
        x = value(Name("x"))
        assert sp.simplify(value(found.tree) - value(given.tree).subs(x, value(shift.node))) == 0


@pytest.mark.parametrize("shift", [TURNED, FROM_B, Shift("x", -1, 1, B)], ids=["turned", "from b", "both"])
def test_a_slope_is_that_of_the_sound_formula(shift: Shift) -> None:
    """What is derived by a coordinate is so before the other is put in its place."""
    found = exchanged(parse("diff(a*x^3 + y*x, x)", NAMES), Exchange({"x": shift}))
    a, x, y = map(value, (A, X, Y))
    assert sp.expand(value(found.tree) - (3 * a * x**2 + y).subs(x, value(shift.node))) == 0
    assert parse(found.text, NAMES).tree == parse(written(found.tree), NAMES).tree


@pytest.mark.parametrize(
    ("tree", "text", "after"),
    [
        (ZERO, "a*x + b", "b"),
        (ZERO, "a", "0"),
        (ZERO, "a + a*x", "0"),
        (ZERO, "x - a", "x"),
        (ZERO, "-a*x + b + y", "b + y"),
        (ZERO, "sin(a) + (a*x)^2", "sin(0) + 0^2"),
        (B, "a/x + a", "b/x + b"),
        (Sum((B, Y)), "a*x - a", "(b + y)*x - (b + y)"),
        (scaled(Fraction(3), A), "a*x", "3*a*x"),
        (scaled(Fraction(3), A), "diff(a^2*x, a)", "diff((3*a)^2*x, a)/3"),
        (scaled(Fraction(1), A), "a*x", "a*x"),
        (scaled(Fraction(-1), A), "a*x", "(-a)*x"),
    ],
)
def test_a_parameter_that_another_expression_takes_the_place_of(tree: Node, text: str, after: str) -> None:
    assert exchanged(parse(text, NAMES), Exchange(trees={"a": tree})).text == after


def test_what_speaks_of_none_of_the_names_stays_as_it_was_written() -> None:
    given = parse("a* (y+ b )", NAMES, "plain")
    assert exchanged(given, Exchange({"x": Shift("x", -1)})) is given
