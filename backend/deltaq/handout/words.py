"""How the quantities of a scene are called in a program of their own: valid names that mean nothing else there."""

from __future__ import annotations

import builtins
import keyword
import re
from collections.abc import Iterable, Mapping
from functools import reduce

import sympy as sp
from sympy.core.sorting import ordered
from sympy.printing.numpy import NumPyPrinter

from ..derivation.system import System
from ..language.functions import FUNCTIONS

# What the program's own code calls something where the scene's names stand, too.
IMPORTED = {"np", "pi", "pyplot", "solve_ivp"}
LOCAL = {"biases", "q", "rates", "row", "state", "t", "times", "v"}
LOCAL |= {"forces", "found", "held", "mode", "shares", "slipping", "slips"}
DEFINED = re.compile(r"^(?:\{.*\})?(?:def )?(\w+)(?:\(| = )", re.MULTILINE)
RECIPROCALS = {sp.cot: sp.tan, sp.sec: sp.cos, sp.csc: sp.sin}


class _Printer(NumPyPrinter):  # type: ignore[misc]
    """NumPy's functions by their plain names, few of which a scene may want for its own: e is written exp(1)."""

    def __init__(self) -> None:
        super().__init__({"fully_qualified_modules": False})

    def _print_Exp1(self, _number: sp.Basic) -> str:
        return self._called("exp", "1")

    def _print_Heaviside(self, jump: sp.Heaviside) -> str:
        return self._called("heaviside", *map(self._print, jump.args))

    def _print_Max(self, largest: sp.Max) -> str:
        return self._of_two("maximum", largest)

    def _print_Min(self, smallest: sp.Min) -> str:
        return self._of_two("minimum", smallest)

    def _of_two(self, name: str, of_many: sp.Expr) -> str:
        arguments: Iterable[str] = map(self._print, ordered(of_many.args))
        return reduce(lambda one, two: self._called(name, one, two), arguments)

    def _called(self, name: str, *arguments: str) -> str:
        return f"{self._module_format(f'numpy.{name}')}({', '.join(arguments)})"


OF_NUMPY = {
    *("heaviside", "maximum", "minimum"),
    *(name.removeprefix("numpy.") for name in _Printer().known_functions.values() if name.startswith("numpy.")),
}


class Words:
    """How the quantities of a system are called in the program, and the functions it needs of NumPy."""

    def __init__(self, system: System, templates: Iterable[str]) -> None:
        """`templates`: what the program is made of, whose functions and constants keep their names."""
        scene = system.scene
        plain = [*(p.name for p in scene.parameters), *(c.name for c in scene.coordinates)]
        wanted = {event_symbol(event.name): f"event_{event.name}" for event in scene.events}
        wanted |= {name: name for name in plain} | {system.rate(c.name).name: f"{c.name}_dot" for c in scene.free}
        wanted |= {system.acceleration(c.name).name: f"{c.name}_ddot" for c in scene.free}
        wanted |= {symbol.name: symbol.name for symbol in system.multipliers}
        self._known = {**_distinct(wanted, templates), system.t.name: "t"}
        self._printer = _Printer()

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
        """The expression in Python, by functions that NumPy has; without impulses at jumps, as in δq's motions."""
        called = {symbol: sp.Symbol(self._known[symbol.name]) for symbol in expression.free_symbols}
        plain = expression.xreplace(called).replace(_is_reciprocal, _by_its_inverse).replace(sp.DiracDelta, _nothing)
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


def _nothing(*_arguments: sp.Expr) -> sp.Expr:
    return sp.S.Zero


def _distinct(wanted: Mapping[str, str], templates: Iterable[str]) -> dict[str, str]:
    """Each its name, or one like it where the name means something else already."""
    defined = (name for template in templates for name in DEFINED.findall(template))
    taken, given = {*IMPORTED, *LOCAL, *OF_NUMPY, *FUNCTIONS, *dir(builtins), *defined}, {}
    for symbol, proposed in wanted.items():
        name = proposed if proposed.isascii() and proposed.isidentifier() else "x"
        while keyword.iskeyword(name) or name in taken:
            name += "_"
        taken.add(name)
        given[symbol] = name
    return given
