"""A published answer and the service's own, read by SymPy and held to each other where a system moves.

Formulas are texts such as `m*ddot(x) = -k*x`; `dot(x)` and `ddot(x)` are symbols of these names.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Any

import mpmath
import numpy as np
import sympy as sp
from sympy.parsing.sympy_parser import parse_expr

DIGITS = 40
FUNCTIONS = {
    name: getattr(sp, name) for name in ("sin", "cos", "tan", "acos", "asin", "atan", "sqrt", "sign", "exp", "log")
}
NAME = re.compile(r"(?:d?dot)\(\w+\)|[A-Za-z_]\w*")
TIME = sp.Symbol("t")
Document = Mapping[str, Any]


@cache
def read(text: str) -> Any:
    """A formula; an equation as the difference of its sides."""
    left, _, right = text.partition("=")
    return _expression(left) - (_expression(right) if right else 0)


def _expression(text: str) -> Any:
    names: dict[str, Any] = {}

    def placed(found: re.Match[str]) -> str:
        if found[0] in FUNCTIONS or found[0] == "pi":
            return found[0]
        names[key := f"name{len(names)}"] = sp.Symbol(found[0])
        return key

    return sp.nsimplify(parse_expr(NAME.sub(placed, text).replace("^", "**"), {**FUNCTIONS, "pi": sp.pi, **names}))


def rate(symbol: Any) -> Any:
    """The symbol of its time derivative."""
    name = symbol.name
    return sp.Symbol(f"d{name}" if name.startswith("dot(") else f"dot({name})")


@dataclass(frozen=True, eq=False)
class Published:
    """A row of the table beside the answer of `POST /derivations` to its scene."""

    row: Document
    result: Document
    constants: frozenset[str]

    def time_derivative(self, expression: Any) -> Any:
        moving = (s for s in expression.free_symbols if s.name not in self.constants and s != TIME)
        return sp.Add(expression.diff(TIME), *(expression.diff(s) * rate(s) for s in sorted(moving, key=str)))

    @cached_property
    def definitions(self) -> dict[Any, Any]:
        """What `on` puts somewhere, with its derivatives; of a coordinate the second one is the service's."""
        found: dict[Any, Any] = {}
        for name, text in self.row.get("on", {}).items():
            symbol, value = sp.Symbol(name), read(text)
            found[symbol] = value
            if name not in self.constants:
                found[rate(symbol)] = self.time_derivative(value)
            if name not in self.constants and not name.startswith("dot("):
                found[rate(rate(symbol))] = self.time_derivative(self.time_derivative(value))
        return {symbol: value for symbol, value in found.items() if symbol not in self.accelerations}

    @property
    def coordinates(self) -> list[str]:
        return [equation["coordinate"] for equation in self.result["equations"]]

    @property
    def accelerations(self) -> list[Any]:
        return [sp.Symbol(f"ddot({q})") for q in self.coordinates]

    @cached_property
    def unknowns(self) -> list[Any]:
        """Accelerations and multipliers."""
        return [*self.accelerations, *(sp.Symbol(c["multiplier"]["plain"]) for c in self.result["constraints"])]

    @cached_property
    def kept(self) -> list[Any]:
        """The constraints as the service states them."""
        return [read(c["equation"]["plain"]) for c in self.result["constraints"]]

    @cached_property
    def kept_accelerations(self) -> list[Any]:
        """The constraints, differentiated until there are accelerations."""
        twice = (self.time_derivative(kept) if c["holonomic"] else kept for kept, c in self._pairs())
        return [self.time_derivative(once) for once in twice]

    def _pairs(self) -> Iterable[tuple[Any, Document]]:
        return zip(self.kept, self.result["constraints"], strict=True)

    @cached_property
    def derived(self) -> list[Any]:
        """All that the service says about accelerations and multipliers: as many equations."""
        return [*(read(e["plain"]) for e in self.result["equations"]), *self.kept_accelerations]

    @cached_property
    def laws(self) -> list[Any]:
        """The published ones; of a Lagrange function its equations."""
        laws = [read(text) for text in self.row.get("laws", [])]
        if "lagrangian" in self.row:
            function = read(self.row["lagrangian"])
            laws += [self._euler(function, sp.Symbol(q)) for q in self.coordinates]
        return laws

    def _euler(self, function: Any, q: Any) -> Any:
        return self.time_derivative(function.diff(rate(q))) - function.diff(q)

    def resolved(self, expression: Any) -> Any:
        """In coordinates alone, without the names that `on` gives."""
        named = {s: v for s, v in self.definitions.items() if not self._is_of_coordinate(s)}
        while named.keys() & expression.free_symbols:
            expression = expression.xreplace(named)
        return expression

    def _is_of_coordinate(self, symbol: Any) -> bool:
        return any(symbol.name in (q, f"dot({q})") for q in self.coordinates) or symbol.name in self.constants

    def state(self, seed: int) -> State:
        """A random one that the constraints allow, and how it moves on by the service's equations."""
        state = State(self.definitions, random.Random(seed))
        matrix = [[state(equation.diff(u)) for u in self.unknowns] for equation in self.derived]
        rest = [state(equation.xreplace(dict.fromkeys(self.unknowns, sp.S.Zero))) for equation in self.derived]
        found = mpmath.lu_solve(mpmath.matrix(matrix), -mpmath.matrix(rest))
        state.values.update(zip(self.unknowns, found, strict=True))
        return state

    def integrals(self) -> list[Any]:
        return [read(text) for text in self.row.get("conserved", [])]

    def states(self) -> list[Any]:
        """Coordinates, rates and time, on which integrals depend."""
        return [TIME, *map(sp.Symbol, self.coordinates), *(sp.Symbol(f"dot({q})") for q in self.coordinates)]


@dataclass
class State:
    """Values of all symbols, each drawn or found when it is asked for."""

    definitions: Mapping[Any, Any]
    draw: random.Random
    values: dict[Any, Any] = field(default_factory=dict)

    def __call__(self, expression: Any) -> Any:
        symbols, function = _compiled(sp.sympify(expression))
        return mpmath.mpmathify(function(*map(self._value, symbols)))

    def _value(self, symbol: Any) -> Any:
        if symbol not in self.values:
            self.values[symbol] = self._found(symbol)
        return self.values[symbol]

    def _found(self, symbol: Any) -> Any:
        if symbol in self.definitions:
            return self(self.definitions[symbol])
        assert not symbol.name.startswith("ddot("), symbol
        return mpmath.mpf(self.draw.uniform(0.3, 1.4))


@cache
def _compiled(expression: Any) -> tuple[list[Any], Callable[..., Any]]:
    symbols = sorted(expression.free_symbols, key=str)
    return symbols, sp.lambdify(symbols, expression, "mpmath")


def rank(rows: Sequence[Sequence[Any]]) -> int:
    """How many of the rows are independent."""
    return int(np.linalg.matrix_rank(np.array(rows, dtype=float), tol=1e-9)) if rows else 0
