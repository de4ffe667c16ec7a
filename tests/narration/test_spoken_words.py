"""What is said of each kind of expression, symbol and formula, word for word as a lecturer would read it aloud."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest
import sympy as sp

from deltaq.contract.reading import read
from deltaq.contract.variation import VariationRequest
from deltaq.derivation.formula import (
    AtEquilibrium,
    AtTime,
    Boundary,
    Bounds,
    Called,
    Determinant,
    Directional,
    Dot,
    Each,
    Equation,
    Explicit,
    Formula,
    Gateaux,
    Given,
    Inserted,
    Integral,
    Jacobian,
    LimitOfQuotient,
    MassIntegral,
    MatrixTimes,
    Named,
    Partial,
    Plus,
    Power,
    Quantity,
    Rate,
    Ratio,
    Rounded,
    Shifted,
    Stack,
    Substituted,
    Summed,
    Term,
    Times,
    minus,
)
from deltaq.derivation.step import Relation
from deltaq.derivation.system import System
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.spoken_printer import ATOM, POWER, PREFIX, PRODUCT, QUOTIENT, SUM, SpokenPrinter
from deltaq.language.spoken_symbols import SpokenSymbols, SymbolReader
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.library import load_scene
from deltaq.narration.derive import notation_of
from deltaq.narration.marks import unmarked
from deltaq.narration.prose import CatalogText
from deltaq.narration.speech import Speech, speech_of, vocabulary
from deltaq.narration.variation_request import read_question
from deltaq.narration.vary import _notation as notation_of_variation

NAMES = Names(
    (
        *(Symbol(name, "coordinate") for name in ("phi", "x")),
        *(Symbol(name, "parameter", positive=True) for name in ("m", "l", "g", "k", "a", "d", "c_d", "omega")),
        Symbol("u", "parameter", "v^{a}", positive=True),
    )
)
WITH_E = Names((*NAMES.symbols, Symbol("e", "parameter", positive=True)))
X, PHI, M, L, K = Symbols(NAMES).name("x"), *(Symbols(NAMES).name(name) for name in ("phi", "m", "l", "k"))
ROOT = X**2 + L**2


def said(value: object, binding: int = 0, **options: object) -> str:
    return SpokenPrinter(SpokenSymbols(NAMES, vocabulary("en")), **options).text(value, binding)  # type: ignore[arg-type]


# Where the last word of a row is a closing bracket or an end, what it stands in would reach too far without it.
EXPRESSIONS = [
    ("0", "zero"),
    ("12*x", "twelve x"),
    ("13*x", "13 times x"),
    ("-2*x", "minus two x"),
    ("3/8", "three eighths"),
    ("12/11", "twelve elevenths"),
    ("1/12", "one twelfth"),
    ("1/13", "the fraction one over 13, end of fraction"),
    ("13/12", "the fraction 13 over twelve, end of fraction"),
    ("1/20", "0.05"),
    ("m*x/13", "the fraction one over 13, end of fraction times m x"),
    ("13*m*x/12", "the fraction 13 over twelve, end of fraction times m x"),
    ("-13*m*x/12", "minus the fraction 13 over twelve, end of fraction times m x"),
    ("m*x/12", "one twelfth m x"),
    ("12*m*x/11", "twelve elevenths m x"),
    ("3*x/4", "three quarters x"),
    ("sin(x)/2", "one half times sine of x"),
    ("m*(x + l)/2", "one half m times open bracket x plus l close bracket"),
    ("pi/2", "pi over two"),
    ("3*pi/2", "three halves times pi"),
    ("x/pi", "x over pi"),
    ("1/x", "one over x"),
    ("2/x", "two over x"),
    ("1/x^2", "the fraction one over x squared, end of fraction"),
    ("1/sqrt(x)", "the fraction one over the square root of x, end of fraction"),
    ("m*x/(2*k)", "the fraction m x over two k, end of fraction"),
    ("-x/k", "minus x over k"),
    ("(x/k + l)/m", "the fraction the fraction x over k, end of fraction, plus l over m, end of fraction"),
    ("m/(x/k - l)", "the fraction m over the fraction x over k, end of fraction, minus l, end of fraction"),
    ("delta(phi)/2", "delta phi over two"),
    ("3*delta(phi)/4", "three quarters times delta phi"),
    ("m*delta(phi)", "m times delta phi"),
    ("2*delta(phi)", "two times delta phi"),
    ("delta(phi)^2", "open bracket delta phi close bracket squared"),
    ("sin(d(x))", "sine of open bracket d x close bracket"),
    ("dot(phi)^2", "phi dot squared"),
    ("sin(ddot(phi))", "sine of phi double dot"),
    ("m*a", "m times a"),
    ("m*d", "m times d"),
    ("a*x", "a times x"),
    ("m*c_d", "m c sub d"),
    ("c_d*x", "c sub d times x"),
    ("u*x", "v upper a times x"),
    ("m*x^3", "m times x cubed"),
    ("x^3*dot(x)", "x cubed times x dot"),
    ("x^2*dot(x)", "x squared x dot"),
    ("m*sqrt(k)", "m times the square root of k"),
    ("x^(2/3)", "x to the power of two thirds"),
    ("x^4", "x to the power of four"),
    ("sqrt(2)", "the square root of two"),
    ("sqrt(x + l)", "the square root of x plus l, end of root"),
    ("sqrt(phi*x)", "the square root of phi x, end of root"),
    ("sqrt(sqrt(sqrt(k) + l) + m)",
     ("the square root of m, plus the square root of the square root of k, end of root, plus l, end of root,"
     " end of root")),
    ("sqrt(sin(x))", "the square root of sine of x, end of root"),
    ("sin(x)^(3/2)", "open bracket sine of x close bracket to the power of three halves"),
    ("sin(x)^4", "sine to the power of four of x"),
    ("sin(sin(x)^2)", "sine of open bracket sine squared of x close bracket"),
    ("sin(x/2)", "sine of the fraction x over two, end of fraction"),
    ("sin(m*g/k)", "sine of the fraction m g over k, end of fraction"),
    ("exp(-x/k)", "e to the power of minus the fraction x over k, end of fraction"),
    ("exp(2)", "e to the power of two"),
    ("exp(-2)", "e to the power of minus two"),
    ("exp(x)", "e to the power of x"),
    ("exp(x)*m", "m times e to the power of x"),
    ("exp(1)", "e"),
    ("2*exp(1)", "two times e"),
    ("exp(exp(x))", "e to the power of open bracket e to the power of x close bracket"),
    ("sqrt(exp(x) + 1)", "the square root of one, plus e to the power of x, end of root"),
    ("atan2(x, l)", "arc tangent of the fraction x over l, end of fraction"),
    ("atan2(x, phi)", "two-argument arc tangent of open bracket x and phi close bracket"),
    ("abs(x + l)", "absolute value of open bracket x plus l close bracket"),
    ("m*l*x*phi + g", "m l phi x plus g"),
    ("m*l*x + g", "m l x plus g"),
    ("x*m - l*m", "m x minus m l"),
    ("-x - l", "minus x minus l"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "words"), EXPRESSIONS, ids=[text for text, _ in EXPRESSIONS])
def test_an_expression(text: str, words: str) -> None:
    assert said(to_sympy(parse(text, NAMES, "plain").tree, Symbols(NAMES))) == words


def test_a_power_of_a_symbol_with_a_minus_is_no_fraction() -> None:
    assert said(X ** (-K)) == "x to the power of open bracket minus k close bracket"
    assert said(X ** (K / 2)) == "x to the power of the fraction k over two, end of fraction"


HALF = sp.Rational(1, 2)


@pytest.mark.parametrize(
    ("value", "loosest"),
    [
        (M + L, SUM),
        (X / K, QUOTIENT),
        (M * X, PRODUCT),
        (HALF, PRODUCT),
        (sp.Integer(-2), PRODUCT),
        (X**2, POWER),
        (sp.exp(X), POWER),
        (sp.sin(X), PREFIX),
        (sp.sin(X) ** 2, PREFIX),
        (sp.sqrt(X), PREFIX),
        (sp.Symbol("delta(x)", real=True), PREFIX),
        (sp.Symbol("dot(x)", real=True), ATOM),
        (sp.Integer(2), ATOM),
        (sp.Float("0.7"), ATOM),
        (sp.pi, ATOM),
        (sp.sqrt(X + L), ATOM),
        (M * X / K, ATOM),
    ],
    ids=str,
)
def test_what_binds_more_loosely_than_its_place_gets_brackets_and_nothing_else_does(
    value: sp.Expr, loosest: int
) -> None:
    bare = said(value)
    enclosed = "the fraction x over k, end of fraction" if loosest == QUOTIENT else f"open bracket {bare} close bracket"
    assert [said(value, binding) for binding in range(ATOM + 1)] == [
        bare if binding <= loosest else enclosed for binding in range(ATOM + 1)
    ]


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (sp.sqrt(ROOT), "s"),
        (ROOT, "s squared"),
        (ROOT ** sp.Rational(3, 2), "s cubed"),
        (ROOT**2, "s to the power of four"),
        (1 / sp.sqrt(ROOT), "one over s"),
        (X / sp.sqrt(ROOT), "x over s"),
        (X / ROOT, "the fraction x over s squared, end of fraction"),
        (ROOT / M, "the fraction s squared over m, end of fraction"),
        (sp.sin(sp.sqrt(ROOT)), "sine of s"),
        (sp.sin(ROOT), "sine of open bracket s squared close bracket"),
        (ROOT ** sp.Rational(1, 3), "open bracket s squared close bracket to the power of one third"),
        (X**2 + M**2, "x squared plus m squared"),
    ],
    ids=str,
)
def test_a_root_that_has_a_letter_is_said_by_it(value: sp.Expr, words: str) -> None:
    assert said(value, roots={ROOT: "s"}) == words
    assert said(sp.sqrt(X + L), roots={ROOT: "s"}) == said(sp.sqrt(X + L))


@pytest.mark.parametrize(
    ("value", "decimals", "words"),
    [
        (sp.Rational(7, 10) * X + HALF * M * X, None, "0.7 times x, plus one half m x"),
        (sp.Rational(7, 10) * X, True, "0.7 times x"),
        (sp.Rational(7, 5) * X, True, "1.4 times x"),
        (sp.Rational(7, 5) * M * X, None, "seven fifths m x"),
        (sp.Rational(1, 10) * M * X, False, "one tenth m x"),
        (HALF * M * X, True, "one half m x"),
        (sp.Float("-0.25"), None, "minus 0.25"),
        (sp.Float("2.0") * X, None, "two x"),
    ],
)
def test_decimals_are_said_where_they_are_written(value: sp.Expr, decimals: bool | None, words: str) -> None:
    assert said(value, decimals=decimals) == words


def test_a_decimal_and_a_fraction_said_by_the_same_printer_stay_what_they_are() -> None:
    printer = SpokenPrinter(SpokenSymbols(NAMES, vocabulary("de")), decimals=True)
    assert [printer.text(value) for value in (sp.Rational(7, 5) * X, X / 3, sp.Rational(7, 5) * X)] == [
        "1,4 mal x", "x durch drei", "1,4 mal x",
    ]  # fmt: skip


def test_vectors_matrices_and_several_values() -> None:
    assert (
        said(sp.ImmutableMatrix([X, M + L]))
        == "the vector with component one: x, component two: m plus l, end of vector"
    )
    assert (
        said(sp.ImmutableMatrix([[X, 0], [1, M]]))
        == "the matrix with row one: x, next zero, row two: one, next m, end of matrix"
    )
    assert said(sp.ImmutableMatrix([[X, M]])) == "the matrix with row one: x, next m, end of matrix"
    assert said(sp.Tuple(X, M)) == "x. m"
    assert said(sp.Eq(X, M + L)) == "x equals m plus l"
    printer = SpokenPrinter(SpokenSymbols(NAMES, vocabulary("en")))
    assert printer.summands(L - X) == ["l", "minus x"]
    assert printer.summands(M * X) == ["m x"]


def test_e_is_a_function_where_a_parameter_is_called_so() -> None:
    printer = SpokenPrinter(SpokenSymbols(WITH_E, vocabulary("en")))
    assert printer.text(sp.exp(X)) == "exponential function of x"
    assert printer.text(sp.E) == "exponential function of one"
    assert printer.text(M * Symbols(WITH_E).name("e")) == "m times e"


SYMBOLS = [
    (r"\ell", "l"),
    (r"\varphi", "phi"),
    (r"\mu", "mu"),
    (r"\Omega", "capital omega"),
    (r"\Theta", "theta"),
    ("F", "capital F"),
    ("W", "W"),
    (r"\dot{\varphi}_{1}", "phi dot one"),
    (r"\ddot x", "x double dot"),
    (r"\dddot{x}", "x triple dot"),
    (r"\hat{e}", "e hat"),
    (r"\bar x_1", "x bar one"),
    (r"\tilde{x}", "x tilde"),
    (r"\vec r", "vector r"),
    (r"\delta\mathbf{r}_{\text{bob}}", "delta vector r sub bob"),
    (r"\mathbf{q}", "q"),
    (r"\mathbf{M}", "matrix capital M"),
    (r"\mathbf{D}_0", "matrix D zero"),
    (r"\boldsymbol{r}", "vector r"),
    (r"\mathrm{d}x", "d x"),
    (r"\mathcal{P}", "script P"),
    (r"\mathcal P_1", "script P one"),
    ("m_{12}", "m twelve"),
    ("m_{20}", "m 20"),
    ("m_{123}", "m 1 2 3"),
    ("m_1", "m one"),
    ("m_ 1", "m one"),
    (r"\mathrm dx", "d x"),
    (r"\mathrm{d}xy", "d x y"),
    (r"x_{\pm}", "x sub plus or minus"),
    (r"x_{1\dots}", "x sub one and so on"),
    (r"\Xi", "capital xi"),
    (r"\Psi", "psi"),
    (r"\Pr", "Pr"),
    ("m_{1,2}", "m sub one comma two"),
    ("m_{2s}", "m sub two s"),
    ("m_k", "m sub k"),
    ("m_{i-1}", "m sub i minus one"),
    (r"m_{\text{a,b}}", "m sub a b"),
    (r"m_{\text{rod}}", "m sub rod"),
    ("m_{rod}", "m sub r o d"),
    ("x^2", "x squared"),
    ("x^{2}_{1}", "x squared one"),
    ("x^3", "x upper three"),
    ("x^{*}", "x upper star"),
    ("x_2", "x two"),
    ("x'", "x prime"),
    (r"x_{1}\,y", "x one y"),
    (r"p_{\dot x}", "p sub x dot"),
]


@pytest.mark.parametrize(("latex", "words"), SYMBOLS, ids=[latex for latex, _ in SYMBOLS])
def test_a_symbol_is_said_by_its_latex(latex: str, words: str) -> None:
    letters = frozenset({"f", "omega", "xi", "r", "x", "m", "M", "D"})
    assert SymbolReader(vocabulary("en"), letters, letters).words(latex) == words


def test_capitals_and_vectors_are_told_apart_only_where_the_small_and_the_plain_ones_are_there() -> None:
    alone = SymbolReader(vocabulary("en"))
    assert [alone.words(latex) for latex in (r"\Omega", "F", r"\mathbf{r}", r"\mathbf{M}")] == ["omega", "F", "r", "M"]
    names = Names(
        (
            Symbol("F", "parameter"),
            Symbol("Omega", "parameter"),
            Symbol("omega", "parameter"),
            Symbol("r", "coordinate"),
            Symbol("u", "parameter", r"\mathbf{u}"),
        )
    )
    words = SpokenSymbols(names, vocabulary("de"))
    assert [words.symbol(name) for name in ("F", "Omega", "omega", "ddot(r)")] == [
        "groß F", "groß omega", "omega", "r Punkt Punkt",
    ]  # fmt: skip
    assert words.reader.words(r"\mathbf{r}") == "Vektor r"
    assert [words.reader.words(latex) for latex in (r"\mathbf{x}", r"\mathbf{u}")] == ["x", "u"]


@pytest.mark.parametrize(
    ("name", "words", "atom"),
    [
        ("phi", "phi", True),
        ("dot(phi)", "phi dot", True),
        ("dddot(x)", "x triple dot", True),
        ("ddddot(x)", "x fourfold dot", True),
        ("d(x)", "d x", False),
        ("delta(x)", "delta x", False),
        ("dot(delta(x))", "delta x dot", False),
        ("ddot(delta(x))", "delta x double dot", False),
        ("unknown_1", "unknown one", True),
    ],
)
def test_a_symbol_is_said_by_its_name(name: str, words: str, atom: bool) -> None:
    symbols = SpokenSymbols(NAMES, vocabulary("en"))
    assert (symbols.symbol(name), symbols.is_atom(name)) == (words, atom)


def test_german_nouns_stand_in_the_case_that_the_word_before_asks_for() -> None:
    words = vocabulary("de")
    assert words.say("of", "Sinus", "Wurzel aus x") == "Sinus von der Wurzel aus x"
    assert words.say("of", "Sinus", "Bruch x durch k") == "Sinus vom Bruch x durch k"
    assert (
        words.say("integral", "a", "b", "Bruch x durch k", "x") == "Integral von a bis b über den Bruch x durch k d x"
    )
    assert (
        words.say("equals", "zweite Ableitung nach der Zeit von x")
        == "gleich der zweiten Ableitung nach der Zeit von x"
    )
    assert words.say("plus", "Wurzel aus x") == "plus Wurzel aus x"
    assert words.whole(12) == "zwölf"
    assert words.whole(13) == "13"


# Formulas of a scene with one body, "bob", at r(φ) on a rod of length ℓ; its coordinates are called q₁ …

R = Quantity("position", "bob")
E_KIN, V_POT, L_FUN = Quantity("kinetic-energy"), Quantity("potential-energy"), Quantity("lagrangian")
DPHI, T, H, S = (sp.Symbol(name, real=True) for name in ("dot(phi)", "t", "h", "s"))
POSITION = Named(R, sp.ImmutableMatrix([L * sp.sin(PHI), L * sp.cos(PHI)]), (PHI,))
VELOCITY = Named(Quantity("velocity", "bob"), sp.ImmutableMatrix([L * DPHI, 0]))
KINETIC, POTENTIAL = Named(E_KIN, M * DPHI**2 / 2), Named(V_POT, M * X)
SUM_OF_BOTH = Plus((Term(KINETIC), minus(POTENTIAL)))
LAGRANGIAN = Named(L_FUN, M * X, (PHI, DPHI))
MODE = Named(Quantity("mode", "1"), sp.ImmutableMatrix([1]))
MATRIX = Named(Quantity("mass-matrix"), sp.ImmutableMatrix([[M]]))
FORCING = Named(Quantity("forcing-vector"), sp.ImmutableMatrix([X]))
ACCELERATIONS = Named(Quantity("accelerations-vector"), sp.ImmutableMatrix([X]))


def e(value: object) -> Explicit:
    return Explicit(sp.sympify(value))


FORMULAS = [
    ("name", KINETIC, "E"),
    ("name with an argument", POSITION, "r of phi"),
    ("name with two arguments", LAGRANGIAN, "capital L of phi and phi dot"),
    ("name with more than symbols", Named(R, X, (PHI + X, PHI)), "r of open bracket phi plus x and phi close bracket"),
    ("name with a sum", Named(R, X, (PHI + X,)), "r of open bracket phi plus x close bracket"),
    ("value", e(M * X + L), "m x plus l"),
    ("difference", SUM_OF_BOTH, "E minus capital V"),
    ("sum whose first is subtracted", Plus((minus(KINETIC), Term(POTENTIAL))), "minus E plus capital V"),
    (
        "subtracted sum",
        Plus((Term(KINETIC), minus(SUM_OF_BOTH))),
        "E, minus open bracket E minus capital V close bracket",
    ),
    ("added sum", Plus((Term(KINETIC), Term(Plus((minus(KINETIC), Term(POTENTIAL)))))), "E minus E plus capital V"),
    ("added sum of values", Plus((Term(KINETIC), Term(e(L - X)))), "E plus l minus x"),
    ("subtracted sum of values", Plus((minus(e(L - X)),)), "minus open bracket l minus x close bracket"),
    ("subtracted negative value", Plus((Term(KINETIC), minus(e(-M * X)))), "E plus m x"),
    ("added negative value", Plus((Term(KINETIC), Term(e(-M * X)))), "E minus m x"),
    ("terms that are zero are left out", Plus((Term(e(0)), Term(KINETIC), Term(e(0)))), "E"),
    ("nothing but zero", Plus((Term(e(0)),)), "zero"),
    ("equation", Equation(SUM_OF_BOTH, e(L - X)), "E minus capital V equals l minus x"),
    ("long equation", Equation(KINETIC, e(M * L**2 * DPHI * X)), "E, equals m l squared x phi dot"),
    ("product", Times((e(HALF), KINETIC)), "one half times E"),
    ("product with a sum", Times((e(M), SUM_OF_BOTH)), "m times open bracket E minus capital V close bracket"),
    ("name twice", Times((e(HALF), VELOCITY, VELOCITY)), "one half times v squared"),
    ("name thrice", Times((VELOCITY,) * 3), "v cubed"),
    ("name four times", Times((VELOCITY,) * 4), "v to the power of four"),
    ("value twice", Times((e(M), e(M))), "m times m"),
    ("scalar product", Dot(VELOCITY, POSITION), "the scalar product of v with r of phi"),
    ("product of scalar products", Times((Dot(VELOCITY, VELOCITY), e(M))), "the scalar product of v with v times m"),
    ("derivative of a name", Partial(LAGRANGIAN, PHI), "the partial derivative of capital L with respect to phi"),
    (
        "derivative of a sum",
        Partial(SUM_OF_BOTH, PHI),
        "the partial derivative of open bracket E minus capital V close bracket with respect to phi",
    ),
    (
        "product of derivatives",
        Times((Partial(LAGRANGIAN, PHI), e(sp.Symbol("delta(phi)", real=True)))),
        "the partial derivative of capital L with respect to phi times delta phi",
    ),
    ("rate", Rate(POSITION), "d by d t of r"),
    (
        "rate of a derivative",
        Rate(Partial(LAGRANGIAN, DPHI)),
        "d by d t of the partial derivative of capital L with respect to phi dot",
    ),
    ("second rate", Rate(Rate(KINETIC)), "the second derivative with respect to t of E"),
    ("rate of a value", Rate(e(M * X)), "d by d t of open bracket m x close bracket"),
    ("variation of a name", Gateaux(KINETIC), "delta E"),
    ("variation of a sum", Gateaux(SUM_OF_BOTH), "delta open bracket E minus capital V close bracket"),
    (
        "variation by its definition",
        Gateaux(POSITION),
        "the derivative at h equal to zero of r of open bracket phi plus h times delta phi close bracket",
    ),
    (
        "variation by its definition, the time frozen",
        Gateaux(Named(R, X, (PHI, T))),
        "the derivative at h equal to zero of r of open bracket phi plus h times delta phi and t close bracket",
    ),
    ("shifted", Shifted(M * X, H), "the derivative at h equal to zero of open bracket m x close bracket"),
    (
        "integral",
        Integral(e(M * S), (Bounds(S, sp.S.Zero, L),)),
        "the integral from zero to l of m s d s",
    ),
    (
        "integral of a sum",
        Integral(SUM_OF_BOTH, (Bounds(S, sp.S.Zero, L),)),
        "the integral from zero to l of open bracket E minus capital V close bracket d s",
    ),
    (
        "integral over two, the last one innermost",
        Integral(KINETIC, (Bounds(S, sp.S.Zero, L), Bounds(X, sp.S.One, M))),
        "the integral from zero to l of the integral from one to m of E d x d s",
    ),
    ("substituted", Substituted(e(M * X), {X: L + M}), "the value of m x for x equal to m plus l, end of value"),
    (
        "two substituted, one of them not there",
        Substituted(e(M * X), {X: L, PHI: M, M: K}),
        "the value of m x for x equal to l and m equal to k, end of value",
    ),
    ("nothing substituted", Substituted(e(M * X), {PHI: L}), "m x"),
    (
        "substituted in what is not written out",
        Substituted(SUM_OF_BOTH, {PHI: L}),
        "the value of E minus capital V for phi equal to l, end of value",
    ),
    (
        "product with nothing substituted",
        Times((e(M), Substituted(SUM_OF_BOTH, {}))),
        "m times open bracket E minus capital V close bracket",
    ),
    ("an instant", AtTime(e(X), sp.S.Zero), "x of zero"),
    ("an instant of what is no symbol", AtTime(e(M * X), L), "the value of m x at time l, end of value"),
    (
        "boundary",
        Boundary(SUM_OF_BOTH, sp.S.Zero, L),
        "the boundary term E minus capital V taken from zero to l, end of boundary term",
    ),
    ("ratio", Ratio(KINETIC, e(M)), "the fraction E over m, end of fraction"),
    (
        "ratio of a sum",
        Ratio(SUM_OF_BOTH, e(M)),
        "the fraction open bracket E minus capital V close bracket over m, end of fraction",
    ),
    (
        "integral over a region",
        MassIntegral(SUM_OF_BOTH, "S", "S", Bounds(S, sp.S.Zero, L), M),
        "the integral over S of open bracket E minus capital V close bracket d S",
    ),
    ("summed", Summed(Times((e(M), KINETIC)), (KINETIC, KINETIC)), "m times E"),
    ("each", Each(Equation(KINETIC, POTENTIAL), (KINETIC,)), "E equals capital V"),
    (
        "column",
        Stack((KINETIC, SUM_OF_BOTH)),
        "the vector with component one: E, component two: E minus capital V, end of vector",
    ),
    ("matrix times vector", MatrixTimes(MATRIX, ACCELERATIONS), "capital M times q double dot"),
    (
        "Jacobian",
        Jacobian(FORCING, (X,), Quantity("coordinates-vector")),
        "the partial derivative of f with respect to q",
    ),
    ("determinant", Determinant(MATRIX), "the determinant of capital M"),
    (
        "determinant of a sum",
        Determinant(Plus((Term(MATRIX), minus(MATRIX)))),
        "the determinant of open bracket capital M minus capital M close bracket",
    ),
    ("power", Power(KINETIC, 2), "E squared"),
    (
        "power of a value with a unit",
        Power(Rounded(sp.Float("2.5"), "m"), 2),
        "open bracket 2.5 metres close bracket squared",
    ),
    (
        "determinant of numbers",
        Determinant(Rounded(sp.ImmutableMatrix([[sp.Float("0.5"), 1]]))),
        "the determinant of the matrix with row one: 0.5, next 1, end of matrix",
    ),
    (
        "power of a variation",
        Power(Named(Quantity("virtual-displacement", "bob"), X), 2),
        "open bracket delta r close bracket squared",
    ),
    ("product with what the scene states", Times((e(M), Given((), M * L))), "m times m l"),
    ("power of a sum", Power(SUM_OF_BOTH, 4), "open bracket E minus capital V close bracket to the power of four"),
    ("mode", MODE, "a one"),
    ("at equilibrium", AtEquilibrium(SUM_OF_BOTH, {}), "the value of E minus capital V in the equilibrium"),
    ("inserted", Inserted(SUM_OF_BOTH, {}), "E minus capital V"),
    (
        "product with what is inserted",
        Times((e(M), Inserted(SUM_OF_BOTH, {}))),
        "m times open bracket E minus capital V close bracket",
    ),
    ("number with a unit", Rounded(sp.Float("3.11729"), "1/s"), "3.117 per second"),
    ("number without", Rounded(sp.Float("-0.25")), "minus 0.25"),
    ("number with an unknown unit", Rounded(sp.Float("2.5"), "kg"), "2.5 kg"),
    ("large number", Rounded(sp.Float("1.5e8"), "m"), "1.5 times ten to the power of eight metres"),
    ("small number", Rounded(sp.Float("-1.5e-8")), "minus 1.5 times ten to the power of minus eight"),
    (
        "vector of numbers",
        Rounded(sp.ImmutableMatrix([sp.Float("0.5"), sp.S.One])),
        "the vector with component one: 0.5, component two: 1, end of vector",
    ),
]


@cache
def of_pendulum(language: str) -> Speech:
    return speech_of(notation_of(System(load_scene("pendulum")), language), language)


@pytest.mark.parametrize(("formula", "words"), [row[1:] for row in FORMULAS], ids=[row[0] for row in FORMULAS])
def test_a_formula(formula: Formula, words: str) -> None:
    assert of_pendulum("en").formula(formula) == words


# Formulas about functions x(t) and ψ(t), with the directions v and w or without names.


@cache
def of_functions(named: bool) -> Speech:
    asked: dict[str, object] = {
        "expression": "l*x + psi",
        "functions": ["x", "psi"],
        "parameters": ["l", "t0"],
        "functional": {"kind": "value", "at": "t0"},
        **({"direction": ["v", "w"]} if named else {}),
    }
    question = read_question(read(VariationRequest, asked))
    return speech_of(notation_of_variation(question, unmarked), "en")


T0, PSI, DX = (sp.Symbol(name, real=True) for name in ("t0", "psi", "dot(x)"))
VX, VDX, VPSI = (sp.Symbol(name, real=True) for name in ("delta(x)", "dot(delta(x))", "delta(psi)"))
ALONG = {X: VX}
CALLED = Called(Quantity("function"), e(L * X), (X,))
OF_BOTH = Called(Quantity("value-functional"), e(X), (X, PSI))
ON_FUNCTIONS = [
    ("value", e(L * X), "l x"),
    ("direction", e(L * VX), "l v"),
    ("rate of a direction", e(VDX**2), "v dot squared"),
    ("second rate of a direction", e(sp.Symbol("ddot(delta(x))", real=True)), "v double dot"),
    ("fourth rate of a function", e(sp.Symbol("ddddot(x)", real=True)), "x fourfold dot"),
    ("another direction", e(VPSI), "w"),
    ("differential", e(sp.Symbol("d(x)", real=True) ** 2), "open bracket d x close bracket squared"),
    ("function of a function", e(sp.sin(X)), "sine of x"),
    ("power", e(X**2), "x squared"),
    ("name", CALLED, "f of x of t"),
    (
        "name, of two",
        Called(Quantity("function"), e(X), (X, PSI)),
        "f of open bracket x of t and psi of t close bracket",
    ),
    ("name of a functional", Called(Quantity("value-functional"), e(X), (X,)), "I sub t zero of x of t"),
    ("name of a functional, of two", OF_BOTH, "I sub t zero of open bracket x of t and psi of t close bracket"),
    ("name that is no function of time", Called(Quantity("integrand"), e(X), (X, DX)), "capital F of x and x dot"),
    ("an instant", AtTime(e(X), T0), "x of t zero"),
    ("an instant of a product", AtTime(e(L * X), T0), "l times x of t zero"),
    ("an instant of a sum", AtTime(e(X + L), T0), "open bracket x of t zero plus l close bracket"),
    ("an instant of what depends on time", AtTime(e(X * T), T0), "t zero times x of t zero"),
    (
        "an instant of a derivative",
        AtTime(Partial(CALLED, X), T0),
        "the value of the partial derivative of f with respect to x at time t zero, end of value",
    ),
    ("an instant of a rate", AtTime(Rate(CALLED), T0), "the value of d by d t of f at time t zero, end of value"),
    ("an instant of a difference", AtTime(Plus((Term(CALLED), minus(e(X)))), T0), "f of x of t, minus x of t zero"),
    (
        "a product with an instant",
        Times((e(L), AtTime(e(X + L), T0))),
        "l times open bracket x of t zero plus l close bracket",
    ),
    ("derivative", Partial(CALLED, X), "the partial derivative of f with respect to x"),
    ("rate", Rate(CALLED), "d by d t of f"),
    ("second rate", Rate(Rate(CALLED)), "the second derivative with respect to t of f of x of t"),
    (
        "along a direction",
        Directional(CALLED, ALONG, H),
        "the derivative at h equal to zero of f of open bracket x of t plus h times v of t close bracket",
    ),
    (
        "along a direction, written out",
        Directional(e(L * X), ALONG, H),
        (
            "the derivative at h equal to zero of open bracket"
            " l times open bracket x plus h times v close bracket close bracket"
        ),
    ),
    (
        "along two directions",
        Directional(OF_BOTH, {X: VX, PSI: VPSI}, H),
        (
            "the derivative at h equal to zero of I sub t zero of open bracket open bracket x of t plus h times v of t"
            " close bracket and open bracket psi of t plus h times w of t close bracket close bracket"
        ),
    ),
    (
        "along a direction and its rate",
        Directional(e(X + DX), {X: VX, DX: VDX}, H),
        (
            "the derivative at h equal to zero of open bracket open bracket x dot plus h times v dot close bracket,"
            " plus open bracket x plus h times v close bracket close bracket"
        ),
    ),
    (
        "integral along a direction",
        Directional(Integral(e(L * X), (Bounds(T, sp.S.Zero, T0),)), ALONG, H),
        (
            "the derivative at h equal to zero of the integral from zero to t zero of"
            " l times open bracket x plus h times v close bracket d t"
        ),
    ),
    (
        "instant along a direction",
        Directional(AtTime(e(X), T0), ALONG, H),
        (
            "the derivative at h equal to zero of open bracket open bracket x of t zero plus h times v of t zero"
            " close bracket close bracket"
        ),
    ),
    (
        "instant of a function of a function along a direction",
        Directional(AtTime(e(sp.sin(X)), T0), ALONG, H),
        (
            "the derivative at h equal to zero of open bracket sine of"
            " open bracket x of t zero plus h times v of t zero close bracket close bracket"
        ),
    ),
    (
        "difference quotient",
        LimitOfQuotient(CALLED, ALONG, H),
        (
            "the limit as h goes to zero of the fraction f of open bracket x of t plus h times v of t close bracket"
            " minus f of x of t over h, end of fraction"
        ),
    ),
    (
        "difference quotient, written out",
        LimitOfQuotient(e(L * X), ALONG, H),
        (
            "the limit as h goes to zero of the fraction l times open bracket x plus h times v close bracket"
            " minus l x over h, end of fraction"
        ),
    ),
]
WITHOUT_NAMES = [
    ("direction", e(L * VX), "l times delta x"),
    ("rate of a direction", e(VDX**2), "open bracket delta x dot close bracket squared"),
    ("a direction at an instant", AtTime(e(VX), T0), "delta x of t zero"),
]


@pytest.mark.parametrize(
    ("formula", "words", "named"),
    [
        pytest.param(formula, words, named, id=f"{name}, {'named' if named else 'not named'}")
        for rows, named in ((ON_FUNCTIONS, True), (WITHOUT_NAMES, False))
        for name, formula, words in rows
    ],
)
def test_a_formula_about_functions(formula: Formula, words: str, named: bool) -> None:
    assert of_functions(named).formula(formula) == words


EQUAL = Relation((KINETIC, SUM_OF_BOTH, e(M * L**2 * DPHI * X)))


@pytest.mark.parametrize(
    ("relations", "where", "pieces"),
    [
        ((EQUAL,), (), ["E ", "equals E, ", "minus capital V, ", "equals m l squared x phi dot"]),
        ((Relation((KINETIC, KINETIC, POTENTIAL)),), (), ["E ", "equals capital V"]),
        ((Relation((KINETIC, POTENTIAL, KINETIC)),), (), ["E ", "equals capital V ", "equals E"]),
        (
            (Relation((KINETIC, e(X)), "≈"), Relation((e(L), e(M), e(L)), "≤")),
            (),
            ["E ", "is approximately x. ", "l ", "is at most m, ", "is at most l"],
        ),
        (
            (Relation((Equation(KINETIC, e(M)), Equation(e(X), e(L - M))), "⇔"),),
            (("s", "x squared"), ("u", "x")),
            [
                "E ",
                "equals m, ",
                "if and only if x ",
                "equals l ",
                "minus m. ",
                "with s ",
                "equals x squared. ",
                "and u ",
                "equals x",
            ],
        ),
        ((), (("s", "x"),), ["with s ", "equals x"]),
        ((Relation((KINETIC, e(M * X * L)), "≠"),), (), ["E ", "is not equal to m l x"]),
        (
            (Relation((Summed(SUM_OF_BOTH, ()), Inserted(SUM_OF_BOTH, {}), Each(e(X), ())), "<"),),
            (),
            ["E ", "minus capital V, ", "is less than x"],
        ),
    ],
)
def test_a_step_is_said_term_by_term(
    relations: tuple[Relation, ...], where: tuple[tuple[str, str], ...], pieces: list[str]
) -> None:
    """The places where terms begin cut what is said into these; pauses are where one needs to draw breath."""
    text, places = of_pendulum("en").spoken(relations, where)
    assert [text[a:b] for a, b in zip([0, *places[1:]], [*places[1:], len(text)], strict=True)] == pieces


def test_expressions_are_said_as_the_notation_writes_them() -> None:
    speech = of_pendulum("en")
    told = replace(speech, typography=replace(speech.typography, roots={ROOT: "s"}, decimals=True))
    assert told.formula(e(sp.sqrt(ROOT) * sp.Rational(7, 5))) == "1.4 times s"
    assert told.formula(e(sp.Rational(7, 5) * M * X)) == "1.4 times m x"


def test_sentences_are_said_with_their_symbols_in_words() -> None:
    speech = of_pendulum("de")
    texts = (CatalogText(r"Es gilt $\dot{\varphi}_1$."), CatalogText(""), CatalogText("$m_2$ ruht"))
    assert speech.sentences(*texts) == "Es gilt phi Punkt eins. m zwei ruht"
    assert speech.equated(L * X) == "l x gleich null"
    assert speech.name("m_1") == "m eins"
    assert speech.rounded(sp.Float("9.8066")) == "9,807"
