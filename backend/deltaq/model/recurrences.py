"""A model as recurrences between Taylor coefficients: from those of q, q̇ and t up to order k to those of q̈ of order k.

Each operation on a tape makes a series out of series, and its coefficient of order k follows from lower ones and from
those of order k of its operands. Most need sums Σ uⱼ vₖ₋ⱼ over 0 < j < k. M q̈ = f is solved in the same way: the pivots
of L D Lᵀ, the products and the quotients are operations like all others.
Sources: À. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99–117, §2.1; Griewank, Walther, Evaluating Derivatives,
2nd ed., ch. 13.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
NUDGE = 1.5 * 2.0**-52

# What an operation makes of its operands a, b, c and its constant γ. ϑu is the series of k uₖ.
CONSTANT, SHIFT, SCALE, ADD, SUBTRACT = 0, 1, 2, 3, 4  # γ, a + γ, γ a, a + b, a − b
MULTIPLY, SQUARE, DIVIDE, RECIPROCAL, ROOT, POWER = 5, 6, 7, 8, 9, 10  # a b, a², a/b, γ/b, √a, a^γ
RISE, FALL = 11, 12  # y′ = b a′ and y′ = −b a′; y₀ is the function `c` of a₀
QUOTIENT, NEGATIVE_QUOTIENT = 13, 14  # y′ = a′/b and y′ = −a′/b; y₀ is the function `c` of a₀
ANGLE = 15  # the angle of (b, a), c = a² + b²
CHOICE = 16  # b where the condition of number a holds, else c

# Functions by the place of their names, for y₀.
FUNCTIONS = (
    "exp",
    "log",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
)


@dataclass(frozen=True)
class Operation:
    """One series: its code, the places of its operands, and that of its constant."""

    code: int
    a: int = 0
    b: int = 0
    c: int = 0
    constant: int = 0

    def sums(self, place: int) -> tuple[Term, ...]:
        """The sums Σ uⱼ vₖ₋ⱼ, 0 < j < k, that its coefficient of order k needs, standing at a place itself."""
        a, b, y = self.a, self.b, place
        of_code: Mapping[int, tuple[Term, ...]] = {
            MULTIPLY: (((a, False), (b, False)),),
            SQUARE: (((a, False), (a, False)),),
            DIVIDE: (((y, False), (b, False)),),
            RECIPROCAL: (((y, False), (b, False)),),
            ROOT: (((y, False), (y, False)),),
            POWER: (((y, False), (a, True)), ((y, False), (a, False))),
            RISE: (((a, True), (b, False)),),
            FALL: (((a, True), (b, False)),),
            QUOTIENT: (((y, True), (b, False)),),
            NEGATIVE_QUOTIENT: (((y, True), (b, False)),),
            ANGLE: (((a, True), (b, False)), ((b, True), (a, False)), ((y, True), (self.c, False))),
        }
        return of_code.get(self.code, ())


Series = tuple[int, bool]  # a place, and whether its coefficients are multiplied by their order
Term = tuple[Series, Series]


@dataclass(frozen=True)
class Condition:
    """Whether a series is positive, `kind` as on a tape: a > 0, ≥ 0, < 0 or ≤ 0."""

    kind: int
    argument: int


@dataclass(frozen=True)
class Recurrences:
    """Places 0 … width − 1 are q, q̇ and t; operation i stands at width + i.

    `accelerations` are the places of q̈, `power` that of P where power is fed in. `pivots` are pairs of a pivot of M and
    the diagonal entry it is left of. `constants` tells the constants for given parameters.
    """

    degrees: int
    operations: tuple[Operation, ...]
    accelerations: tuple[int, ...]
    power: int | None
    conditions: tuple[Condition, ...]
    pivots: tuple[tuple[int, int], ...]
    formulas: tuple[Formula, ...]
    kept: tuple[int, ...]

    @property
    def inputs(self) -> int:
        """How many places come before the operations: 2n + 1."""
        return 2 * self.degrees + 1

    def constants(self, parameters: Floats) -> Floats:
        """The constants for parameters of shape (parameters, …): shape (constants, …)."""
        values: list[Floats] = []
        with np.errstate(all="ignore"):
            for formula in self.formulas:
                values.append(formula.value(values, parameters))
        found = np.empty((len(self.kept), *parameters.shape[1:]))
        for number, place in enumerate(self.kept):
            found[number] = values[place]
        return found

    def nudged(self, constants: Floats) -> Floats:
        """Constants, shape (…, constants): those that depend on parameters some units in the last place away.

        Plain numbers stay, exponents above all.
        """
        is_made = [bool(self.formulas[place].function or self.formulas[place].operands) for place in self.kept]
        return np.where(is_made, nudged(constants), constants)


def nudged(numbers: Floats) -> Floats:
    """Numbers, shape (…, numbers), some units in the last place away, up and down in no simple order; zero stays so."""
    return np.asarray(numbers * (1.0 + NUDGE * np.cos(2.0 + 2.0 * np.arange(numbers.shape[-1]))))


@dataclass(frozen=True)
class Formula:
    """One number that depends on the parameters alone: `function` of earlier ones, or a parameter, or a number.

    For many motions at once it is an array, of the shape (motions,) that each parameter has.
    """

    function: Callable[..., Floats] | None
    operands: tuple[int, ...] = ()
    number: float = 0.0

    def value(self, values: Sequence[Floats], parameters: Floats) -> Floats:
        """Its value, from the values before it, all of shape (…); `parameters` has shape (parameters, …)."""
        if self.function is None:
            return np.asarray(parameters[self.operands[0]] if self.operands else self.number)
        return np.asarray(self.function(*(values[place] for place in self.operands)))


WITH_CONSTANT = frozenset({CONSTANT, SHIFT, SCALE, RECIPROCAL, POWER})
WITH_FUNCTION = frozenset({RISE, FALL, QUOTIENT, NEGATIVE_QUOTIENT})
OPERANDS: Mapping[int, str] = MappingProxyType(
    {
        CONSTANT: "",
        SHIFT: "a",
        SCALE: "a",
        SQUARE: "a",
        ROOT: "a",
        POWER: "a",
        RECIPROCAL: "b",
        ANGLE: "abc",
        CHOICE: "bc",
    }
)


def operands(operation: Operation) -> tuple[int, ...]:
    """The places that an operation reads."""
    return tuple(getattr(operation, name) for name in OPERANDS.get(operation.code, "ab"))
