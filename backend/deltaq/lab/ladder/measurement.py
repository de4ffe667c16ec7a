"""One rung computed: its motion in the full scene's coordinates, and what it costs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...mechanics.mass import total_mass
from ...mechanics.scene import Scene
from ...model.operations import operations
from ...simulation.auto import choose
from ...simulation.choice import Choice
from ...simulation.driver import simulate
from ...simulation.integration import Flag
from ...simulation.outcome import OK, Outcome
from ...simulation.problem import Floats, Problem
from ...simulation.service import problem_of
from ...simulation.trajectory import Trajectory
from ...vocabulary import AUTO
from .distance import Accuracy, Yardstick
from .findings import Cost, Deviation, Timing
from .metric import particles, radians
from .simplification import Back, Motion

TOLERANCE, LEAST_TOLERANCE = 1e-8, 1e-11  # of the integration: what is left is the error of the rung
ENOUGH = 1e-6  # of the size of the motion: its error, which asks for a tighter tolerance where that is small
SAMPLES, MOST_SAMPLES = 1601, 60_001  # dense, since errors are seen at samples and the way back may have to integrate
PER_STEP = 2  # samples for each step of the full motion
SHOWN = 400  # about so many of them are told
STEP_LIMIT = 200_000  # of one run
CERTAIN = 10.0  # times as large as the error of the integration: what it cannot explain
# Of the extent: a rung that is so far away has nothing to do with the motion. How far it runs until its computation
# ends says nothing of it, and depends on the units in which it is computed.
LOST = 1000.0
ROUGH = 1e-4  # of the size: an error of the integration that asks for the least tolerance
USUAL = Accuracy(TOLERANCE, SAMPLES)
MOST_CUTS = 8
COARSER = (1e-7, 1e-6, 1e-5)  # tried where rounding lets no finer integration come to the end


@dataclass(frozen=True)
class RungRun:
    """A scene's motion as computed: the problem, the method chosen for it, and the trajectory."""

    scene: Scene
    problem: Problem
    choice: Choice
    trajectory: Trajectory
    accuracy: Accuracy

    @property
    def outcome(self) -> Outcome:
        """How the run ended; ok if it met the tolerance, even if the motion is too small to have a digit of its own."""
        found = self.trajectory
        return OK if found.tolerance_reached and found.event is None else found.outcome

    @property
    def is_complete(self) -> bool:
        """Whether it came to the end, or to an event that ended it."""
        return self.trajectory.event is not None or self.trajectory.reached >= self.problem.t_end

    @property
    def gives_out(self) -> bool:
        """Whether the computation ended it (steps, Newton's method), which a coarser one may avoid."""
        return self.outcome.code in ("step_limit", "step_underflow", "newton_failed", "stiff")

    def is_sound(self, full: Yardstick, tolerance: float) -> bool:
        """Whether the error of its integration is far below `tolerance`, as long as the full motion is known.

        It may have missed a tolerance far below that, over thousands of turns; and what becomes of it later is no
        matter.
        """
        return CERTAIN * full.uncertainty(self.floor_until(full.end)) <= tolerance * full.size

    def floor_until(self, end: float) -> float:
        """The error of the integration up to a time in seconds: absolute for coordinates below 1, relative above."""
        found = self.trajectory.estimate
        if found is None:
            return self.floor
        errors, times = found.errors, self.trajectory.times[: len(found.errors)]
        largest = float(errors.max(initial=0.0))
        part = float(errors[times <= end].max(initial=0.0)) / largest if largest > 0.0 else 1.0
        return found.worst * min(1.0, part)

    def sure_until(self, limit: float) -> float:
        """The time in seconds up to which that error stays within a limit."""
        found = self.trajectory.estimate
        if found is None or found.worst <= limit:
            return self.trajectory.trusted_until
        errors = np.maximum.accumulate(found.errors)
        first = int(np.argmax(errors * found.worst > limit * errors[-1]))
        return min(self.trajectory.trusted_until, float(self.trajectory.times[max(0, first - 1)]))

    @cached_property
    def sampled(self) -> tuple[Floats, Floats]:
        """Times, shape (samples,), and states (q, q̇), shape (samples, 2n), of the even samples, without an event's."""
        found = self.trajectory
        count = int(np.searchsorted(found.times, found.reached)) if found.event else len(found.times)
        return found.times[:count], np.hstack([found.values, found.rates])[:count]

    @property
    def floor(self) -> float:
        """The error of the integration: absolute for coordinates below 1, relative above."""
        return self.trajectory.estimate.worst if self.trajectory.estimate else self.accuracy.tolerance


def run_rung(scene: Scene, span: float, cancelled: Flag, accuracy: Accuracy = USUAL) -> RungRun:
    """The motion of a scene over `span` seconds, by the method that suits it."""
    problem = replace(problem_of(scene, span, accuracy.samples), step_limit=STEP_LIMIT)
    problem.model.settle()
    choice = choose(AUTO, scene, problem, None, accuracy.tolerance)
    found = simulate(problem, choice.method, tolerance=accuracy.tolerance, cancelled=cancelled)
    return RungRun(scene, problem, choice, found, accuracy)


def run_beside(scene: Scene, full: Yardstick, cancelled: Flag) -> RungRun:
    """The motion of a rung with the accuracy of the full motion, or else the finest with which it gets to the end."""
    wanted = (replace(full.accuracy, tolerance=each) for each in _tolerances(full.accuracy.tolerance))
    runs = (run_rung(scene, full.problem.t_end, cancelled, each) for each in wanted)
    return _longest(runs, full.end, lambda each: each.trajectory.trusted_until)


def _tolerances(finest: float) -> tuple[float, ...]:
    return (finest, *(each for each in (TOLERANCE, *COARSER) if each > finest))


def _longest(runs: Iterator[RungRun], end: float, known: Callable[[RungRun], float]) -> RungRun:
    """The first that is known to the end, or ends for another reason than the steps; else the one known for longest."""
    found: list[tuple[float, RungRun]] = []
    for each in runs:
        found.append((min(end, known(each)), each))
        if found[-1][0] >= end or not each.gives_out:
            break
    return max(found, key=lambda one: one[0])[1]


def full_run(scene: Scene, span: float, cancelled: Flag, allowed: float = np.inf, needed: float = np.inf) -> RungRun:
    """The reference motion over `span` seconds, with an error far below `allowed`, as far as it is `needed`.

    It is computed anew where it is small in its units or has many turns, and where small errors grow in it; and more
    coarsely where rounding lets no finer one get far.
    """
    found = run_rung(scene, span, cancelled)
    seen = yardstick(found)
    is_rough = seen.uncertainty(seen.floor) > ROUGH * seen.size
    tolerance = LEAST_TOLERANCE if is_rough else max(LEAST_TOLERANCE, seen.tolerance(TOLERANCE, ENOUGH))
    samples = min(MOST_SAMPLES, max(SAMPLES, PER_STEP * found.trajectory.cost.steps + 1))
    wanted = (Accuracy(each, samples) for each in _tolerances(tolerance))
    runs = (found if each == found.accuracy else run_rung(scene, span, cancelled, each) for each in wanted)
    return _longest(runs, min(span, needed), lambda each: yardstick(each, allowed).end)


def yardstick(full: RungRun, tolerance: float = np.inf, limit: float = np.inf) -> Yardstick:
    """The full motion up to `limit` seconds, as long as its error is far below `tolerance`."""
    (times, states), problem = full.sampled, full.problem
    end = min(limit, full.trajectory.trusted_until)
    count, floor = int(np.count_nonzero(times <= end)), full.floor_until(end)
    turns = radians(full.scene, problem)
    mass, bodies = total_mass(full.scene), particles(full.scene)
    found = Yardstick(problem, mass, times[:count], states[:count], floor, turns, full.accuracy, bodies)
    return _sure(full, found, tolerance) if count and np.isfinite(tolerance) else found


def _sure(full: RungRun, found: Yardstick, tolerance: float) -> Yardstick:
    """The part that is known so well, by the size of that part."""
    for _ in range(MOST_CUTS):
        errs = CERTAIN * found.uncertainty(found.floor)
        if errs <= tolerance * found.size:
            return found
        end = full.sure_until(tolerance * found.size / errs * found.floor)
        found = found.until(end, full.floor_until(end))
    return found.until(0.0, found.floor)


def deviation(full: Yardstick, rung: RungRun, back: Back) -> Deviation | None:
    """How far a rung is from the full motion; None if no sample can be compared."""
    if not len(full.times) or not len(rung.sampled[0]):
        return None
    errors = full.errors(back(seen(rung)).values)
    errors = errors[full.times[: len(errors)] <= rung.trajectory.trusted_until]
    good = int(np.isfinite(errors).cumprod().sum())
    if good == 0:
        return None
    errors, largest = errors[:good], float(errors[:good].max())
    floor = full.uncertainty(max(full.floor, rung.floor_until(full.end)))
    relative = min(largest / full.extent, LOST) if full.extent > 0.0 else None
    shown = slice(0, good, max(1, full.accuracy.samples // SHOWN))
    times, curve = full.times[shown].tolist(), errors[shown].tolist()
    return Deviation(tuple(times), tuple(curve), largest, relative, floor / full.size, float(full.times[good - 1]))


def seen(rung: RungRun) -> Motion:
    """Values and rates of all coordinates of the rung's own scene along its run."""
    (times, states), n, free = rung.sampled, rung.problem.degrees, rung.problem.model.layout.free
    observed = rung.problem.model.observe(rung.problem.inputs(times, states))
    values = _named(free, states[:, :n]) | dict(observed.values)
    rates = _named(free, states[:, n:]) | dict(observed.rates)
    return Motion(times, values, rates)


def _named(names: tuple[str, ...], columns: Floats) -> dict[str, Floats]:
    return dict(zip(names, columns.T, strict=True))


def cost(rung: RungRun, repeats: int, cancelled: Flag) -> Cost:
    """What the run of a rung costs: medians and quartiles of so many repeats."""
    method = rung.choice.method
    runs = [
        simulate(rung.problem, method, tolerance=rung.accuracy.tolerance, with_error=False, cancelled=cancelled).cost
        for _ in range(repeats)
    ]
    return Cost(
        operations(rung.scene),
        method.id,
        runs[0].run_evaluations,
        runs[0].steps,
        _timing([each.run_time / max(1, each.run_evaluations) for each in runs]),
        _timing([each.run_time for each in runs]),
    )


def _timing(seconds: list[float]) -> Timing:
    low, median, high = np.quantile(seconds, (0.25, 0.5, 0.75)).tolist()
    return Timing(median, low, high, len(seconds))
