"""How fine the boundary of basins is, by its uncertainty exponent.

Of starts drawn at random a part f(ε) has a neighbour at the distance ε that comes to another attractor: f ~ ε^α, and
the boundary in the plane has the box dimension 2 − α. Where it is a smooth curve, α = 1.
Source: McDonald, Grebogi, Ott, Yorke, Physica D 17 (1985) 125–153; intervals: Wilson, J. Am. Stat. Assoc. 22 (1927)
209; Efron, Tibshirani, An Introduction to the Bootstrap, ch. 13.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..contract.experiments.basins import SCALES
from ..simulation.march import Integers, Truths
from ..simulation.problem import Floats

CONFIDENCE, QUANTILE = 0.95, 1.959963984540054
COARSEST = 1.0 / 8.0  # of the sides
DISTANCES = COARSEST * 0.2 ** np.arange(SCALES)
SATURATED = 0.5  # parts that are larger fall no longer like a power
FEWEST, LEVELS = 12, 3  # uncertain starts, and distances, that a power is fitted to
ROUNDS = 30  # of Newton's method
RESAMPLES = 200


@dataclass(frozen=True)
class Boundary:
    """The uncertainty exponent α with its interval."""

    exponent: float
    low: float
    high: float


def wilson(hits: int, count: int) -> tuple[float, float]:
    """The interval of a part of which so many of `count` were seen."""
    z = QUANTILE
    part, bottom = hits / count, 1.0 + z * z / count
    middle = (part + z * z / (2.0 * count)) / bottom
    half = z / bottom * math.sqrt(part * (1.0 - part) / count + z * z / (4.0 * count * count))
    return max(0.0, middle - half), min(1.0, middle + half)


def neighbours(count: int, seed: int) -> Floats:
    """Places in the unit square: `count` at random and, of each, two neighbours at every distance.

    The direction is drawn as well; some lie a little beside the square. Returns shape (count, 1 + SCALES + SCALES, 2).
    """
    random = np.random.default_rng(seed)
    base, angle = random.uniform(size=(count, 1, 2)), random.uniform(0.0, math.tau, count)
    direction = np.column_stack([np.cos(angle), np.sin(angle)])[:, None, :]
    steps = np.concatenate([DISTANCES, -DISTANCES])[None, :, None] * direction
    return np.asarray(np.concatenate([base, base + steps], axis=1))


def uncertain(basins: Integers) -> tuple[Truths, Truths]:
    """Whether a neighbour at each distance comes elsewhere, and whether that is known: shape (count, distances) each.

    `basins`, shape (count, 1 + 2 distances), are numbers of attractors, negative where there is none.
    """
    own, ahead, behind = basins[:, :1], basins[:, 1 : 1 + SCALES], basins[:, 1 + SCALES :]
    known = (own >= 0) & (ahead >= 0) & (behind >= 0)
    return np.asarray(known & ((ahead != own) | (behind != own))), np.asarray(known)


def boundary_of(hits: Truths, known: Truths, seed: int) -> Boundary | None:
    """α by a power fitted to the parts, its interval by drawing the starts anew; None where too few are uncertain."""
    exponent = _fitted(hits, known)
    if exponent is None:
        return None
    random, found = np.random.default_rng([seed, 1]), list[float]()
    for _ in range(RESAMPLES):
        rows = random.integers(0, len(hits), len(hits))
        again = _fitted(hits[rows], known[rows])
        if again is not None:
            found.append(again)
    if len(found) < RESAMPLES // 2:
        return None
    low, high = np.quantile(found, [0.5 * (1.0 - CONFIDENCE), 0.5 * (1.0 + CONFIDENCE)])
    return Boundary(exponent, float(low), float(high))


def _fitted(hits: Truths, known: Truths) -> float | None:
    """The exponent by which n ε^α e^a most likely gives the numbers of uncertain starts (Poisson); zeros count, too."""
    number, count = hits.sum(axis=0).astype(np.float64), known.sum(axis=0).astype(np.float64)
    used = (count > 0) & (number <= SATURATED * count)
    number, count, x = number[used], count[used], np.log(DISTANCES[used])
    if used.sum() < LEVELS or number.sum() < FEWEST or (number > 0).sum() < 2:
        return None
    x = x - x[0]
    found = np.array([math.log(max(number[0], 0.5) / count[0]), 1.0])
    for _ in range(ROUNDS):
        expected = count * np.exp(np.clip(found[0] + found[1] * x, -50.0, 3.0))
        design = np.column_stack([np.ones_like(x), x])
        change = np.linalg.lstsq(design.T @ (expected[:, None] * design), design.T @ (number - expected), rcond=None)[0]
        found = found + np.clip(change, -1.0, 1.0)
        if np.abs(change).max() < 1e-10:
            break
    return float(found[1])
