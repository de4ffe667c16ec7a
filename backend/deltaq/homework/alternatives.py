"""Other right answers: a constant force may be kept out of the potential.

Its potential −F · r goes into V, or its generalized force stays on the right side of the equation: both are taught. So
V and L are right with and without the potentials of given forces and moments that are constant. The weight, springs and
other potentials belong to V; and a V in which nothing would be left says nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from ..mechanics.contributions import Contribution, DistributedForce, Moment, PointForce
from .equality import Parts
from .solution import Solution
from .task import Task

GIVEN = ("force", "moment", "distributed")
MOST_LOADS = 4


def alternatives(solution: Solution, task: Task) -> Iterator[tuple[Parts, tuple[str, ...]]]:
    """The answers that are right besides, each with the loads that it leaves out of V."""
    sign = {"potential-energy": -1, "lagrangian": 1}.get(task.quantity.kind)
    loads = list(constant_forces(solution))[:MOST_LOADS] if sign else []
    for count in range(1, len(loads) + 1):
        for left_out in combinations(loads, count):
            left = sum(map(solution.load_potential, left_out), solution.zero)
            (right,) = task.value(solution)
            found = (right + (sign or 1) * left).expand()
            if found.free_symbols & {kind(q) for q in solution.free for kind in (solution.q, solution.rate)}:
                yield (found,), left_out


def constant_forces(solution: Solution) -> Iterator[str]:
    """The given forces and moments with a potential that depend on nothing."""
    for load in solution.scene.loads:
        parts = [part for part in solution.scene.contributions if part.source == load.name]
        if (
            load.kind in GIVEN
            and solution.is_conservative(load.name)
            and all(_is_constant(part, solution) for part in parts)
        ):
            yield load.name


def _is_constant(part: Contribution, solution: Solution) -> bool:
    moving = {solution.t, *map(solution.q, solution.coordinates), *map(solution.rate, solution.coordinates)}
    match part:
        case PointForce() | DistributedForce():
            values = list(solution.force(part))
        case Moment():
            values = [solution.expression(part.moment)]
        case _:
            return False
    return not any(value.free_symbols & moving for value in values)
