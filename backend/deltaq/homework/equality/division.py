"""The factor by which one set of equations is another: where it vanishes, and what may be divided out all the same.

What a right equation has as a factor f of all its terms, r in r² φ̈ + 2 r ṙ φ̇ + g r sin φ = 0, may be divided out,
though it can be zero: where it is, the right equation reads 0 = 0 and determines nothing. The divided one loses nothing
there, and says the same elsewhere; textbooks print it so. To multiply by what can be zero, or to divide by what is zero
where the right equation does determine an acceleration (φ̈/sin φ = −g/l), makes another equation.

So X = A A₀⁻¹ must be regular, with a determinant that is nowhere zero, after its columns are multiplied by powers of
the factors of the right rows that belong to them. It is looked at in numbers, in states where such things happen.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product

import sympy as sp

from ...derivation.compiled import Function, compiled
from ..solution import Solution

SPECIAL = (0.0, math.pi / 2, math.pi, -math.pi / 2, -0.7, 0.9)
NEARLY_A_TURN = 0.9 * 2 * math.pi
MOST_STATES = 400
NOTHING = 1e-12
EMPTY = 1e-9
POWERS = range(4)  # of a factor that may have been divided out
NEAR = (1e-3, 1e-5)  # how far from the zero of a factor what is left of it is looked at
STEADY = 4.0  # times: what grows or shrinks more between the two is not regular
GRID = 29
APART = 0.011

Numbers = Sequence[float]


@dataclass(frozen=True)
class Content:
    """What all terms of one of the right equations have as a factor, and at which values of a coordinate it is zero."""

    row: int
    factor: sp.Expr
    symbol: sp.Symbol
    zeros: tuple[float, ...]


class Division:
    """X = own · right⁻¹ for square blocks of two sets of equations; `whole` are the right ones with all columns."""

    def __init__(self, own: sp.Matrix, right: sp.Matrix, whole: sp.Matrix, solution: Solution) -> None:
        self._solution = solution
        self._size = right.rows
        symbols = sorted(own.free_symbols | right.free_symbols, key=str)
        others = sorted(whole.free_symbols - set(symbols), key=str)
        self._slots = {symbol: index for index, symbol in enumerate((*symbols, *others))}
        positive = {solution.q(p.name): 1.3 + 0.1 * k for k, p in enumerate(solution.scene.parameters) if p.positive}
        self._choices = [(positive[s],) if s in positive else special(s, solution) for s in symbols]
        self._others = [positive.get(symbol, 0.9 + 0.1 * k) for k, symbol in enumerate(others)]
        self._own, self._right, self._whole = (self._compiled(matrix) for matrix in (own, right, whole))
        determinants = [matrix.det(method="berkowitz") for matrix in (own, right)]
        self._above, self._below = (compiled(each, self._slots) for each in determinants)

    def _compiled(self, matrix: sp.Matrix) -> list[list[Function]]:
        return [[compiled(entry, self._slots) for entry in matrix.row(k)] for k in range(matrix.rows)]

    def divided(self) -> tuple[sp.Expr, ...] | None:
        """What was divided out, () if nothing; None if the equations are others."""
        for powers in product(POWERS, repeat=len(self.contents)):
            if self._is_regular(powers):
                used = (c.factor for c, power in zip(self.contents, powers, strict=True) if power)
                return tuple(dict.fromkeys(used))
        return None

    @cached_property
    def contents(self) -> tuple[Content, ...]:
        """The factors of all terms of a right equation that can be zero."""
        return tuple(self._contents())

    def _contents(self) -> Iterator[Content]:
        for symbol, choices in zip(self._slots, self._choices, strict=False):
            for row in range(self._size) if len(choices) > 1 else ():
                zeros = tuple(z for z in (0.0, math.pi, math.pi / 2) if z in choices and self._is_empty(row, symbol, z))
                if zeros[:1] == (0.0,):
                    yield Content(row, sp.sin(symbol) if math.pi in zeros else symbol, symbol, zeros)
                elif zeros:
                    yield Content(row, sp.cos(symbol), symbol, zeros)

    def _is_empty(self, row: int, symbol: sp.Symbol, value: float) -> bool:
        """Whether all coefficients of a right equation are zero at a value of a coordinate, whatever the others are."""
        for base in self._bases:
            state = self._with(base, symbol, value)
            usual = max((abs(entry(base)) for entry in self._whole[row]), default=1.0)
            if not all(abs(entry(state)) <= EMPTY * usual for entry in self._whole[row]):
                return False
        return True

    @cached_property
    def _noise(self) -> float:
        """What a determinant that is zero may come out as: its products are of the size of those elsewhere."""
        sizes = (abs(each(base)) for each in (self._above, self._below) for base in self._bases)
        return NOTHING * max(1.0, *filter(math.isfinite, sizes))

    @property
    def _bases(self) -> list[list[float]]:
        """Two states at which nothing happens: no two coordinates are equal, where sin(φ₁ − φ₂) is zero."""
        return [[*self._apart(k), *self._others] for k in (-1, -2)]

    def _apart(self, place: int) -> Iterator[float]:
        for index, choices in enumerate(self._choices):
            yield choices[0] if len(choices) == 1 else choices[max(place, -len(choices))] * (1 + index * APART)

    def _with(self, state: Numbers, symbol: sp.Symbol, value: float) -> list[float]:
        slot = self._slots[symbol]
        return [*state[:slot], value, *state[slot + 1 :]]

    # --- whether the factor is regular ------------------------------------------------------------------------------

    def _is_regular(self, powers: Sequence[int]) -> bool:
        scale = [self._scale(content, power) for content, power in zip(self.contents, powers, strict=True)]

        def ratio(state: Numbers) -> float:
            a, b = self._above(state), self._below(state)
            whole = math.prod(each(state) for each in scale)
            return a * whole / b if abs(b) > self._noise else math.inf

        return self._in_special_states(ratio) and self._along_lines(ratio) and self._near_zeros(ratio, scale)

    def _scale(self, content: Content, power: int) -> Callable[[Numbers], float]:
        function = compiled(content.factor, self._slots)
        return lambda state: function(state) ** power

    def _in_special_states(self, ratio: Callable[[Numbers], float]) -> bool:
        """0/0 tells nothing, nor does a state at which the right equation is undefined; what is undefined in the other
        one does: NaN is not ≤ anything.
        """
        ratios = []
        for state in ([*state, *self._others] for state in states(self._choices)):
            a, b = self._above(state), self._below(state)
            told = not math.isnan(b) and not max(abs(a), abs(b)) <= self._noise
            if told and not any(self._vanishes(content, state) for content in self.contents):
                ratios.append(ratio(state))
        regular = all(NOTHING <= abs(each) <= 1 / NOTHING for each in ratios)
        return regular and (bool(self.contents) or len({each > 0 for each in ratios}) < 2)

    def _vanishes(self, content: Content, state: Numbers) -> bool:
        return state[self._slots[content.symbol]] in content.zeros

    def _along_lines(self, ratio: Callable[[Numbers], float]) -> bool:
        """Whether the factor keeps its sign along every coordinate, but for the zeros of contents."""
        for symbol, choices in zip(self._slots, self._choices, strict=False):
            low, high = min(choices), max(choices)
            zeros = {z for content in self.contents if content.symbol == symbol for z in content.zeros}
            points = [low + (high - low) * (k + 0.37) / GRID for k in range(GRID)] if len(choices) > 1 else []
            for base in self._bases:
                seen = [(point, ratio(self._with(base, symbol, point))) for point in points]
                for (p, a), (q, b) in pairwise(seen):
                    if a * b < 0 and not any(p <= zero <= q for zero in zeros):
                        return False
        return True

    def _near_zeros(self, ratio: Callable[[Numbers], float], scale: Sequence[Callable[[Numbers], float]]) -> bool:
        """Whether X is regular, and its determinant not zero, as near as one likes to the zeros of contents."""
        for content in self.contents:
            for zero, base, side in product(content.zeros, self._bases, (1, -1)):
                far, near = (self._with(base, content.symbol, zero + side * step) for step in NEAR)
                if not _is_steady(ratio(far), ratio(near)) or not self._has_regular_entries(far, near, scale):
                    return False
        return True

    def _has_regular_entries(self, far: Numbers, near: Numbers, scale: Sequence[Callable[[Numbers], float]]) -> bool:
        pairs = zip(self._entries(far, scale), self._entries(near, scale), strict=True)
        return all(abs(b) <= STEADY * max(abs(a), 1.0) for a, b in pairs)

    def _entries(self, state: Numbers, scale: Sequence[Callable[[Numbers], float]]) -> list[float]:
        """The entries of X with its columns multiplied; NaN where the right block is singular."""
        right = [[entry(state) for entry in row] for row in self._right]
        own = [[entry(state) for entry in row] for row in self._own]
        columns = [
            math.prod(each(state) for each, c in zip(scale, self.contents, strict=True) if c.row == k)
            for k in range(self._size)
        ]
        return [x * c for row in own for x, c in zip(_solved_left(right, row), columns, strict=True)]


def _is_steady(far: float, near: float) -> bool:
    return NOTHING < abs(far) < 1 / NOTHING and 1 / STEADY <= abs(near / far) <= STEADY


def _solved_left(matrix: Sequence[Numbers], row: Numbers) -> list[float]:
    """x with x · matrix = row, by elimination with pivots; NaN if the matrix is singular."""
    size = len(matrix)
    work = [[matrix[j][i] for j in range(size)] + [row[i]] for i in range(size)]
    for k in range(size):
        pivot = max(range(k, size), key=lambda i: abs(work[i][k]))
        work[k], work[pivot] = work[pivot], work[k]
        if not work[k][k]:
            return [math.nan] * size
        work[k] = [entry / work[k][k] for entry in work[k]]
        for i in range(size):
            if i != k:
                work[i] = [a - work[i][k] * b for a, b in zip(work[i], work[k], strict=True)]
    return [line[-1] for line in work]


def states(choices: Sequence[Numbers]) -> Iterator[Numbers]:
    """Every symbol at its special values: all combinations of few, each by itself of many."""
    if math.prod(map(len, choices)) <= MOST_STATES:
        yield from product(*choices)
        return
    for index, values in enumerate(choices):
        for value in values:
            yield [value if k == index else own[-1] for k, own in enumerate(choices)]


def special(symbol: sp.Symbol, solution: Solution) -> Numbers:
    """The values at which factors tend to vanish; of a coordinate only those in its range, where it makes sense."""
    found = next((c for c in solution.scene.coordinates if c.name == symbol.name), None)
    if found is None or found.min is None or found.max is None:
        return SPECIAL
    if found.unit == "rad" and found.max - found.min > NEARLY_A_TURN:
        return SPECIAL  # a slider that ends short of ±π bounds where a motion starts, not where it goes
    inside = [value for value in SPECIAL if found.min <= value <= found.max]
    width = found.max - found.min
    return [*inside, found.min + 0.3 * width, found.min + 0.8 * width]
