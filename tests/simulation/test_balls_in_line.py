"""Balls on a line between two walls that meet each other and the walls, held against the same motion in 60 digits.

Between impacts nothing accelerates them, so that every method is right but for rounding. Masses differ up to a
thousand times, and the coordinates are skew: impulses take much of the digits then. Of impacts that lose energy
ever more follow each other in a moment.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from random import Random

import numpy as np
import pytest
from mpmath import lu_solve, matrix, mp, mpf, workdps
from numpy.typing import NDArray
from tests.simulation.scenes import document

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

METHODS = ("dop853", "taylor", "dormand-prince-54", "rk4", "radau-5", "gauss-4")
WALLS_AWAY = 8.0
EVER = 1e-15


@dataclass(frozen=True)
class Balls:
    """Balls at x = A q, of these masses and rates ẋ, all with one acceleration; `kept` are coefficients of restitution.

    The first and the last are those of the walls at x = 0 and x = 8.
    """

    skew: tuple[tuple[float, ...], ...]
    places: tuple[float, ...]
    rates: tuple[float, ...]
    masses: tuple[float, ...]
    kept: tuple[float, ...]
    pull: float = 0.0

    @property
    def count(self) -> int:
        return len(self.masses)

    @property
    def start(self) -> list[tuple[float, float]]:
        """q and q̇ of each coordinate."""
        return list(
            zip(*(np.linalg.solve(self.skew, each).tolist() for each in (self.places, self.rates)), strict=True)
        )

    @property
    def scene(self) -> Scene:
        names = [f"q{j}" for j in range(self.count)]
        x = [" + ".join(f"({a!r})*{name}" for a, name in zip(row, names, strict=True)) for row in self.skew]
        gaps = [x[0], *(f"({b}) - ({a})" for a, b in pairwise(x)), f"{WALLS_AWAY} - ({x[-1]})"]
        masses = {f"m{j}": mass for j, mass in enumerate(self.masses)}
        weight = {"kind": "gravity", "name": "weight", "acceleration": [repr(self.pull), "0"]}
        found = document(
            dict(zip(names, self.start, strict=True)),
            masses,
            {f"ball{j}": (name, [place, "0"]) for j, (name, place) in enumerate(zip(masses, x, strict=True))},
            [weight] if self.pull else [],
        )
        events = [
            {"name": f"gap{j}", "value": gap, "then": "bounce", "restitution": repr(e)}
            for j, (gap, e) in enumerate(zip(gaps, self.kept, strict=True))
        ]
        return read_scene(found | {"events": events})

    def exactly(self, times: Sequence[float]) -> NDArray[np.float64]:
        """q at these times, shape (samples, n), from impact to impact."""
        with workdps(60):
            skew, ahead = matrix([list(row) for row in self.skew]), [mpf(each) for each in times]
            return np.array([[float(q) for q in lu_solve(skew, matrix(x))] for x in self._along(skew, ahead)])

    def _along(self, skew: matrix, times: list[mpf]) -> Iterator[list[mpf]]:
        x, v = (list(skew * matrix([mpf(each[k]) for each in self.start])) for k in (0, 1))
        a, now = mpf(self.pull), mpf(0)
        while times:
            flight, gap = min(self._meetings(x, v, a), default=(mp.inf, 0))
            while times and times[0] <= now + flight:
                s = times.pop(0) - now
                yield [each + s * (rate + a * s / 2) for each, rate in zip(x, v, strict=True)]
            if times:
                x = [each + flight * (rate + a * flight / 2) for each, rate in zip(x, v, strict=True)]
                v, now = self._met([rate + a * flight for rate in v], gap), now + flight

    def _meetings(self, x: list[mpf], v: list[mpf], a: mpf) -> Iterator[tuple[mpf, int]]:
        """After which times each gap would close."""
        gaps = [x[0], *(x[j + 1] - x[j] for j in range(self.count - 1)), mpf(WALLS_AWAY) - x[-1]]
        rates = [v[0], *(v[j + 1] - v[j] for j in range(self.count - 1)), -v[-1]]
        pulls = [a, *[mpf(0)] * (self.count - 1), -a]
        for j, (gap, rate, pull) in enumerate(zip(gaps, rates, pulls, strict=True)):
            square = rate * rate - 2 * pull * gap
            if pull != 0 and square >= 0:
                if (flight := (-rate - mp.sqrt(square)) / pull) > EVER:
                    yield flight, j
            elif pull == 0 and rate < 0:
                yield max(-gap / rate, mpf(0)), j

    def _met(self, v: list[mpf], gap: int) -> list[mpf]:
        """The rates behind an impact."""
        e = mpf(self.kept[gap])
        if gap in (0, self.count):
            j = min(gap, self.count - 1)
            return [-e * rate if k == j else rate for k, rate in enumerate(v)]
        i, j = gap - 1, gap
        m, n = mpf(self.masses[i]), mpf(self.masses[j])
        impulse = (1 + e) * m * n / (m + n) * (v[i] - v[j])
        return [rate - impulse / m if k == i else rate + impulse / n if k == j else rate for k, rate in enumerate(v)]


def drawn(random: Random, count: int) -> Balls:
    """Balls that lose nothing, of masses from 0.03 to 30, in skew coordinates."""
    skew = np.eye(count) + np.array([[random.uniform(-0.4, 0.4) for _ in range(count)] for _ in range(count)])
    return Balls(
        tuple(map(tuple, skew.tolist())),
        tuple(sorted(random.uniform(0.5, 7.5) for _ in range(count))),
        tuple(random.uniform(-3.0, 3.0) for _ in range(count)),
        tuple(10.0 ** random.uniform(-1.5, 1.5) for _ in range(count)),
        (1.0,) * (count + 1),
    )


COLLAPSE = Balls(
    skew=((1.0, 0.2), (-0.1, 0.9)), places=(2.5, 7.9), rates=(1.7, -1.6), masses=(22.7, 0.5), kept=(1.0, 0.36, 1.0)
)
HEAP = Balls(
    skew=((1.0, 0.1, 0.0), (0.0, 1.0, -0.2), (0.1, 0.0, 0.9)),
    places=(1.0, 3.0, 6.0),
    rates=(0.5, -1.0, 0.3),
    masses=(2.8, 0.1, 0.15),
    kept=(1.0, 0.46, 0.54, 1.0),
    pull=0.44,
)


@pytest.mark.parametrize("method", METHODS)
def test_what_impulses_make_of_rounding_is_told(method: str) -> None:
    random, covered = Random(f"{method} 1"), []
    for count in (2, 2, 3, 3, 3, 4, 4, 4) * 2:
        balls = drawn(random, count)
        found = simulate(problem_of(balls.scene, 8.0, 51), get_method(method), tolerance=1e-6)
        assert found.estimate is not None
        assert found.outcome.status == "ok"
        true = np.abs(found.values - balls.exactly(found.times.tolist())).max(axis=1)
        covered.append(bool((true <= found.estimate.errors + EVER).all()))
    assert all(covered), covered


@pytest.mark.parametrize("method", METHODS)
def test_impacts_that_are_taken_at_once_are_in_the_estimate(method: str) -> None:
    """Of ever smaller gaps the last ones count as closed: the answer leaves out what happens in them."""
    found = simulate(problem_of(COLLAPSE.scene, 20.0, 51), get_method(method), tolerance=1e-6)
    true = np.abs(found.values - COLLAPSE.exactly(found.times.tolist())).max(axis=1)
    assert found.estimate is not None
    assert found.outcome.status == "ok"
    assert true.max() > 1e-13
    assert (true <= found.estimate.errors + EVER).all(), (true / found.estimate.errors).max()


@pytest.mark.parametrize("method", METHODS)
def test_a_motion_that_ends_in_a_heap_is_not_refined(method: str) -> None:
    """Nothing says how balls go on that meet without an end in a moment; up to there the first pair is right."""
    found = simulate(problem_of(HEAP.scene, 40.0, 51), get_method(method), tolerance=1e-6)
    assert (found.outcome.status, found.outcome.code) == ("unresolved", "contacts_at_once")
    assert found.cost.runs <= 4
    before = found.times <= found.trusted_until
    true = np.abs(found.values - HEAP.exactly(found.times.tolist())).max(axis=1)
    assert true[before].max() < 1e-6


def test_a_span_may_be_an_integer() -> None:
    balls = replace(HEAP, pull=0.0)
    one, other = (simulate(problem_of(balls.scene, span, 11), get_method("gauss-4"), step=0.01) for span in (2, 2.0))
    assert one.values.tolist() == other.values.tolist()
