"""Prescribed lengths along a run: where one comes to zero, a rod has no direction left in which it could act.

On a line its condition would go on, with places that have passed through each other at a distance below zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mechanics.constraints.distance import DistanceConstraint
from ..model.compiled import Compiled, compile_expressions
from ..model.equations import guided_into
from ..model.model import Model
from ..model.symengine_algebra import to_symengine
from .problem import Floats, Problem

HALVINGS = 60
LITTLE = 1e-2  # of a length's largest value on the way, where a run could not go on


@dataclass(frozen=True)
class Lengths:
    """The prescribed lengths that change with the time or the place, by the names of their constraints."""

    names: tuple[str, ...]
    values: Compiled

    @classmethod
    def of(cls, model: Model) -> Lengths | None:
        """Those of a model's scene; None if it has none."""
        symbols = model.eqs.symbols
        rods = [each for each in model.scene.constraints if isinstance(each, DistanceConstraint)]
        found = {rod.name: guided_into(model.scene, to_symengine(rod.length.tree, symbols)) for rod in rods}
        moving = {symbols.time, *(symbols.values[name] for name in symbols.free)}
        changing = {name: length for name, length in found.items() if length.free_symbols & moving}
        if not changing:
            return None
        return cls(tuple(changing), compile_expressions(symbols.inputs, list(changing.values())))

    def at(self, problem: Problem, times: Floats, states: Floats) -> Floats:
        """The lengths at `times`, shape (states,), and `states`, shape (states, ≥ 2n): shape (states, lengths)."""
        return self.values.table(problem.inputs(times, states))


@dataclass(frozen=True)
class Vanishing:
    """The constraint whose length comes to zero, and when, in seconds."""

    name: str
    time: float


def first_vanishing(problem: Problem, times: Floats, states: Floats) -> Vanishing | None:
    """The first length that is not positive at states in the order of their times; None if all are.

    `times` has shape (states,), `states` shape (states, ≥ 2n).
    """
    lengths = _lengths(problem)
    if lengths is None or not len(times):
        return None
    is_gone = lengths.at(problem, times, states) <= 0.0
    if not is_gone.any():
        return None
    last = int(np.argmax(is_gone.any(axis=1)))
    which = int(np.argmax(is_gone[last]))
    if last == 0:
        return Vanishing(lengths.names[which], float(times[0]))
    n, low, high = problem.degrees, 0.0, 1.0
    ends = times[last - 1 : last + 1], states[last - 1 : last + 1, : 2 * n]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        is_left = lengths.at(problem, *_between(*ends, middle))[0, which] > 0.0
        low, high = (middle, high) if is_left else (low, middle)
    return Vanishing(lengths.names[which], float(ends[0][0] + low * (ends[0][1] - ends[0][0])))


def fading_length(problem: Problem, times: Floats, states: Floats) -> str | None:
    """The constraint whose length had come close to zero at the last of some states; None if none had.

    `times` has shape (states,), `states` shape (states, ≥ 2n).
    """
    lengths = _lengths(problem)
    if lengths is None or len(times) < 2:
        return None
    values = lengths.at(problem, times, states)
    share = values[-1] / values.max(axis=0)
    least = int(np.argmin(share))
    return lengths.names[least] if share[least] < LITTLE and values[-1, least] < values[-2, least] else None


def _lengths(problem: Problem) -> Lengths | None:
    model = problem.model
    return model.kept("lengths", lambda: Lengths.of(model))


def _between(times: Floats, states: Floats, share: float) -> tuple[Floats, Floats]:
    """Time and state at a share of the way between two, by a cubic for q and a line for q̇: shapes (1,) and (1, 2n).

    `times` has shape (2,), `states` shape (2, 2n).
    """
    n, h = states.shape[1] // 2, float(times[1] - times[0])
    q, v = states[:, :n], states[:, n:]
    rest = 1.0 - share
    place = rest * q[0] + share * q[1]
    place = place + share * rest * (rest * (h * v[0] - q[1] + q[0]) - share * (h * v[1] - q[1] + q[0]))
    found = np.concatenate([place, rest * v[0] + share * v[1]])
    return np.array([times[0] + share * h]), found[None, :]
