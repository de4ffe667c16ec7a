"""The symbols of an imagined scene, for all tests of the language."""

from __future__ import annotations

from typing import Any

from deltaq.errors import ExpressionError, Problem
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import Syntax, parse
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy

NAMES = Names(
    (
        Symbol("y", "coordinate", "q_1"),
        Symbol("phi", "coordinate", r"\varphi"),
        Symbol("x", "coordinate"),
        *(Symbol(name, "parameter", positive=True) for name in ("m", "l", "g", "k", "c", "omega", "y0", "F0", "m1")),
        Symbol("a", "parameter"),
        Symbol("s", "material"),
    )
)
SYMBOLS = Symbols(NAMES)

DOUBLE = Names(
    (
        Symbol("phi1", "coordinate"),
        Symbol("phi2", "coordinate"),
        *(Symbol(name, "parameter", positive=True) for name in ("m1", "m2", "l1", "l2", "g")),
    )
)
DOUBLE_KINETIC_ENERGY = (
    "m1*l1^2*dot(phi1)^2/2 + m2*((l1*cos(phi1)*dot(phi1) + l2*cos(phi2)*dot(phi2))^2"
    " + (l1*sin(phi1)*dot(phi1) + l2*sin(phi2)*dot(phi2))^2)/2"
)


def read(text: str, syntax: Syntax = "plain", names: Names = NAMES) -> Any:
    """The SymPy value of a text."""
    return to_sympy(parse(text, names, syntax).tree, Symbols(names))


def problem_of(text: str, syntax: Syntax = "plain", names: Names = NAMES) -> Problem:
    """The one problem with which a text is refused."""
    try:
        value = read(text, syntax, names)
    except ExpressionError as error:
        (problem,) = error.problems
        return problem
    raise AssertionError(f"{text!r} was read as {value}")
