"""How the quantities of a scene are called in a program of their own: valid names that mean nothing else there."""

from __future__ import annotations

import builtins
import keyword
from collections.abc import Mapping

import sympy as sp
from sympy.printing.numpy import NumPyPrinter

from ..derivation.system import System
from ..language.functions import FUNCTIONS

OWN = {"np", "solve_ivp", "mass_matrix", "forcing", "positions", "right_hand_side", "solve", "draw", "pyplot"}
OF_CONSTRAINTS = {
    "conditions",
    "constraint_matrix",
    "constraint_offset",
    "constraint_drift",
    "projected",
    "multipliers",
    "correction",
}
OF_RELEASES = {"reactions", "reaction"}
OF_SWITCHING = {
    "rows",
    "friction",
    "contacts",
    "accelerations_and_reactions",
    "watched",
    "pushed",
    "behind_impacts",
    "settled",
}
LOCAL_THERE = {
    "rates",
    "biases",
    "accelerations_and_multipliers",
    "mass",
    "rows",
    "whole",
    "gap",
    "moved",
    "states",
    "begin",
    "end",
}
LOCAL = {"t", "q", "v", "state", "times", "found", "start", "name", "curve", "row", "value", "t_end", "samples"}
CONSTANTS = {"COORDINATES", "VALUES", "RATES", "T_END", "SAMPLES", "MULTIPLIERS", "HOLONOMIC", "FRICTIONS", "HELD"}
OF_NUMPY = {"arcsin", "arccos", "arctan", "arctan2", "arcsinh", "arccosh", "arctanh", "pi"}
RECIPROCALS = {sp.cot: sp.tan, sp.sec: sp.cos, sp.csc: sp.sin}
TAKEN = frozenset(
    {
        *OWN,
        *OF_CONSTRAINTS,
        *OF_SWITCHING,
        *OF_RELEASES,
        *LOCAL,
        *LOCAL_THERE,
        *CONSTANTS,
        *OF_NUMPY,
        *FUNCTIONS,
        *dir(builtins),
    }
)


class Words:
    """How the quantities of a system are called in the program, and the functions it needs of NumPy."""

    def __init__(self, system: System) -> None:
        scene = system.scene
        plain = [*(p.name for p in scene.parameters), *(c.name for c in scene.coordinates)]
        wanted = {event_symbol(event.name): f"event_{event.name}" for event in scene.events}
        wanted |= {name: name for name in plain} | {system.rate(c.name).name: f"{c.name}_dot" for c in scene.free}
        wanted |= {system.acceleration(c.name).name: f"{c.name}_ddot" for c in scene.free}
        wanted |= {symbol.name: symbol.name for symbol in system.multipliers}
        self._known = {**_distinct(wanted), system.t.name: "t"}
        self._printer = NumPyPrinter({"fully_qualified_modules": False})

    @property
    def functions(self) -> list[str]:
        """What the program imports from NumPy for what has been printed so far."""
        return sorted(self._printer.module_imports.get("numpy", ())) or ["pi"]

    def knows(self, expression: sp.ImmutableMatrix) -> bool:
        """Whether the program has all that the expression hangs on."""
        return {symbol.name for symbol in expression.free_symbols} <= self._known.keys()

    def called(self, name: str) -> str:
        """What the symbol of this name is called in the program."""
        return self._known[name]

    def text(self, expression: sp.Expr) -> str:
        """The expression in Python, by functions that NumPy has."""
        called = {symbol: sp.Symbol(self._known[symbol.name]) for symbol in expression.free_symbols}
        plain = expression.xreplace(called).replace(_is_reciprocal, _by_its_inverse)
        return str(self._printer.doprint(plain))

    def vector(self, column: sp.ImmutableMatrix) -> str:
        """A column as `[x, y, …]`."""
        return f"[{', '.join(map(self.text, column))}]"

    def matrix(self, square: sp.ImmutableMatrix) -> str:
        """A square matrix as `[[…], […]]`, row by row."""
        rows = (", ".join(map(self.text, row)) for row in square.tolist())
        return f"[{', '.join(f'[{row}]' for row in rows)}]"


def event_symbol(name: str) -> str:
    """An event among the names of symbols, none of which has a blank."""
    return f"event {name}"


def _is_reciprocal(expression: sp.Basic) -> bool:
    return expression.func in RECIPROCALS


def _by_its_inverse(expression: sp.Basic) -> sp.Expr:
    return 1 / RECIPROCALS[expression.func](*expression.args)


def _distinct(wanted: Mapping[str, str]) -> dict[str, str]:
    """Each its name, or one like it where the name means something else already."""
    taken, given = set(TAKEN), {}
    for symbol, proposed in wanted.items():
        name = proposed if proposed.isascii() and proposed.isidentifier() else "x"
        while keyword.iskeyword(name) or name in taken:
            name += "_"
        taken.add(name)
        given[symbol] = name
    return given
