"""How fast neighbouring motions part: twin runs, and a small deviation followed for thousands of periods.

A deviation of a chaotic motion grows like e^(λt), one of a regular motion like a power of the time. It is followed by
the tangent dynamics (see `simulation.kernels.tangent`) over equal stretches, quarters of a typical period.
Source: Benettin, Galgani, Strelcyn, Phys. Rev. A 14 (1976) 2338; Sprott, Chaos and Time-Series Analysis, ch. 5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..mechanics.library import load_scene
from ..simulation.audit import Audit
from ..simulation.audited import audited_run
from ..simulation.derivatives import accelerations, derivatives
from ..simulation.integration import motion_of
from ..simulation.kernels.motion import FINE, STEP_LIMIT
from ..simulation.kernels.step import make_workspace
from ..simulation.kernels.step_control import Control
from ..simulation.kernels.tangent import Pair, Progress, Trace
from ..simulation.library import get_method
from ..simulation.march import SEEN
from ..simulation.method import Tableau
from ..simulation.outcome import OUT_OF_REACH, outcome_of
from ..simulation.problem import Floats, Problem
from ..simulation.run import Run, Steps
from ..simulation.service import problem_of
from ..simulation.stability import real_stability
from ..simulation.stiffness import drive, spectrum
from ..simulation.weights import explicit_weights
from .deviation import Deviation, make_record

METHOD, TOLERANCE = "dop853", 1e-12
LOCAL_TOLERANCE, FINEST = 1e-11, 1e-4  # of the motion that is followed, down to that part of it for small motions
IN_PERIOD, PERIODS = 4, 12_000
PART = 800  # stretches that are followed at a time
STEP_BUDGET = 600_000  # steps of a motion with two degrees of freedom: some two seconds
PILOT_PERIODS, PILOT_SAMPLES = 40, 1601
PER_DRIVE = 6  # steps in a period of what drives the scene
ROUNDS = 40  # of a run, each by shorter steps where the one before was blind
SHOWS = 1e-9  # of the largest; what moves less is at rest


@dataclass(frozen=True)
class Rhythm:
    """What is typical of a motion: its angular frequency in 1/s, and how far each component of the state goes.

    `scales` has shape (2n,).
    """

    frequency: float
    scales: Floats  # shape (2n,)

    @property
    def stretch(self) -> float:
        """The length of a stretch in seconds: a quarter of a typical period."""
        return math.tau / self.frequency / IN_PERIOD


@dataclass(frozen=True)
class Followed:
    """A motion over equal stretches: at the end of each the state and the ln of a deviation's growth in it.

    `states` has shape (stretches, 2n), `growths` shape (stretches,). `status` is "ok", or how the motion ended before
    its time; `is_whole` is whether it will not be followed further.
    """

    rhythm: Rhythm
    states: Floats  # shape (stretches, 2n)
    growths: Floats
    status: str
    is_whole: bool

    @property
    def span(self) -> float:
        """Seconds that were followed."""
        return len(self.growths) * self.rhythm.stretch

    @property
    def progress(self) -> float:
        """From 0 to 1."""
        return len(self.growths) / (IN_PERIOD * PERIODS)

    @property
    def rates(self) -> Floats:
        """q̇ in units of the scales: shape (stretches, n)."""
        n = self.states.shape[1] // 2
        return np.asarray(self.states[:, n:] / self.rhythm.scales[n:])


def moved(problem: Problem, state: Floats) -> Problem:
    """The problem with another initial state, shape (≥ 2n,)."""
    n = problem.degrees
    return replace(problem, values=tuple(map(float, state[:n])), rates=tuple(map(float, state[n : 2 * n])))


def solved(problem: Problem, times: Floats, tolerance: float = TOLERANCE) -> Run:
    """One accurate run with samples at `times`, shape (samples,), in seconds, up to where it may miss a force."""
    steps, flag = Steps(max(problem.t_end / 10, 1e-12), tolerance), np.zeros(1, dtype=np.int64)
    found, blind = audited_run(problem, get_method(METHOD), times, steps, max(tolerance, SEEN), flag, ROUNDS)
    return found.before(min(each.start for each in blind)) if blind else found


def twins(problem: Problem, apart: float, samples: int) -> tuple[Floats, Floats]:
    """Times and the distance of two motions that begin `apart` from each other in their first coordinate.

    Both have shape (samples,).
    """
    times, start = np.linspace(0.0, problem.t_end, samples), problem.state[: 2 * problem.degrees].copy()
    start[0] += apart
    first, second = solved(problem, times), solved(moved(problem, start), times)
    count, n = min(len(first.times), len(second.times)), problem.degrees
    return times[:count], np.linalg.norm(first.states[:count, :n] - second.states[:count, :n], axis=1)


def rhythm_of(problem: Problem) -> Rhythm:
    """The rhythm of the first forty periods; where nothing moves, that of the linearized scene."""
    n, linear = problem.degrees, max(spectrum(problem, 0.0, problem.state).size, drive(problem, problem.state))
    guess = linear or math.tau / problem.t_end
    span = PILOT_PERIODS * math.tau / guess
    found = solved(replace(problem, t_end=span), np.linspace(0.0, span, PILOT_SAMPLES), 1e-8)
    rates = found.states[:, n : 2 * n]
    fast, swing = np.std(accelerations(problem, found.times, found.states), axis=0), np.std(rates, axis=0)
    moves = (swing > SHOWS * max(1e-300, float(np.abs(rates).max(initial=0.0)))) & (fast > 0.0)
    frequency = float(np.exp(np.log(fast[moves] / swing[moves]).mean())) if moves.any() else guess
    return Rhythm(frequency, _scales(found.states[:, :n], rates, frequency))


def _scales(values: Floats, rates: Floats, frequency: float) -> Floats:
    """How far each goes; an angle that winds around, within a period. What is at rest is measured like the others."""
    speeds = np.abs(rates).max(axis=0, initial=0.0)
    ways = np.minimum(np.ptp(values, axis=0), math.tau * speeds / frequency)
    largest = float(ways.max(initial=0.0)) or 1.0
    ways = np.where(ways > SHOWS * largest, ways, largest)
    fastest = float(speeds.max(initial=0.0)) or largest * frequency
    return np.concatenate([ways, np.where(speeds > SHOWS * fastest, speeds, fastest)])


def followed(problem: Problem, rhythm: Rhythm, periods: int = PERIODS) -> Iterator[Followed]:
    """The motion while it is followed, over so many periods; ends early where the motion does or costs too much."""
    count, n = IN_PERIOD * periods, problem.degrees
    deviation = _deviation(problem, rhythm, count)
    trace, turning = deviation.trace, np.zeros(n, dtype=bool)
    outcome, done, asked = deviation.begin(), 0, PART
    while outcome == FINE and done < count:
        begun = done
        while outcome == FINE and done < min(begun + PART, count):
            wanted = min(asked, begun + PART - done, count - done)
            outcome, reached = deviation.advance(done, wanted)
            asked, done = (1 if reached < done + wanted else 2 * wanted), reached
        turning |= _turning(problem, trace.states[begun:done])
        _unwind(deviation.pair, turning)
        if done < count and outcome == FINE:
            yield Followed(rhythm, trace.states[:done], trace.growths[:done], "ok", is_whole=False)
    status = outcome_of(outcome, {}).status if outcome not in (FINE, STEP_LIMIT, OUT_OF_REACH) else "ok"
    yield Followed(rhythm, trace.states[:done], trace.growths[:done], status, is_whole=True)


def _deviation(problem: Problem, rhythm: Rhythm, count: int) -> Deviation:
    """A deviation at the start, with room for so many stretches."""
    method, state = get_method(METHOD), problem.state
    scheme = method.scheme
    if not isinstance(scheme, Tableau):
        raise TypeError("the tangent dynamics steps by an explicit Runge–Kutta method")
    driven = drive(problem, state)
    largest = rhythm.stretch / 2.0  # at rest there is no error to choose the step by, yet a deviation turns
    largest = min(largest, math.tau / driven / PER_DRIVE) if driven else largest
    tolerance = LOCAL_TOLERANCE * float(np.clip(rhythm.scales.max(), FINEST, 1.0))
    limit = max(STEP_BUDGET * 2 // max(problem.degrees, 2), PART)
    plan = make_record(largest, 2 * problem.degrees)
    control = Control(tolerance, largest, 8.0, 0.0, limit, scheme.stages, real_stability(scheme), plan)
    weights = explicit_weights(scheme)
    workspaces = make_workspace(state.copy(), weights), make_workspace(state.copy(), weights)
    pair = Pair(motion_of(problem), weights, control, *workspaces, rhythm.scales)
    trace = Trace(np.zeros((count, 2 * problem.degrees)), np.zeros(count))
    audit = Audit(replace(problem, t_end=PART * rhythm.stretch), method)
    return Deviation(pair, Progress(np.zeros(2), np.zeros(1)), trace, audit, rhythm.stretch)


def _turning(problem: Problem, states: Floats) -> np.ndarray:
    """Which coordinates wind around far, though the equations are the same a turn further."""
    n = problem.degrees
    far = np.abs(states[-1, :n]) > 4.0 * math.tau if len(states) else np.zeros(n, dtype=bool)
    for place in np.flatnonzero(far):
        some = states[:: max(1, len(states) // 8)].copy()
        here = derivatives(problem, np.zeros(len(some)), some)
        some[:, place] -= math.tau
        there = derivatives(problem, np.zeros(len(some)), some)
        far[place] = np.allclose(here, there, rtol=1e-8, atol=1e-8 * float(np.abs(here).max(initial=0.0)))
    return np.asarray(far)


def _unwind(pair: Pair, turning: np.ndarray) -> None:
    """Takes whole turns off both motions, so that no digits are lost to a large angle."""
    for place in np.flatnonzero(turning):
        turns = math.tau * np.round(pair.workspace.old[place] / math.tau)
        pair.workspace.old[place] -= turns
        pair.neighbour.old[place] -= turns


def warm() -> None:
    """Compiles the kernel of the tangent dynamics, or loads it from the cache on disk."""
    problem = problem_of(load_scene("pendulum"), 1.0)
    next(followed(problem, rhythm_of(problem)))
