"""Histories of lines that are written by hand: what comes from what, and what becomes of it."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
import sympy as sp

from deltaq.derivation import formula as f
from deltaq.derivation.history import MOST, History, summands, with_names
from deltaq.derivation.normal_algebra import NormalAlgebra
from deltaq.derivation.step import Line, Relation, Step

a, b, c, x, y = sp.symbols("a b c x y", real=True)


def line(*terms: sp.Expr, owners: Sequence[tuple[str, ...]] = ()) -> f.Plus:
    """A sum of such terms; a term may belong to bodies and loads."""
    of = owners or ((),) * len(terms)
    return f.Plus(tuple(f.Term(f.Explicit(term), sources) for term, sources in zip(terms, of, strict=True)))


def told(*members: f.Formula) -> tuple[Line, ...]:
    """The lines of a step that says that these are equal."""
    step = Step("energy", "", (Relation(members),))
    (lines,) = History(NormalAlgebra(("x", "y"))).lines(step)
    return lines


def origins(*members: f.Formula) -> list[list[tuple[str, str]]]:
    """Of each term of the last member: where it comes from (member.term), and what became of it."""
    last = told(*members)[-1]
    return [[(one.term.rpartition("/")[2], one.change) for one in term.origins] for term in last.terms]


@pytest.mark.parametrize(
    ("before", "after", "found"),
    [
        ((a * x, b), (b, a * x), [[("0.0.1", "kept")], [("0.0.0", "kept")]]),
        ((a * x, b), (-a * x, -b), [[("0.0.0", "sign-turned")], [("0.0.1", "sign-turned")]]),
        ((a * (x + y), c), (a * x, a * y, c), [[("0.0.0", "expanded")], [("0.0.0", "expanded")], [("0.0.1", "kept")]]),
        ((a * x, a * y, c), (a * (x + y), c), [[("0.0.0", "merged"), ("0.0.1", "merged")], [("0.0.2", "kept")]]),
        ((2 * a, 3 * a, b), (5 * a, b), [[("0.0.0", "merged"), ("0.0.1", "merged")], [("0.0.2", "kept")]]),
    ],
)
def test_terms_come_from_terms_that_share_their_products(
    before: tuple[sp.Expr, ...], after: tuple[sp.Expr, ...], found: list[list[tuple[str, str]]]
) -> None:
    assert origins(line(*before), line(*after)) == found


def test_what_two_terms_have_with_opposite_signs_is_in_neither_and_cancelled() -> None:
    lines = told(line(a * x + b, -a * x, c * y), line(b, c * y))
    assert [[one.term for one in term.origins] for term in lines[-1].terms] == [["energy/0.0.0"], ["energy/0.0.2"]]
    assert lines[-1].cancelled == ("energy/0.0.1",)


@pytest.mark.parametrize(
    ("left", "right", "found"),
    [
        pytest.param([a * x], [c, -b * y], ["kept 0", "kept 2", "sign-turned 1"], id="to the right"),
        pytest.param([a * x, b * y, -c], [0], ["kept 0", "kept 1", "sign-turned 2"], id="to the left"),
        pytest.param([-a * x, -b * y], [-c], ["sign-turned 0", "sign-turned 1", "sign-turned 2"], id="times −1"),
        pytest.param([c], [a * x, b * y], ["kept 2", "kept 0", "kept 1"], id="the other way round"),
    ],
)
def test_terms_of_an_equation_turn_their_signs_as_they_are_written(
    left: list[sp.Expr], right: list[sp.Expr], found: list[str]
) -> None:
    """a x + b y = c in other words."""
    last = origins(f.Equation(line(a * x, b * y), line(c)), f.Equation(line(*left), line(*map(sp.sympify, right))))
    assert [[f"{change} {name[-1]}" for name, change in term] for term in last] == [[one] for one in found]


def test_a_term_that_is_zero_comes_from_nothing() -> None:
    """d/dt a = 0 of a constant, beside terms that come from where they came from before."""
    after = f.Plus((f.Term(f.Rate(f.Explicit(a))), f.Term(f.Explicit(b)), f.Term(f.Explicit(a * x))))
    assert origins(line(a * x, b), after) == [[], [("0.0.1", "kept")], [("0.0.0", "kept")]]


def test_what_cancels_goes_by_pairs() -> None:
    lines = told(line(a * x, -a * x, a * x, c), line(a * x, c))
    assert [[one.term for one in term.origins] for term in lines[-1].terms] == [["energy/0.0.2"], ["energy/0.0.3"]]
    assert lines[-1].cancelled == ("energy/0.0.0", "energy/0.0.1")


def test_what_is_opposite_in_one_product_only_is_in_the_sum() -> None:
    """x (a + b) + x (2b − a) + a x = x (a + 3b)"""
    assert origins(line(x * (a + b), x * (2 * b - a), a * x), line(x * (a + 3 * b))) == [
        [("0.0.0", "merged"), ("0.0.1", "merged"), ("0.0.2", "merged")]
    ]


@pytest.mark.parametrize(("number", "is_told"), [(MOST, True), (MOST + 1, False)])
def test_very_long_lines_are_told_as_a_whole(number: int, is_told: bool) -> None:
    terms = sp.symbols(f"a:{number}", real=True)
    last = told(line(*terms), line(*reversed(terms)))[-1]
    assert {len(term.origins) for term in last.terms} == {int(is_told)}


@pytest.mark.parametrize("rest", [sp.Integer(1), c, c * y])
@pytest.mark.parametrize("power", [1, 2, 3])
def test_summands_of_a_bracket_have_the_sources_of_the_terms_they_come_from(power: int, rest: sp.Expr) -> None:
    """(a + b)ⁿ, where a is of one body and b of another, gathered from the terms of its expansion."""
    expanded = sp.expand(rest * (a + b) ** power).args
    of = {a: "body:one", b: "body:two"}
    owners = [tuple(of[each] for each in (a, b) if term.has(each)) for term in expanded]
    (term,) = told(line(*expanded, owners=owners), line(rest * (a + b) ** power))[-1].terms
    assert term.sources == ("body:one", "body:two")
    ((bracket, parts),) = term.inside
    assert (bracket, dict(parts)) == (a + b, {a: ("body:one",), b: ("body:two",)})


def test_a_bracket_is_told_apart_only_where_its_summands_have_different_sources() -> None:
    both = ("body:one", "body:two")
    (term,) = told(line(a * c, b * c, owners=[both, both]), line(c * (a + b)))[-1].terms
    assert (term.sources, term.inside) == (both, ())


def test_a_bracket_of_what_has_no_normal_form_is_not_told_apart() -> None:
    body = f.MassIntegral(f.Explicit(x), "B", "dm", f.Bounds(y, sp.Integer(0), a), b)
    before = f.Plus((f.Term(body, ("body:one",)), f.Term(f.Explicit(c), ("body:two",))))
    (term,) = told(before, line(x * (a + b)))[-1].terms
    assert [one.change for one in term.origins] == ["integrated", "merged"]
    assert (term.sources, term.inside) == (("body:one", "body:two"), ())


def test_of_terms_alike_each_comes_from_those_of_its_own_body() -> None:
    owners = [("body:one",), ("body:two", "load:weight"), ("body:two", "load:drag")]
    terms = (a * x, 2 * a * x, 3 * a * x)
    last = told(line(*terms, owners=owners), line(*reversed(terms), owners=owners[::-1]))[-1]
    assert [[one.term for one in term.origins] for term in last.terms] == [
        ["energy/0.0.2"],
        ["energy/0.0.1"],
        ["energy/0.0.0"],
    ]


V, W = f.Named(f.Quantity("velocity"), a * x + b * y), f.Named(f.Quantity("work"), c)
XD, YD = (sp.Symbol(f"dot({name})", real=True) for name in "xy")


def from_known(*members: f.Formula) -> list[list[tuple[int, str]]]:
    """Of each term of the last member: which terms of v = a x + b y it comes from, and what became of them."""
    history = History(NormalAlgebra(("x", "y")))
    first = Step("first", "", (Relation((V, line(a * x, b * y, owners=[("body:one",), ("body:two",)]))),))
    history.lines(first)
    ((*_, last),) = history.lines(Step("next", "", (Relation(members),)))
    known = {"first/0.1.0": 0, "first/0.1.1": 1}
    return [[(known[one.term], one.change) for one in term.origins if one.term in known] for term in last.terms]


def column(*entries: sp.Expr) -> f.Explicit:
    return f.Explicit(sp.ImmutableMatrix(entries))


@pytest.mark.parametrize(
    ("formula", "value", "found"),
    [
        pytest.param(V, line(b * y, a * x), [(1, "kept"), (0, "kept")], id="itself"),
        pytest.param(f.Rate(V), line(a * XD, b * YD), [(0, "differentiated"), (1, "differentiated")], id="rate"),
        pytest.param(f.Partial(V, y), line(b), [(1, "differentiated")], id="slope"),
        pytest.param(
            f.Times((f.Explicit(c), V)), line(b * c * y, a * c * x), [(1, "expanded"), (0, "expanded")], id="product"
        ),
        pytest.param(
            f.Plus((f.minus(V), f.Term(f.Explicit(c)))),
            line(c, -a * x, -b * y),
            [None, (0, "sign-turned"), (1, "sign-turned")],
            id="difference",
        ),
        pytest.param(
            f.Equation(W, V), f.Equation(line(c, -a * x), line(b * y)),
            [None, (0, "sign-turned"), (1, "kept")], id="right side of an equation",
        ),
        pytest.param(
            f.Stack((W, V)), column(c, a * x + b * y), [None, (0, "expanded"), (1, "expanded")], id="column"
        ),
        pytest.param(
            f.Dot(f.Stack((V, W)), column(c, a)), line(a * c * x, b * c * y, a * c),
            [(0, "expanded"), (1, "expanded"), None], id="scalar product from the left",
        ),
        pytest.param(
            f.Dot(column(c, a), f.Stack((V, W))), line(a * c * x, b * c * y, a * c),
            [(0, "expanded"), (1, "expanded"), None], id="scalar product from the right",
        ),
        pytest.param(
            f.MatrixTimes(f.Explicit(sp.ImmutableMatrix([[c, 0], [0, 1]])), f.Stack((V, W))),
            column(a * c * x + b * c * y, c), [(0, "expanded"), (1, "expanded"), None], id="vector times matrix",
        ),
        pytest.param(f.Called(f.Quantity("action"), V), line(b * y, a * x), [(1, "kept"), (0, "kept")], id="called"),
        pytest.param(
            f.Rate(f.Times((f.Explicit(c), V))), line(b * c * YD, a * c * XD),
            [(1, "differentiated"), (0, "differentiated")], id="rate of a product",
        ),
        pytest.param(
            f.Times((f.Explicit(c), f.Rate(V))), line(b * c * YD, a * c * XD),
            [(1, "differentiated"), (0, "differentiated")], id="product with a rate",
        ),
    ],
)  # fmt: skip
def test_terms_come_from_what_an_earlier_step_said_of_a_name(
    formula: f.Formula, value: f.Formula, found: list[tuple[int, str] | None]
) -> None:
    assert from_known(formula, value) == [[one] if one else [] for one in found]


@pytest.mark.parametrize(
    ("formula", "found"),
    [
        (V, [("first/0.1.0", "kept"), ("first/0.1.1", "kept")]),
        (f.Rate(V), [("first/0.1.0", "differentiated"), ("first/0.1.1", "differentiated")]),
        (f.Partial(V, y), [("first/0.1.1", "differentiated")]),
        (W, []),
    ],
)
def test_the_first_member_comes_from_the_step_that_said_what_it_is(
    formula: f.Formula, found: list[tuple[str, str]]
) -> None:
    history = History(NormalAlgebra(("x", "y")))
    history.lines(Step("first", "", (Relation((V, line(a * x, b * y))),)))
    ((only,),) = history.lines(Step("next", "", (Relation((formula,)),)))
    assert [(one.term, one.change) for term in only.terms for one in term.origins] == found


def test_sources_of_terms_that_come_from_a_name_are_those_of_its_terms() -> None:
    """v is of both bodies, a x of one of them."""
    history = History(NormalAlgebra(("x", "y")))
    history.lines(Step("first", "", (Relation((V, line(a * x, b * y, owners=[("body:one",), ("body:two",)]))),)))
    ((whole, last),) = history.lines(Step("next", "", (Relation((V, line(a * x, b * y))),)))
    assert [term.sources for term in whole.terms] == [("body:one", "body:two")]
    assert [term.sources for term in last.terms] == [("body:one",), ("body:two",)]


def test_what_is_not_equal_comes_from_nothing() -> None:
    history = History(NormalAlgebra(("x", "y")))
    ((_, last),) = history.lines(Step("first", "", (Relation((line(a, b), line(a, -b)), "≠"),)))
    assert [term.origins for term in last.terms] == [(), ()]


def test_a_matrix_has_the_terms_of_its_entries() -> None:
    matrix = sp.ImmutableMatrix([a * x + b, c])
    lines = told(f.Explicit(matrix), f.Explicit(sp.ImmutableMatrix([b - a * x, c])))
    assert [[one.term for one in term.origins] for term in lines[-1].terms] == [
        ["energy/0.0.0"],
        ["energy/0.0.1"],
        ["energy/0.0.2"],
    ]


@pytest.mark.parametrize(
    ("formula", "classes"),
    [
        (f.Explicit(a + b), ["A", "B"]),
        (f.Explicit(a * b), []),  # one term needs no class within
        (line(a, b), ["A", "B"]),
        (f.Equation(f.Explicit(a + b), f.Explicit(sp.Integer(0))), ["A", "B"]),
        (f.Equation(f.Explicit(sp.Integer(0)), f.Explicit(a + b)), ["A", "B"]),
        (f.Equation(f.Explicit(a + b), f.Explicit(c + x)), ["A", "B", "C", "D"]),
        (f.Equation(f.Explicit(a * b), f.Explicit(c + x)), ["B", "C"]),
        (f.Explicit(sp.ImmutableMatrix([a + b, c])), ["A", "B"]),
    ],
)
def test_classes_are_given_in_the_order_of_the_terms(formula: f.Formula, classes: list[str]) -> None:
    assert list(_classes(with_names(formula, iter("ABCDEFG")))) == classes


def _classes(formula: f.Formula) -> list[str]:
    match formula:
        case f.Plus(terms):
            return [term.role for term in terms if term.role]
        case f.Equation(left, right):
            return [*_classes(left), *_classes(right)]
        case f.Explicit(_, owners):
            return [name for _, parts in owners for _, (name,) in parts]
        case f.Integral(of) | f.AtTime(of):
            return _classes(of)
    return []


T, OVER_TIME = sp.Symbol("t", real=True), (f.Bounds(sp.Symbol("t", real=True), sp.Integer(0), b),)


@pytest.mark.parametrize(
    "formula",
    [
        line(a, b, c),
        line(a, sp.Integer(0), c),
        f.Explicit(a + b),
        column(a + b, c + x),
        f.Integral(line(a * x, b), OVER_TIME),
        f.AtTime(line(a * x, b), T),
        f.Equation(f.AtTime(line(a, b), T), f.Integral(f.Explicit(c + x), OVER_TIME)),
        f.Rate(f.Explicit(x)),
    ],
    ids=lambda one: type(one).__name__,
)
def test_each_term_of_a_line_takes_a_name_and_the_line_stays_what_it_was(formula: f.Formula) -> None:
    names = [f"term-{number}" for number in range(9)]
    left = iter(names)
    named = with_names(formula, left)
    used = len(names) - len(list(left))
    assert used == len(list(summands(formula)))
    assert type(named) is type(formula)
    assert _classes(named) in (names[:used], [])
    assert _classes(named) or isinstance(formula, f.Rate)
    algebra = NormalAlgebra(("x", "y"))
    assert algebra.products(named) == algebra.products(formula)
