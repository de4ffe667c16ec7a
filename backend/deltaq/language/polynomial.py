"""Forms as polynomials: what the planner of the display works on.

A generator is a symbol, a wave such as sin φ, or a power of a kernel; x and 1/x are generators of their own, so that
all exponents are natural numbers. Numbers are whole, with one denominator in front.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property
from typing import Any

import flint
import sympy
from flint import fmpq

from .fourier import Form, Monomial
from .memory import cached_method, hashed_once
from .normal_form import Reader
from .operations import operations
from .order import Order, split_symbol
from .trigonometry import written

Exponents = tuple[int, ...]
Poly = dict[Exponents, int]

RATE = 1


class Kind(IntEnum):
    """What a generator stands for, as far as habits of writing ask for it."""

    MASS = 0
    PARAMETER = 1
    COORDINATE = 2
    WAVE = 3
    KERNEL = 4
    RATE = 5
    OUTER = 6  # accelerations, differentials, virtual displacements


@dataclass(frozen=True)
class Generator:
    """`value` to the power `unit`: √s is s with the unit ½, 1/x is x with the unit −1."""

    name: str
    value: Any = field(compare=False)
    unit: Any
    kind: Kind
    moves: bool
    weight: int  # operations inside

    def power(self, exponent: int) -> Any:
        """The generator to a natural power, in SymPy."""
        return self.value ** (sympy.Rational(int(self.unit.p), int(self.unit.q)) * exponent)

    def operations(self, exponent: int) -> int:
        """Operations to write the power, without the line of a fraction it may stand below."""
        shown = abs(self.unit) * exponent
        return self.weight + int(shown != 1)


@hashed_once
@dataclass(frozen=True)
class Shape:
    """Generators without what they are called and stand for: all that a plan hangs on, so that like sums share one."""

    generators: tuple[Generator, ...]

    @cached_property
    def context(self) -> Any:
        """Polynomials in as many variables, for the algebra to factor."""
        names = [f"x{i}" for i in range(len(self.generators))]
        return flint.fmpz_mpoly_ctx.get(names, flint.Ordering.lex)

    @cached_method
    def of_kinds(self, *kinds: Kind) -> frozenset[int]:
        """The generators of these kinds."""
        return frozenset(i for i, g in enumerate(self.generators) if g.kind in kinds)


class Alphabet:
    """The generators of some forms of one reader; `shown` says how a kernel is written."""

    def __init__(self, reader: Reader, order: Order, forms: Iterable[Form], shown: Callable[[str], Any]) -> None:
        self._reader = reader
        self._order = order
        self._shown = shown
        self._units = _units(forms)
        found = {(name, unit) for (name, _), unit in self._units.items()}
        ranked = sorted((self._generator(name, unit) for name, unit in found), key=self._rank)
        self.generators = tuple(ranked)
        self.shape = Shape(tuple(replace(each, name="", value=None) for each in ranked))
        self._index = {(g.name, g.unit): i for i, g in enumerate(ranked)}

    def _generator(self, name: str, unit: Any) -> Generator:
        value = self._shown(name) if name in self._reader.bases else self._reader.meaning[name]
        kind, moves = self._kind(name, value)
        return Generator(name, value, unit, kind, moves, operations(value))

    def _kind(self, name: str, value: Any) -> tuple[Kind, bool]:
        symbols = value.free_symbols
        if not value.is_Symbol:
            moves = any(map(self._order.is_moving, symbols))
            kernel = name in self._reader.bases
            return (Kind.KERNEL if kernel else Kind.WAVE) if moves else Kind.PARAMETER, moves
        tense, base = split_symbol(value.name)
        if tense:
            return Kind.RATE if tense == RATE else Kind.OUTER, True
        if self._order.is_moving(value):
            return Kind.COORDINATE, True
        return Kind.MASS if self._order.is_mass(base) else Kind.PARAMETER, False

    def _rank(self, generator: Generator) -> tuple[Any, ...]:
        return (-generator.kind, self._order.factor(generator.value), -generator.unit)

    def exponents(self, mono: Monomial) -> Exponents:
        """The exponents of a monomial. KeyError for a generator that is none of these."""
        found = [0] * len(self.generators)
        for name, e in mono:
            unit = self._units[name, e > 0]
            found[self._index[name, unit]] = int((fmpq(e) / unit).p)
        return tuple(found)

    def without_waves(self, exponents: Exponents) -> Exponents:
        """The exponents of everything but waves."""
        return tuple(0 if g.kind == Kind.WAVE else e for g, e in zip(self.generators, exponents, strict=True))

    def polynomial(self, form: Form) -> tuple[Poly, int]:
        """Whole coefficients, and the denominator they share."""
        denominator = math.lcm(*(int(c.q) for c in form.values()))
        total = {self.exponents(mono): int((c * denominator).p) for (mono, _, _), c in form.items()}
        return self._raised(total), denominator

    def _raised(self, poly: Poly) -> Poly:
        """Fractions cancelled: s²/s³ is 1/s where s² is multiplied out."""
        for index, generator in enumerate(self.generators):
            base = self._base(index) if generator.unit < 0 else None
            if base:
                poly = self._cancelled(poly, index, base)
        return poly

    def _cancelled(self, poly: Poly, index: int, base: Poly) -> Poly:
        step = int((1 / abs(self.generators[index].unit)).p)
        levels: dict[int, Poly] = {}
        for exponents, c in poly.items():
            levels.setdefault(exponents[index], {})[_with(exponents, index, 0)] = c
        divisor = self.shape.context.from_dict(base)
        for level in sorted(levels, reverse=True):
            coefficient = levels.get(level, {})  # none where it went up with one from below
            while level >= step and len(coefficient) >= len(base):
                quotient, rest = divmod(self.shape.context.from_dict(coefficient), divisor)
                if len(rest):
                    break
                del levels[level]
                level -= step  # noqa: PLW2901 - one step further up
                coefficient = _plus(levels.get(level, {}), as_poly(quotient))
                levels[level] = coefficient
        return {_with(key, index, level): c for level, part in levels.items() for key, c in part.items()}

    @cached_method
    def _base(self, index: int) -> Poly | None:
        """What a reciprocal or a root is one of, as a polynomial of the same generators; None if it is none of them."""
        form = self._reader.bases.get(self.generators[index].name)
        if form is None:
            return None
        form = written(form, self._reader)
        try:
            keys = {self.exponents(mono): c for (mono, _, _), c in form.items()}
        except KeyError:
            return None
        return {key: int(c.p) for key, c in keys.items()} if all(c.q == 1 for c in keys.values()) else None


def _units(forms: Iterable[Form]) -> dict[tuple[str, bool], Any]:
    """For each name, above and below the line, the largest power that all others are natural powers of."""
    denominators: dict[tuple[str, bool], int] = {}
    for form in forms:
        for mono, _, _ in form:
            for name, e in mono:
                key = name, e > 0
                denominators[key] = math.lcm(denominators.get(key, 1), int(fmpq(e).q))
    return {(name, above): fmpq(1 if above else -1, q) for (name, above), q in denominators.items()}


def as_poly(polynomial: Any) -> Poly:
    """The coefficients of a polynomial of the algebra."""
    return {tuple(map(int, exponents)): int(c) for exponents, c in polynomial.to_dict().items()}


def _with(exponents: Exponents, index: int, value: int) -> Exponents:
    return (*exponents[:index], value, *exponents[index + 1 :])


def _plus(left: Poly, right: Poly) -> Poly:
    total = dict(left)
    for key, c in right.items():
        total[key] = total.get(key, 0) + c
    return {key: c for key, c in total.items() if c}
