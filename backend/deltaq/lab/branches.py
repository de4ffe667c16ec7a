"""All branches of periodic motions that sweeps have come upon, and those that spring from their bifurcations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..simulation.problem import Floats
from .closing import Closing
from .continuation import Branch, Point, Range, at_value, followed, sprung
from .hysteresis import Settled

MOST_BRANCHES = 24
SAME = 1e-5  # of the scales: motions so near are one
LOOKED_AT = 10  # parts of a branch, between which it is looked whether it is on another
CLOSE_BY = 0.02  # the same, for a branch on which a motion may lie


@dataclass(frozen=True)
class Search:
    """Where branches are sought: the equations for motions of one fold, the range, and the most folds."""

    closing: Closing
    limits: Range
    most_folds: int

    def branches(self, seeds: Iterable[Settled]) -> Iterator[Branch]:
        """One branch after the other: first through the seeds, each followed by all that spring from it."""
        found: list[Branch] = []
        for seed in seeds:
            start = self._start(seed)
            if start is None or any(_holds(branch, *start) for branch in found):
                continue
            waiting = [followed(start[0], start[1], self.limits)]
            while waiting and len(found) < MOST_BRANCHES:
                branch = waiting.pop(0)
                if not branch.points or any(_is_covered(branch, each) for each in found):
                    continue
                found.append(branch)
                yield branch
                waiting += self._sprung(branch)

    def _sprung(self, branch: Branch) -> list[Branch]:
        found: list[Branch] = []
        for each in branch.bifurcations:
            doubles = each.kind == "period-doubling"
            if not doubles or 2 * branch.folds <= self.most_folds:
                found += sprung(each, branch.closing, self.limits)
        return found

    def _start(self, seed: Settled) -> tuple[Closing, Point] | None:
        """The periodic motion that a sweep has settled to, of as few folds as it has."""
        if seed.start is None or not seed.folds:
            return None
        closing = replace(self.closing, folds=seed.folds)
        unknown = [*seed.start, *([seed.span] if closing.period is None else []), seed.value]
        point = at_value(closing, np.array(unknown))
        if point is None:
            return None
        for folds in range(1, seed.folds):
            orbit = point.closed.image.orbit
            if seed.folds % folds or closing.period is None or not len(orbit) > folds:
                continue
            if np.abs(closing.gap(orbit[folds], orbit[0]) / closing.scales[: closing.width]).max() < SAME:
                less = replace(closing, folds=folds)
                again = at_value(less, point.unknown)
                return None if again is None else (less, again)
        return closing, point


def _holds(branch: Branch, closing: Closing, point: Point) -> bool:
    """Whether a motion belongs to a branch: found again from neighbours there, at any of its folds."""
    if branch.folds != closing.folds:
        return False
    for one, other in pairwise(branch.points):
        low, high = sorted((one.value, other.value))
        if not low <= point.value <= high:
            continue
        share = 0.5 if one.value == other.value else (point.value - one.value) / (other.value - one.value)
        near = one.unknown + share * (other.unknown - one.unknown)
        near[-1] = point.value
        if _distance(closing, near, point) > CLOSE_BY + _length(closing, one, other):
            continue
        again = at_value(closing, near)
        if again is not None and _distance(closing, again.unknown, point) < SAME:
            return True
    return False


def _distance(closing: Closing, unknown: Floats, point: Point) -> float:
    """How far a state is from the nearest of the states that a motion has at its folds, over scales."""
    orbit = point.closed.image.orbit
    apart = closing.gap(np.tile(closing.state(unknown), (len(orbit), 1)), orbit) / closing.scales[: closing.width]
    return float(np.abs(apart).max(axis=1).min())


def _length(closing: Closing, one: Point, other: Point) -> float:
    apart = closing.gap(closing.state(one.unknown), closing.state(other.unknown))
    return float(np.abs(apart / closing.scales[: closing.width]).max())


def _is_covered(branch: Branch, other: Branch) -> bool:
    """Whether a branch lies on another one, by some of its points: some others may be where both begin."""
    last = len(branch.points) - 1
    return any(_holds(other, branch.closing, branch.points[last * part // LOOKED_AT]) for part in range(1, LOOKED_AT))


def feigenbaum(branches: Sequence[Branch]) -> tuple[float, ...]:
    """Quotients (pₖ − pₖ₋₁)/(pₖ₊₁ − pₖ) of the doublings in a row, from the first motion that doubles three times.

    Source: Feigenbaum, J. Stat. Phys. 19 (1978) 25–52: they tend to 4.6692…
    """
    chains: dict[int, float] = {}
    for branch in branches:
        doublings = [one.point.value for one in branch.bifurcations if one.kind == "period-doubling"]
        if not doublings or (chains and branch.folds != 2 * max(chains)):
            continue
        begin = branch.points[0].value
        chains[branch.folds] = min(doublings, key=lambda value: abs(value - begin)) if chains else doublings[0]
    values = [chains[folds] for folds in sorted(chains)]
    steps = np.diff(values)
    if len(steps) < 2 or not (np.sign(steps) == np.sign(steps[0])).all():
        return ()
    return tuple(map(float, steps[:-1] / steps[1:]))
