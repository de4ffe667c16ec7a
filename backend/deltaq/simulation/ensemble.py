"""Many motions of one scene together: each with its own initial values and parameters, its own status and error.

Errors are estimated by what each step did wrong and a neighbour of each motion, which tells what becomes of it
(`series.neighbour`); the estimate of a run never falls with time. Neither sees what lies between the places at which a
step looks at the forces, so that the steps of all are audited; a motion that was blind somewhere is run by itself.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..model.recurrences import nudged
from .audit import USUAL, Audit
from .driver import simulate
from .integration import Flag
from .kernels.ensemble import Addresses, Members, integrate_members, make_lanes
from .kernels.motion import FINE, STEP_LIMIT
from .kernels.sight import Meshes
from .library import get_method
from .method import Series
from .outcome import OUT_OF_REACH, Number, Outcome, outcome_of
from .pieces import Pieces
from .problem import Floats, Problem
from .reach import PART, is_far, is_steady
from .refinement import APART, FINEST_OF_SERIES, BySeries
from .rounding import short
from .run import Steps
from .series.engine import code_of_neighbours, code_of_steps, jet_of_model, lanes_of_host

BLOCK = 64  # motions between which it is looked for others that may go on
ROUNDS = 3  # of a smaller local tolerance for those that missed theirs
LOST = 0.5  # an error this large, relative to the size of the coordinate, leaves no digit
ROUNDING = 2.0**-50
# Times what neighbours tell, and times the change of starts and constants by rounding, of which they tell
# (tests/benchmarks/bench_ensemble_errors.py).
MARGIN, NUDGES = 3.0, 2.0
SCHEME = Series(8)
AHEAD = 0.1  # the first local tolerance over the tolerance
# The largest step over the span: half of that of a motion with two runs, between whose ends it is looked as well. A
# round number of steps might lead from one quiet place to another.
LARGEST: float = 3.0**-3.4
SMALLER, SMALLEST = 0.1, 1e-6  # a next one over what the error asks for, and over the one before at least
NEAR, MANY = 5, 1000  # the order of neighbours' series, and the steps up to which it suffices
# With more steps: the local tolerance of a finer run over that of the other one, and times the factor for one motion;
# of many with two runs each, some come close to each other by chance.
BELOW, OF_PAIRS = 1e-2, 2.0
MOST_DRIVEN = 20_000  # steps that a drive may ask for, up to which motions go side by side
SAME = 1e-12  # of the span: times that are nearer to each other are one
MESH = 256  # ends of steps of each motion that are looked at together
GRAIN = 5e-12  # below that local tolerance rounding may do as much as the steps, and the one hide the other


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

    def limited(self, steps: int) -> Ensemble:
        """The same with so many steps at most, and no more than before."""
        return replace(self, problem=replace(self.problem, step_limit=min(steps, self.problem.step_limit)))


@dataclass(frozen=True)
class EnsembleMotion:
    """What came of all motions at `times`, shape (samples,), NaN where a run did not come.

    `values` and `rates` are q and q̇ of the free coordinates, shape (motions, samples, n).
    `errors`, of the same shape, estimate those of the values; `worst`, shape (motions,), is the largest in the measure
    of a tolerance, NaN of a motion that came to no end: how wrong it is there nobody knows. `steps`, shape (motions,),
    are those of the runs returned. `blind`, shape (motions,), tells where forces may have been missed.
    """

    times: Floats
    values: Floats
    rates: Floats
    errors: Floats
    worst: Floats
    steps: NDArray[np.int64]
    outcomes: tuple[Outcome, ...]
    blind: NDArray[np.bool_]


@dataclass(frozen=True)
class Sight:
    """An audit that looks at the steps of motions of one model, for a tolerance of their coordinates."""

    audit: Audit
    tolerance: float

    def over(self, members: Members, parameters: Floats, integrate: Callable[[Members], bool]) -> None:
        """Integrates motions, and writes which of those that came to the end were blind.

        `parameters` has shape (motions, parameters). `integrate` returns whether there is more to come; it is looked
        at what has been gone in between.
        """
        count, width = members.states.shape[0], 2 * self.audit.problem.degrees + 1
        meshes = Meshes(np.empty((count, MESH, width)), np.zeros(count, dtype=np.int64))
        members = members._replace(mesh_rows=meshes.rows, mesh_counts=meshes.counts)
        watcher, goes_on = self.audit.watcher(MESH), True
        while goes_on:
            goes_on = integrate(members)
            least = MESH // 2 if goes_on else 1  # few looks at long parts, not many at short ones
            which = np.flatnonzero(meshes.counts > least)
            members.blind[which] |= watcher.blind(meshes, parameters, which, self.tolerance)
            meshes.go_on(which)
        members.blind[members.outcomes != FINE] = 0


def run_ensemble(
    ensemble: Ensemble,
    tolerance: float,
    cancelled: Flag | None = None,
    report: Callable[[int], None] | None = None,
) -> EnsembleMotion:
    """All motions to a tolerance of their coordinates; `report` hears how many are done.

    Scenes whose forces jump, ask for very short steps somewhere, or that have events, are run one by one: `simulate`
    knows how. So are motions whose steps turn out to be blind.
    """
    return run_some(ensemble, tolerance, largest_step(ensemble), cancelled, report or (lambda _done: None))


def run_some(
    ensemble: Ensemble,
    tolerance: float,
    largest: float,
    flag: Flag | None = None,
    tell: Callable[[int], None] = lambda _done: None,
) -> EnsembleMotion:
    """The same by steps up to the largest, which all motions share; 0 for those that lanes cannot do.

    Each motion is the same whichever others are beside it.
    """
    flag = np.zeros(1, dtype=np.int64) if flag is None else flag
    if largest == 0.0:
        return _one_by_one(ensemble, tolerance, flag, tell)
    local = np.full(len(ensemble), _told_apart(AHEAD * tolerance))
    found = _run(ensemble, Steps(largest, float(local[0])), tolerance, flag, tell)
    for _ in range(ROUNDS - 1):
        is_missed = np.array([each.status == "tolerance_missed" for each in found.outcomes], dtype=np.bool_)
        is_missed &= ~found.blind & (local > FINEST_OF_SERIES)
        for place in np.flatnonzero(is_missed):
            local[place] = _finer(float(local[place]), float(found.worst[place]) / tolerance)
        for each in np.unique(local[is_missed]):
            which = np.flatnonzero(is_missed & (local == each))
            again = _run(ensemble.chosen(which), Steps(largest, float(each)), tolerance, flag)
            found = _merged(found, again, which, again.worst < found.worst[which])  # not where they come to no end
    blind = np.flatnonzero(found.blind)
    if not len(blind):
        return found
    alone = _one_by_one(ensemble.chosen(blind), tolerance, flag)
    return _merged(found, alone, blind, np.ones(len(blind), dtype=np.bool_))


def _finer(local: float, excess: float) -> float:
    """The next local tolerance of a motion whose error was so many times too large.

    It is one of a few, so that many motions have the same, and no other motion has a say in it.
    """
    wanted = local * max(SMALLER / excess, SMALLEST)
    return _told_apart(10.0 ** math.floor(math.log10(wanted)))


def _told_apart(local: float) -> float:
    """The largest local tolerance up to that at which rounding cannot hide what the steps do."""
    return local if local >= GRAIN else FINEST_OF_SERIES


def warm(problem: Problem) -> None:
    """Compiles the kernels of the lanes, or loads them from the cache on disk."""
    states, parameters = problem.state[None, : 2 * problem.degrees], np.array(problem.parameters)[None, :]
    run_ensemble(Ensemble(problem, states, parameters), 1e-6)
    # a motion that is seen through at once leaves the closer look to others
    rows = np.hstack([np.repeat(states, 2, axis=0), [[0.0], [problem.t_end]]])
    mesh = Meshes(rows[None, :, :], np.array([2]))
    Audit(problem, get_method("taylor")).watcher(MESH).step_by_step(mesh, parameters, 1e-6)


def prepare(problem: Problem) -> None:
    """Compiles the code for the lanes of a model, which is kept."""
    shape = jet_of_model(problem.model, is_long=True, lanes=lanes_of_host()).shape
    code_of_steps(shape)
    code_of_neighbours(shape)


def needs_single_runs(ensemble: Ensemble) -> bool:
    """Whether the lanes cannot do these motions."""
    return largest_step(ensemble) == 0.0


def largest_step(ensemble: Ensemble) -> float:
    """Seconds up to which steps see how the forces of all depend on the time alone; 0 where lanes cannot do them.

    It is looked at motions with the extremes of all initial values and parameters.
    """
    problem, model = ensemble.problem, ensemble.problem.model
    if model.events is not None or model.switches is not None or model.recurrences.conditions:
        return 0.0
    method, largest = get_method("taylor"), LARGEST * problem.t_end
    if not model.tape.uses(2 * problem.degrees):
        return largest
    for index in _extremes(np.hstack([ensemble.states, ensemble.parameters])):
        largest = min(largest, *Audit(ensemble.member(index), method).before(USUAL).largest)
        if largest * MOST_DRIVEN < problem.t_end:
            return 0.0
    return largest


def _extremes(table: Floats) -> list[int]:
    """The rows with the least and the largest number of each column, and the first; `table` is (motions, columns)."""
    varied = np.flatnonzero((table != table[0]).any(axis=0))
    return sorted({0, *table[:, varied].argmin(axis=0).tolist(), *table[:, varied].argmax(axis=0).tolist()})


def _run(
    ensemble: Ensemble,
    steps: Steps,
    tolerance: float,
    flag: Flag,
    tell: Callable[[int], None] = lambda _done: None,
) -> EnsembleMotion:
    """All motions once, at samples that are spread evenly, with what their neighbours tell.

    Those with very many steps are compared with finer runs.
    """
    problem, n = ensemble.problem, ensemble.problem.degrees
    times = np.linspace(0.0, problem.t_end, problem.samples)
    sight = Sight(Audit(problem, get_method("taylor")), AHEAD * tolerance)
    runs = _within_reach(ensemble, times, steps, flag, tell, sight)
    errors = MARGIN * runs.errors[:, :, :n]
    for many, most in _alike(runs.steps, MANY):
        errors[many] = _by_finer_runs(ensemble.chosen(many).limited(most), runs, many, steps, flag)
    return _judged(ensemble, runs, errors, tolerance)


def _within_reach(
    ensemble: Ensemble, times: Floats, steps: Steps, flag: Flag, tell: Callable[[int], None], sight: Sight
) -> Members:
    """All motions; those that no number of steps would bring to the end are OUT_OF_REACH, as single ones (`reach`)."""
    part = ensemble.problem.step_limit // PART
    runs = in_lanes(ensemble.limited(part), times, steps, flag, tell, near=NEAR, sight=sight)
    limited = runs.outcomes == STEP_LIMIT
    far = np.flatnonzero(limited & is_far(runs.reached, float(times[-1])))
    if len(far):
        half = in_lanes(ensemble.chosen(far).limited(part // 2), times[[0, -1]], steps, flag)
        runs.outcomes[far[is_steady(runs.reached[far], half.reached)]] = OUT_OF_REACH
    left = np.flatnonzero(limited & (runs.outcomes == STEP_LIMIT))
    if len(left):
        again = in_lanes(ensemble.chosen(left), times, steps, flag, near=NEAR, sight=sight)
        for name in ("samples", "errors", "outcomes", "steps", "filled", "reached", "blind"):
            getattr(runs, name)[left] = getattr(again, name)
    return runs


def _alike(steps: NDArray[np.int64], least: int) -> Iterator[tuple[NDArray[np.int64], int]]:
    """Motions with more than `least` steps, those with about as many together, and the steps of finer runs of them.

    These are twice as many as of any of them, and a power of two, so that no other motion has a say in it.
    """
    powers = np.where(steps > least, np.ceil(np.log2(np.maximum(steps, 1))).astype(np.int64), 0)
    for power in np.unique(powers[powers > 0]).tolist():
        yield np.flatnonzero(powers == power), 2 ** (power + 1)


def _by_finer_runs(ensemble: Ensemble, runs: Members, which: NDArray[np.int64], steps: Steps, flag: Flag) -> Floats:
    """The errors of some runs by others that are finer and a little away, shape (motions, samples, n).

    What but one of both came to is not known, and taken from `runs`.
    """
    t_end, n = ensemble.problem.t_end, ensemble.problem.degrees
    refinement = BySeries(t_end, SCHEME, AHEAD, BELOW)
    coarse, fine = refinement.pair(steps.tolerance, Pieces.whole(t_end))
    finer_steps = replace(fine, size=steps.size / APART, is_nudged=True)
    finer = in_lanes(ensemble, runs.times, finer_steps, flag)
    runs.outcomes[which] = np.where(runs.outcomes[which] != FINE, runs.outcomes[which], finer.outcomes)
    runs.filled[which] = np.minimum(runs.filled[which], finer.filled)
    runs.samples[which] = np.where(np.isfinite(finer.samples).all(axis=2, keepdims=True), runs.samples[which], np.nan)
    factor = OF_PAIRS * refinement.factor_of_answer(coarse, fine)
    with np.errstate(invalid="ignore", over="ignore"):
        apart = factor * np.abs(runs.samples[which][:, :, :n] - finer.samples[:, :, :n])
    return np.asarray(np.maximum.accumulate(apart, axis=1))


def in_lanes(
    ensemble: Ensemble,
    times: Floats,
    steps: Steps,
    flag: Flag,
    tell: Callable[[int], None] = lambda _done: None,
    *,
    near: int = 0,
    sight: Sight | None = None,
) -> Members:
    """All motions from times[0] on, with samples at `times`, shape (samples,), ascending, each run once.

    They go side by side in lanes, blocks of them in as many threads as there are processors. Errors are found where an
    order of neighbours is given, `near` (`series.neighbour`), and blind steps of those that come to the end where there
    is somebody to look, `sight`.
    """
    problem, count, order = ensemble.problem, len(ensemble), steps.order or SCHEME.order_for(steps.tolerance)
    jet = jet_of_model(problem.model, is_long=True, lanes=lanes_of_host())
    members, shape = _begun(ensemble, times, jet.shape.width, near, is_nudged=steps.is_nudged), jet.shape
    sizes = shape.conditions, shape.components, shape.constants, jet.work, shape.lanes
    codes = [jet.code, code_of_steps(shape), *([code_of_neighbours(shape)] if near else [])]  # kept while it runs
    known = {name: address for code in codes for name, address in code.addresses.items()}
    addresses = Addresses(**{name: known.get(name, 0) for name in Addresses._fields})

    def block(start: int) -> int:
        lanes = make_lanes(addresses, (order, near), problem.degrees, shape.width, sizes)
        part = slice(start, start + BLOCK)
        some = members._replace(  # views: what is written stays
            **{name: array[part] for name, array in members._asdict().items() if name != "times"}
        )

        def integrate(each: Members) -> bool:
            return bool(integrate_members(lanes, each, steps.tolerance, steps.size, problem.step_limit, flag))

        integrate(some) if sight is None else sight.over(some, ensemble.parameters[part], integrate)
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


def _begun(ensemble: Ensemble, times: Floats, width: int, near: int, *, is_nudged: bool) -> Members:
    """All motions at their beginnings, with room for states of so many numbers at `times`, shape (samples,)."""
    count, recurrences = len(ensemble), ensemble.problem.model.recurrences
    states = np.hstack([ensemble.states, np.zeros((count, width - ensemble.states.shape[1]))])
    constants = np.ascontiguousarray(recurrences.constants(ensemble.parameters.T).T).reshape(count, -1)
    with np.errstate(invalid="ignore"):  # a constant that is out of range ends the motion
        changes = np.hstack([nudged(ensemble.states) - ensemble.states, recurrences.nudged(constants) - constants])
    if is_nudged:
        states, constants = nudged(states), recurrences.nudged(constants)
    return Members(
        np.ascontiguousarray(states),
        constants,
        NUDGES * changes if near else changes[:, :0],
        np.ascontiguousarray(times),
        np.full((count, len(times), width), np.nan),
        np.full((count, len(times), ensemble.states.shape[1] if near else 0), np.nan),
        np.zeros(count, dtype=np.int64),
        np.zeros(count, dtype=np.int64),
        np.zeros(count, dtype=np.int64),
        np.zeros(count),
        np.empty((count, 0, ensemble.states.shape[1] + 1)),
        np.zeros(count, dtype=np.int64),
        np.zeros(count, dtype=np.int64),
    )


def _judged(ensemble: Ensemble, runs: Members, told: Floats, tolerance: float) -> EnsembleMotion:
    """The runs with their outcomes; `told`, shape (motions, samples, n), are errors but for rounding at the end."""
    n, problem, end, codes = ensemble.problem.degrees, ensemble.problem, 2 * ensemble.problem.degrees, runs.outcomes
    values, rates = runs.samples[:, :, :n], runs.samples[:, :, n:end]
    sizes = np.abs(values)
    with np.errstate(invalid="ignore", over="ignore"):
        errors = told + ROUNDING * np.maximum.accumulate(sizes, axis=1)
        known = np.nan_to_num(errors, nan=0.0)  # NaN from the end on
        worst = (known / np.maximum(1.0, np.nan_to_num(sizes))).max(axis=(1, 2))
        largest = np.nan_to_num(sizes).max(axis=1, keepdims=True)
        angular = np.array(problem.angular or (False,) * n)
        scale = np.where(angular, np.minimum(largest, 1.0), largest)
        lost = ((known >= LOST * scale) & (scale > 0.0)).any(axis=2)
    worst = np.where(codes == FINE, worst, np.nan)
    horizons = np.where(lost.any(axis=1), runs.times[lost.argmax(axis=1)], np.inf)
    excess = np.where(worst > tolerance, worst, 0.0)
    ends = runs.times[np.maximum(runs.filled - 1, 0)]
    told_apart = list(zip(codes.tolist(), ends.tolist(), horizons.tolist(), excess.tolist(), strict=True))
    of_kinds = {kind: _outcome(problem, *kind, tolerance) for kind in set(told_apart)}  # most are the same
    outcomes = tuple(of_kinds[kind] for kind in told_apart)
    return EnsembleMotion(runs.times, values, rates, errors, worst, runs.steps, outcomes, runs.blind > 0)


def _outcome(problem: Problem, code: int, end: float, horizon: float, worst: float, tolerance: float) -> Outcome:
    told: dict[str, Number] = {"method": "taylor", "t": short(end), "t_end": problem.t_end}
    if code != 0:
        return outcome_of(code, told | {"steps": problem.step_limit})
    if horizon < np.inf:
        return Outcome("horizon_reached", "horizon_reached", told | {"t": short(horizon)})
    if worst > tolerance:
        return Outcome("tolerance_missed", "tolerance_missed", told | {"tolerance": tolerance, "error": short(worst)})
    return outcome_of(code, told)


def _merged(
    found: EnsembleMotion, again: EnsembleMotion, which: NDArray[np.int64], better: NDArray[np.bool_]
) -> EnsembleMotion:
    """The motions, some of them, `which`, replaced by new ones where these are better: both of shape (new ones,)."""
    places, rows = which[better], np.flatnonzero(better)
    outcomes = list(found.outcomes)
    for place, row in zip(places, rows, strict=True):
        outcomes[place] = again.outcomes[row]
    for name in ("values", "rates", "errors", "worst", "steps", "blind"):
        getattr(found, name)[places] = getattr(again, name)[rows]
    return replace(found, outcomes=tuple(outcomes))


def _one_by_one(
    ensemble: Ensemble, tolerance: float, flag: Flag, tell: Callable[[int], None] = lambda _done: None
) -> EnsembleMotion:
    """Each motion by itself; what comes behind its end is not a number."""
    problem, count = ensemble.problem, len(ensemble)
    times = np.linspace(0.0, problem.t_end, problem.samples)
    shape = (count, len(times), problem.degrees)
    values, rates, errors = (np.full(shape, np.nan) for _ in range(3))
    worst, steps, outcomes = np.zeros(count), np.zeros(count, dtype=np.int64), list[Outcome]()
    for index in range(count):
        found = simulate(ensemble.member(index), get_method("taylor"), tolerance=tolerance, cancelled=flag)
        here, there = _at_samples(found.times, times)
        values[index, there], rates[index, there] = found.values[here], found.rates[here]
        if found.estimate is not None:
            known = here < len(found.estimate.errors)
            errors[index, there[known]] = found.estimate.errors[here[known], None]  # the largest of any coordinate
        is_judged = found.estimate is not None and found.outcome.is_judged
        worst[index] = found.estimate.worst if found.estimate is not None and is_judged else np.nan
        steps[index] = found.cost.steps
        told = {} if found.event is None else {"title": problem.model.scene.events[found.event.index].name}
        outcomes.append(replace(found.outcome, parameters={**found.outcome.parameters, **told}))
        tell(index + 1)
    blind = np.zeros(count, dtype=np.bool_)
    return EnsembleMotion(times, values, rates, errors, worst, steps, tuple(outcomes), blind)


def _at_samples(found: Floats, times: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Which of the times of a motion, shape (rows,), are at which of the samples, shape (samples,).

    A motion that goes on behind events has their times among its own, each twice; of a sample at one, what is behind it
    counts.
    """
    room = SAME * float(times[-1])
    places = np.searchsorted(found, times + room, side="right") - 1
    there = np.flatnonzero(np.abs(found[places] - times) <= room)
    return places[there], there
