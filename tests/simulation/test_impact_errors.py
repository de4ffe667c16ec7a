"""Error estimates of motions with many impacts, held against the same motion in 60 digits.

A ball between two walls without friction flies on parabolas, which every method follows to rounding; but in a wide
wedge each impact parts neighbours, so that after some dozens of them rounding is all that is left.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

import numpy as np
import pytest
from mpmath import mp, mpf, sqrt, workdps
from numpy.typing import NDArray
from tests.simulation.scenes import document

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

METHODS = ("dop853", "taylor", "dormand-prince-54", "rk4")
EVER = 1e-15


@dataclass(frozen=True)
class Wedge:
    """Walls at an angle to the vertical, a start (x, y, ẋ, ẏ) between them, and how much of a rate is left."""

    half_angle: float
    start: tuple[float, float, float, float]
    restitution: float

    @property
    def walls(self) -> tuple[tuple[float, float], ...]:
        """Their normals inwards."""
        sine, cosine = math.sin(self.half_angle), math.cos(self.half_angle)
        return (-cosine, sine), (cosine, sine)

    @property
    def scene(self) -> Scene:
        x, y, u, v = self.start
        weight = {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}
        found = document({"x": (x, u), "y": (y, v)}, {"m": 1.0, "g": 1.0}, {"ball": ("m", ["x", "y"])}, [weight])
        bounce = {"then": "bounce", "restitution": repr(self.restitution)}
        walls = [
            {"name": f"wall{k}", "value": f"({nx!r})*x + ({ny!r})*y", **bounce} for k, (nx, ny) in enumerate(self.walls)
        ]
        return read_scene(found | {"events": walls})

    def exactly(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """(x, y) at these times, shape (samples, 2), parabola by parabola."""
        with workdps(60):
            return np.array([[float(x), float(y)] for x, y in self._along([mpf(float(t)) for t in times])])

    def _along(self, times: list[mpf]) -> Iterator[tuple[mpf, mpf]]:
        x, y, u, v = (mpf(each) for each in self.start)
        now, e = mpf(0), mpf(self.restitution)
        while times:
            flight, (nx, ny) = min(self._meetings(x, y, u, v))
            while times and times[0] <= now + flight:
                s = times.pop(0) - now
                yield x + u * s, y + v * s - s * s / 2
            x, y, v, now = x + u * flight, y + v * flight - flight * flight / 2, v - flight, now + flight
            size = nx * nx + ny * ny
            rate, gap = (nx * u + ny * v) / size, (nx * x + ny * y) / size
            u, v, x, y = u - (1 + e) * rate * nx, v - (1 + e) * rate * ny, x - gap * nx, y - gap * ny

    def _meetings(self, x: mpf, y: mpf, u: mpf, v: mpf) -> Iterator[tuple[mpf, tuple[mpf, mpf]]]:
        """After which times the ball would come through each wall."""
        for nx, ny in ((mpf(a), mpf(b)) for a, b in self.walls):
            a, b, c = -ny / 2, nx * u + ny * v, nx * x + ny * y
            flight = (-b - sqrt(b * b - 4 * a * c)) / (2 * a)
            if flight > mpf(10) ** (10 - mp.dps):
                yield flight, (nx, ny)


def drawn(random: Random, low: float, high: float, restitution: float) -> Wedge:
    angle, height = math.radians(random.uniform(low, high)), random.uniform(0.7, 1.5)
    aside = random.uniform(-0.5, 0.5) * height * math.tan(angle)
    return Wedge(angle, (aside, height, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)), restitution)


def is_covered(found: Trajectory, wedge: Wedge) -> bool:
    """Whether no error is larger than its estimate as long as there are digits."""
    assert found.estimate is not None
    assert {each.kind for each in found.transitions} == {"impact"}
    trusted = found.times <= found.trusted_until
    true = np.abs(found.values - wedge.exactly(found.times)).max(axis=1)
    if found.outcome.status == "ok":
        assert true.max() <= max(found.estimate.worst, 1e-10)
    return bool((true[trusted] <= found.estimate.errors[trusted] + EVER).all())


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("low", "high", "restitution", "t_end"),
    [
        pytest.param(46.0, 70.0, 1.0, 40.0, id="chaos"),
        pytest.param(25.0, 44.0, 1.0, 40.0, id="curves and chaos"),
        pytest.param(25.0, 70.0, 0.95, 15.0, id="something is lost"),
    ],
)
def test_what_impacts_make_of_rounding_is_told(
    method: str, low: float, high: float, restitution: float, t_end: float
) -> None:
    random = Random(f"{method} {low} {restitution}")
    covered = []
    for _ in range(6):
        wedge = drawn(random, low, high, restitution)
        found = simulate(problem_of(wedge.scene, t_end, 51), get_method(method), tolerance=1e-8)
        covered.append(is_covered(found, wedge))
    assert all(covered), covered
