"""The states at which a question evaluates answers: numbers in its variables, the same ones each time.

There are two groups. Within a group the parameters are the same, so that what hangs on them alone is one unknown number
there; two groups tell a parameter from the number it happens to be.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

import sympy as sp

from ...derivation.compiled import compiled
from ..equality.division import special
from ..task import Task
from ..workbook import Workbook
from .maxima import maxima_name

GROUPS = 2
STATES = 4
MOST_TRIALS = 400
BESIDE = 1e-4  # how far from the zero of a factor it is looked at
Point = tuple[float, ...]


@dataclass(frozen=True, eq=False)
class States:
    """The symbols that an answer to a task may hold, and groups of their values at which the right answer is real."""

    workbook: Workbook
    task: Task

    @cached_property
    def constant(self) -> tuple[sp.Symbol, ...]:
        """The parameters; for a potential the time as well, on which its level may depend."""
        solution = self.workbook.solution
        held = (solution.t,) if self.task.quantity.kind == "potential-energy" else ()
        return (*(solution.q(p.name) for p in self.workbook.scene.parameters), *held)

    @cached_property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        """All symbols: first those that a group holds constant."""
        solution = self.workbook.solution
        names = solution.coordinates
        virtual = (solution.symbols.variation, solution.symbols.differential) if self._is_virtual else ()
        kinds = (solution.q, solution.rate, solution.acceleration, *virtual)
        moving = [kind(q) for kind in kinds for q in names]
        moving += [solution.symbols.differential("t")] if self._is_virtual else []
        materials = [solution.q(m.name) for m in self.workbook.scene.material]
        return tuple(dict.fromkeys((*self.constant, solution.t, *moving, *materials)))

    @property
    def _is_virtual(self) -> bool:
        return self.task.quantity.kind in ("virtual-displacement", "virtual-work", "generalized-force")

    @cached_property
    def groups(self) -> tuple[tuple[Point, ...], ...]:
        """Values of the symbols, four figures each. Raises ValueError where the right answer is nowhere real."""
        source = random.Random(20_061)
        drawn = (tuple(islice(self._group(source), STATES)) for _ in range(MOST_TRIALS))
        found = tuple(islice((group for group in drawn if len(group) == STATES), GROUPS))
        if len(found) < GROUPS:
            raise ValueError(f"the right answer to {self.task.id} has no real values")
        return found

    def _group(self, source: random.Random) -> Iterator[Point]:
        """States with one choice of the parameters; few or none where the answer is not real for it."""
        held = tuple(_rounded(source.uniform(0.55, 1.65)) for _ in self.constant)
        for _ in range(4 * STATES):
            moving = (_rounded(source.uniform(0.3, 1.4)) for _ in self.symbols[len(held) :])
            point = (*held, *moving)
            if self._is_defined(point):
                yield point

    def _is_defined(self, point: Point) -> bool:
        return all(math.isfinite(function(point)) for function in self._functions)

    @cached_property
    def _functions(self) -> tuple:  # type: ignore[type-arg]
        slots = {symbol: index for index, symbol in enumerate(self.symbols)}
        return tuple(compiled(part, slots) for part in self.workbook.right(self.task))

    @cached_property
    def special(self) -> tuple[tuple[sp.Symbol, float], ...]:
        """Beside which values of coordinates and rates a factor tends to vanish."""
        solution = self.workbook.solution
        found = [(solution.q(q), value) for q in solution.free for value in special(solution.q(q), solution)]
        found += [(solution.rate(q), 0.0) for q in solution.free]
        return tuple((symbol, round(value + BESIDE, 6)) for symbol, value in found)

    @cached_property
    def scene_values(self) -> tuple[tuple[str, float], ...]:
        """The scene's parameters, and one for what an angular frequency does not depend on."""
        values = self.workbook.solution.parameter_values
        return tuple((maxima_name(s.name), float(values.get(s, 1.0))) for s in self.symbols)


def _rounded(value: float) -> float:
    return float(f"{value:.4g}")
