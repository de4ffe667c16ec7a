"""Recurrences written down: from the tape of a model, each operation once, and M q̈ = f solved on the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from . import tape as t
from .recurrence_solving import Value, solved
from .recurrences import (
    ADD,
    ANGLE,
    CHOICE,
    CONSTANT,
    DIVIDE,
    FALL,
    FUNCTIONS,
    MULTIPLY,
    NEGATIVE_QUOTIENT,
    OPERANDS,
    POWER,
    QUOTIENT,
    RECIPROCAL,
    RISE,
    ROOT,
    SCALE,
    SHIFT,
    SQUARE,
    SUBTRACT,
    WITH_CONSTANT,
    WITH_FUNCTION,
    Condition,
    Floats,
    Formula,
    Operation,
    Recurrences,
    operands,
)
from .tape import Tape

LARGEST_EXPONENT = 16  # of whole powers that are made by multiplication


_OF_TAPE: Mapping[int, str] = MappingProxyType(
    {code: name for code, name in t.NAMES.items() if code != t.ARCTANGENT_2}  # those of one operand
)
_NUMPY: Mapping[str, Callable[..., Floats]] = MappingProxyType(
    {
        **{name: getattr(np, name) for name in ("exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh")},
        **{name: getattr(np, "arc" + name[1:]) for name in ("asin", "acos", "atan", "asinh", "acosh", "atanh")},
    }
)
_CONDITIONS: Mapping[int, Callable[..., Floats]] = MappingProxyType(
    {
        t.POSITIVE: lambda a: a > 0.0,
        t.NOT_NEGATIVE: lambda a: a >= 0.0,
        t.NEGATIVE: lambda a: a < 0.0,
        t.NOT_POSITIVE: lambda a: a <= 0.0,
    }
)


def recurrences_of(tape: Tape, degrees: int, *, is_powered: bool = False) -> Recurrences:
    """The recurrences of a tape whose outputs are the packed lower triangle of M, f and, with power, P₀ and p₁."""
    writer = _Writer(degrees)
    values = writer.read(tape)
    outputs = [values[place] for place in tape.outputs]
    triangle, rest = outputs[: degrees * (degrees + 1) // 2], outputs[degrees * (degrees + 1) // 2 :]
    accelerations, pivots = solved(writer, triangle, rest[:degrees])
    power = None
    if is_powered:
        power = rest[degrees]
        for factor, acceleration in zip(rest[degrees + 1 :], accelerations, strict=True):
            power = writer.add(power, writer.multiply(factor, acceleration))
    return writer.finished(accelerations, power, pivots)


class _Writer:
    """Writes operations one behind the other, each once; what depends on parameters alone becomes a formula."""

    def __init__(self, degrees: int) -> None:
        self._degrees = degrees
        self._first = 2 * degrees + 1
        self._operations: list[Operation] = []
        self._formulas: list[Formula] = []
        self._numbers: dict[float, int] = {}
        self._places: dict[Operation, int] = {}
        self._known: dict[tuple[object, ...], int] = {}
        self._conditions: dict[Condition, int] = {}
        self._factors: dict[int, tuple[float, tuple[int, ...]]] = {}  # signs and factors of constants

    # constants

    def number(self, number: float) -> Value:
        """A number as it is."""
        if number not in self._numbers:
            self._numbers[number] = self._formula(Formula(None, number=number))
        return Value(self._numbers[number], is_constant=True)

    def _formula(self, formula: Formula) -> int:
        self._formulas.append(formula)
        return len(self._formulas) - 1

    def _derived(self, function: Callable[..., Floats], *operands: Value) -> Value:
        """A constant made of constants."""
        key = (function, *(each.place for each in operands))
        if key not in self._known:
            self._known[key] = self._formula(Formula(function, tuple(each.place for each in operands)))
        return Value(self._known[key], is_constant=True)

    def _constant_product(self, *constants: Value) -> Value:
        """The product of constants: the same one, in whatever order and with whatever parentheses it is asked for."""
        sign, factors = 1.0, list[int]()
        for each in constants:
            literal = self._literal(each)
            mine, parts = self._factors.get(each.place, (1.0, (each.place,)))
            if literal is not None and abs(literal) == 1.0:
                mine, parts = literal, ()
            sign, factors = sign * mine, [*factors, *parts]
        factors.sort()
        found = self.number(1.0) if not factors else Value(factors[0], is_constant=True)
        for place in factors[1:]:
            found = self._derived(np.multiply, found, Value(place, is_constant=True))
        if factors and sign < 0.0:
            found = self._derived(np.negative, found)
        elif not factors:
            found = self.number(sign)
        self._factors[found.place] = (sign, tuple(factors))
        return found

    def _is_negative_of(self, a: Value, b: Value) -> bool:
        """Whether a = −b is known of two constants."""
        return self._constant_product(self.number(-1.0), a) == b

    def _literal(self, value: Value) -> float | None:
        """The number that a value is whatever the parameters."""
        formula = self._formulas[value.place] if value.is_constant else None
        return None if formula is None or formula.function is not None or formula.operands else formula.number

    # series

    def _write(self, code: int, a: int = 0, b: int = 0, c: int = 0, constant: int = 0) -> Value:
        operation = Operation(code, a, b, c, constant)
        if operation not in self._places:
            self._operations.append(operation)
            self._places[operation] = self._first + len(self._operations) - 1
        return Value(self._places[operation], is_constant=False)

    def _operation(self, value: Value) -> Operation | None:
        """What makes a series; None of an input or a constant."""
        is_made = not value.is_constant and value.place >= self._first
        return self._operations[value.place - self._first] if is_made else None

    def series(self, value: Value) -> Value:
        """The value as a series, also if it is a constant."""
        return self._write(CONSTANT, constant=value.place) if value.is_constant else value

    def add(self, a: Value, b: Value) -> Value:
        """a + b."""
        if a.is_constant and b.is_constant:
            return self._derived(np.add, a, b)
        if a.is_constant:
            a, b = b, a
        if b.is_constant:
            return a if self._literal(b) == 0.0 else self._write(SHIFT, a.place, constant=b.place)
        (x, of_x), (y, of_y) = self._scaled(a), self._scaled(b)
        if of_x is not None and of_x == of_y:
            return self.multiply(of_x, self.add(x, y))
        if of_x is not None and of_y is not None and self._is_negative_of(of_x, of_y):
            return self.multiply(of_x, self.subtract(x, y))
        for one, other, factor in ((a, y, of_y), (b, x, of_x)):
            if factor is not None and self._literal(factor) == -1.0:
                return self.subtract(one, other)
        return self._of_angles(a, b, is_sum=True) or self._write(ADD, *sorted((a.place, b.place)))

    def _scaled(self, value: Value) -> tuple[Value, Value | None]:
        """x and γ of a value γ x; of any other itself and None."""
        operation = self._operation(value)
        if operation is None or operation.code != SCALE:
            return value, None
        return Value(operation.a, is_constant=False), Value(operation.constant, is_constant=True)

    def subtract(self, a: Value, b: Value) -> Value:
        """a − b."""
        if a.is_constant or b.is_constant:
            return self.add(a, self.multiply(self.number(-1.0), b))
        (x, of_x), (y, of_y) = self._scaled(a), self._scaled(b)
        if of_x is not None and of_x == of_y:
            return self.multiply(of_x, self.subtract(x, y))
        if of_x is not None and of_y is not None and self._is_negative_of(of_x, of_y):
            return self.multiply(of_x, self.add(x, y))
        if of_y is not None and self._literal(of_y) == -1.0:
            return self.add(a, y)
        return self._of_angles(a, b, is_sum=False) or self._write(SUBTRACT, a.place, b.place)

    def _of_angles(self, a: Value, b: Value, *, is_sum: bool) -> Value | None:
        """a ± b by the sine or cosine of a sum or difference of two angles, where the addition theorems know one."""
        first, second = self._circular(a), self._circular(b)
        if first.keys() != second.keys() or len(first) != 2 or any(first[x] == second[x] for x in first):
            return None
        x, y = sorted(first)
        names, one, minus = [first[x], first[y]], Value(x, is_constant=False), self.number(-1.0)
        other = Value(y, is_constant=False)
        if names[0] == names[1]:  # cos x cos y ± sin x sin y, or the other way round
            found = self.function("cos", self.subtract(one, other) if is_sum else self.add(one, other))
            return found if is_sum or names[0] == "cos" else self.multiply(minus, found)
        found = self.function("sin", self.add(one, other) if is_sum else self.subtract(one, other))
        return found if is_sum or names[0] == "sin" else self.multiply(minus, found)

    def _circular(self, value: Value) -> Mapping[int, str]:
        """Of a product of two sines or cosines: which of an angle at which place."""
        operation = self._operation(value)
        found: dict[int, str] = {}
        for place in (operation.a, operation.b) if operation is not None and operation.code == MULTIPLY else ():
            factor = self._operation(Value(place, is_constant=False))
            if factor is not None and factor.code in WITH_FUNCTION and FUNCTIONS[factor.c] in ("sin", "cos"):
                found[factor.a] = FUNCTIONS[factor.c]
        return found

    def multiply(self, a: Value, b: Value) -> Value:
        """a b."""
        if a.is_constant and b.is_constant:
            return self._constant_product(a, b)
        if b.is_constant:
            a, b = b, a
        if not a.is_constant:
            return self._product(a, b)
        literal, (x, factor) = self._literal(a), self._scaled(b)
        if literal is not None and literal in (0.0, 1.0):
            return a if literal == 0.0 else b
        if factor is not None:
            return self.multiply(self.multiply(a, factor), x)
        return self._write(SCALE, b.place, constant=a.place)

    def _product(self, a: Value, b: Value) -> Value:
        """a b of two series; constant factors come before it."""
        (x, of_x), (y, of_y) = self._scaled(a), self._scaled(b)
        if of_x is not None or of_y is not None:
            one = self.number(1.0)
            return self.multiply(self.multiply(of_x or one, of_y or one), self._product(x, y))
        return self._write(SQUARE, a.place) if a == b else self._write(MULTIPLY, *sorted((a.place, b.place)))

    def divide(self, a: Value, b: Value) -> Value:
        """a / b."""
        if a.is_constant and b.is_constant:
            return a if self._literal(a) == 0.0 else self._derived(np.divide, a, b)
        if b.is_constant:
            return self.multiply(self._derived(np.divide, self.number(1.0), b), a)
        if a.is_constant:
            return a if self._literal(a) == 0.0 else self._write(RECIPROCAL, 0, b.place, constant=a.place)
        return self._write(DIVIDE, a.place, b.place)

    def minus_products(self, value: Value, a: Sequence[Value], b: Sequence[Value]) -> Value:
        """value − Σ aᵢ bᵢ."""
        for x, y in zip(a, b, strict=False):
            product = self.multiply(x, y)
            if self._literal(product) != 0.0:
                value = self.subtract(value, product)
        return value

    def power(self, a: Value, exponent: float) -> Value:
        """a^exponent; whole powers by multiplication, so that a may be 0."""
        if a.is_constant:
            return self._derived(np.power, a, self.number(exponent))
        if exponent < 0.0 and float(-exponent).is_integer() and -exponent <= LARGEST_EXPONENT:
            return self.divide(self.number(1.0), self.power(a, -exponent))
        if float(exponent).is_integer() and 0.0 < exponent <= LARGEST_EXPONENT:
            return self._whole_power(a, int(exponent))
        if exponent == 0.5:
            return self._write(ROOT, a.place)
        return self._write(POWER, a.place, constant=self.number(exponent).place)

    def _whole_power(self, a: Value, exponent: int) -> Value:
        if exponent == 1:
            return a
        half = self._whole_power(a, exponent // 2)
        square = self.multiply(half, half)
        return self.multiply(square, a) if exponent % 2 else square

    def function(self, name: str, a: Value) -> Value:
        """A function of one series: with what its derivative is made of, y′ = b a′ or y′ = a′/b."""
        if a.is_constant:
            return self._derived(_NUMPY[name], a)
        number, one = FUNCTIONS.index(name), self.number(1.0)
        pairs = {"sin": ("cos", RISE, FALL), "cos": ("sin", FALL, RISE)}
        pairs |= {"sinh": ("cosh", RISE, RISE), "cosh": ("sinh", RISE, RISE)}
        if name in pairs:
            return self._pair(number, a, *pairs[name])
        if name == "exp":
            return self._exponential(number, a)
        if name in ("tan", "tanh"):
            return self._tangent(name, number, a)
        square = self.power(a, 2.0)
        under = {
            "log": lambda: a,
            "asin": lambda: self.power(self.subtract(one, square), 0.5),
            "acos": lambda: self.power(self.subtract(one, square), 0.5),
            "atan": lambda: self.add(one, square),
            "asinh": lambda: self.power(self.add(one, square), 0.5),
            "acosh": lambda: self.power(self.subtract(square, one), 0.5),
            "atanh": lambda: self.subtract(one, square),
        }[name]()
        return self._write(NEGATIVE_QUOTIENT if name == "acos" else QUOTIENT, a.place, under.place, number)

    def _exponential(self, number: int, a: Value) -> Value:
        """y′ = y a′: the operation reads what it writes."""
        key = ("exp", a.place)
        if key not in self._known:
            self._known[key] = self._first + len(self._operations)
            self._operations.append(Operation(RISE, a.place, self._known[key], number))
        return Value(self._known[key], is_constant=False)

    def _pair(self, number: int, a: Value, other: str, code: int, other_code: int) -> Value:
        """Two functions, each the derivative of the other but for its sign; they stand side by side."""
        key = ("pair", number, a.place)
        if key not in self._known:
            here = self._first + len(self._operations)
            partner = FUNCTIONS.index(other)
            self._operations.append(Operation(code, a.place, here + 1, number))
            self._operations.append(Operation(other_code, a.place, here, partner))
            self._known[key], self._known["pair", partner, a.place] = here, here + 1
        return Value(self._known[key], is_constant=False)

    def _tangent(self, name: str, number: int, a: Value) -> Value:
        """y′ = (1 ± y²) a′: the operation reads what is made of it, two places behind."""
        key = (name, a.place)
        if key not in self._known:
            here = self._first + len(self._operations)
            self._operations.append(Operation(RISE, a.place, 0, number))
            self._known[key] = here
            square = self._write(SQUARE, here)
            one = self.number(1.0)
            slope = self.add(one, square) if name == "tan" else self.subtract(one, square)
            self._operations[here - self._first] = Operation(RISE, a.place, slope.place, number)
        return Value(self._known[key], is_constant=False)

    def angle(self, a: Value, b: Value) -> Value:
        """The angle of the point (b, a)."""
        if a.is_constant and b.is_constant:
            return self._derived(np.arctan2, a, b)
        a, b = self.series(a), self.series(b)
        square = self.add(self.multiply(a, a), self.multiply(b, b))
        return self._write(ANGLE, a.place, b.place, square.place)

    def choice(self, condition: Value | Condition, first: Value, second: Value) -> Value:
        """One of two values, by a condition."""
        if isinstance(condition, Value):
            return self._derived(np.where, condition, first, second)
        number = self._conditions.setdefault(condition, len(self._conditions))
        return self._write(CHOICE, number, self.series(first).place, self.series(second).place)

    # from the tape, and to the recurrences

    def read(self, tape: Tape) -> list[Any]:
        """What stands at each place of a tape: a value or a condition."""
        values: list[Any] = []
        for code, a, b, c, constant in zip(tape.codes, tape.a, tape.b, tape.c, tape.constants, strict=True):
            values.append(self._of_tape(int(code), values, (int(a), int(b), int(c)), float(constant)))
        return values

    def _of_tape(
        self, code: int, values: list[Any], places: tuple[int, int, int], constant: float
    ) -> Value | Condition:
        a, b, c = places
        if code == t.INPUT:
            is_constant = a >= self._first
            place = self._formula(Formula(None, (a - self._first,))) if is_constant else a
            return Value(place, is_constant=is_constant)
        if code in _CONDITIONS:
            first: Value = values[a]
            return self._derived(_CONDITIONS[code], first) if first.is_constant else Condition(code, first.place)
        if code in _OF_TAPE:
            return self.function(_OF_TAPE[code], values[a])
        others: Mapping[int, Callable[[], Value]] = {
            t.CONSTANT: lambda: self.number(constant),
            t.POWER: lambda: self.power(values[a], constant),
            t.CHOICE: lambda: self.choice(values[a], values[b], values[c]),
            t.ADD: lambda: self.add(values[a], values[b]),
            t.MULTIPLY: lambda: self.multiply(values[a], values[b]),
            t.ARCTANGENT_2: lambda: self.angle(values[a], values[b]),
        }
        return others[code]()

    def _with_quotients(self, wanted: set[int]) -> list[Operation]:
        """x · (1/y) as a quotient, where the reciprocal has no other use: one sum less."""
        uses: dict[int, int] = dict.fromkeys(wanted, 1)
        for each in self._operations:
            for place in operands(each):
                uses[place] = uses.get(place, 0) + 1
        found = list(self._operations)
        reciprocals = {
            self._first + number: each.b
            for number, each in enumerate(found)
            if each.code == RECIPROCAL and self._literal(Value(each.constant, is_constant=True)) == 1.0
        }
        for index, each in enumerate(found):
            for one, other in ((each.a, each.b), (each.b, each.a)) if each.code == MULTIPLY else ():
                if other in reciprocals and uses[other] == 1:
                    found[index] = Operation(DIVIDE, one, reciprocals[other])
                    break
        return found

    def finished(
        self, accelerations: list[Value], power: Value | None, pivots: list[tuple[Value, Value]]
    ) -> Recurrences:
        """The recurrences of what is needed of all that was written."""
        of_accelerations = [self.series(each).place for each in accelerations]
        work = None if power is None else self.series(power).place
        pairs = [(self.series(one).place, self.series(other).place) for one, other in pivots]
        conditions = list(self._conditions)
        wanted = {
            *of_accelerations,
            *(place for pair in pairs for place in pair),
            *(each.argument for each in conditions),
        }
        wanted |= set() if work is None else {work}
        operations, moved = _needed(self._with_quotients(wanted), self._first, wanted)
        kept = sorted({each.constant for each in operations if each.code in WITH_CONSTANT})
        numbers = {place: number for number, place in enumerate(kept)}
        return Recurrences(
            self._degrees,
            tuple(_numbered(each, numbers) for each in operations),
            tuple(moved[place] for place in of_accelerations),
            None if work is None else moved[work],
            tuple(Condition(each.kind, moved[each.argument]) for each in conditions),
            tuple((moved[one], moved[other]) for one, other in pairs),
            tuple(self._formulas),
            tuple(kept),
        )


def _numbered(operation: Operation, numbers: Mapping[int, int]) -> Operation:
    if operation.code not in WITH_CONSTANT:
        return operation
    return Operation(operation.code, operation.a, operation.b, operation.c, numbers[operation.constant])


def _needed(operations: list[Operation], first: int, wanted: set[int]) -> tuple[list[Operation], dict[int, int]]:
    """The operations that something wanted rests on, at their new places; and the new place of each old one."""
    reached, left = set[int](), [place for place in wanted if place >= first]
    while left:
        place = left.pop()
        if place not in reached:
            reached.add(place)
            left += [each for each in operands(operations[place - first]) if each >= first]
    moved = {place: place for place in range(first)}
    moved |= {place: first + number for number, place in enumerate(sorted(reached))}
    found = []
    for place in sorted(reached):
        each = operations[place - first]
        of_operands = {name: moved[getattr(each, name)] for name in OPERANDS.get(each.code, "ab")}
        found.append(Operation(**{**each.__dict__, **of_operands}))
    return found, moved
