"""A run of a hybrid system, which goes on behind events: one smooth stretch behind the other, each in its mode.

Every stretch is a run of its own, ended where a watched value falls through zero, located on the step's polynomial; so
no step runs over a kink. Rebounds that pile up end in rest. What an impact takes from the energy goes into ∫P dt.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from ..model.modes import Modes
from .audited import AuditedParts, mesh_of
from .constraints import Reactions
from .event import Event
from .friction_bounds import require_holding, require_opposing
from .impact import NoDirectionError, UndeterminedError, UnsettledError
from .integration import Flag, Workspace
from .kernels.loop import Result
from .kernels.motion import FINE, MANY_EVENTS, NOT_FINITE, SINGULAR, STEP_LIMIT, UNSETTLED
from .method import Method
from .mode_state import TOUCHING, ModeState
from .outcome import CHATTERS, DRIVES, HOLDS_LESS, NO_DIRECTION, OUT_OF_REACH, SLIDES, UNDETERMINED, WITHIN_STEPS
from .pieces import Pieces
from .problem import Floats, Problem
from .run import Mesh, Run, Steps, run
from .sliding import SlidingError
from .transitions import BoundError, Transition, begun, passed, with_offsets

MOST = 5000  # events in one run
AT_ONCE = 50  # events at the same time, by rounding
CROWD, CROWDED = 400, 1e-4  # so many switches in such a part of the span: the state slides along a kink
IN_A_STEP, ALWAYS = 2.0, 1000  # switches in one given step on average, and in any run
NEAR = 1e-6  # of the span, of differences
SAME = 1e-13  # of the time, and at least of the span or of a second, whichever is shorter
SHAKE = 8.0 * 2.0**-52  # of a rate, and of what it changes by up to the time
OF_TERMS = 2.0 * 2.0**-52  # of the terms of the momenta that jump: M is rounded, and the same at each impact
OF_TIME = 2.0**-52  # of the time of a jump, which is rounded up more often than down
NARROW = 1.0 / 16.0  # of the gaps that count as closed
OUTCOMES: Mapping[type[Exception], int] = {
    UnsettledError: UNSETTLED,
    NoDirectionError: NO_DIRECTION,
    UndeterminedError: UNDETERMINED,
    np.linalg.LinAlgError: SINGULAR,
}


@dataclass
class _Record:
    """What the stretches leave: samples with their multipliers, mesh, counts, events."""

    out: Floats
    held: Floats
    most_switches: float
    filled: int = 1
    work: float = 0.0
    steps: int = 0
    rejected: int = 0
    evaluations: int = 0
    conditioning: float = 1.0
    wall_time: float = 0.0
    meshes: list[Mesh] = field(default_factory=list)
    transitions: list[Transition] = field(default_factory=list)
    last: float = 0.0
    at_once: int = 0
    switches: int = 0
    switched: deque[float] = field(default_factory=lambda: deque(maxlen=CROWD))

    def is_crowded(self, span: float) -> bool:
        """Whether forces switch to and fro without the motion going on."""
        return len(self.switched) == CROWD and self.switched[-1] - self.switched[0] <= CROWDED * span

    def moved(self, event: Event, time: float, degrees: int) -> Floats:
        """The state of an event carried over to a time close to it by its rates, shape (width,); all work is in it."""
        state = event.state.copy()
        state[:degrees] += (time - event.time) * event.state[degrees : 2 * degrees]
        if state.size > 2 * degrees:
            state[-1] += self.work
        return state

    def add(self, problem: Problem, found: Run) -> None:
        """The samples of a stretch behind its first, which is its beginning, and what it took."""
        states, first = found.states[1:], self.filled
        self.filled += len(states)
        self.out[first : self.filled] = states
        if states.shape[1] % 2:
            self.out[first : self.filled, -1] += self.work
        if found.reactions is not None:
            self.held[first - 1 : self.filled] = found.reactions.multipliers
        self.steps += found.result.steps
        self.rejected += found.result.rejected
        self.evaluations += found.result.evaluations
        self.conditioning = min(self.conditioning, found.conditioning)
        self.wall_time += found.wall_time
        self.meshes.append(mesh_of(problem, found))


def run_on(
    problem: Problem,
    modes: Modes,
    method: Method,
    times: Floats,
    cancelled: Flag,
    steps: Steps,
    parts: AuditedParts | None = None,
    begin: Callable[[float], ModeState] | None = None,
) -> Run:
    """The run of a problem in modes, with samples at `times`, shape (samples,), as far as it comes.

    With `parts`, those of it that may have missed a force are run again before it goes on behind them. One that is
    `shaken` is moved by a little more than rounding does, at its start and behind each event: impacts part
    neighbours, and two runs that round alike would know nothing of it. `begin` is `begun` of the problem, where several
    runs have the same.
    """
    start = _first(modes, steps, begin or partial(begun, problem, modes))
    if isinstance(start, _End):
        return _not_begun(problem, times, steps, start)
    current = with_offsets(_shaken(start, start.v, 0, steps.shaken))
    width, count = current.problem.state.size, len(problem.reactions)
    most_switches = _most_switches(steps, float(times[-1]))
    record = _Record(np.zeros((times.size, width)), np.zeros((times.size, count)), most_switches)
    record.out[0, : 2 * problem.degrees] = problem.state[: 2 * problem.degrees]
    go = partial(run, workspace=Workspace()) if parts is None else parts.first_part
    while True:
        stretch, ahead = _problem(current, record.steps), _ahead(times, current.time)
        found = go(stretch, method, ahead, cancelled, _after(steps, current.time))
        record.add(stretch, found)
        if (part := _end_of_part(current, found, times)) is not None:
            current = part
            continue
        if found.event is None or found.result.outcome in (STEP_LIMIT, OUT_OF_REACH):
            return _whole(record, times, found.result.outcome, float(found.result.reached), found, found.at)
        event = found.event
        _fill(record, times, event, problem.degrees)
        if event.index < len(modes.ending):
            return _ended(record, times, modes, _falling(current, event), found)
        behind = _behind(current, event, record, float(times[-1]))
        if isinstance(behind, _End):
            return _whole(record, times, behind.outcome, event.time, found, behind.at)
        rates = event.state[problem.degrees : 2 * problem.degrees]
        current = with_offsets(_shaken(behind, rates, len(record.meshes), steps.shaken))
        if current.time >= times[-1]:
            return _whole(record, times, FINE, float(times[-1]), found)


def in_first_mode(problem: Problem, modes: Modes) -> Problem:
    """The problem as it is up to its first event; as it stands where nothing tells how it begins."""
    try:
        return _problem(with_offsets(begun(replace(problem, model=modes.model), modes)), 0)
    except (UnsettledError, NoDirectionError, UndeterminedError, SlidingError, np.linalg.LinAlgError):
        return problem


def _most_switches(steps: Steps, span: float) -> float:
    """How often forces may switch: steps of a given size that are unstable between switches would find ever more."""
    if steps.tolerance > 0.0:
        return np.inf
    return max(ALWAYS, IN_A_STEP * span * steps.ratio / steps.size)


@dataclass(frozen=True)
class _End:
    """Why a motion does not go on behind an event, and what it happens at the zero of, if that says more."""

    outcome: int
    at: str = ""


def _first(modes: Modes, steps: Steps, begin: Callable[[float], ModeState]) -> ModeState | _End:
    """The state that a run begins with, or why there is none."""
    try:
        return begin(_closed(modes, steps))
    except SlidingError as sliding:
        return _End(SLIDES, modes.name_of(sliding.row))
    except tuple(OUTCOMES) as unknown:
        return _End(OUTCOMES[type(unknown)])


def _behind(current: ModeState, event: Event, record: _Record, span: float) -> ModeState | _End:
    """The state behind an event, or why there is none that the run goes on from."""
    try:
        behind = _next(current, event, record)
    except BoundError as broken:
        return _End(DRIVES if broken.drives else HOLDS_LESS, current.modes.frictions[broken.friction])
    except SlidingError as sliding:
        return _End(SLIDES, current.modes.name_of(sliding.row))
    except tuple(OUTCOMES) as unknown:
        return _End(OUTCOMES[type(unknown)])
    if behind is None:
        return _End(NOT_FINITE)
    if record.is_crowded(span):
        return _End(CHATTERS, current.modes.name_of_watched(event.index))
    return _too_often(record) or behind


def _too_often(record: _Record) -> _End | None:
    """Why no more events are followed, if they are not."""
    if record.switches > record.most_switches:
        return _End(WITHIN_STEPS)
    is_over = len(record.transitions) >= MOST or record.at_once >= AT_ONCE
    return _End(MANY_EVENTS) if is_over else None


def _problem(current: ModeState, taken: int) -> Problem:
    """The problem of the next stretch."""
    problem, values, rates = current.problem, tuple(current.q.tolist()), tuple(current.v.tolist())
    return problem.going_on(current.parameters, values, rates, max(problem.step_limit - taken, 1))


def _end_of_part(current: ModeState, found: Run, times: Floats) -> ModeState | None:
    """Where a run ended before the last of the times, shape (samples,), and without an event; None if it did not."""
    if found.event is not None or found.result.outcome != FINE or found.times[-1] >= times[-1]:
        return None
    n, last = len(current.q), found.states[-1]
    return current.at(float(found.times[-1]), last[:n].copy(), last[n : 2 * n].copy())


def _ahead(times: Floats, start: float) -> Floats:
    """The samples of a stretch: its beginning and those behind it."""
    behind = times[times.searchsorted(start, side="right") :]
    found = np.empty(len(behind) + 1)
    found[0], found[1:] = start, behind
    return found


def _after(steps: Steps, start: float) -> Steps:
    """The pieces that are left behind a time."""
    pieces = steps.pieces
    if pieces is None or pieces.is_whole or pieces.ends[0] > start:
        return steps
    first = next(k for k, end in enumerate(pieces.ends) if end > start)
    return replace(steps, pieces=Pieces(pieces.ends[first:], pieces.largest[first:]))


def _fill(record: _Record, times: Floats, event: Event, degrees: int) -> None:
    """Samples so close before an event that the stretch left them out are those of the event, moved by its rates."""
    while record.filled < times.size and times[record.filled] <= event.time:
        record.out[record.filled] = record.moved(event, float(times[record.filled]), degrees)
        record.held[record.filled] = record.held[record.filled - 1]
        record.filled += 1


def _next(current: ModeState, event: Event, record: _Record) -> ModeState | None:
    """The state behind an event, None if it exceeds all numbers; its name is recorded, with the energy that it took."""
    n = len(current.q)
    before = current.at(event.time, event.state[:n].copy(), event.state[n : 2 * n].copy())
    require_opposing(before)
    after, name, kind, together = passed(before, event.index)
    if not (before.is_finite and after.is_finite):
        return None
    require_holding(after)
    loss = before.kinetic - after.kinetic if kind in ("impact", "rest", "slide") else 0.0
    reached = record.moved(event, after.time, n)
    record.work += (float(event.state[-1]) if event.state.size > 2 * n else 0.0) - loss
    is_same = event.time - record.last <= SAME * max(min(1.0, current.problem.t_end), event.time)
    record.at_once = record.at_once + 1 if is_same else 0
    record.last = event.time
    if kind == "switch":
        record.switches += 1
        record.switched.append(event.time)
    else:
        left = np.array([*after.q.tolist(), *after.v.tolist(), record.work][: event.state.size])
        is_last = kind == "slide" and current.modes.is_pin(event.index)
        record.transitions.append(Transition(name, after.time, kind, reached, left, loss, None, is_last, together))
    return after


def _closed(modes: Modes, steps: Steps) -> float:
    """How small gaps count as closed: smaller ones than for runs that are shaken.

    Of contacts that follow each other faster and faster the last ones count as one at a time. What that leaves out is a
    part of what shaken runs leave out, and so of the difference of the two.
    """
    return NARROW * TOUCHING if modes.contacts and steps.shaken == 0 else TOUCHING


def _shaken(current: ModeState, before: Floats, number: int, pattern: int) -> ModeState:
    """The state moved by what rounding would do, up and down in no simple order; `before` it jumped, q̇ was that.

    What is held stays as it is, and constraints are kept. Where forces exceed all numbers, or M has no inverse, the run
    tells so itself. Both q̇ have shape (n,).
    """
    if pattern == 0 or any(current.mode.flags):
        return current
    with suppress(np.linalg.LinAlgError):
        if all(map(math.isfinite, current.accelerations.tolist())):
            return _moved_by_rounding(current, current.v - before, number, pattern)
    return current


def _moved_by_rounding(current: ModeState, jump: Floats, number: int, pattern: int) -> ModeState:
    """What rounding does to rates, differently each time; to a jump of theirs, and to its time, always alike."""
    size, rows = np.abs(current.v) + current.time * np.abs(current.accelerations), np.arange(len(jump))
    wave = np.cos(2.0 * rows + pattern * (number + 2.0))
    momenta = SHAKE * current.mass @ (size * wave)
    momenta += OF_TERMS * (np.abs(current.mass) @ np.abs(jump)) * np.cos(3.0 * rows + 1.7 * pattern)
    return current.at(current.time, current.q + OF_TIME * current.time * jump, current.v + current.moved_by(momenta))


def _falling(current: ModeState, event: Event) -> Event:
    """An event that ends the motion, with the first two derivatives of its value along the motion by differences."""
    n = len(current.q)
    at = current.at(event.time, event.state[:n].copy(), event.state[n : 2 * n].copy())
    a, near = at.accelerations, NEAR * current.problem.t_end
    before, now, after = (
        at.at(at.time + h, at.q + h * (at.v + 0.5 * h * a), at.v + h * a).watched[event.index]
        for h in (-near, 0.0, near)
    )
    return replace(event, fall=(after - before) / (2.0 * near), bend=(after - 2.0 * now + before) / near**2)


def _ended(record: _Record, times: Floats, modes: Modes, event: Event, found: Run) -> Run:
    """The run up to one of the scene's events that end it."""
    state = event.state.copy()
    if state.size % 2:
        state[-1] += record.work
    ended = _whole(record, times, found.result.outcome, event.time, found)
    return replace(ended, event=replace(event, index=modes.ending[event.index], state=state))


def _not_begun(problem: Problem, times: Floats, steps: Steps, end: _End) -> Run:
    """The start alone, where switches do not tell how it goes on, or M has no inverse."""
    states = problem.state[None, :]
    held = Reactions(np.zeros((1, len(problem.reactions))), np.zeros(1)) if problem.reactions else None
    return Run(times[:1], states, Result(end.outcome, 1, 0, 0, 0, 0.0), 1.0, 0.0, steps, reactions=held, at=end.at)


def _whole(record: _Record, times: Floats, outcome: int, reached: float, found: Run, at: str = "") -> Run:
    """All stretches as one run."""
    count = record.filled
    result = Result(outcome, count, record.steps, record.rejected, record.evaluations, reached)
    return Run(
        times[:count],
        record.out[:count],
        result,
        record.conditioning,
        record.wall_time,
        found.steps,
        held=found.held,
        transitions=tuple(record.transitions),
        reactions=Reactions(record.held[:count], np.zeros(count)) if record.held.size else None,
        meshes=tuple(record.meshes),
        at=at,
    )
