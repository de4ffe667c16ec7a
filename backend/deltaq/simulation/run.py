"""One run of one method with given steps or local tolerance: the kernels seen from outside."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from .constraints import Finish, Reactions, is_locked, pivot_of, seems_turned
from .event import Approach, Event, approaches, first_event, quick_event
from .forks import fork_crossed, fork_passed, is_at_fork
from .integration import Flag, KernelArguments, Workspace, compile_symbols, run_kernel
from .kernels.loop import Result
from .kernels.motion import (
    EVENT,
    FINE,
    HELD,
    LOCKED,
    NEWTON_FAILED,
    NOT_FINITE,
    SINGULAR,
    STEP_LIMIT,
    STEP_UNDERFLOW,
    STIFF,
)
from .kernels.plan import CAPACITY, COUNT, STRIDE, Plan, make_plan
from .kernels.step_control import Control
from .lengths import first_vanishing
from .method import Method, Series
from .outcome import NO_LENGTH, OUT_OF_REACH
from .pieces import Pieces
from .problem import Floats, Problem
from .reach import PART, is_far, is_steady
from .reactions import reactions_at
from .series.engine import jet_of_model
from .stability import real_stability
from .transitions import Transition

APART = 1e-6  # of the distance between two samples; the last one before an event is that far from it at least

UNSOLVED = (NEWTON_FAILED, NOT_FINITE, STEP_UNDERFLOW)  # what a run may end with near a fork
FEW = 200  # evaluations; with more of them steps on constraints are by symbols, whose compilation takes some 10 ms
SHORT = 100_000  # right-hand sides; the time for so many is about that of compiling thoroughly


@dataclass(frozen=True)
class Stop:
    """Which switching function holds a motion by friction, since when, and the `state` then, shape (width,).

    The work ∫P dt in that state is not known.
    """

    index: int
    time: float
    state: Floats


@dataclass(frozen=True)
class Mesh:
    """The mesh of a stretch between events, as that of a run, its problem in its mode, and its `start` in seconds.

    `mesh_times` has shape (mesh,), `mesh_states` shape (mesh, 2n).
    """

    problem: Problem
    start: float
    mesh_times: Floats
    mesh_states: Floats
    stride: int


@dataclass(frozen=True)
class Run:
    """A motion as far as the run came: `times`, shape (samples,), and `states`, shape (samples, width).

    A state is (q, q̇) or, where power is fed in, (q, q̇, ∫P dt). `event` is what ended it, if an event did; else
    `approaches` tell how close it came to each of the scene's events. `held` is where friction holds it. `mesh_times`,
    shape (mesh,), and `mesh_states` (q, q̇), shape (mesh, 2n), are the ends of its steps, or of every `stride`-th,
    where they were recorded. `transitions` are the events behind which it went on; `at` names the switching function
    at whose zero it could not.
    """

    times: Floats
    states: Floats
    result: Result
    conditioning: float  # smallest pivot of M met, relative to the diagonal entry it is left of
    wall_time: float
    steps: Steps
    event: Event | None = None
    held: Stop | None = None
    approaches: tuple[Approach, ...] = ()
    mesh_times: Floats = field(default_factory=lambda: np.empty(0))
    mesh_states: Floats = field(default_factory=lambda: np.empty((0, 0)))
    stride: int = 1
    reactions: Reactions | None = None  # where there are constraints
    transitions: tuple[Transition, ...] = ()
    meshes: tuple[Mesh, ...] = ()
    at: str = ""

    @property
    def is_complete(self) -> bool:
        """Whether it came to the end, to an event, or to where friction holds it."""
        return bool(self.result.outcome in (FINE, EVENT, HELD))

    def before(self, time: float) -> Run:
        """The same with the samples before a time, the first one in any case."""
        count = max(int(np.searchsorted(self.times, time)), 1)
        reactions = self.reactions and self.reactions.first(count)
        return replace(self, times=self.times[:count], states=self.states[:count], reactions=reactions)


@dataclass(frozen=True)
class Steps:
    """How to step: with a local tolerance and steps up to `size`, or (tolerance 0) with steps of that size.

    Pieces bound the steps further; of fixed ones each piece gets a whole number, `ratio` times as many as it needs.
    `order` is that of a method whose order may be chosen, None for what suits the tolerance. A run that `is_nudged`
    begins some units in the last place away, with constants that are as far away; only series can. One that goes on
    behind events and is `shaken` has its rates moved there, by a pattern of this number (`hybrid`); 0 for none.
    """

    size: float
    tolerance: float = 0.0
    pieces: Pieces | None = None
    ratio: float = 1.0
    is_recorded: bool = False
    order: int | None = None
    is_nudged: bool = False
    shaken: int = 0

    def plan(self, start: float, t_end: float, degrees: int, method: Method) -> Plan:
        """Pieces and sizes as a kernel wants them; the last fixed step of an implicit method may go past the end.

        What is left of a span behind an event may be shorter than a fixed step. A finer run takes several there, or it
        would take the same one as the coarser run, and be wrong by the same.
        """
        pieces, size = self.pieces, self.size
        if self.tolerance == 0.0:
            size = (self.size if self.ratio == 1.0 else min(self.size, t_end - start)) / self.ratio
        ends = np.array((t_end,) if pieces is None else pieces.ends)
        if pieces is None or (self.tolerance == 0.0 and pieces.is_whole):
            sizes = np.array((size,))
        else:
            sizes = pieces.bounded(size) if self.tolerance > 0.0 else pieces.steps(self.size, self.ratio, start)
        if self.tolerance == 0.0 and not method.is_explicit:
            ends[-1] = np.inf
        return make_plan(ends, sizes, 2 * degrees, CAPACITY if self.is_recorded else 0)


def run(
    problem: Problem, method: Method, times: Floats, cancelled: Flag, steps: Steps, workspace: Workspace | None = None
) -> Run:
    """Integrates a problem once, with samples at `times`, shape (samples,), in seconds; `cancelled` has shape (1,).

    A run begins in machine code that is compiled quickly, or with series that are interpreted. One that turns out to be
    long begins again in code that runs faster, whose compilation takes as long as what was lost; so do runs of a model
    that has run for as long already.
    One that has taken a part of the steps that are allowed is given up where the rest of them would bring it nowhere.
    Runs that follow one another may share a `workspace`.
    """
    task = _Task(problem, method, times, cancelled, steps, workspace or Workspace())
    model, stages, limit = problem.model, method.scheme.stages, problem.step_limit
    shortest = limit * stages <= SHORT
    if shortest or not (model.is_thorough or max(task.known, model.usage.evaluations) > SHORT):
        found = task.run(min(SHORT // stages, limit), is_long=False)
        model.usage.evaluations += found.result.evaluations
        if shortest or found.result.outcome not in (STEP_LIMIT, STIFF):
            return found
    if steps.tolerance > 0.0 and limit // PART * stages > SHORT:
        found = task.limited()
        if found.result.outcome != STEP_LIMIT:
            return found
    return task.run(limit, is_long=True)


@dataclass(frozen=True)
class _Task:
    """What a run is given but for how many steps it may take; see `run`."""

    problem: Problem
    method: Method
    times: Floats
    cancelled: Flag
    steps: Steps
    workspace: Workspace

    @property
    def known(self) -> float:
        """How many evaluations its fixed steps take; 0 where steps are not."""
        steps, stages = self.steps, self.method.scheme.stages
        return float(self.times[-1]) / steps.size * steps.ratio * stages if steps.tolerance == 0.0 else 0.0

    def limited(self) -> Run:
        """A run of a part of the steps; OUT_OF_REACH if all that are allowed would bring it nowhere (`reach`)."""
        part, span = self.problem.step_limit // PART, float(self.times[-1] - self.times[0])
        found = self.run(part, is_long=True)
        if found.result.outcome != STEP_LIMIT:
            return found
        gone = float(found.result.reached - self.times[0])
        if not is_far(gone, span):
            return found
        half = self.run(part // 2, is_long=True)
        is_lost = is_steady(gone, float(half.result.reached - self.times[0]))
        return replace(found, result=found.result._replace(outcome=OUT_OF_REACH)) if is_lost else found

    def run(self, limit: int, *, is_long: bool) -> Run:
        """A run of so many steps at most."""
        problem, method, times, steps, workspace = self.problem, self.method, self.times, self.steps, self.workspace
        plan = steps.plan(float(times[0]), float(times[-1]), problem.degrees, method)
        is_series = isinstance(method.scheme, Series)
        if is_series:
            jet_of_model(problem.model, is_long=is_long)  # compiled before the time is taken
        in_symbols = is_long or self.known > FEW
        if in_symbols:
            compile_symbols(method.scheme, problem)
        arguments = KernelArguments(
            problem,
            workspace.motion(problem, is_long=is_long and not is_series, finish=Finish.of(method)),
            _control(limit, method, steps, plan),
            workspace.watch(problem, self.cancelled, method.scheme),
            np.ascontiguousarray(times),  # a kernel is compiled anew for an array with strides
            np.zeros((times.size, problem.width)),
            is_long,
            in_symbols,
            steps.order,
            steps.is_nudged,
            workspace.call,
        )
        start = perf_counter()
        result = run_kernel(method.scheme, arguments)
        wall_time = perf_counter() - start
        return _while_lengths_last(problem, _found(arguments, plan, result, wall_time, steps))


def _found(arguments: KernelArguments, plan: Plan, result: Result, wall_time: float, steps: Steps) -> Run:
    """What a kernel left, as far as it is finite, up to the event if there is one."""
    problem, times = arguments.problem, arguments.times
    out, conditioning = arguments.out, float(arguments.motion.conditioning[0])
    known = np.isfinite(out[: result.samples])
    good = len(known) if known.all() else int(known.all(axis=1).cumprod().sum())
    reactions = None
    if problem.is_constrained:
        memory = arguments.motion.memory
        result, conditioning = _told_apart(result, memory), min(conditioning, pivot_of(memory))
    if problem.reactions:
        out, reactions = reactions_at(problem, times[:good], out[:good])
        if len(out) < good and result.outcome in (FINE, EVENT):  # what the samples did not come to is not known
            result = result._replace(outcome=NEWTON_FAILED, reached=float(times[len(out)]), samples=len(out))
        good = len(out)
    mesh_times, mesh_states = plan.times[: plan.progress[COUNT]], plan.states[: plan.progress[COUNT]]
    stride = int(plan.progress[STRIDE])
    turned = problem.is_constrained and stride == 1 and seems_turned(arguments.motion.memory)
    known_states = out[:good, : 2 * problem.degrees]
    result = _forked(problem, times[:good], known_states, mesh_times, mesh_states, result, turned=turned)
    good = min(good, result.samples)
    if stride > 1:
        mesh_times, mesh_states = _to_the_end(mesh_times, mesh_states, times[:good], out[:good])
    result, event, close = _watched(arguments, times[:good], result)
    good = min(good, result.samples)
    return Run(
        times[:good],
        out[:good],
        result,
        conditioning,
        wall_time,
        steps,
        event=event,
        held=_stop(arguments) if result.outcome == HELD else None,
        approaches=close,
        mesh_times=mesh_times,
        mesh_states=mesh_states,
        stride=stride,
        reactions=reactions and reactions.first(good),
    )


def _while_lengths_last(problem: Problem, found: Run) -> Run:
    """A run up to where the first prescribed length comes to zero, looked for at its samples and its mesh."""
    if not (problem.is_constrained and len(found.times)):
        return found
    known = found.mesh_times <= found.times[-1]
    every, states = found.times, found.states[:, : 2 * problem.degrees]
    if known.any():
        every, states = np.append(every, found.mesh_times[known]), np.vstack([states, found.mesh_states[known]])
    order = np.argsort(every, kind="stable")
    gone = first_vanishing(problem, every[order], states[order])
    if gone is None or (found.event is not None and found.event.time <= gone.time):
        return found
    count = max(int(np.searchsorted(found.times, gone.time, side="right")), 1)
    return replace(
        found,
        times=found.times[:count],
        states=found.states[:count],
        reactions=found.reactions and found.reactions.first(count),
        result=found.result._replace(outcome=NO_LENGTH, reached=gone.time, samples=count),
        event=None,
        held=None,
        approaches=(),
        at=gone.name,
    )


def _to_the_end(mesh_times: Floats, mesh_states: Floats, times: Floats, states: Floats) -> tuple[Floats, Floats]:
    """A mesh whose last step is prolonged to the last sample: of very many steps the last ones are not recorded.

    No step stands for fewer of the run than it is said to. The arrays have shapes (steps,), (steps, 2n), (samples,) and
    (samples, ≥ 2n).
    """
    if not (mesh_times.size and times.size and times[-1] > mesh_times[-1]):
        return mesh_times, mesh_states
    kept, width = slice(None, max(mesh_times.size - 1, 1)), mesh_states.shape[1]
    return np.append(mesh_times[kept], times[-1]), np.vstack([mesh_states[kept], states[-1:, :width]])


def _forked(
    problem: Problem,
    times: Floats,
    states: Floats,
    mesh_times: Floats,
    mesh_states: Floats,
    result: Result,
    *,
    turned: bool,
) -> Result:
    """The result, saying whether the run ended at a fork of the constraints, or where it should have done so.

    `times`, shape (samples,), and `states`, shape (samples, 2n), are the samples, the others the mesh; where the
    constraints `turned` within a step, it has all of them.
    """
    if result.outcome in UNSOLVED:
        later = mesh_times > times[-1] if len(times) else mesh_times >= 0.0
        known, seen = np.append(times, mesh_times[later]), np.vstack([states, mesh_states[later]])
        return result._replace(outcome=LOCKED) if is_at_fork(problem, known, seen, result.reached) else result
    passed = fork_passed(problem, mesh_times, mesh_states) if result.outcome in (FINE, EVENT) else None
    if passed is None and turned and result.outcome in (FINE, EVENT):
        passed = fork_crossed(problem, mesh_times, mesh_states)
    if passed is None:
        return result
    return result._replace(outcome=LOCKED, reached=passed, samples=int(np.searchsorted(times, passed, side="right")))


def _control(limit: int, method: Method, steps: Steps, plan: Plan) -> Control:
    return Control(
        float(steps.tolerance),
        float(steps.size),
        float(method.error_order or method.order),
        float(method.memory),
        limit,
        int(method.scheme.stages),
        real_stability(method.scheme),
        plan,
    )


def _stop(arguments: KernelArguments) -> Stop:
    """Where the kernel found the motion held."""
    switch = arguments.watch.switch
    return Stop(int(switch.which[0]), float(switch.when[0]), switch.middle.copy())


def _watched(
    arguments: KernelArguments, times: Floats, result: Result
) -> tuple[Result, Event | None, tuple[Approach, ...]]:
    """The result up to the event, if there is one; a fixed step may have met one beyond the end.

    `times`, shape (samples,), are those that the kernel came to. Without an event it is told how close others came.
    """
    problem, watch, t_end = arguments.problem, arguments.watch, float(arguments.times[-1])
    if not watch.functions or result.outcome == HELD:
        return result, None, ()
    in_modes = problem.model.is_in_modes
    event = quick_event(problem, watch, t_end, arguments.call) if in_modes else first_event(problem, watch, t_end)
    if event is None:
        fine = result._replace(outcome=FINE) if result.outcome == EVENT else result
        return fine, None, () if in_modes else approaches(problem, watch, t_end)
    close = APART * (arguments.times[1] - arguments.times[0])
    count = max(int(times.searchsorted(event.time - close)), 1)
    return result._replace(outcome=EVENT, reached=event.time, samples=count), event, ()


def _told_apart(result: Result, memory: Floats) -> Result:
    """The result, saying whether M has no inverse or the constraints have lost their independence."""
    return result._replace(outcome=LOCKED) if result.outcome == SINGULAR and is_locked(memory) else result
