"""When an event happened, and how close to one a motion came: by the polynomials through what the kernel saw of steps.

The kernel looks at a few places of each step. It stops where a value is no longer positive there, and keeps of each
value the step in which it came closest to zero, so that a fall through zero and back between two places is found, too.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from .derivatives import accelerations
from .kernels.watch import Watch
from .problem import Floats, Problem

ROUNDS, PARTS = 12, 32  # each round looks at so many parts of what the one before left: 32¹² > 2⁵³
CLOSER = 6  # rounds for a minimum, each an eighth of the part before; its value is flat
MOST_ROOT_STEPS = 100
Point: TypeAlias = tuple[float, float]  # a place and the value there
NUDGE, LEAST_NUDGE = 0.01, 1e-6  # of the step, and seconds


@dataclass(frozen=True)
class Event:
    """Which of the scene's events happened first, when, and the `state` (q, q̇, ∫P dt) then, shape (width,).

    `fall` and `bend` are the first and second time derivatives of its value as it went through zero.
    """

    index: int
    time: float
    state: Floats
    fall: float
    bend: float

    def may_not_be(self, doubt: float) -> bool:
        """Whether the event is uncertain: its value turns back before it is below zero by its error `doubt`."""
        return self.bend > 0.0 and 0.5 * self.fall * self.fall <= doubt * self.bend

    def late_by(self, doubt: float) -> float:
        """The error of the time in seconds if the value is wrong by `doubt`: s in |fall| s − |bend| s²/2 = doubt."""
        root = math.sqrt(max(self.fall * self.fall - 2.0 * abs(self.bend) * doubt, 0.0))
        return 2.0 * doubt / max(abs(self.fall) + root, sys.float_info.min)


@dataclass(frozen=True)
class Approach:
    """How close the value of an event came to zero, when, and in which `state`, shape (width,)."""

    index: int
    value: float
    time: float
    state: Floats


@dataclass(frozen=True)
class EventOccurrence:
    """The event that ended a motion: its number in the scene, its time and that time's estimated error, in seconds."""

    index: int
    time: float
    error: float | None


@dataclass(frozen=True)
class Step:
    """A step as the kernel saw it: states at times, in Chebyshev's extreme points.

    `nodes` (the points in units of the step, from 0 to 1) and `times` have shape (nodes,), `states` shape (nodes,
    width).
    """

    problem: Problem
    nodes: Floats
    times: Floats
    states: Floats

    @property
    def size(self) -> float:
        """The length of the step in seconds."""
        return float(self.times[-1] - self.times[0])

    def time(self, x: Floats) -> Floats:
        """The times at places x of the step, 0 to 1: shape (points,) to shape (points,)."""
        return np.asarray(self.times[0] + self.size * x)

    def state(self, x: Floats) -> Floats:
        """The states at places x of the step by the barycentric formula: shape (points,) to shape (points, width).

        Source: Trefethen, Approximation Theory and Approximation Practice, ch. 5.
        """
        weights = np.where(np.arange(self.nodes.size) % 2 == 0, 1.0, -1.0)
        weights[[0, -1]] *= 0.5
        apart = x[:, None] - self.nodes
        row, column = np.nonzero(apart == 0.0)
        apart[row, column] = 1.0
        shares = weights / apart
        first = self.states[0]  # what rests stays where it is, to the last digit
        found = first + (shares @ (self.states - first)) / shares.sum(axis=1, keepdims=True)
        found[row] = self.states[column]
        return np.asarray(found)

    def values(self, x: Floats) -> Floats:
        """The values of all events at places x of the step: shape (points,) to shape (points, events)."""
        return event_values(self.problem, self.time(x), self.state(x))


def event_values(problem: Problem, times: Floats, states: Floats) -> Floats:
    """What is positive as long as no event has happened.

    `times` has shape (states,), `states` shape (states, ≥ 2n); returns shape (states, events).
    """
    function = problem.model.events
    return np.ones((len(times), 0)) if function is None else function.table(problem.inputs(times, states))


def first_event(problem: Problem, watch: Watch, t_end: float) -> Event | None:
    """The first event in the steps that the kernel recorded, located to rounding; None if none is before `t_end`."""
    steps = (Step(problem, watch.nodes, watch.times, watch.states), *_closest(problem, watch))
    found = [event for step in steps for event in _falls(step) if event.time <= t_end]
    return min(found, key=lambda event: event.time, default=None)


def quick_event(problem: Problem, watch: Watch, t_end: float) -> Event | None:
    """`first_event` for runs that go on behind events: from the values that the kernel saw, by the Illinois method.

    Those that fell between two places that the kernel looked at are left to it.
    """
    fallen = (watch.values <= 0.0).any(axis=1)
    if (watch.least <= 0.0).sum() > (watch.values <= 0.0).any(axis=0).sum() or not fallen.any():
        return first_event(problem, watch, t_end) if (watch.least <= 0.0).any() else None
    last = int(np.argmax(fallen))
    indices = np.flatnonzero(watch.values[last] <= 0.0)
    if last == 0:
        return first_event(problem, watch, t_end)
    look = _Look(problem, watch)
    a, b = float(watch.nodes[last - 1]), float(watch.nodes[last])
    roots = [(look.root(int(j), a, b, watch.values[last - 1, j], watch.values[last, j]), int(j)) for j in indices]
    x, index = min(roots)
    time = look.time(x)
    return Event(index, time, look.state(x), 0.0, 0.0) if time <= t_end else None


class _Look:
    """Values of events at places of a step, one at a time and without the detours of tables."""

    def __init__(self, problem: Problem, watch: Watch) -> None:
        self._nodes, self._states, self._times = watch.nodes, watch.states, watch.times
        self._weights = np.where(np.arange(watch.nodes.size) % 2 == 0, 1.0, -1.0)
        self._weights[[0, -1]] *= 0.5
        self._row = problem.inputs(watch.times[:1], watch.states[:1])[0]
        self._width = 2 * problem.degrees
        self._function: Any = problem.model.events.function if problem.model.events is not None else None

    def time(self, x: float) -> float:
        return float(self._times[0] + (self._times[-1] - self._times[0]) * x)

    def state(self, x: float) -> Floats:
        """By the barycentric formula, shape (width,)."""
        apart = x - self._nodes
        at = np.flatnonzero(apart == 0.0)
        if at.size:
            return np.array(self._states[at[0]])
        shares = self._weights / apart
        first = self._states[0]
        return np.asarray(first + (shares @ (self._states - first)) / shares.sum())

    def value(self, index: int, x: float) -> float:
        self._row[: self._width] = self.state(x)[: self._width]
        self._row[self._width] = self.time(x)
        return float(np.asarray(self._function(self._row)).ravel()[index])

    def root(self, index: int, a: float, b: float, above: float, below: float) -> float:
        """A place with a value ≤ 0, as near to one with a positive one as times can be told apart.

        Source: T. R. Chandrupatla, Advances in Engineering Software 28 (1997) 145–149: inverse quadratic interpolation
        where three values allow it, else the middle.
        """
        span = float(self._times[-1] - self._times[0])
        near = max(math.ulp(b), 0.5 * math.ulp(self.time(b)) / span if span > 0.0 else 0.0)
        (x1, f1), (x2, f2), part = (b, below), (a, above), below / (below - above)
        for _ in range(MOST_ROOT_STEPS):
            x = x1 + min(max(part, near / abs(x2 - x1)), 1.0 - near / abs(x2 - x1)) * (x2 - x1)
            found = self.value(index, x)
            if (found > 0.0) == (f1 > 0.0):
                x3, f3 = x1, f1
            else:
                x3, f3, x2, f2 = x2, f2, x1, f1
            x1, f1 = x, found
            if abs(x2 - x1) <= 2.0 * near or f1 == 0.0:
                break
            part = _inverse_quadratic((x1, f1), (x2, f2), (x3, f3))
        return x1 if f1 <= 0.0 else x2


def _inverse_quadratic(new: Point, across: Point, old: Point) -> float:
    """The part of the way from the newest place to that across the root; half of it where three values do not tell."""
    (x1, f1), (x2, f2), (x3, f3) = new, across, old
    xi, phi = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
    if not (phi * phi < xi and (1.0 - phi) ** 2 < 1.0 - xi):
        return 0.5
    return f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)


def approaches(problem: Problem, watch: Watch, t_end: float) -> tuple[Approach, ...]:
    """How close the value of each event came to zero, as far as that was before `t_end` and is a number."""
    found = (_approach(step, index) for index, step in enumerate(_closest(problem, watch)))
    return tuple(approach for approach in found if approach.time <= t_end and math.isfinite(approach.value))


def _closest(problem: Problem, watch: Watch) -> Iterator[Step]:
    """For each event, the step in which its value was least."""
    for times, states in zip(watch.closest_times, watch.closest_states, strict=True):
        yield Step(problem, watch.nodes, times, states)


def _falls(step: Step) -> Iterator[Event]:
    """The first event in a step, if there is one."""
    if not step.size > 0.0:
        return
    least = [_least(step, index) for index in range(step.values(step.nodes).shape[1])]
    x = _first_fall(step.values, np.union1d(step.nodes, least))
    if x is None:
        return
    place = np.array([x])
    index, time, state = int(np.argmin(step.values(place))), step.time(place), step.state(place)
    yield Event(index, float(time[0]), state[0], *_derivatives(step, index, time, state))


def _derivatives(step: Step, index: int, time: Floats, state: Floats) -> tuple[float, float]:
    """The first two time derivatives of a value along the motion; a coarse method's polynomial has no second one."""
    near = NUDGE * step.size + LEAST_NUDGE
    ahead = np.array([-near, 0.0, near])[:, None]
    halfway = state + 0.5 * ahead * _flow(step.problem, np.repeat(time, 3), np.repeat(state, 3, axis=0))
    rates = _flow(step.problem, time + 0.5 * ahead[:, 0], halfway)
    before, at, after = event_values(step.problem, time + ahead[:, 0], state + ahead * rates)[:, index]
    return float((after - before) / (2.0 * near)), float((after - 2.0 * at + before) / near**2)


def _flow(problem: Problem, times: Floats, states: Floats) -> Floats:
    """d/dt of (q, q̇); the work, on which no event depends, is left at rest."""
    n = problem.degrees
    found = np.zeros_like(states)
    found[:, :n], found[:, n : 2 * n] = states[:, n : 2 * n], accelerations(problem, times, states)
    return found


def _first_fall(values: Callable[[Floats], Floats], nodes: Floats) -> float | None:
    """The first place in the step at which a value is no longer positive; None if there is none."""
    x = np.union1d(nodes, np.linspace(0.0, 1.0, PARTS + 1))
    if not (values(x) <= 0.0).any():
        return None
    for _ in range(ROUNDS):
        fallen = (values(x) <= 0.0).any(axis=1)
        first = int(np.argmax(fallen)) if fallen.any() else len(x) - 1
        if first == 0:
            return float(x[0])
        x = np.linspace(x[first - 1], x[first], PARTS + 1)
    return float(x[-1])


def _approach(step: Step, index: int) -> Approach:
    x = np.array([_least(step, index)])
    return Approach(index, float(step.values(x)[0, index]), float(step.time(x)[0]), step.state(x)[0])


def _least(step: Step, index: int) -> float:
    """The place in the step at which a value is least; the first where it is no number all along."""
    x = np.union1d(step.nodes, np.linspace(0.0, 1.0, PARTS + 1))
    for _ in range(CLOSER):
        at = int(np.argmin(np.nan_to_num(step.values(x)[:, index], nan=np.inf)))
        best = float(x[at])
        x = np.linspace(x[max(at - 1, 0)], x[min(at + 1, len(x) - 1)], PARTS + 1)
    return best
