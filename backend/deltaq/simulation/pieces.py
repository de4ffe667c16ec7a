"""The span of a problem in pieces, each with the largest step that sees what the forces do there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from .problem import Floats

JOINED = 4.0  # neighbouring pieces whose largest steps differ by less are one
MOST_PIECES = 2000
ROOM = 8.0  # units in the last place of a time


@dataclass(frozen=True)
class BlindStretch:
    """Times between which steps are too long to see what happens, and the step that would see."""

    start: float
    end: float
    step: float


@dataclass(frozen=True)
class Pieces:
    """Piece k goes up to ends[k], with steps up to largest[k]; 0 marks a jump between two neighbouring numbers."""

    ends: tuple[float, ...]
    largest: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.ends) != len(self.largest) or any(
            b <= a for a, b in zip((0.0, *self.ends), self.ends, strict=False)
        ):
            raise ValueError("pieces must follow one another, each with its largest step")

    @classmethod
    def whole(cls, t_end: float) -> Pieces:
        """One piece without a bound."""
        return cls((t_end,), (np.inf,))

    @classmethod
    def joined(cls, t_end: float, leaves: Sequence[tuple[float, float, float]]) -> Pieces:
        """Pieces from adjoining intervals (start, end, largest step), those joined that need much the same."""
        share = JOINED
        while True:
            found: list[tuple[float, float, float]] = []
            for _, end, bound in leaves:
                step = min(bound, t_end)
                if found and _alike(step, found[-1], share):
                    _, smallest, largest = found[-1]
                    found[-1] = (end, min(smallest, step), max(largest, step))
                else:
                    found.append((end, step, step))
            if len(found) <= MOST_PIECES:
                return cls(*zip(*_with_room(t_end, [(end, step) for end, step, _ in found]), strict=True))
            share *= 2.0

    @property
    def jumps(self) -> tuple[tuple[float, float], ...]:
        """The times just before and just after the forces jump."""
        starts = (0.0, *self.ends)
        return tuple((starts[k], self.ends[k]) for k, largest in enumerate(self.largest) if largest == 0.0)

    @property
    def is_whole(self) -> bool:
        """Whether it is one piece whose steps nothing bounds."""
        return len(self.largest) == 1 and self.largest[0] >= self.ends[0]

    def needed_by(self, step: float) -> BlindStretch | None:
        """The first stretch that a fixed step passes over without seeing what happens there; None if it sees all."""
        starts = (0.0, *self.ends[:-1])
        short = (
            (a, b, size) for a, b, size in zip(starts, self.ends, self.largest, strict=True) if 0.0 < size < 0.5 * step
        )
        between = ((a, b, b - a) for (_, a), (b, _) in pairwise(self.jumps) if b - a < step)
        return min((BlindStretch(*found) for found in (*short, *between)), key=lambda found: found.start, default=None)

    def with_bounds(self, bounds: Sequence[tuple[float, float, float]]) -> Pieces:
        """The pieces with further bounds (start, end, largest step) on some stretches."""
        cuts = sorted({*self.ends, *(t for start, end, _ in bounds for t in (start, end) if 0.0 < t < self.ends[-1])})
        starts = np.array((0.0, *cuts[:-1]))
        largest = np.array(self.largest)[np.searchsorted(self.ends, cuts)]
        for start, end, step in bounds:
            inside = (starts >= start) & (np.array(cuts) <= end) & (largest > 0.0)
            largest[inside] = np.minimum(largest[inside], step)
        return Pieces(tuple(cuts), tuple(largest.tolist()))

    def steps(self, size: float, ratio: float = 1.0, start: float = 0.0) -> Floats:
        """Fixed steps for each piece: as many as it takes with that size or the bound, `ratio` times as many.

        The first piece counts from the `start` of the run, in seconds. Returns shape (pieces,), in seconds.
        """
        lengths = np.diff(np.array((start, *self.ends)))
        bounds = np.minimum(np.array(self.largest), size)
        with np.errstate(divide="ignore"):
            counts = np.ceil(np.ceil(lengths / bounds * (1.0 - 1e-12)) * ratio * (1.0 - 1e-12))
        return np.asarray(np.where(bounds == 0.0, 0.0, lengths / np.maximum(counts, 1.0)))

    def scaled(self, factor: float) -> Pieces:
        """The pieces with all bounds that much smaller, for steps that are to become so everywhere.

        What bounds a step may be the length of its piece.
        """
        if self.is_whole:
            return self
        lengths = np.diff(np.array((0.0, *self.ends)))
        return Pieces(self.ends, tuple((np.minimum(np.array(self.largest), lengths) * factor).tolist()))

    def bounded(self, size: float) -> Floats:
        """The largest step of each piece, none above the size: shape (pieces,)."""
        return np.asarray(np.minimum(np.array(self.largest), size))


def _with_room(t_end: float, pieces: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Pieces (end, largest step) with jumps a few units in the last place of the time wider on both sides.

    The time t + h of a last stage is rounded, and must not be behind the jump that the step ends before.
    """
    found: list[tuple[float, float]] = []
    steps = [step for _, step in pieces]
    for (planned, step), following in zip(pieces, [*steps[1:], np.inf], strict=True):
        room = ROOM * float(np.spacing(planned))
        end = planned + room if step == 0.0 else planned - room if following == 0.0 else planned
        start, before = found[-1] if found else (0.0, np.inf)
        if step == before == 0.0:
            found[-1] = (max(end, start), 0.0)
        elif end > start:
            found.append((end, step))
    return [*found[:-1], (t_end, found[-1][1])]


def _alike(step: float, piece: tuple[float, float, float], share: float) -> bool:
    """Whether a bound fits in with those of a piece; jumps that follow one another are one."""
    _, smallest, largest = piece
    if step == 0.0 or smallest == 0.0:
        return step == largest
    return max(step, largest) < share * min(step, smallest)
