"""Where a motion is looked at: once in each period of a drive, or wherever it passes a plane; and what is seen there.

Between samples of a motion the plane's root is sought on a quintic (`interpolation`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..language.expression import Expression
from ..model.compiled import Compiled
from ..model.observables import Observable, Observables
from ..simulation.problem import Floats
from ..simulation.section import Brackets, Surface, refined
from .flow import Flow
from .interpolation import quintics

SAMPLES = 96  # in a period, at least
PER_STEP = 12  # samples in a step of the motion


@dataclass(frozen=True)
class Passed:
    """A motion where it is looked at: `rows` (q, q̇, t), shape (passages, 2n + 1), and its `end`, shape (2n,).

    `status` is the outcome of the kernel, 0 where it came to its end.
    """

    rows: Floats
    end: Floats
    status: int


@dataclass(frozen=True)
class View:
    """What is seen of motions: the value of an expression, once in a period, or where `plane` is passed."""

    flow: Flow
    observables: Observables
    axis: Expression
    plane: Expression | None
    direction: int

    @cached_property
    def _seen(self) -> Compiled:
        return self.observables.seen([self.axis])

    @cached_property
    def plane_function(self) -> Observable | None:
        """h of the plane, of q, q̇, t and the parameter."""
        return None if self.plane is None else self.observables.observable(self.plane)

    @cached_property
    def _turns(self) -> bool:
        return _turns(self.observables.observable(self.axis), self.flow)

    def surface(self, value: float) -> Surface:
        """The plane at a value of the parameter."""
        function = self.plane_function
        if function is None:
            raise LookupError("what is seen once in a period has no plane")
        turn = math.tau if _turns(function, self.flow) else math.inf
        return Surface(_at(function.jet, value), self.direction, turn)

    def values(self, value: float, rows: Floats) -> Floats:
        """What is seen at rows (q, q̇, t), shape (rows,); an angle is between −π and π."""
        if not len(rows):
            return np.zeros(0)
        found = _at(self._seen, value)(rows)[:, 0]
        return np.asarray(np.remainder(found + math.pi, math.tau) - math.pi if self._turns else found)

    def energies(self, value: float, rows: Floats) -> Floats:
        """The energy at rows (q, q̇, t), shape (rows,)."""
        return _at(self._seen, value)(rows)[:, -1]

    def passed(self, value: float, state: Floats, unit: float, count: int, density: float = 0.0) -> Passed:
        """The motion from a state, shape (2n,), over so many units of time (a period), where it is looked at."""
        if self.plane is None:
            times = np.linspace(0.0, unit * count, count + 1)
            found = self.flow.traced(np.array([value]), state[None, :], times)
            rows = np.column_stack([found.states[0], times])
            rows = rows[np.isfinite(rows).all(axis=1)]
            return Passed(rows[:-1], found.states[0, -1], int(found.outcomes[0]))
        samples = math.ceil(count * max(SAMPLES, unit * density))
        times = np.linspace(0.0, unit * count, samples + 1)
        found = self.flow.traced(np.array([value]), state[None, :], times)
        states = found.states[0]
        good = int(np.isfinite(states).all(axis=1).cumprod().sum())
        rows = self._crossings(value, np.column_stack([states, times])[:good])
        return Passed(rows, states[-1], int(found.outcomes[0]))

    def _crossings(self, value: float, rows: Floats) -> Floats:
        surface = self.surface(value)
        found = surface.values(rows)[:, 0]
        shift = surface.shift(0.5 * (found[:-1] + found[1:]))
        left, right = found[:-1] - shift, found[1:] - shift
        (where,) = np.nonzero(surface.is_crossed(left, right) & np.isfinite(left + right))
        if not len(where):
            return rows[:0]
        series = quintics(self.flow.at(value), rows[where], rows[where + 1])
        ends = np.zeros(len(where)), np.ones(len(where))
        brackets = Brackets(where, series, *ends, left[where], right[where], shift[where])
        return refined(brackets, surface).rows


def _at(function: Compiled, value: float) -> Callable[[Floats], Floats]:
    """A function of (q, q̇, t) at a value of the parameter."""
    return lambda rows: function.table(np.column_stack([rows, np.full(len(rows), value)]))


def _turns(function: Observable, flow: Flow) -> bool:
    """Whether a turn of one of the angles changes the value by a turn, and nothing else."""
    return any(flow.problem.angular[place] for place in function.turning)
