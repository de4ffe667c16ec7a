"""Every spelling of a symbol resolves to it, and to nothing else."""

from __future__ import annotations

import pytest
from tests.language.scene_names import DOUBLE, NAMES, SYMBOLS, problem_of

from deltaq.errors import InputError, Problem
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import Syntax, parse
from deltaq.language.plain_printer import plain
from deltaq.language.spelling import in_unicode
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy

SPELLINGS = [
    ("phi", "phi"), ("φ", "phi"), ("ϕ", "phi"), ("varphi", "phi"), (r"\varphi", "phi"), (r"\phi", "phi"),
    ("q_2", "phi"), ("q2", "phi"), ("q_{2}", "phi"), ("q₂", "phi"), ("y", "y"), ("q_1", "y"), ("x", "x"), ("q_3", "x"),
    (r"\ell", "l"), ("ℓ", "l"), ("ell", "l"), ("y_0", "y0"), ("y_{0}", "y0"), (r"\omega", "omega"), ("ω", "omega"),
    ("t", "t"), ("pi", "pi"), ("π", "pi"), ("q_4", None), ("Phi", None), ("", None), ("r", None),
]  # fmt: skip


@pytest.mark.parametrize(("spelling", "name"), SPELLINGS)
def test_resolves(spelling: str, name: str | None) -> None:
    found = NAMES.resolve(spelling)
    assert (found.name if found else None) == name


def test_a_name_beats_a_number() -> None:
    names = Names((Symbol("phi", "coordinate"), Symbol("q1", "parameter")))
    found = names.resolve("q_1")
    assert found is not None
    assert found.name == "q1"


def test_letters_that_the_scene_tells_apart_stay_apart() -> None:
    names = Names((Symbol("phi", "coordinate"), Symbol("varphi", "coordinate"), Symbol("l", "parameter")))
    assert [[s.name for s in names.candidates(spelling)] for spelling in ("phi", "varphi", r"\phi")] == [
        ["phi"],
        ["varphi"],
        ["phi"],
    ]


def test_letters_that_are_written_alike_are_ambiguous() -> None:
    names = Names((Symbol("phi", "coordinate"), Symbol("varphi", "coordinate")))
    assert [s.name for s in names.candidates(r"\varphi")] == ["phi", "varphi"]
    assert names.resolve(r"\varphi") is None


def test_one_latex_for_two_symbols_is_ambiguous() -> None:
    names = Names((Symbol("s1", "coordinate", "s"), Symbol("s2", "coordinate", "s")))
    assert names.resolve("s") is None
    wanted = Problem("ambiguous-name", "", 0, 1, {"text": "s", "first": "s1", "second": "s2"})
    assert problem_of("s", names=names) == wanted


def test_a_word_and_a_product_are_ambiguous_in_latex() -> None:
    names = Names(tuple(Symbol(n, "parameter") for n in ("m", "l", "ml")))
    wanted = Problem("ambiguous-product", "", 0, 2, {"text": "ml", "first": "m*l", "second": "ml"})
    assert problem_of("ml", "latex", names) == wanted


def test_an_index_belongs_to_the_last_letter_or_to_the_word() -> None:
    names = Names(tuple(Symbol(n, "parameter") for n in ("m", "l_1", "ml_1")))
    wanted = Problem("ambiguous-product", "", 1, 4, {"text": "ml_1", "first": "m*l_1", "second": "ml_1"})
    assert problem_of("2ml_1", "latex", names) == wanted


def test_of_a_long_word_the_beginning_is_told() -> None:
    problem = problem_of("x + " + "z" * 45)
    assert (problem.code, problem.offset, problem.length, problem.parameters["name"]) == (
        "unknown-name",
        4,
        45,
        "z" * 40,
    )


def test_two_ways_to_split_a_word_are_ambiguous() -> None:
    names = Names(tuple(Symbol(n, "parameter") for n in ("a", "b", "ab", "bc", "c")))
    wanted = Problem("ambiguous-product", "", 0, 3, {"text": "abc", "first": "a*b*c", "second": "a*bc"})
    assert problem_of("abc", names=names) == wanted


def test_coordinates_keep_their_order() -> None:
    assert NAMES.coordinates == ("y", "phi", "x")


BAD_NAMES = [
    pytest.param("t", "reserved-name", id="time"),
    pytest.param("pi", "reserved-name", id="pi"),
    pytest.param("sin", "reserved-name", id="function"),
    pytest.param("delta", "reserved-name", id="operator"),
    pytest.param("1x", "malformed-name", id="digit first"),
    pytest.param("x y", "malformed-name", id="space"),
    pytest.param("φ", "malformed-name", id="not ASCII"),
    pytest.param("", "malformed-name", id="empty"),
    pytest.param("x" * 33, "malformed-name", id="too long"),
    pytest.param("x\n", "malformed-name", id="line break"),
    pytest.param("__import__", "malformed-name", id="underscore first"),
]


@pytest.mark.parametrize(("name", "code"), BAD_NAMES)
def test_bad_names_are_refused(name: str, code: str) -> None:
    with pytest.raises(InputError) as caught:
        Names((Symbol(name, "parameter"),))
    assert caught.value.problems == (Problem(code, parameters={"name": name}),)


def test_duplicate_names_are_refused() -> None:
    with pytest.raises(InputError) as caught:
        Names((Symbol("x", "parameter"), Symbol("x", "coordinate")))
    assert caught.value.problems == (Problem("duplicate-name", parameters={"name": "x"}),)


def test_too_many_names_are_refused() -> None:
    with pytest.raises(InputError) as caught:
        Names(tuple(Symbol(f"x{i}", "parameter") for i in range(201)))
    assert caught.value.problems == (Problem("too-many-names", parameters={"count": 201, "limit": 200}),)


LATEX = [
    ("phi", r"\varphi"), ("phi1", r"\varphi_{1}"), ("y_0", "y_{0}"), ("y0", "y_{0}"), ("ell", r"\ell"), ("m", "m"),
    ("omega_max", r"\omega_{\mathrm{max}}"), ("mass", r"\mathrm{mass}"), ("q_i_1", "q_{i,1}"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "latex"), LATEX)
def test_latex_of_a_name(name: str, latex: str) -> None:
    assert Symbol(name, "parameter").typeset == latex


@pytest.mark.parametrize(
    ("latex", "text"),
    [(r"\varphi_{1}", "φ₁"), (r"\omega", "ω"), ("q_2", "q₂"), (r"\ell", "ℓ"), ("c_d", "c_d"), (r"\vartheta", "ϑ")],
)
def test_symbol_in_a_line_of_text(latex: str, text: str) -> None:
    assert in_unicode(latex) == text


def test_what_is_known_of_a_symbol() -> None:
    x, rate, varied, changed = (
        SYMBOLS.name("x"),
        SYMBOLS.rate("x"),
        SYMBOLS.variation("x", 1),
        SYMBOLS.differential("x"),
    )
    assert [str(symbol) for symbol in (x, rate, varied, changed)] == ["x", "dot(x)", "dot(delta(x))", "d(x)"]
    assert [symbol.is_real for symbol in (x, rate, varied, changed, SYMBOLS.time, SYMBOLS.name("unknown"))] == [
        True
    ] * 6
    assert [SYMBOLS.name(name).is_positive for name in ("m", "a", "x", "pi")] == [True, None, None, True]
    assert SYMBOLS.rate("x") == SYMBOLS.rate("x", 1)
    assert str(SYMBOLS.variation("x")) == "delta(x)"


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (r"\dot{φ}_1", "dot(phi1)"),
        (r"\ddot{φ}_2^2", "ddot(phi2)^2"),
        (r"\dot{\varphi}_1", "dot(phi1)"),
        ("φ_1", "phi1"),
    ],
)
def test_an_index_may_stand_outside_an_accent(text: str, meant: str) -> None:
    assert plain(to_sympy(parse(text, DOUBLE, "latex").tree, Symbols(DOUBLE))) == meant


D = Names((Symbol("x", "coordinate"), Symbol("d", "parameter", positive=True), Symbol("m", "parameter", positive=True)))


@pytest.mark.parametrize(
    ("text", "syntax", "meant"),
    [
        ("d*dot(x)", "plain", "d*dot(x)"),
        ("2 d x", "plain", "2*d*x"),
        ("d(x + 1)", "plain", "d*(x + 1)"),
        ("md", "plain", "m*d"),
        ("d(x)", "plain", "d(x)"),
        ("dx", "plain", "d(x)"),
        ("d/dt (d*x)", "plain", "d*dot(x)"),
        (r"d \dot{x}", "latex", "d*dot(x)"),
        (r"m d^2", "latex", "m*d^2"),
        (r"dx", "latex", "d(x)"),
        (r"\mathrm{d}x", "latex", "d(x)"),
        (r"\frac{d}{dt}(d \, x)", "latex", "d*dot(x)"),
    ],
)
def test_d_may_be_a_name_beside_the_differential(text: str, syntax: Syntax, meant: str) -> None:
    assert plain(to_sympy(parse(text, D, syntax).tree, Symbols(D))) == meant
