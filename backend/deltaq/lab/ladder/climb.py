"""Climbing: every rung measured against the full model, at the scene's own initial values and at other amplitudes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...contract.experiment import LONGEST
from ...contract.experiments.fidelity import LARGEST_ERROR, Ending
from ...errors import InputError, Problem, RequestError
from ...mechanics.scene import Scene
from ...simulation.integration import Flag
from ...simulation.outcome import Outcome
from .building import Chain, chains, rung_of, simplified
from .centre import Centre, centre_of
from .distance import Yardstick
from .ending import DIGITS, known
from .findings import Deviation, Finding, Growth, Ladder, Least, Measured, Rung
from .mean import Mean
from .measurement import CERTAIN, RungRun, cost, deviation, full_run, run_beside, seen, yardstick
from .minimal import minimal
from .nudge import WAYS, allowed, nudged
from .simplification import Motion, SimplificationContext
from .verdict import is_within, lasts, least

AMPLITUDES = (0.1, 0.2, 0.5, 1.0)
MOST_AMPLITUDES, MOST_REPEATS = 8, 25
ROUNDING = 1e-10  # an error below it says nothing of a slope


def climb(
    scene: Scene,
    span: float,
    amplitudes: Sequence[float] = AMPLITUDES,
    tolerance: float = 0.01,
    repeats: int = 5,
    cancelled: Flag | None = None,
) -> Iterator[Finding]:
    """The ladder of a scene over [0, span], found step by step: the rungs, each one measured, how errors grow.

    `tolerance` is the relative error allowed: the largest distance from the full motion (`distance.py`) as a part of
    the extent of that motion. A rung must also hold after a nudge (`nudge.py`) to be the least. `amplitudes` are
    factors of the scene's initial deviation from rest or steady motion.
    A rung that cannot be built or run is kept, with its reason. Raises RequestError for numbers out of bounds.
    """
    _check(span, amplitudes, tolerance, repeats)
    flag = np.zeros(1, dtype=np.int64) if cancelled is None else cancelled
    run = full_run(scene, span, flag, tolerance)
    full, ending = known(run, tolerance)
    motion = seen(run).until(len(full.times))
    centre = None if scene.constraints else centre_of(scene, full)
    values = centre.values if centre else _rest(scene, motion, span, flag)
    context = SimplificationContext(scene, values, Mean.of(scene, span), motion)
    found = [rung_of(context, chain) for chain in ((), *chains(context))]
    factors = tuple(sorted({1.0, *amplitudes})) if centre else (1.0,)
    sound = [rung for rung in found if rung.scene is not None]
    count = len(sound) + (len(sound) - 1) * (len(factors) > 1) + 1
    yield Ladder(tuple(found), dict(values), span, factors, count)
    yield from _Climb(context, centre, full, ending, tolerance, factors, repeats, flag).findings(sound)


def _rest(scene: Scene, motion: Motion, span: float, cancelled: Flag) -> Mapping[str, float]:
    """The centre of a scene with constraints, in minimal coordinates; empty where there is none."""
    if not scene.constraints:
        return {}
    try:
        below = minimal(scene, motion).scene
        found = centre_of(below, yardstick(full_run(below, span, cancelled)))
    except InputError:
        return {}
    return found.values if found else {}


def _check(span: float, amplitudes: Sequence[float], tolerance: float, repeats: int) -> None:
    """Raises RequestError with every number that is out of bounds."""
    bounds = [
        ("/t_end", span, 0.0, LONGEST),
        ("/tolerance", tolerance, 0.0, LARGEST_ERROR),
        ("/repeats", repeats, 0, MOST_REPEATS),
        ("/amplitudes", len(amplitudes), -1, MOST_AMPLITUDES),
        *((f"/amplitudes/{index}", each, 0.0, 10.0) for index, each in enumerate(amplitudes)),
    ]
    problems = [
        Problem("request-outside", pointer, parameters={"value": value, "min": low, "max": high})
        for pointer, value, low, high in bounds
        if not low < value <= high
    ]
    if problems:
        raise RequestError(*problems)


@dataclass(frozen=True)
class _Climb:
    context: SimplificationContext
    centre: Centre | None
    full: Yardstick
    ending: Ending
    tolerance: float
    amplitudes: tuple[float, ...]
    repeats: int
    cancelled: Flag

    def findings(self, rungs: list[Rung]) -> Iterator[Finding]:
        measured = []
        for rung in rungs:
            measured.append(self._measured(rung))
            if self.cancelled[0]:
                return
            yield measured[-1]
        others = {factor: self._full(self._context(factor)) for factor in self.amplitudes if factor != 1.0}
        full = {1.0: self.full} | others
        for rung in rungs if others else ():
            if rung.parts and not self.cancelled[0]:
                yield self._growth(rung, full)
        if not self.cancelled[0]:
            yield self._least(rungs, measured)

    def _least(self, rungs: list[Rung], measured: list[Measured]) -> Least:
        """The verdict, for as long as the full motion is known: its own, and those after the nudges that were tried."""
        found = least(rungs, measured, self.tolerance)
        if found is None or not self.full.end > 0.0:
            return Least(self.tolerance, None, 0.0, self.ending or DIGITS)
        was_nudged = any(each.survives is not None for each in measured[1:])
        end = min((full.end for _, full in self._nudged), default=0.0) if was_nudged else self.full.end
        if lasts(end, self.full.end):
            return Least(self.tolerance, found, self.full.end, self.ending)
        return Least(self.tolerance, found, end, self.ending or DIGITS)

    def _full(self, context: SimplificationContext) -> Yardstick:
        """The full motion from other initial values."""
        return known(self._full_run(context, math.inf), self.tolerance)[0]

    def _full_beside(self, context: SimplificationContext) -> Yardstick:
        """The full motion from values close to its own, for no longer than from those."""
        return yardstick(self._full_run(context, self.full.end), self.tolerance, self.full.end)

    def _full_run(self, context: SimplificationContext, needed: float) -> RungRun:
        return full_run(context.scene, self.full.problem.t_end, self.cancelled, self.tolerance, needed)

    def _run(self, scene: Scene, full: Yardstick) -> RungRun:
        return run_beside(scene, full, self.cancelled)

    def _context(self, amplitude: float) -> SimplificationContext:
        return self.context if self.centre is None else self.context.with_scene(self.centre.at(amplitude))

    def _measured(self, rung: Rung) -> Measured:
        try:
            below = simplified(self.context, rung.parts)
            found = self._run(below.scene, self.full)
        except InputError as error:
            return Measured(rung.id, _refusal(error), None, None)
        price = cost(found, self.repeats, self.cancelled) if found.is_complete else None
        apart = deviation(self.full, found, below.back)
        if not found.is_sound(self.full, self.tolerance) or not is_within(apart, self.tolerance, self.full):
            return Measured(rung.id, found.outcome, price, apart)
        after = self._after_nudges(rung.parts) if rung.parts else 0.0
        return Measured(rung.id, found.outcome, price, apart, after, self._survives(apart, after))

    def _survives(self, apart: Deviation | None, after: float) -> bool:
        before = apart.relative if apart else None
        return after <= (self.tolerance if before is None else allowed(before, self.tolerance, self.full))

    def _after_nudges(self, chain: Chain) -> float:
        """The largest error of the rung from nudged values, as a part of the size of the full motion.

        Infinite where one of the two now ends, and the other does not.
        """
        return max(self._after(chain, context, full) for context, full in self._nudged)

    def _after(self, chain: Chain, context: SimplificationContext, full: Yardstick) -> float:
        """No less than integration may err by; at rest it is measured by what motion the nudge makes."""
        try:
            below = simplified(context, chain)
            found = self._run(below.scene, full)
        except InputError:
            return math.inf
        apart = deviation(full, found, below.back)
        if apart is None or not lasts(apart.until, full.end):
            return math.inf
        error = max(apart.largest, CERTAIN * apart.floor * full.size)
        return error / (self.full.extent or full.size)

    @cached_property
    def _nudged(self) -> tuple[tuple[SimplificationContext, Yardstick], ...]:
        """The full model from nudged values, for no longer than from its own."""
        scenes = (nudged(self.context.scene, self.full, way) for way in range(WAYS))
        contexts = tuple(self.context.with_scene(scene) for scene in scenes)
        return tuple((context, self._full_beside(context)) for context in contexts)

    def _growth(self, rung: Rung, full: dict[float, Yardstick]) -> Growth:
        found = [self._deviation(rung.parts, factor, full[factor]) for factor in self.amplitudes]
        relative = tuple(each.relative if each else None for each in found)
        largest = tuple(each.largest if each else None for each in found)
        return Growth(rung.id, relative, largest, _slope(self.amplitudes, found))

    def _deviation(self, chain: Chain, amplitude: float, full: Yardstick) -> Deviation | None:
        try:
            below = simplified(self._context(amplitude), chain)
            found = self._run(below.scene, full)
        except InputError:
            return None
        apart = deviation(full, found, below.back) if found.is_sound(full, self.tolerance) else None
        return apart if apart and lasts(apart.until, full.end) else None


def _refusal(error: InputError) -> Outcome:
    problem = error.problems[0]
    return Outcome("refused", problem.code, dict(problem.parameters))


def _slope(amplitudes: tuple[float, ...], found: list[Deviation | None]) -> float | None:
    """The slope of log(relative error) over log(amplitude), by least squares."""
    points = [
        (math.log(amplitude), math.log(each.relative))
        for amplitude, each in zip(amplitudes, found, strict=True)
        if each is not None and each.relative and each.relative > CERTAIN * max(each.floor, ROUNDING)
    ]
    if len(points) < 2:
        return None
    across, up = np.array(points).T
    return float(np.polyfit(across, up, 1)[0])
