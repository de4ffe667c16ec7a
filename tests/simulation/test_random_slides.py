"""Random slides with springs, dry friction and walls against SciPy's integrator, stopped at its own events."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from deltaq.simulation.service import run

SLOW = 1e-5  # m/s: a rebound that is no more
SAMPLES = np.linspace(0.0, 4.0, 41)


@dataclass(frozen=True)
class Slide:
    """m = 1 kg on a line: −k (x − a) + c − d v + A sin ωt, friction R and at rest S, walls at `low` and `high`, e."""

    k: float
    a: float
    c: float
    d: float
    amplitude: float
    omega: float
    slipping: float
    static: float
    low: float
    high: float
    e: float

    def force(self, t: float, x: float) -> float:
        """Without friction and damper."""
        return -self.k * (x - self.a) + self.c + self.amplitude * float(np.sin(self.omega * t))

    @property
    def document(self) -> dict[str, Any]:
        names = ("k", "a", "c", "d", "amplitude", "omega", "slipping", "static", "low", "high", "e")
        parameters = [
            {"name": f"p{n}", "value": getattr(self, name), "positive": False} for n, name in enumerate(names)
        ]
        walls = {"low": "x - p8", "high": "p9 - x"}
        return {
            "format": 1, "id": "slide", "title": "slide", "dimension": 2, "coordinates": [{"name": "x"}],
            "parameters": [*parameters, {"name": "m", "value": 1.0}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
            "loads": [
                {"kind": "force", "at": "bob", "force": ["-p0*(x - p1) + p2 + p4*sin(p5*t)", "0"]},
                {"kind": "dissipation", "function": "p3*dot(x)^2/2"},
                {"kind": "friction", "coordinate": "x", "force": "p6", "static": "p7"},
            ],
            "events": [{"name": n, "value": v, "then": "bounce", "restitution": "p10"} for n, v in walls.items()],
        }  # fmt: skip

    def motion(self, x: float, v: float) -> np.ndarray:
        """x at the samples: slipping one way, or at rest until the force exceeds what holds, again and again."""
        t, found = 0.0, [x]
        while t < SAMPLES[-1]:
            way = float(np.sign(v)) or self._start(t, x)
            if way:
                t, x, v, part = self._slip(t, x, v, way)
            else:
                t, v, part = self._rest(t, x)
            found += part
        return np.array(found[: SAMPLES.size])

    def _start(self, t: float, x: float) -> float:
        """Which way it begins to move, 0 if it does not."""
        force = self.force(t, x)
        way = float(np.sign(force)) if abs(force) > self.static else 0.0
        stopped = (way < 0.0 and x <= self.low) or (way > 0.0 and x >= self.high)
        return 0.0 if stopped else way

    def _rest(self, t: float, x: float) -> tuple[float, float, list[float]]:
        """At rest to the end, or to the first time at which something starts it."""
        times = np.arange(t, SAMPLES[-1], 1e-3)
        begun = next((s for s in times if self._start(float(s), x)), None) if self.amplitude else None
        end = SAMPLES[-1] if begun is None else self._between(float(begun) - 1e-3, float(begun), x)
        return end, 0.0, [x] * int(np.count_nonzero((t < SAMPLES) & (end >= SAMPLES)))

    def _between(self, low: float, high: float, x: float) -> float:
        while high - low > 1e-15 * max(1.0, high):
            middle = 0.5 * (low + high)
            if middle in (low, high):
                break
            low, high = (low, middle) if self._start(middle, x) else (middle, high)
        return high

    def _slip(self, t: float, x: float, v: float, way: float) -> tuple[float, float, float, list[float]]:
        """Until it stops or meets a wall; behind which the rate is that of the rebound."""

        def rates(t: float, y: np.ndarray) -> list[float]:
            return [y[1], self.force(t, y[0]) - self.d * y[1] - way * self.slipping]

        wall = self.high if way > 0 else self.low
        stops: list[Callable[..., float]] = [lambda _t, y: float(way * y[1]), lambda _t, y: float(way * (wall - y[0]))]
        for stop in stops:
            stop.terminal, stop.direction = True, -1.0  # type: ignore[attr-defined]
        inside = SAMPLES[t < SAMPLES]
        options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14, "max_step": 0.05}
        solved = solve_ivp(rates, (t, SAMPLES[-1]), [x, v], t_eval=inside, events=stops, **options)
        values = [float(each) for each in solved.y[0]] if np.size(solved.y) else []
        if solved.t_events[1].size:
            rebound = -self.e * float(solved.y_events[1][0][1])
            return float(solved.t_events[1][0]), wall, 0.0 if abs(rebound) < SLOW else rebound, values
        if solved.t_events[0].size:
            return float(solved.t_events[0][0]), float(solved.y_events[0][0][0]), 0.0, values
        return SAMPLES[-1], x, v, values


def drawn(seed: int) -> tuple[Slide, float, float]:
    source = Random(f"slide {seed}")
    numbers = [(0.0, 8.0), (-1.0, 1.0), (-3.0, 3.0), (0.0, 0.5), (0.0, 3.0), (1.0, 6.0), (0.1, 2.0)]
    k, a, c, d, amplitude, omega, slipping = (round(source.uniform(*ends), 3) for ends in numbers)
    static = round(slipping * source.choice((1.0, 1.0, 1.4)), 4)
    low, high = -round(source.uniform(0.2, 1.0), 3), round(source.uniform(0.2, 1.0), 3)
    slide = Slide(
        k, a, c, d, source.choice((0.0, amplitude)), omega, slipping, static, low, high, source.choice((0.0, 0.3, 0.6))
    )
    return slide, *source.choice(((low, 0.0), (high, 0.0), (0.1, 0.0), (0.0, round(source.uniform(-2.0, 2.0), 3))))


@pytest.mark.one_in(4)
@pytest.mark.parametrize("seed", range(24))
def test_random_slides_move_stick_and_lie_at_walls_as_scipy_says(seed: int) -> None:
    slide, x, v = drawn(seed)
    asked = {"scene": slide.document, "initial": {"x": {"value": x, "rate": v}}, "t_end": 4.0, "samples": SAMPLES.size}
    answer = run({**asked, "method": "dop853", "tolerance": 1e-10})
    assert answer["status"] == "ok"
    told = {round(float(t), 9): value for t, value in zip(answer["t"], answer["coordinates"]["x"], strict=True)}  # type: ignore[call-overload, index]
    at_samples = np.array([told[round(float(t), 9)] for t in SAMPLES])
    np.testing.assert_allclose(at_samples, slide.motion(x, v), atol=1e-6)
