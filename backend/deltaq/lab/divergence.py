"""How fast neighbouring motions part: twin runs, and the largest Lyapunov exponent.

A small deviation of a chaotic motion grows like e^(λt). The exponent is the mean of ln(growth) over many short
stretches, after each of which the deviation is made small again.
Source: Benettin, Galgani, Strelcyn, Phys. Rev. A 14 (1976) 2338; Sprott, Chaos and Time-Series Analysis, ch. 5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..simulation.kernels.motion import FINE
from ..simulation.library import get_method
from ..simulation.problem import Floats, Problem
from ..simulation.run import Run, Steps, run

METHOD, TOLERANCE = "dop853", 1e-12
APART = 1e-8
STRETCHES, PACE = 1000, 40


@dataclass(frozen=True)
class Exponent:
    """λ(t), the mean growth rate up to each of the times, in 1/s; `spread` is what the last half still wanders by."""

    times: Floats
    values: Floats

    @property
    def last(self) -> float:
        return float(self.values[-1]) if self.values.size else 0.0

    @property
    def spread(self) -> float:
        late = self.values[self.values.size // 2 :]
        return float(np.ptp(late)) if late.size else 0.0


def moved(problem: Problem, state: Floats) -> Problem:
    """The problem with another initial state."""
    n = problem.degrees
    return replace(problem, values=tuple(map(float, state[:n])), rates=tuple(map(float, state[n : 2 * n])))


def solved(problem: Problem, times: Floats, tolerance: float = TOLERANCE) -> Run:
    """One accurate run."""
    steps = Steps(max(problem.t_end / 10, 1e-12), tolerance)
    return run(problem, get_method(METHOD), times, np.zeros(1, dtype=np.int64), steps)


def twins(problem: Problem, apart: float, samples: int) -> tuple[Floats, Floats]:
    """Times, and the distance of two motions that begin `apart` from each other in their first coordinate."""
    times, start = np.linspace(0.0, problem.t_end, samples), problem.state[: 2 * problem.degrees].copy()
    start[0] += apart
    first, second = solved(problem, times), solved(moved(problem, start), times)
    count, n = min(len(first.times), len(second.times)), problem.degrees
    return times[:count], np.linalg.norm(first.states[:count, :n] - second.states[:count, :n], axis=1)


def exponents(problem: Problem, stretch: float) -> Iterator[Exponent]:
    """λ(t) while it is measured, over 1000 stretches of so many seconds; ends early where the motion does.

    Each stretch begins at t = 0 of the scene, so a driven scene needs whole periods.
    """
    short, width = replace(problem, t_end=stretch), 2 * problem.degrees
    state, apart = problem.state[:width], APART * _direction(width)
    grown: list[float] = []
    for _ in range(STRETCHES):
        first, second = _end(moved(short, state)), _end(moved(short, state + apart))
        if first is None or second is None:
            break
        size = max(float(np.linalg.norm(second - first)), 1e-300)
        grown.append(float(np.log(size / APART)))
        state, apart = first, (second - first) * (APART / size)
        if len(grown) % PACE == 0:
            yield _exponent(grown, stretch)
    if len(grown) % PACE:
        yield _exponent(grown, stretch)


def _direction(width: int) -> Floats:
    random = np.random.default_rng(0).normal(size=width)
    return np.asarray(random / np.linalg.norm(random))


def _end(problem: Problem) -> Floats | None:
    found = solved(problem, np.array([0.0, problem.t_end]))
    return found.states[1, : 2 * problem.degrees] if found.result.outcome == FINE and len(found.states) == 2 else None


def _exponent(grown: list[float], stretch: float) -> Exponent:
    count = np.arange(1, len(grown) + 1)
    times = np.asarray(stretch * count, dtype=np.float64)
    return Exponent(times, np.cumsum(grown) / times)
