"""Periodic motions as roots: a state that a motion comes back to, over a parameter; with its Floquet multipliers.

Where something drives the scene the time of return is a multiple of the drive's period: φ(y, kT(p); p) = y. Else it is
unknown, too, and the state is bound to lie in the plane of the section: φ(y, τ; p) = y, h(y; p) = 0. Multipliers μ are
the eigenvalues of ∂φ/∂y; without a drive one of them is 1, along the motion, and is left out.
Source: Seydel, Practical Bifurcation and Stability Analysis, 3rd ed., §7.2 to §7.6.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..simulation.problem import Floats
from ..simulation.section import Surface
from .flow import Flow, Image

PASSES, CLOSE = 12, 1e-11  # of Newton's method; of what is left, over the scales
LONGEST_MOVE = 0.3  # of the scales, in one pass
NEARLY = 1e-8  # of the scales: a last move
SINGULAR = 1e-10  # directions in which nothing changes by more than that are left alone
ROUNDING = 1e-6  # of a multiplier, by which a stable motion may miss 1


@dataclass(frozen=True)
class Closed:
    """How far an unknown is from a root: `left`, shape (m,), and its `slopes`, shape (m, m + 1); both over scales.

    `to_time` is whether the time of return is among the unknowns.
    """

    image: Image
    left: Floats
    slopes: Floats
    to_time: bool

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """μ, shape (2n,), or (2n − 1,) without a drive; the largest first."""
        found = np.linalg.eigvals(self.image.by_state).astype(np.complex128)
        if self.to_time:
            found = np.delete(found, int(np.argmin(np.abs(found - 1.0))))
        return found[np.argsort(-np.abs(found))]

    @property
    def is_stable(self) -> bool:
        """Whether no |μ| exceeds 1."""
        return bool(np.abs(self.multipliers).max(initial=0.0) <= 1.0 + ROUNDING)

    @property
    def doubling(self) -> float:
        """Zero where a multiplier is −1."""
        return float(np.linalg.det(self.image.by_state + np.eye(len(self.image.end))))

    @property
    def folding(self) -> float:
        """Zero where a multiplier is 1."""
        return float(np.linalg.det(self.slopes[:, :-1]))

    @property
    def turning(self) -> float:
        """Zero where a pair of complex multipliers has modulus 1; infinite where there is no such pair."""
        pair = np.abs(self.multipliers[np.abs(self.multipliers.imag) > ROUNDING])
        is_kept = (
            abs(abs(float(np.linalg.det(self.image.by_state))) - 1.0) < ROUNDING
        )  # nothing is lost: |μ| = 1 anyway
        return math.inf if is_kept or not len(pair) else float(pair.max()) - 1.0


@dataclass(frozen=True)
class Closing:
    """The equations of motions that close after `folds` periods, or passages of the plane.

    Unknowns are (y, p), or (y, τ, p) where `period` is None, shape (2n + 1,) or (2n + 2,); `scales` has their shape.
    `turns` says of each coordinate whether the scene is the same after a turn of it, shape (n,).
    """

    flow: Flow
    period: Callable[[float], float] | None
    surface: Callable[[float], Surface] | None
    folds: int
    scales: Floats
    turns: NDArray[np.bool_]

    @property
    def width(self) -> int:
        """How many components a state has, 2n."""
        return 2 * self.flow.problem.degrees

    def span(self, unknown: Floats) -> float:
        """The time of return of an unknown, shape (2n + 1,) or (2n + 2,), in seconds."""
        return float(unknown[self.width]) if self.period is None else self.folds * self.period(float(unknown[-1]))

    def state(self, unknown: Floats) -> Floats:
        """y, shape (2n,)."""
        return unknown[: self.width]

    def gap(self, end: Floats, state: Floats) -> Floats:
        """How far apart two states are, but for whole turns of angles; shape (…, 2n)."""
        apart = end - state
        n = self.flow.problem.degrees
        apart[..., :n] -= np.where(self.turns, math.tau * np.round(apart[..., :n] / math.tau), 0.0)
        return apart

    def at(self, unknown: Floats) -> Closed | None:
        """The equations at an unknown, shape (2n + 1,) or (2n + 2,); None where the motion ends."""
        span, value, state = self.span(unknown), float(unknown[-1]), self.state(unknown)
        if not (np.isfinite(unknown).all() and span > 0.0):
            return None
        image = self.flow.image(np.ascontiguousarray(state), span, value, self.folds, self._longer(value))
        if image is None:
            return None
        left, by_state = self.gap(image.end, state), image.by_state - np.eye(self.width)
        own = self.scales[: self.width]
        if self.period is None:
            slopes = np.column_stack([by_state, image.by_time, image.by_value]) / own[:, None]
            value_there, row = self._in_plane(state, value)
            slopes, left = np.vstack([slopes, row]), np.append(left / own, value_there)
        else:
            slopes, left = np.column_stack([by_state, image.by_value]) / own[:, None], left / own
        return Closed(image, left, slopes * self.scales, self.period is None)

    def _longer(self, value: float) -> float:
        """What the parameter adds to the period."""
        if self.period is None:
            return 0.0
        step = self.flow.nudges[-1]
        return float((self.period(value + step) - self.period(value - step)) / (2.0 * step))

    def _in_plane(self, state: Floats, value: float) -> tuple[float, Floats]:
        """h and its derivatives by all unknowns, over what h changes by along the scales."""
        if self.surface is None:
            raise LookupError("without a drive there is a plane")
        row, step = np.append(state, 0.0)[None, :], self.flow.nudges[-1]
        here, above, below = (self.surface(one).values(row)[0] for one in (value, value + step, value - step))
        slopes = np.concatenate([here[1:-1], [0.0, (above[0] - below[0]) / (2.0 * step)]])
        size = float(np.abs(slopes * self.scales).max()) or 1.0
        lost = here[0] - float(self.surface(value).shift(np.array([here[0]]))[0])
        return lost / size, slopes / size

    def root(self, near: Floats, normal: Floats) -> tuple[Floats, Closed] | None:
        """Newton's method from an unknown, across `normal` (over scales), both of shape (2n + 1,) or (2n + 2,).

        None where it does not close.
        """
        found = near.copy()
        for _ in range(PASSES):
            closed = self.at(found)
            if closed is None:
                return None
            off = float(normal @ ((found - near) / self.scales))
            matrix, right = np.vstack([closed.slopes, normal]), -np.append(closed.left, off)
            if not np.isfinite(matrix).all():
                return None
            move = np.linalg.lstsq(matrix, right, rcond=SINGULAR)[0]
            size = float(np.abs(move).max())
            if np.abs(right).max() < CLOSE:  # where branches cross, the last move is made of rounding alone
                return (found + self.scales * move if size < NEARLY else found), closed
            found = found + self.scales * move * min(1.0, LONGEST_MOVE / max(size, 1e-300))
        return None

    def tangent(self, closed: Closed, near: Floats) -> Floats:
        """The direction in which roots follow one another, over scales, of length 1: shape (2n + 1,) or (2n + 2,).

        Where branches cross there are several; it is the one next to `near`.
        """
        matrix = np.vstack([closed.slopes, near])
        found = np.linalg.lstsq(matrix, np.append(np.zeros(len(closed.slopes)), 1.0), rcond=SINGULAR)[0]
        return np.asarray(found / np.linalg.norm(found))
