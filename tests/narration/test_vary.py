"""The document of a first variation."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator

import pytest
from tests.lecture.answers import walk

from deltaq.errors import InputError, Problem
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.plain_printer import plain
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.narration.vary import vary_request

SAFE = re.compile(r"[A-Za-z0-9:_-]+")
INTEGRAL = {"kind": "integral", "from": "0", "to": "T", "ends": "fixed"}
OSCILLATOR = {"expression": "m*dot(x)^2/2 - k*x^2/2", "functions": ["x"], "parameters": ["m", "k", "T"]}
NUMERIC = {"functions": {"x": "sin(t)"}, "direction": {"x": "t^2"}, "t": 0.7}


def vary(**document: object) -> dict:
    return vary_request(document)


def problems(**document: object) -> tuple[Problem, ...]:
    with pytest.raises(InputError) as caught:
        vary(**document)
    return caught.value.problems


def all_steps(answer: dict) -> dict[str, dict]:
    return {s["id"]: s for chapter in answer["chapters"] for step in chapter["steps"] for s in walk(step)}


@pytest.mark.parametrize("lang", ["de", "en"])
@pytest.mark.parametrize(
    "question",
    [
        pytest.param({"expression": "l*sin(x)", "functions": ["x"], "parameters": ["l"]}, id="expression"),
        pytest.param({"expression": "[x, y]", "functions": ["x", "y"], "direction": ["v", "w"]}, id="vector"),
        pytest.param(
            {"expression": "x", "functions": ["x"], "functional": {"kind": "value", "at": "2"}}, id="identity"
        ),
        pytest.param({**OSCILLATOR, "functional": INTEGRAL}, id="fixed ends"),
        pytest.param({**OSCILLATOR, "functional": {**INTEGRAL, "ends": "free"}}, id="free ends"),
    ],
)
def test_every_variation_is_told(question: dict, lang: str) -> None:
    answer = vary(**question, lang=lang)
    json.dumps(answer, allow_nan=False)
    for identifier, step in all_steps(answer).items():
        assert SAFE.fullmatch(identifier)
        assert step["verified"] is True
        assert step["text"].endswith(".")
        for latex in (step["latex"], step["marked"]):
            assert latex.count("{") == latex.count("}")
        assert "htmlClass" not in step["latex"]


def test_chapters_of_an_integral() -> None:
    answer = vary(**OSCILLATOR, functional=INTEGRAL)
    assert [chapter["id"] for chapter in answer["chapters"]] == [
        "functional",
        "variation-by-definition",
        "variation-by-chain-rule",
        "both-routes",
        "integration-by-parts",
        "euler-lagrange",
        "first-integrals",
    ]


def test_result_of_an_integral_with_fixed_ends() -> None:
    result = vary(**OSCILLATOR, functional=INTEGRAL)["result"]
    assert result["first_variation"] == {
        "plain": "-k*x*delta(x) + m*dot(x)*dot(delta(x))",
        "latex": r"\int_{0}^{T} \left(-k x \, \delta x + m \dot{x} \, \delta \dot{x}\right)\,\mathrm{d}t",
        "spoken": "the integral from zero to capital T of open bracket minus k x times delta x, "
        "plus m x dot times delta x dot close bracket d t",
        "from": "0",
        "to": "T",
        "ends": "fixed",
    }
    (equation,) = result["euler_lagrange"]
    assert (equation["function"], equation["plain"]) == ("x", "m*ddot(x) + k*x = 0")
    (boundary,) = result["boundary_terms"]
    assert (boundary["plain"], boundary["vanishes"], boundary["condition"]) == ("m*dot(x)*delta(x)", True, None)


def test_natural_conditions_at_free_ends() -> None:
    result = vary(**OSCILLATOR, functional={**INTEGRAL, "ends": "free"})["result"]
    (boundary,) = result["boundary_terms"]
    assert boundary["vanishes"] is False
    assert boundary["condition"] == {"plain": "dot(x) = 0", "latex": r"\dot{x} = 0", "spoken": "x dot equals zero"}


def test_named_directions_are_read_back_by_the_parser() -> None:
    result = vary(expression="x*dot(x)*sin(y)", functions=["x", "y"], direction=["v", "w"])["result"]
    names = Names(tuple(Symbol(name, "coordinate") for name in ("x", "y", "v", "w")))
    plain = result["first_variation"]["plain"]
    assert {"v", "w"} <= parse(plain, names).names
    assert "dot(v)" in plain


def test_classes_of_the_page() -> None:
    marked = all_steps(vary(expression="x*y", functions=["x", "y"]))["variation-by-chain-rule"]["marked"]
    for css in ("q-0", "q-1", "q-0 variation", "q-1 variation"):
        assert rf"\htmlClass{{{css}}}" in marked


def test_latex_is_read_too() -> None:
    latex = vary(expression=r"\frac{1}{2} m \dot{x}^2", syntax="latex", functions=["x"], parameters=["m"])
    plain = vary(expression="m*dot(x)^2/2", functions=["x"], parameters=["m"])
    assert latex["result"] == plain["result"]


def test_h_of_the_user_is_not_the_h_of_the_definition() -> None:
    step = all_steps(vary(expression="h*x", functions=["x"], parameters=["h"]))["variation-by-definition"]
    assert step["verified"] is True
    assert r"\partial \varepsilon" in step["latex"]


def test_letters_of_the_user_are_not_those_of_the_functional() -> None:
    """A force F in the integrand F, a function H with the constant H."""
    answer = vary(
        expression="F*H + dot(H)^2", functions=["H"], parameters=["F"], functional={**INTEGRAL, "to": "1"}, lang="en"
    )
    steps = all_steps(answer)
    assert r"\mathcal{F}(H, \dot{H})" in steps["functional"]["latex"]
    assert steps["beltrami-identity"]["latex"].startswith(r"\begin{aligned}\mathcal{H} &=")
    assert r"$\mathcal{H}$" in steps["beltrami-identity"]["text"]


def test_quotient() -> None:
    quotient = vary(expression="x^2*dot(x)", functions=["x"], include=["quotient"], numeric=NUMERIC)["quotient"]
    json.dumps(quotient, allow_nan=False)
    assert len(quotient["h"]) == len(quotient["central"]["error"]) == 65
    assert quotient["central"]["best"]["error"] == pytest.approx(0, abs=1e-10)
    assert quotient["one_sided"]["best"]["h"] < quotient["h"][0]


@pytest.mark.parametrize(
    ("functional", "numeric", "span", "at"),
    [
        pytest.param(None, NUMERIC | {"t": 0.5}, (0, 1), 0.5, id="expression: the instant in the middle"),
        pytest.param(None, NUMERIC | {"t": -0.5}, (-1, 0), -0.5, id="before zero"),
        pytest.param(None, NUMERIC | {"t": 0.0}, (0, 1), 0, id="at zero"),
        pytest.param({"kind": "value", "at": "2"}, NUMERIC, (0, 4), 2, id="value"),
        pytest.param({"kind": "integral", "from": "1", "to": "3"}, NUMERIC, (1, 3), None, id="integral"),
    ],
)
def test_curves(functional: dict | None, numeric: dict, span: tuple[float, float], at: float | None) -> None:
    answer = vary(expression="x", functions=["x"], functional=functional, include=["quotient"], numeric=numeric)
    curves = answer["quotient"]["curves"]
    assert (curves["t"][0], curves["t"][-1], curves["at"]) == (*span, at)
    assert curves["functions"]["x"] == pytest.approx([math.sin(t) for t in curves["t"]])
    assert curves["direction"]["x"] == pytest.approx([t**2 for t in curves["t"]])


def test_one_end_fixed_and_one_free() -> None:
    integral = {**INTEGRAL, "ends": "fixed-free"}
    answer = vary(expression="dot(x)^2", functions=["x"], parameters=["T"], functional=integral)
    (term,) = answer["result"]["boundary_terms"]
    assert (term["vanishes"], term["at"], term["condition"]["plain"]) == (False, ["T"], "dot(x) = 0")
    steps = all_steps(answer)
    assert r"\delta x(0) &= 0" in steps["boundary-terms"]["latex"]
    assert r"\dot{x}(T) = 0" in steps["boundary-terms"]["latex"]
    assert r"\dot{x}(0)" not in steps["boundary-terms"]["latex"]
    assert "left[" not in steps["collected-variation"]["latex"]


@pytest.mark.parametrize(
    ("functional", "derivative"),
    [
        pytest.param({"kind": "value", "at": "2"}, 4.0, id="value at 2 of t^2"),
        pytest.param({"kind": "integral", "from": "0", "to": "3", "ends": "free"}, 9.0, id="integral of t^2 to 3"),
    ],
)
def test_quotient_of_a_functional(functional: dict, derivative: float) -> None:
    answer = vary(expression="x", functions=["x"], functional=functional, include=["quotient"], numeric=NUMERIC)
    assert answer["quotient"]["derivative"] == pytest.approx(derivative)


@pytest.mark.parametrize(
    ("document", "problem"),
    [
        pytest.param(
            {"expression": "x + zz", "functions": ["x"]},
            Problem("unknown-name", "/expression", 4, 2, {"name": "zz", "known": "x, t, pi"}),
            id="unknown name",
        ),
        pytest.param(
            {"expression": "sin(t)", "functions": ["x", "y"]},
            Problem("nothing-varied", "/expression", parameters={"names": "x, y"}),
            id="nothing to vary",
        ),
        pytest.param(
            {"expression": "x - x", "functions": ["x"], "functional": {**INTEGRAL, "to": "1"}},
            Problem("nothing-varied", "/expression", parameters={"names": "x"}),
            id="what cancels",
        ),
        pytest.param(
            {"expression": "sqrt(-1 - x^2)", "functions": ["x"]},
            Problem("value-undefined", "/expression"),
            id="real nowhere",
        ),
        pytest.param({"expression": "x = 1", "functions": ["x"]}, Problem("not-scalar", "/expression"), id="equation"),
        pytest.param(
            {"expression": "delta(x)", "functions": ["x"]}, Problem("not-scalar", "/expression"), id="a variation"
        ),
        pytest.param(
            {"expression": "diff(x^2, x)", "functions": ["x"]},
            Problem("derivative-in-scene", "/expression"),
            id="derivative",
        ),
        pytest.param(
            {"expression": "sign(x)", "functions": ["x"]},
            Problem("not-differentiable", "/expression"),
            id="not differentiable",
        ),
        pytest.param(
            {"expression": "x/0", "functions": ["x"]},
            Problem("division-by-zero", "/expression", 2, 1, {}),
            id="division by zero",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x", "sin"]},
            Problem("reserved-name", "/functions/1", parameters={"name": "sin"}),
            id="reserved function",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "parameters": ["x"]},
            Problem("duplicate-name", "/parameters/0", parameters={"name": "x"}),
            id="a name twice",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "parameters": ["1a"]},
            Problem("malformed-name", "/parameters/0", parameters={"name": "1a"}),
            id="malformed parameter",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x", "y"], "direction": ["v"]},
            Problem("direction-count", "/direction", parameters={"functions": 2, "found": 1}),
            id="too few directions",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "direction": ["x"]},
            Problem("duplicate-name", "/direction/0", parameters={"name": "x"}),
            id="direction of the same name",
        ),
        pytest.param(
            {"expression": "x + dot(ddot(x))", "functions": ["x"], "functional": {**INTEGRAL, "to": "1"}},
            Problem("integrand-order", "/expression", 4, 12, {"name": "x"}),
            id="integrand with a third rate",
        ),
        pytest.param(
            {"expression": "[x, x]", "functions": ["x"], "functional": {**INTEGRAL, "to": "1"}},
            Problem("not-scalar", "/expression"),
            id="integral of a vector",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "functional": {**INTEGRAL, "to": "0"}},
            Problem("empty-interval", "/functional/to"),
            id="empty interval",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "functional": {**INTEGRAL, "to": "2*t"}},
            Problem("instant-not-constant", "/functional/to", parameters={"name": "t"}),
            id="end that moves",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "functional": {"kind": "value", "at": "x"}},
            Problem("instant-not-constant", "/functional/at", parameters={"name": "x"}),
            id="instant that depends on a function",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "include": ["quotient"]},
            Problem("missing-field", "/numeric", parameters={"field": "numeric"}),
            id="quotient without functions",
        ),
        pytest.param(
            {"expression": "x", "functions": ["x"], "include": ["quotient"], "numeric": {**NUMERIC, "direction": {}}},
            Problem("missing-field", "/numeric/direction/x", parameters={"field": "x"}),
            id="no direction",
        ),
        pytest.param(
            {"expression": "l*x", "functions": ["x"], "parameters": ["l"], "include": ["quotient"], "numeric": NUMERIC},
            Problem("missing-field", "/numeric/parameters/l", parameters={"field": "l"}),
            id="parameter without value",
        ),
        pytest.param(
            {"expression": "log(x)", "functions": ["x"], "include": ["quotient"], "numeric": {**NUMERIC, "t": 0.0}},
            Problem("value-undefined", "/numeric"),
            id="no value there",
        ),
        pytest.param(
            {"expression": "[x, x]", "functions": ["x"], "include": ["quotient"], "numeric": NUMERIC},
            Problem("not-scalar", "/expression"),
            id="quotient of a vector",
        ),
    ],
)
def test_wrong_input(document: dict, problem: Problem) -> None:
    assert problems(**document) == (problem,)


def plain_texts(part: object) -> Iterator[str]:
    if isinstance(part, dict):
        yield from (text for key, text in part.items() if key == "plain")
        for value in part.values():
            yield from plain_texts(value)
    elif isinstance(part, list):
        for value in part:
            yield from plain_texts(value)


@pytest.mark.parametrize(
    "integrand", ["E*ddot(w)^2/2 - q*w", "w*dot(w)*ddot(w)^2", "sqrt(1 + ddot(w)^2)", "ddot(w)^3*t"]
)
def test_answers_with_high_rates_are_read_back(integrand: str) -> None:
    names = Names((Symbol("w", "coordinate"), Symbol("E", "parameter"), Symbol("q", "parameter")))
    functional = {"kind": "integral", "from": "0", "to": "1", "ends": "free"}
    asked = {"expression": integrand, "functions": ["w"], "parameters": ["E", "q"], "functional": functional}
    texts = list(plain_texts(vary(**asked)["result"]))
    assert any("dddot(w)" in text for text in texts)
    for text in texts:
        left = text.removesuffix(" = 0")
        assert plain(to_sympy(parse(left, names).tree, Symbols(names))) == left
