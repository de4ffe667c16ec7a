"""A model as a tape: the operations of M, f and the guides in an order in which each needs only earlier ones.

Machine code tells values. A tape also tells how each value comes about, so that the operations can be repeated in
another arithmetic: with intervals, to bound what happens between the places that an integrator looks at.
Source: Griewank, Walther, Evaluating Derivatives, 2nd ed., §2.2 (evaluation procedures).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
import symengine as se
from numpy.typing import NDArray

from .functions import Expr

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

# What an operation does with its operands a, b, c (places of earlier operations) and its constant.
INPUT, CONSTANT, ADD, MULTIPLY, POWER, EXPONENTIAL, LOGARITHM = 0, 1, 2, 3, 4, 5, 6
SINE, COSINE, TANGENT, ARCSINE, ARCCOSINE, ARCTANGENT, ARCTANGENT_2 = 7, 8, 9, 10, 11, 12, 13
HYPERBOLIC_SINE, HYPERBOLIC_COSINE, HYPERBOLIC_TANGENT = 14, 15, 16
AREA_SINE, AREA_COSINE, AREA_TANGENT = 17, 18, 19
POSITIVE, NOT_NEGATIVE, NEGATIVE, NOT_POSITIVE, CHOICE = 20, 21, 22, 23, 24  # a > 0, ≥, <, ≤; b where a holds, else c

_FUNCTIONS: Mapping[str, int] = MappingProxyType(
    {
        "sin": SINE,
        "cos": COSINE,
        "tan": TANGENT,
        "asin": ARCSINE,
        "acos": ARCCOSINE,
        "atan": ARCTANGENT,
        "atan2": ARCTANGENT_2,
        "sinh": HYPERBOLIC_SINE,
        "cosh": HYPERBOLIC_COSINE,
        "tanh": HYPERBOLIC_TANGENT,
        "asinh": AREA_SINE,
        "acosh": AREA_COSINE,
        "atanh": AREA_TANGENT,
        "log": LOGARITHM,
    }
)
# Names of functions, by operation.
NAMES: Mapping[int, str] = MappingProxyType({EXPONENTIAL: "exp", **{code: name for name, code in _FUNCTIONS.items()}})
_RECIPROCALS: Mapping[str, int] = MappingProxyType({"sec": COSINE, "csc": SINE, "cot": TANGENT})


@dataclass(frozen=True)
class Tape:
    """Operation i is codes[i] with operands at the places a[i], b[i], c[i] < i and the constant constants[i].

    `codes`, `a`, `b`, `c` and `constants` have shape (operations,). An input's `a` is its number among the model's
    inputs (q, q̇, t, parameters). `outputs`, shape (n (n + 1)/2 + n + 2 guided + m n + m,), are the places of the packed
    lower triangle of M, of f, of the values of guided coordinates, of their rates, and, with constraints, of A and γ.
    """

    codes: Indices
    a: Indices
    b: Indices
    c: Indices
    constants: Floats
    outputs: Indices

    @property
    def has_choices(self) -> bool:
        """Whether any value jumps or bends where a condition changes."""
        return bool((self.codes == CHOICE).any())

    def uses(self, number: int) -> bool:
        """Whether any value is made of the input of this number, which must not be 0, as unused operands are."""
        return number in self._used

    @cached_property
    def _used(self) -> frozenset[int]:
        """The places of operands and outputs: inputs come first, each at the place of its number."""
        made = ~np.isin(self.codes, (INPUT, CONSTANT))
        return frozenset(np.concatenate([self.a[made], self.b[made], self.c[made], self.outputs]).tolist())


def tape_of(inputs: Sequence[Expr], outputs: Sequence[Expr]) -> Tape:
    """The tape of some expressions in the inputs; equal subexpressions stand on it once."""
    return _written(_Writer({symbol: number for number, symbol in enumerate(inputs)}), outputs)


def shared_tape_of(inputs: Sequence[Expr], outputs: Sequence[Expr], constants: Sequence[Expr]) -> Tape:
    """The same with fewer operations: common parts of sums and products are found, and constants come first in both.

    `constants` are the inputs that stay as they are along a motion.
    """
    writer = _Writer({symbol: number for number, symbol in enumerate(inputs)}, set(constants))
    definitions, shared = se.cse(list(outputs))
    for symbol, expression in definitions:
        writer.define(symbol, expression)
    return _written(writer, shared)


def _written(writer: _Writer, outputs: Sequence[Expr]) -> Tape:
    places = [writer.place(se.sympify(output)) for output in outputs]
    codes, a, b, c, constants = zip(*writer.operations, strict=True) if writer.operations else ((),) * 5
    columns = (np.array(column, dtype=np.int64) for column in (codes, a, b, c))
    kinds, first, second, third = columns
    return Tape(kinds, first, second, third, np.array(constants, dtype=np.float64), np.array(places, dtype=np.int64))


class _Writer:
    """Writes operations one behind the other and remembers where the value of each expression stands."""

    def __init__(self, numbers: Mapping[Expr, int], constants: set[Expr] | None = None) -> None:
        self.operations: list[tuple[int, int, int, int, float]] = []
        self._constants = constants
        self._known: dict[Expr, int] = {}
        for symbol, number in numbers.items():
            self._known[symbol] = self._write(INPUT, number)
        self._writers: Mapping[str, Callable[[Expr], int]] = {
            "Add": lambda e: self._chain(ADD, e.args),
            "Mul": lambda e: self._chain(MULTIPLY, e.args),
            "Pow": self._power,
            "Piecewise": lambda e: self._choice(e.args),
            "StrictLessThan": lambda e: self._condition(POSITIVE, NEGATIVE, e),
            "LessThan": lambda e: self._condition(NOT_NEGATIVE, NOT_POSITIVE, e),
            "Equality": self._shared_condition,
            "Abs": lambda e: self.place(se.Piecewise((e.args[0], e.args[0] >= 0), (-e.args[0], True))),
        }

    def place(self, expression: Expr) -> int:
        """Where the value of an expression stands."""
        found = self._known.get(expression)
        if found is None:
            found = self._known[expression] = self._written(expression)
        return found

    def define(self, symbol: Expr, expression: Expr) -> None:
        """From now on the symbol stands for an expression."""
        self._known[symbol] = self.place(expression)
        if self._constants is not None and expression.free_symbols <= self._constants:
            self._constants.add(symbol)

    def _write(self, code: int, a: int = 0, b: int = 0, c: int = 0, constant: float = 0.0) -> int:
        self.operations.append((code, a, b, c, constant))
        return len(self.operations) - 1

    def _written(self, expression: Expr) -> int:
        name = type(expression).__name__
        if name in self._writers:
            return self._writers[name](expression)
        if name in _FUNCTIONS:
            return self._write(_FUNCTIONS[name], *map(self.place, expression.args))
        if name in _RECIPROCALS:
            return self._write(POWER, self._write(_RECIPROCALS[name], self.place(expression.args[0])), constant=-1.0)
        return self._write(CONSTANT, constant=float(expression))

    def _chain(self, code: int, parts: Sequence[Expr]) -> int:
        if self._constants is not None:
            parts = sorted(parts, key=self._moves)
        places = [self.place(part) for part in parts]
        found = places[0]
        for place in places[1:]:
            found = self._write(code, found, place)
        return found

    def _moves(self, part: Expr) -> bool:
        return not part.free_symbols <= (self._constants or set())

    def _power(self, expression: Expr) -> int:
        base, exponent = expression.args
        if not exponent.free_symbols and base != se.E:
            return self._write(POWER, self.place(base), constant=float(exponent))
        if base == se.E:
            return self._write(EXPONENTIAL, self.place(exponent))
        return self._write(EXPONENTIAL, self._write(MULTIPLY, self.place(exponent), self.place(se.log(base))))

    def _condition(self, code: int, mirrored: int, expression: Expr) -> int:
        """0 < x and x < 0 are conditions on the same number, so that one change of its sign is seen as one."""
        smaller, larger = expression.args
        if smaller - larger in self._known:
            return self._write(mirrored, self._known[smaller - larger])
        return self._write(code, self.place(larger - smaller))

    def _shared_condition(self, expression: Expr) -> int:
        """`x0 == True`: how a condition that several choices share stands in them, its symbol defined before."""
        symbol, *_ = (each for each in expression.args if each in self._known)
        return self._known[symbol]

    def _choice(self, arguments: Sequence[Expr]) -> int:
        """value, condition, value, condition …; the last condition is true."""
        value, *others = arguments[::2]
        if not others:
            return self.place(value)
        first = self.place(value)
        condition, rest = self.place(arguments[1]), self._choice(arguments[2:])
        return self._write(CHOICE, condition, first, rest)
