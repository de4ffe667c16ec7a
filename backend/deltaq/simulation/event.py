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
from .kernels.root import NONE, UNSEEN, find_fall
from .kernels.watch import Watch
from .problem import Floats, Problem

Call: TypeAlias = Callable[..., Any]  # runs a kernel, given before its arguments

ROUNDS, PARTS = 12, 32  # each round looks at so many parts of what the one before left: 32¹² > 2⁵³
CLOSER = 6  # rounds for a minimum, each an eighth of the part before; its value is flat
NUDGE, LEAST_NUDGE = 0.01, 1e-7  # of the step, and of the span


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


def quick_event(problem: Problem, watch: Watch, t_end: float, call: Call) -> Event | None:
    """`first_event` for runs that go on behind events: from the values that the kernel saw (`kernels.root`).

    Those that fell between two places that the kernel looked at are left to it. Kernels are run by `call`.
    """
    width = watch.states.shape[1]
    state, trial, values = np.empty(width), np.empty(width), np.empty(watch.functions)
    index, x = call(find_fall, watch, problem.degrees, state, trial, values)
    if index == UNSEEN:
        return first_event(problem, watch, t_end)
    first, last = float(watch.times[0]), float(watch.times[-1])
    time = first + (last - first) * x
    return Event(index, time, state, 0.0, 0.0) if index != NONE and time <= t_end else None


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
    near = NUDGE * step.size + LEAST_NUDGE * step.problem.t_end
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
