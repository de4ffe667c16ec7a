"""The classical problems of the menu: the service's answer against solutions from books and SymPy's equations."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import sympy as sp
from sympy.calculus.euler import euler_equations
from tests.frontend.node import run
from tests.lecture.answers import walk

from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.narration.vary import vary_request

ROOT = Path(__file__).parents[2]
MENU = """
import { EXAMPLES, GROUPS, example } from "./frontend/model/variations/examples.js";
import { requestOf } from "./frontend/model/variations/question.js";
const asked = Object.fromEntries(EXAMPLES.map((id) => [id, requestOf(example(id), "en")]));
console.log(JSON.stringify({ asked, classics: GROUPS.classics }));
"""
T, S = sp.Symbol("t", real=True), sp.Symbol("s", real=True)
DIGITS = 40


@cache
def menu() -> dict[str, Any]:
    done = run("node", "--input-type=module", "--eval", MENU, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@dataclass(frozen=True)
class Known:
    """A solution t(s), x(s) of a book, for these values of the parameters."""

    source: str
    x: Any
    t: Any = S
    values: tuple[tuple[str, Any], ...] = ()
    at: Any = sp.Rational(7, 10)


R = sp.Rational
KNOWN = {
    "length": Known("Gelfand, Fomin, §4, example 1: straight lines", R(1, 3) + R(2, 7) * S),
    "brachistochrone": Known(
        "Gelfand, Fomin, §4, example 2; Goldstein, §2.2: cycloids",
        R(3, 2) * (1 - sp.cos(S)),
        R(3, 2) * (S - sp.sin(S)),
        (("g", R(981, 100)),),
    ),
    "catenary": Known(
        "Gelfand, Fomin, §12; Bolza, §1: catenaries", R(5, 4) * sp.cosh((S - 1) / R(5, 4)) - 2, values=(("lambda", 2),)
    ),
    "soap-film": Known("Goldstein, §2.2, example 2: catenaries", R(5, 4) * sp.cosh((S - 1) / R(5, 4))),
    "sphere": Known(
        "do Carmo, §4.4, example: great circles cot θ = a cos(φ − φ₀)",
        sp.pi / 2 - sp.atan(R(3, 4) * sp.cos(S - 2)),
        values=(("R", R(3, 2)),),
    ),
    "cylinder": Known("Gelfand, Fomin, §9: helices", R(2, 3) * S - 1, values=(("R", R(3, 2)),)),
    "cone": Known(
        "do Carmo, §4.4: straight lines of the unrolled cone, r cos(φ sin α) = d",
        R(3, 2) / sp.cos((S - R(1, 5)) * sp.sin(R(1, 2))),
        values=(("alpha", R(1, 2)),),
    ),
    "fermat": Known(
        "Aki, Richards, Quantitative Seismology, §9.3: circles about the surface where the speed is zero",
        sp.sqrt(4 - (S - 1) ** 2),
        values=(("k", R(3, 2)),),
    ),
    "relativity": Known(
        "Landau, Lifshitz, The Classical Theory of Fields, §20: hyperbolic motion",
        R(3, 4) * 4 / R(1, 2) * (sp.sqrt(1 + (R(1, 2) * S / (R(3, 4) * 2)) ** 2) - 1),
        values=(("m", R(3, 4)), ("c", 2), ("F", R(1, 2)), ("T", 1)),
    ),
    "newton": Known(
        "Newton, Principia, book II, prop. 34, scholium; Goldstine, A History of the Calculus of Variations, §1.2",
        R(1, 3) * (R(3, 4) * S**4 + S**2 - sp.log(S)),
        R(1, 3) * (1 + S**2) ** 2 / S,
    ),
    "dido": Known(
        "Gelfand, Fomin, §12, example 1: circles of radius |λ|",
        1 - sp.sqrt(R(9, 4) - (S - R(1, 5)) ** 2),
        values=(("lambda", R(3, 2)),),
    ),
    "beam": Known(
        "Gere, Timoshenko, Mechanics of Materials, table G-1: cantilever under a uniform load",
        R(2, 3) / (24 * R(5, 2)) * (S**4 - 4 * R(3, 2) * S**3 + 6 * R(3, 2) ** 2 * S**2),
        values=(("EI", R(5, 2)), ("q", R(2, 3)), ("L", R(3, 2))),
    ),
}


@cache
def answer(name: str) -> dict[str, Any]:
    return vary_request(menu()["asked"][name])


def symbols_of(name: str) -> Symbols:
    asked = menu()["asked"][name]
    kinds = (("functions", "coordinate"), ("parameters", "parameter"))
    return Symbols(Names(tuple(Symbol(n, kind) for field, kind in kinds for n in asked[field])))  # type: ignore[arg-type]


def read(name: str, text: str) -> Any:
    """The language has no third and fourth rates; in answers they are dddot(x) and ddddot(x)."""
    symbols = symbols_of(name)
    (function,) = symbols.names.coordinates
    jets = {f"jet{order}": symbols.rate(function, order) for order in (4, 3)}
    for jet, symbol in jets.items():
        text = text.replace(symbol.name, jet)
    names = Names((*symbols.names.symbols, *(Symbol(jet, "parameter") for jet in jets)))
    value = to_sympy(parse(text, names).tree, Symbols(names))
    return value.subs({Symbols(names).name(jet): symbol for jet, symbol in jets.items()})


def along(known: Known, name: str, bend: Any = 0) -> dict[Any, Any]:
    """t, x, ẋ … of the solution at a place, as numbers; `bend` takes it off the solution."""
    (function,) = symbols_of(name).names.coordinates
    symbols = symbols_of(name)
    jet, value = {}, known.x + bend * S**5
    for order in range(5):
        jet[symbols.rate(function, order)] = sp.N(value.subs(S, known.at), DIGITS)
        value = value.diff(S) / sp.diff(known.t, S)
    parameters = {symbols.name(n): sp.sympify(v) for n, v in known.values}
    return {**jet, **parameters, T: sp.N(sp.sympify(known.t).subs(S, known.at), DIGITS)}


def number(expression: Any, point: dict[Any, Any]) -> Any:
    return sp.N(expression.subs(point), DIGITS)


def test_the_menu_has_all_of_them() -> None:
    assert menu()["classics"] == list(KNOWN)
    assert len(KNOWN) == 12


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", menu()["asked"])
def test_every_step_of_every_example_is_verified(name: str) -> None:
    steps = [s for chapter in answer(name)["chapters"] for step in chapter["steps"] for s in walk(step)]
    assert [step["id"] for step in steps if not step["verified"]] == []


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", KNOWN)
def test_the_solution_of_the_book_solves_the_equation(name: str) -> None:
    (equation,) = answer(name)["result"]["euler_lagrange"]
    left = read(name, equation["plain"].removesuffix(" = 0"))
    assert abs(number(left, along(KNOWN[name], name))) < 1e-30
    assert abs(number(left, along(KNOWN[name], name, bend=R(1, 100)))) > 1e-4


@pytest.mark.parametrize("name", KNOWN)
def test_first_integrals_are_constant_along_it(name: str) -> None:
    known, found = KNOWN[name], answer(name)["result"]["first_integrals"]
    assert len(found) == {"length": 2, "cylinder": 2}.get(name, 1)
    for one in found:
        here, there = (
            number(read(name, one["plain"]), along(Known("", known.x, known.t, known.values, at), name))
            for at in (known.at, known.at + R(1, 5))
        )
        assert abs(here - there) < 1e-30
        assert read(name, one["plain"]).free_symbols & along(known, name).keys()


@pytest.mark.parametrize("name", KNOWN)
def test_the_equation_is_that_of_sympy(name: str) -> None:
    """Where the service's equation puts the highest rate, SymPy's holds, and nowhere beside."""
    symbols, asked = symbols_of(name), menu()["asked"][name]
    (function,) = symbols.names.coordinates
    x = sp.Function(function, real=True)(T)
    functions = {symbols.rate(function, n): sp.diff(x, T, n) for n in range(3)}
    ((theirs, _),) = ((e.lhs, e.rhs) for e in euler_equations(read(name, asked["expression"]).subs(functions), x, T))
    theirs = theirs.doit().subs({x.diff(T, n): symbols.rate(function, n) for n in (4, 3, 2, 1)})
    theirs = theirs.subs(x, symbols.name(function))
    ours = read(name, answer(name)["result"]["euler_lagrange"][0]["plain"].removesuffix(" = 0"))
    highest = symbols.rate(function, 4 if name == "beam" else 2)
    point = {s: R(3 + 2 * n, 11 + n) for n, s in enumerate(sorted(ours.free_symbols | theirs.free_symbols, key=str))}
    point |= {symbols.name("c"): sp.Integer(2)} if name == "relativity" else {}
    del point[highest]
    left = ours.subs(point)
    place = sp.N(-left.subs(highest, 0) / left.coeff(highest) if left.is_Add else sp.Integer(0), DIGITS)
    assert abs(number(theirs, point | {highest: place})) < 1e-30
    assert abs(number(theirs, point | {highest: place + 1})) > 1e-4


def holds(name: str, condition: str, at: Any) -> bool:
    known = KNOWN[name]
    left = read(name, condition.removesuffix(" = 0"))
    return bool(abs(number(left, along(Known("", known.x, known.t, known.values, at), name))) < 1e-30)


def test_a_cantilever_has_no_moment_and_no_shear_force_at_its_free_end() -> None:
    terms = answer("beam")["result"]["boundary_terms"]
    assert [(term["order"], term["at"], term["condition"]["plain"]) for term in terms] == [
        (0, ["L"], "dddot(w) = 0"),
        (1, ["L"], "ddot(w) = 0"),
    ]
    assert all(holds("beam", term["condition"]["plain"], R(3, 2)) for term in terms)
    assert not any(holds("beam", term["condition"]["plain"], R(1, 2)) for term in terms)


@pytest.mark.parametrize(
    ("ends", "conditions"),
    [
        pytest.param("fixed", [], id="clamped"),
        pytest.param("hinged", [("ddot(w) = 0", ["0", "L"])], id="on two hinges"),
        pytest.param("hinged-free", [("dddot(w) = 0", ["L"]), ("ddot(w) = 0", ["0", "L"])], id="hinge and free"),
        pytest.param("free", [("dddot(w) = 0", ["0", "L"]), ("ddot(w) = 0", ["0", "L"])], id="free at both ends"),
    ],
)
def test_supports_of_a_beam(ends: str, conditions: list[tuple[str, list[str]]]) -> None:
    """Source: Gere, Timoshenko, Mechanics of Materials, §9.3: conditions at the supports of a beam."""
    asked = menu()["asked"]["beam"]
    found = vary_request(asked | {"functional": asked["functional"] | {"ends": ends}})
    terms = found["result"]["boundary_terms"]
    told = [(term["condition"]["plain"], term["at"]) for term in terms if not term["vanishes"]]
    assert told == conditions
    assert all(s["verified"] for chapter in found["chapters"] for step in chapter["steps"] for s in walk(step))


FORMS: dict[str, Callable[[str], bool]] = {
    "length": "ddot(x) = 0".__eq__,
    "brachistochrone": "2*x*ddot(x) + dot(x)^2 + 1 = 0".__eq__,
    "soap-film": "x*ddot(x) - dot(x)^2 - 1 = 0".__eq__,
    "relativity": "m*ddot(x) - F*(1 - dot(x)^2/c^2)^(3/2) = 0".__eq__,
    "dido": "lambda*ddot(x) - (dot(x)^2 + 1)^(3/2) = 0".__eq__,
    "beam": "EI*ddddot(w) - q = 0".__eq__,
}


@pytest.mark.parametrize("name", FORMS)
def test_equations_read_as_in_the_book(name: str) -> None:
    (equation,) = answer(name)["result"]["euler_lagrange"]
    assert FORMS[name](equation["plain"]), equation["plain"]
