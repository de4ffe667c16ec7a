"""Fixed points at which answers are evaluated: equal answers have equal values, so unequal values settle most cases.

The parameters and the time are the same at all points, and coordinates, rates, accelerations, virtual displacements
and differentials differ: what hangs on parameters alone is then one unknown number.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..derivation.compiled import Function, compiled
from ..language.memory import cached_method
from .solution import Solution

POINTS = 6
CLOSE = 1e-7
DISTINCT = 1e-4  # values further apart than this are not so by rounding
Values = tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Sampler:
    """Values of expressions in the symbols of a solution."""

    solution: Solution

    @cached_property
    def slots(self) -> dict[sp.Symbol, int]:
        """The place of each symbol in a point."""
        return {symbol: index for index, symbol in enumerate((*self._constant, *self._moving))}

    @property
    def _constant(self) -> list[sp.Symbol]:
        names = [symbol.name for symbol in self.solution.scene.names.symbols if symbol.kind == "parameter"]
        return [self.solution.t, *map(self.solution.q, names)]

    @property
    def _moving(self) -> list[sp.Symbol]:
        solution = self.solution
        jets = [solution.symbols.rate(q, order) for q in solution.coordinates for order in (1, 2, 3)]
        virtual = [solution.symbols.variation(q, order) for q in solution.coordinates for order in (0, 1, 2)]
        differentials = [solution.symbols.differential(name) for name in (*solution.coordinates, "t")]
        materials = [solution.q(m.name) for m in solution.scene.material]
        multipliers = [x for one in solution.scene.multipliers for x in (solution.q(one.name), solution.rate(one.name))]
        return [*map(solution.q, solution.coordinates), *jets, *virtual, *differentials, *materials, *multipliers]

    @cached_property
    def points(self) -> tuple[list[float], ...]:
        """Points at random, always the same: values of all symbols in the order of `slots`."""
        source = random.Random(20_061)
        constant = [source.uniform(0.55, 1.65) for _ in self._constant]
        return tuple([*constant, *(source.uniform(0.3, 1.4) for _ in self._moving)] for _ in range(POINTS))

    def _function(self, expression: sp.Expr) -> Function:
        """The expression as a function of a point; NaN everywhere if it holds other symbols or complex numbers."""
        try:
            return compiled(expression, self.slots)
        except (TypeError, KeyError):
            return lambda _: math.nan

    @cached_method
    def values(self, expression: sp.Expr) -> Values:
        """The value at every point; NaN where it is not defined."""
        function = self._function(expression)
        return tuple(function(point) for point in self.points)

    @cached_method
    def rows(self, residual: sp.Expr) -> tuple[Values, ...]:
        """The row (a₁ … a_f, b) of a residual Σ aᵢ q̈ᵢ + b at every point; NaN where it is not of this form."""
        function = self._function(residual)
        accelerations = [self.slots[self.solution.acceleration(q)] for q in self.solution.free]
        return tuple(_row(function, point, accelerations) for point in self.points)


def _row(function: Callable[[Sequence[float]], float], point: list[float], slots: list[int]) -> Values:
    still = [0.0 if index in slots else value for index, value in enumerate(point)]
    rest = function(still)
    unit = []
    for slot in slots:
        still[slot] = 1.0
        unit.append(function(still) - rest)
        still[slot] = 0.0
    direct = function(point)
    linear = rest + sum(a * point[slot] for a, slot in zip(unit, slots, strict=True))
    size = abs(rest) + sum(map(abs, unit)) + abs(direct)
    return (*unit, rest) if abs(direct - linear) <= CLOSE * size else (float("nan"),) * (len(unit) + 1)


def close(left: Iterable[float], right: Iterable[float], tolerance: float = CLOSE) -> bool:
    """Whether two lists of values are equal but for rounding; NaN is equal to nothing."""
    pairs = list(zip(left, right, strict=True))
    scale = max((max(abs(a), abs(b)) for a, b in pairs), default=0.0)
    return all(abs(a - b) <= tolerance * scale for a, b in pairs)


def defined(values: Iterable[float]) -> bool:
    """Whether all are numbers of a size that can be compared."""
    return all(abs(value) < 1e100 for value in values)


def echelon(rows: Sequence[Sequence[float]]) -> tuple[Values, ...]:
    """The reduced row echelon form, which every invertible combination of the rows shares; fewer rows if dependent."""
    work = [list(row) for row in rows]
    size = max((abs(entry) for row in work for entry in row), default=0.0)
    done = 0
    for column in range(len(work[0]) if work else 0):
        best = max(range(done, len(work)), key=lambda r: abs(work[r][column]), default=None)
        if best is None or abs(work[best][column]) <= CLOSE * size:
            continue
        work[done], work[best] = work[best], work[done]
        work[done] = [entry / work[done][column] for entry in work[done]]
        for r in range(len(work)):
            if r != done:
                work[r] = [a - work[r][column] * b for a, b in zip(work[r], work[done], strict=True)]
        done += 1
    return tuple(tuple(row) for row in work[:done])
