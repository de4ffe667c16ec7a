"""What error estimates of motions with many impacts are worth: a ball between two walls, held against 60 digits.

Run it from the checkout: `python -m tests.benchmarks.bench_impacts [count [seed]]`; 200 motions in two minutes. Half of
them are in wide wedges, where each impact parts neighbours and rounding is all that is wrong, the others in narrow
ones, or lose something with each impact. Prints; judges nothing.
"""

from __future__ import annotations

import sys
from random import Random

import numpy as np
from tests.simulation.test_impact_errors import EVER, METHODS, Wedge, drawn

from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

WIDE, NARROW, ANY = (46.0, 70.0), (25.0, 44.0), (25.0, 70.0)
FAR = 100.0
USUAL = ("200", "1")  # motions, seed


def case(random: Random) -> tuple[Wedge, float]:
    """A wedge with a start, and the seconds it is followed for; what loses much comes to the corner, and is not."""
    angles = random.choice([WIDE, WIDE, NARROW, ANY])
    if angles == ANY:
        return drawn(random, *angles, random.choice([0.9, 0.97, 0.99])), random.choice([10.0, 20.0])
    return drawn(random, *angles, 1.0), random.choice([10.0, 20.0, 40.0, 60.0])


def judged(random: Random) -> tuple[bool, bool, bool] | None:
    """Whether all errors were below their estimates, and the largest not too far; and whether it was wrong in silence.

    None for a motion that comes to rest.
    """
    (wedge, t_end), tolerance, method = case(random), random.choice([1e-6, 1e-8, 1e-10]), random.choice(METHODS)
    found = simulate(problem_of(wedge.scene, t_end, 51), get_method(method), tolerance=tolerance)
    if found.estimate is None or {each.kind for each in found.transitions} != {"impact"}:
        return None
    trusted = found.times <= found.trusted_until
    true = np.abs(found.values - wedge.exactly(found.times)).max(axis=1)[trusted]
    told = found.estimate.errors[trusted]
    is_near = bool(told.max() <= FAR * max(true.max(), EVER))
    is_wrong = bool(found.outcome.status == "ok" and true.max() > tolerance)
    return bool((true <= told + EVER).all()), is_near, is_wrong


def main() -> None:
    count, seed = (int(each) for each in [*sys.argv[1:3], *USUAL[len(sys.argv) - 1 :]])
    random = Random(seed)
    found = [each for each in (judged(random) for _ in range(count)) if each is not None]
    covered, near, wrong = (sum(column) for column in zip(*found, strict=True))
    print(f"{len(found)} motions: {covered} covered, {near} within {FAR:.0f} ×, {wrong} wrong without a warning")


if __name__ == "__main__":
    main()
