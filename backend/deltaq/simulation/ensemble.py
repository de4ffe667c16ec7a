"""Many motions of one scene together: each with its own initial values and parameters, its own status and error.

Errors are estimated as for one motion, by a second run that is much finer and a little away from it; the estimate of a
run never falls with time.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..model.recurrences import nudged
from .audit import Audit
from .driver import simulate
from .integration import Flag
from .kernels.ensemble import Members, integrate_members, make_lanes
from .kernels.motion import FINE
from .library import get_method
from .method import Series
from .outcome import Number, Outcome, outcome_of
from .pieces import Pieces
from .problem import Floats, Problem
from .refinement import BySeries
from .rounding import short
from .run import Steps
from .series.engine import jet_of_model, lanes_of_host

BLOCK = 64  # motions between which it is looked for others that may go on
ROUNDS = 3  # of a smaller local tolerance for those that missed theirs
LOST = 0.5  # an error this large, relative to the size of the coordinate, leaves no digit
ROUNDING = 2.0**-51
MARGIN = 2.0  # of the factor for one motion: of many with two runs each, some come close to each other by chance
SCHEME = Series(8)
AHEAD = 0.1  # the first local tolerance over the tolerance
# That of the finer run over that of the coarser: with 0.1 a seventh is saved, and one estimate of eight falls short
# (tests/benchmarks/bench_ensemble_errors.py).
BELOW = 1e-2


@dataclass(frozen=True)
class Ensemble:
    """Initial values and parameters of many motions: `states`, shape (motions, 2n), `parameters` (motions, count).

    `problem` has what they share: the model, the span, the samples.
    """

    problem: Problem
    states: Floats
    parameters: Floats

    def __len__(self) -> int:
        return len(self.states)

    def member(self, index: int) -> Problem:
        """One motion as a problem of its own."""
        n = self.problem.degrees
        values, rates = self.states[index, :n].tolist(), self.states[index, n:].tolist()
        parameters = tuple(self.parameters[index].tolist())
        return replace(self.problem, values=tuple(values), rates=tuple(rates), parameters=parameters)

    def chosen(self, which: NDArray[np.int64]) -> Ensemble:
        """Some of the motions; `which` has shape (motions,)."""
        return replace(self, states=self.states[which], parameters=self.parameters[which])


@dataclass(frozen=True)
class EnsembleMotion:
    """What came of all motions at `times`, shape (samples,), NaN where a run did not come.

    `values` and `rates` are q and q̇ of the free coordinates, shape (motions, samples, n).
    `errors`, of the same shape, estimate those of the values; `worst`, shape (motions,), is the largest in the measure
    of a tolerance, NaN of a motion that came to no end: how wrong it is there nobody knows. `steps`, shape (motions,),
    are those of the runs returned.
    """

    times: Floats
    values: Floats
    rates: Floats
    errors: Floats
    worst: Floats
    steps: NDArray[np.int64]
    outcomes: tuple[Outcome, ...]


def run_ensemble(
    ensemble: Ensemble, tolerance: float, cancelled: Flag | None = None, report: Callable[[int], None] | None = None
) -> EnsembleMotion:
    """All motions to a tolerance of their coordinates; `report` hears how many are done.

    Scenes whose forces depend on the time alone in ways that bound the steps, or jump, or that have events, are run one
    by one: `simulate` knows how.
    """
    flag = np.zeros(1, dtype=np.int64) if cancelled is None else cancelled
    tell, refinement = report or (lambda _done: None), _refinement(ensemble)
    if needs_single_runs(ensemble):
        return _one_by_one(ensemble, tolerance, flag, tell)
    resolution = refinement.first(tolerance)
    found = _pair(ensemble, resolution, tolerance, flag, tell)
    for _ in range(ROUNDS - 1):
        missed = np.flatnonzero([each.status == "tolerance_missed" for each in found.outcomes])
        if not len(missed) or refinement.is_finest(resolution):
            break
        excess = float(np.nanmax(found.worst[missed])) / tolerance
        resolution = refinement.next(resolution, excess)
        again = _pair(ensemble.chosen(missed), resolution, tolerance, flag, lambda _done: None)
        found = _merged(found, again, missed)
    return found


def warm(problem: Problem) -> None:
    """Compiles the kernel of the lanes, or loads it from the cache on disk."""
    states, parameters = problem.state[None, : 2 * problem.degrees], np.array(problem.parameters)[None, :]
    run_ensemble(Ensemble(problem, states, parameters), 1e-6)


def needs_single_runs(ensemble: Ensemble) -> bool:
    """Whether the lanes cannot do these motions."""
    model = ensemble.problem.model
    if model.events is not None or model.switches is not None or model.recurrences.conditions:
        return True
    return not Audit(ensemble.problem, get_method("taylor")).before(1e-6).is_whole


def _refinement(ensemble: Ensemble) -> BySeries:
    """Less is asked of all than of a motion alone: those that miss their tolerance are run anew, and no others."""
    return BySeries(ensemble.problem.t_end, SCHEME, AHEAD, BELOW)


def _pair(
    ensemble: Ensemble, resolution: float, tolerance: float, flag: Flag, tell: Callable[[int], None]
) -> EnsembleMotion:
    """Two runs of all motions, their difference the estimate."""
    refinement = _refinement(ensemble)
    coarse, fine = refinement.pair(resolution, Pieces.whole(ensemble.problem.t_end))
    runs = _run(ensemble, coarse, flag, tell), _run(ensemble, replace(fine, is_nudged=True), flag, lambda _done: None)
    return _judged(ensemble, *runs, MARGIN * refinement.factor_of_answer(coarse, fine), tolerance)


def _run(ensemble: Ensemble, steps: Steps, flag: Flag, tell: Callable[[int], None]) -> Members:
    """All motions, at samples that are spread evenly."""
    times = np.linspace(0.0, ensemble.problem.t_end, ensemble.problem.samples)
    return in_lanes(ensemble, times, steps, flag, tell)


def in_lanes(
    ensemble: Ensemble, times: Floats, steps: Steps, flag: Flag, tell: Callable[[int], None] = lambda _done: None
) -> Members:
    """All motions from times[0] on, with samples at `times`, shape (samples,), ascending, each run once.

    They go side by side in lanes, blocks of them in as many threads as there are processors.
    """
    problem, count, recurrences = ensemble.problem, len(ensemble), ensemble.problem.model.recurrences
    jet = jet_of_model(problem.model, is_long=True, lanes=lanes_of_host())
    states = np.hstack([ensemble.states, np.zeros((count, jet.shape.width - 2 * problem.degrees))])
    constants = np.ascontiguousarray(recurrences.constants(ensemble.parameters.T).T).reshape(count, -1)
    if steps.is_nudged:
        states, constants = nudged(states), recurrences.nudged(constants)
    order = steps.order or SCHEME.order_for(steps.tolerance)
    members = Members(
        np.ascontiguousarray(states),
        constants,
        np.ascontiguousarray(times),
        np.full((count, len(times), jet.shape.width), np.nan),
        *(np.zeros(count, dtype=np.int64) for _ in range(3)),
    )
    conditions, code = len(recurrences.conditions), jet.code.addresses
    sizes = conditions, jet.shape.components, constants.shape[1], jet.work, jet.shape.lanes
    addresses = code["jet"], code["advance"], code["measure"]

    def block(start: int) -> int:
        lanes = make_lanes(addresses, order, problem.degrees, jet.shape.width, sizes)
        part = slice(start, start + BLOCK)
        some = members._replace(  # views: what is written stays
            **{name: array[part] for name, array in members._asdict().items() if name != "times"}
        )
        integrate_members(lanes, some, steps.tolerance, steps.size, problem.step_limit, flag)
        return len(some.states)

    if count <= BLOCK:  # a thread would cost more than it brings
        tell(block(0))
        return members
    done = 0
    with ThreadPoolExecutor(max_workers=min(os.cpu_count() or 1, -(-count // BLOCK))) as pool:
        for finished in pool.map(block, range(0, count, BLOCK)):
            done += finished
            tell(done)
    return members


def _judged(ensemble: Ensemble, coarse: Members, fine: Members, factor: float, tolerance: float) -> EnsembleMotion:
    """The coarser runs with their estimates and outcomes."""
    n, problem, end = ensemble.problem.degrees, ensemble.problem, 2 * ensemble.problem.degrees
    is_known = np.isfinite(fine.samples[:, :, :end]).all(axis=2, keepdims=True)  # what but one run came to is not
    states = np.where(is_known, coarse.samples[:, :, :end], np.nan)
    values, codes = states[:, :, :n], np.where(coarse.outcomes != 0, coarse.outcomes, fine.outcomes)
    sizes = np.abs(values)
    with np.errstate(invalid="ignore", over="ignore"):
        apart = np.abs(values - fine.samples[:, :, :n])
        errors = np.maximum.accumulate(factor * apart + ROUNDING * sizes, axis=1)  # NaN from the end on
        known = np.nan_to_num(errors, nan=0.0)
        worst = (known / np.maximum(1.0, np.nan_to_num(sizes))).max(axis=(1, 2))
        largest = np.nan_to_num(sizes).max(axis=1, keepdims=True)
        angular = np.array(problem.angular or (False,) * n)
        scale = np.where(angular, np.minimum(largest, 1.0), largest)
        lost = ((known >= LOST * scale) & (scale > 0.0)).any(axis=2)
    worst = np.where(codes == FINE, worst, np.nan)
    horizons = np.where(lost.any(axis=1), coarse.times[lost.argmax(axis=1)], np.inf)
    outcomes = tuple(
        _outcome(problem, int(code), float(end), float(horizon), float(bad), tolerance)
        for code, end, horizon, bad in zip(
            codes,
            coarse.times[np.maximum(np.minimum(fine.filled, coarse.filled) - 1, 0)],
            horizons,
            worst,
            strict=True,
        )
    )
    return EnsembleMotion(coarse.times, values, states[:, :, n:], errors, worst, coarse.steps, outcomes)


def _outcome(problem: Problem, code: int, end: float, horizon: float, worst: float, tolerance: float) -> Outcome:
    told: dict[str, Number] = {"method": "taylor", "t": short(end), "t_end": problem.t_end}
    if code != 0:
        return outcome_of(code, told | {"steps": problem.step_limit})
    if horizon < np.inf:
        return Outcome("horizon_reached", "horizon_reached", told | {"t": short(horizon)})
    if worst > tolerance:
        return Outcome("tolerance_missed", "tolerance_missed", told | {"tolerance": tolerance, "error": short(worst)})
    return outcome_of(code, told)


def _merged(found: EnsembleMotion, again: EnsembleMotion, which: NDArray[np.int64]) -> EnsembleMotion:
    """The motions, some of them replaced where the new ones are better."""
    better = again.worst < found.worst[which]  # not where they come to no end
    places, rows = which[better], np.flatnonzero(better)
    outcomes = list(found.outcomes)
    for place, row in zip(places, rows, strict=True):
        outcomes[place] = again.outcomes[row]
    for name in ("values", "rates", "errors", "worst", "steps"):
        getattr(found, name)[places] = getattr(again, name)[rows]
    return replace(found, outcomes=tuple(outcomes))


def _one_by_one(ensemble: Ensemble, tolerance: float, flag: Flag, tell: Callable[[int], None]) -> EnsembleMotion:
    """Each motion by itself; what comes behind its end is not a number."""
    problem, count = ensemble.problem, len(ensemble)
    times = np.linspace(0.0, problem.t_end, problem.samples)
    shape = (count, len(times), problem.degrees)
    values, rates, errors = (np.full(shape, np.nan) for _ in range(3))
    worst, steps, outcomes = np.zeros(count), np.zeros(count, dtype=np.int64), list[Outcome]()
    for index in range(count):
        found = simulate(ensemble.member(index), get_method("taylor"), tolerance=tolerance, cancelled=flag)
        rows = min(int(np.searchsorted(times, found.times[-1] * (1.0 + 1e-12), side="right")), len(found.times))
        values[index, :rows], rates[index, :rows] = found.values[:rows], found.rates[:rows]
        if found.estimate is not None:
            errors[index, :rows] = found.estimate.errors[:rows, None]  # the largest of any coordinate
        is_judged = found.estimate is not None and found.outcome.is_judged
        worst[index] = found.estimate.worst if found.estimate is not None and is_judged else np.nan
        steps[index] = found.cost.steps
        told = {} if found.event is None else {"title": problem.model.scene.events[found.event.index].name}
        outcomes.append(replace(found.outcome, parameters={**found.outcome.parameters, **told}))
        tell(index + 1)
    return EnsembleMotion(times, values, rates, errors, worst, steps, tuple(outcomes))
