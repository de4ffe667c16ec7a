"""First variations: what is varied comes out right, and every kind of wrong line is caught."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import cycle
from time import process_time

import pytest
import sympy as sp

from deltaq.derivation.clearing import Cleared
from deltaq.derivation.differential_expression import direction
from deltaq.derivation.domain import Instant, Interval
from deltaq.derivation.formula import (
    AtTime,
    Boundary,
    Bounds,
    Directional,
    Explicit,
    Formula,
    FunctionFormula,
    Integral,
    LimitOfQuotient,
)
from deltaq.derivation.function_evaluation import evaluate_functions
from deltaq.derivation.function_points import function_points
from deltaq.derivation.functional import Functional
from deltaq.derivation.rules import functional as functional_rule
from deltaq.derivation.step import Relation
from deltaq.derivation.variation import vary
from deltaq.derivation.verification import holds
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.sympy_algebra import to_sympy

NAMES = Names(
    (
        Symbol("x", "coordinate"),
        Symbol("y", "coordinate"),
        *(Symbol(name, "parameter") for name in ("m", "k", "T", "t0")),
    )
)


def functional(text: str, *, ends: str = "", at: str = "") -> Functional:
    domain: Instant | Interval | None = None
    if at:
        domain = Instant(parse(at, NAMES).tree)
    if ends:
        domain = Interval(parse("0", NAMES).tree, parse("T", NAMES).tree, ends)  # type: ignore[arg-type]
    return Functional(NAMES, (parse(text, NAMES).tree,), domain)


EXPRESSION = functional("x")
X, Y, M, T = (EXPRESSION.symbols.name(name) for name in ("x", "y", "m", "T"))
TIME = EXPRESSION.symbols.time
XD, XDD = EXPRESSION.symbols.rate("x", 1), EXPRESSION.symbols.rate("x", 2)
DX, DXD, DY = direction("x"), direction("x", 1), direction("y")


@pytest.mark.parametrize(
    ("text", "variation"),
    [
        pytest.param("x", DX, id="identity"),
        pytest.param("m*x^2", 2 * M * X * DX, id="square"),
        pytest.param("x*y", Y * DX + X * DY, id="product of two functions"),
        pytest.param("x*dot(x)", XD * DX + X * DXD, id="with a rate"),
        pytest.param("t^2*sin(x)", TIME**2 * sp.cos(X) * DX, id="the time is not varied"),
        pytest.param("exp(-t)*ddot(x)", sp.exp(-TIME) * direction("x", 2), id="acceleration"),
        pytest.param("abs(x)", sp.sign(X) * DX, id="absolute value"),
    ],
)
def test_both_routes(text: str, variation: sp.Expr) -> None:
    subject = functional(text)
    assert subject.by_chain_rule == variation
    assert subject.by_definition == variation


@pytest.mark.parametrize(
    ("text", "left"),
    [
        pytest.param("m*dot(x)^2/2 - k*x^2/2", -M * XDD - sp.Symbol("k", real=True) * X, id="oscillator"),
        pytest.param("sqrt(1 + dot(x)^2)", None, id="shortest line"),
        pytest.param("x*dot(x)", sp.Integer(0), id="a total derivative has none"),
        pytest.param("t*dot(x)^2", -2 * XD - 2 * TIME * XDD, id="explicit time"),
    ],
)
def test_euler_lagrange(text: str, left: sp.Expr | None) -> None:
    found = functional(text, ends="fixed").euler_lagrange("x")
    expected = -XDD / (1 + XD**2) ** sp.Rational(3, 2) if left is None else left
    assert sp.simplify(found - expected) == 0


@pytest.mark.one_in(7)
@pytest.mark.parametrize("ends", ["fixed", "free", "fixed-free", "free-fixed"])
@pytest.mark.parametrize(
    "text",
    [
        "m*dot(x)^2/2 - k*x^2/2",
        "sqrt(1 + dot(x)^2)/sqrt(x)",
        "dot(x)^2*y + cos(x - y)*dot(y)",
        "t*x^3*dot(x)",
        "x^2 + y^2",
        "sqrt(1 - x^2)*dot(x)^2",
        "asin(x)*dot(x)",
        "sqrt(x - 5)*dot(x)^2",
    ],
)
def test_every_step_of_an_integral_is_verified(text: str, ends: str) -> None:
    steps = list(vary(functional(text, ends=ends)).steps())
    assert [step.id for step in steps if not step.verified] == []
    assert len({step.id for step in steps}) == len(steps) >= 7


@pytest.mark.parametrize("text", ["x", "x*sin(y)", "dot(x)^2*t", "log(x)"])
def test_every_step_of_a_value_is_verified(text: str) -> None:
    assert all(step.verified for step in vary(functional(text, at="t0")).steps())


PLACE = {s: sp.Rational(3 + n, 7 + 2 * n) for n, s in enumerate((X, Y, M, EXPRESSION.symbols.name("k"), XD, XDD))}
POINTS = function_points(functional("x", ends="free"))
OVER_TIME = (Bounds(TIME, sp.Integer(0), T),)
IDENTITIES = [
    pytest.param(
        Directional(Explicit(X**2), EXPRESSION.jets, EXPRESSION.h), Explicit(2 * X * DX), id="Gâteaux differential"
    ),
    pytest.param(
        LimitOfQuotient(Explicit(X**2), EXPRESSION.jets, EXPRESSION.h), Explicit(2 * X * DX), id="limit of quotients"
    ),
    pytest.param(Integral(Explicit(XD), OVER_TIME), Boundary(Explicit(X), sp.Integer(0), T), id="fundamental theorem"),
    pytest.param(
        Directional(Integral(Explicit(X * XD), OVER_TIME), EXPRESSION.jets, EXPRESSION.h),
        Integral(Explicit(XD * DX + X * DXD), OVER_TIME),
        id="under the integral",
    ),
    pytest.param(AtTime(Explicit(TIME * M), T), Explicit(T * M), id="value at an instant"),
]


@pytest.mark.parametrize(("formula", "equal"), IDENTITIES)
def test_right_lines_hold(formula: Formula, equal: Formula) -> None:
    assert holds(Relation((formula, equal)), POINTS)


@pytest.mark.parametrize(("formula", "equal"), IDENTITIES)
def test_wrong_lines_do_not(formula: Formula, equal: Formula) -> None:
    wrong = Directional(equal, {X: sp.Rational(1, 10**15)}, EXPRESSION.h)
    assert not holds(Relation((formula, wrong)), POINTS)


def test_boundary_terms_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Free ends told as fixed ones: the terms that are left out are missed."""
    monkeypatch.setattr(Functional, "held", (1, 1))
    subject = functional("dot(x)^2", ends="free")
    monkeypatch.setattr("deltaq.derivation.variation.function_points", lambda s, held=None: function_points(s))
    wrong = {step.id for step in vary(subject).steps() if not step.verified}
    assert wrong == {"boundary-terms", "collected-variation"}


def test_a_wrong_sign_in_the_integration_by_parts_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    right = Functional.momentum_rate
    monkeypatch.setattr(Functional, "momentum_rate", lambda self, x: -right(self, x))
    wrong = {step.id for step in vary(functional("x*dot(x)^2", ends="free")).steps() if not step.verified}
    assert wrong == {"integration-by-parts:x"}


@pytest.mark.parametrize(
    ("name", "caught"),
    [
        pytest.param("momentum", {"boundary-terms", "collected-variation", "beltrami-identity"}, id="boundary terms"),
        pytest.param("rate", {"integration-by-parts-twice:x", "integration-by-parts:x"}, id="parts"),
        pytest.param("euler_lagrange", {"collected-variation", "euler-lagrange-equation:x"}, id="equation"),
    ],
)
def test_a_wrong_line_about_a_second_rate_is_caught(
    monkeypatch: pytest.MonkeyPatch, name: str, caught: set[str]
) -> None:
    right = getattr(Functional, name)
    monkeypatch.setattr(Functional, name, lambda self, *which: right(self, *which) * sp.Rational(10**15 + 1, 10**15))
    subject = functional("m*ddot(x)^2/2 - k*x^2*dot(x)^2", ends="free")
    assert {step.id for step in vary(subject).steps() if not step.verified} == caught


@pytest.mark.parametrize("part", ["value", "factor"])
def test_a_wrong_factor_of_an_equation_is_caught(monkeypatch: pytest.MonkeyPatch, part: str) -> None:
    right = Functional.cleared_equation

    def wrong(self: Functional, function: str) -> Cleared:
        found = right(self, function)
        return replace(found, **{part: -getattr(found, part)})

    monkeypatch.setattr(Functional, "cleared_equation", wrong)
    steps = vary(functional("sqrt((1 + dot(x)^2)/x)", ends="fixed")).steps()
    assert {step.id for step in steps if not step.verified} == {"cleared-equation:x"}


def test_a_first_integral_that_is_none_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of an integrand that holds the time."""
    monkeypatch.setattr(Functional, "is_autonomous", True)
    wrong = {step.id for step in vary(functional("t*dot(x)^2 + x^2", ends="fixed")).steps() if not step.verified}
    assert wrong == {"beltrami-identity"}


FORMS = (
    "sqrt({a} + x^2 + dot(x)^2)",
    "x^{n}*sqrt({a} + {b}*dot(x)^2)",
    "sqrt({a} - x^2)*sqrt(1 + dot(x)^2)",
    "sqrt(x - {a})/(1 + dot(x)^2)",
    "dot(x)^{n}/(x^2 + {a})",
    "log({a}*x)*sqrt(1 + {b}*dot(x)^2)",
    "(1 + x^2)^({n}/3)*dot(x)^2",
    "sqrt(-{a}*x)*dot(x)^2",
    "exp(-x/{a})*sqrt(dot(x)^2 + sin(x)^2)",
    "sqrt({a} - dot(x)^2/{b}) - t*x",
)
DRAWN = random.Random(20)
GENERATED = [form.format(**{name: DRAWN.randint(2, 9) for name in "abn"}) for form in FORMS]


SPANS = cycle((("0", "T"), ("2", "5"), ("0", "100")))


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("text", "ends"), [pytest.param(*case, id=case[0]) for case in zip(GENERATED, SPANS, strict=False)]
)
def test_roots_and_quotients_are_verified(text: str, ends: tuple[str, str]) -> None:
    domain = Interval(parse(ends[0], NAMES).tree, parse(ends[1], NAMES).tree, "fixed-free")
    subject = Functional(NAMES, (parse(text, NAMES).tree,), domain)
    assert [step.id for step in vary(subject).steps() if not step.verified] == []


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("(1 + x + dot(x)^2)^20/(x^2 + dot(x)^3 + 2)^10", id="high powers"),
        pytest.param("sqrt(1 + ddot(x)^2 + x^2)*sqrt(1 + dot(x)^2)/(1 + x^4)", id="second rate under a root"),
        pytest.param("(dot(x)^2 + dot(y)^2)/(m*x^2*sin(y) + k*y^2*cos(x) + 1)^3", id="two functions in a denominator"),
    ],
)
def test_what_is_too_long_to_be_factored_is_left_as_it_is(text: str) -> None:
    """Factoring these takes many times what all other steps take together."""
    subject = functional(text, ends="fixed")
    start = process_time()
    found = subject.cleared_equation("x")
    assert process_time() - start < 1.5
    assert sp.simplify((found.value - found.factor * subject.euler_lagrange("x")).subs(PLACE)) == 0


@pytest.mark.parametrize(
    ("text", "left", "reasons"),
    [
        pytest.param("m*dot(x)^2/2 - k*x^2/2", "m*ddot(x) + k*x", (), id="sign"),
        pytest.param("m*dot(x)^2/2 - m*k*x", "ddot(x) + k", ("constants",), id="parameter"),
        pytest.param("sqrt(dot(x)^2 + x^2)", "x*ddot(x) - 2*dot(x)^2 - x^2", ("denominators", "points"), id="x = 0"),
        pytest.param("t^2*dot(x)^2", "t*ddot(x) + 2*dot(x)", ("points",), id="t = 0"),
        pytest.param("x^2*dot(x)^2", "x^2*ddot(x) + x*dot(x)^2", (), id="x = 0 solves it, and stays"),
        pytest.param("dot(x)^2*sqrt(1 - x^2)", "2*(1 - x^2)*ddot(x) - x*dot(x)^2", ("denominators",), id="root"),
    ],
)
def test_only_what_cannot_be_zero_is_left_out(text: str, left: str, reasons: tuple[str, ...]) -> None:
    found = functional(text, ends="fixed").cleared_equation("x")
    expected = to_sympy(parse(left, NAMES).tree, EXPRESSION.symbols)
    assert sp.expand(found.value - expected) == 0
    assert found.reasons == reasons


def test_a_forgotten_function_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """A chain rule over the first function only."""
    right = Functional.slopes.func
    monkeypatch.setattr(Functional, "by_chain_rule", property(lambda self: right(self)[X] * DX))
    wrong = {step.id for step in vary(functional("x*y")).steps() if not step.verified}
    assert wrong == {"variation-by-definition", "variation-by-chain-rule", "both-routes"}


def test_an_unknown_formula_is_our_bug() -> None:
    with pytest.raises(TypeError, match="no value for FunctionFormula"):
        evaluate_functions(FunctionFormula(), {}, lambda *_: (), lambda *_: T)


def test_what_is_called_i_is_the_integral() -> None:
    subject = functional("x", ends="fixed")
    assert holds(Relation((functional_rule.named(subject), Integral(Explicit(X), OVER_TIME))), POINTS)
