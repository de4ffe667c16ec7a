"""Where a run would be blind, and where it was: what forces, and events, do between the places that a method looks at.

Two runs that agree prove nothing where both miss the same thing: a pulse between their stages, a drive in step with
their steps. So the model's own operations are bounded by intervals, before a run over the time alone, and after it
along the path it took. What asks for short steps somewhere gets them, and what jumps at a known time gets a step that
ends before it and one that begins behind it.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..model.tape import Tape
from .derivatives import accelerations
from .event import event_values
from .kernels.audit import DEEPEST, GROUP, AuditWorkspace, Blind, Path, Rules, inspect, survey_times
from .kernels.compiler import KernelCalls
from .kernels.intervals import Ranges, TapeArrays
from .kernels.sight import Boxes, Meshes, Room, Slopes, find_blind, find_unsure
from .kernels.watch import NODES, NODES_OF_SERIES, places_of_watch
from .method import Method, Series
from .pieces import BlindStretch, Pieces
from .problem import Floats, Problem
from .run import Mesh, Run
from .sensitivity import sensitivities

# Swings of an argument that a method follows: four radians, or less where its stages lie far apart.
LARGEST_SWING, PER_GAP = 4.0, 1.25
SHARE = 0.03  # of the tolerance; a force that moves the coordinates by less over the whole span does not matter
MOST_LEAVES = 4096  # intervals of time looked at in one go
LEVELS = 80  # of halving the span; behind them neighbouring numbers are reached
UNIFORM = 1.001  # swings that differ by less belong to a steady drive, which halving would not resolve any better
STEADY_FROM = 2  # levels, before which all intervals may look alike by chance
KINK = 1e-3  # of the span: a longer rest of an interval with a kink is of no consequence
MOST_STRETCHES = 512
USUAL = 1e-6  # what a run is audited for before its error is known
NOTICED = 1e-9  # a jump of a guide, relative to its size


@dataclass(frozen=True)
class GuideJump:
    """A guided coordinate that jumps, or whose rate does, and the time just before in seconds."""

    name: str
    time: float


@dataclass(frozen=True)
class Level:
    """Intervals of time of much the same length, and whether a switch may lie in what each is a half of.

    `starts`, `ends` and `had_switch` have shape (intervals,).
    """

    starts: Floats
    ends: Floats
    had_switch: NDArray[np.bool_]

    @property
    def sizes(self) -> Floats:
        """The lengths of the intervals: shape (intervals,)."""
        return self.ends - self.starts

    @property
    def is_whole(self) -> NDArray[np.bool_]:
        """Which have nothing between their ends, that is neighbouring numbers: shape (intervals,)."""
        middles = self._middles
        return (middles <= self.starts) | (middles >= self.ends)

    def halved(self, chosen: NDArray[np.bool_], switches: NDArray[np.bool_]) -> Level:
        """Both halves of those chosen; `chosen` and `switches` have shape (intervals,)."""
        starts, ends, middles = self.starts[chosen], self.ends[chosen], self._middles[chosen]
        return Level(np.concatenate([starts, middles]), np.concatenate([middles, ends]), np.tile(switches[chosen], 2))

    @property
    def _middles(self) -> Floats:
        return self.starts + 0.5 * self.sizes


@dataclass(frozen=True)
class Audit:
    """What a method can see of a problem: interval bounds of the forces between the places that it evaluates."""

    problem: Problem
    method: Method

    @cached_property
    def limit(self) -> float:
        """The largest swing per step that the stages of the method can follow."""
        return min(LARGEST_SWING, PER_GAP / largest_gap(self.method))

    def before(self, tolerance: float) -> Pieces:
        """The span in pieces, each with the largest step that resolves how forces and events depend on time alone."""
        end = self.problem.t_end
        if not self._tape.uses(2 * self.problem.degrees):
            return Pieces((end,), (end,))
        return Pieces.joined(end, self._leaves(self.threshold(tolerance)))

    def guide_jump(self) -> GuideJump | None:
        """The first jump of a guide or of its rate: it takes an infinite force, which no equation here contains."""
        layout = self.problem.model.layout
        for before, after in self.before(USUAL).jumps if layout.guided and self._tape.has_choices else ():
            rows = self.problem.inputs(np.array([before, after]), np.repeat(self.problem.state[None, :], 2, axis=0))
            seen = self.problem.model.observe(rows)
            for name in layout.guided:
                sides = [*seen.values[name], *seen.rates[name]]
                if any(abs(b - a) > NOTICED * max(1.0, abs(a), abs(b)) for a, b in (sides[:2], sides[2:])):
                    return GuideJump(name, before)
        return None

    def after(self, run: Run, tolerance: float) -> tuple[BlindStretch, ...]:
        """The stretches of a recorded run on which it was blind, for a tolerance of the coordinates."""
        return self.after_each((Mesh(self.problem, 0.0, run.mesh_times, run.mesh_states, run.stride),), tolerance)

    def after_each(self, meshes: Sequence[Mesh], tolerance: float) -> tuple[BlindStretch, ...]:
        """The same of a run that went on behind events, each mesh in its mode: a problem with other parameters."""
        meshes = [mesh for mesh in meshes if len(mesh.mesh_times) > 1]
        if not meshes:
            return ()
        joined = _Joined.of(meshes)
        threshold, ranges, width = self.threshold(tolerance), self._ranges_of(), 2 * self.problem.degrees + 1
        all_seeds = self.seeds(joined.rows(joined.groups), threshold, self._nearest(joined))
        parts = joined.groups.searchsorted([*joined.firsts, len(joined.times)]).tolist()
        seeds = [all_seeds[i:j] for i, j in pairwise(parts)]
        workspace, blind, spare = _make_workspace(self.tape_arrays.codes.size), _make_blind(), np.zeros((2, width))
        call = KernelCalls()
        found: list[BlindStretch] = []
        for mesh, path, own, parameters in zip(meshes, _paths(joined), seeds, joined.parameters, strict=True):
            ranges.inputs_low[width:] = ranges.inputs_high[width:] = parameters
            workspace.looked[0] = blind.found[0] = 0
            rules = Rules(self.limit, threshold, float(mesh.stride))
            call(inspect, self.tape_arrays, ranges, path, own, rules, workspace, spare, blind)
            columns = (column[: blind.found[0]].tolist() for column in (blind.starts, blind.ends, blind.steps))
            found += [BlindStretch(*each) for each in zip(*columns, strict=True)]
        return tuple(found)

    def watcher(self, capacity: int) -> Watcher:
        """Who looks at steps of motions of this model, up to so many at a time of each; one for each thread.

        No more than the GROUP over which what forces do to q̈ is taken from where a motion begins.
        """
        if capacity > GROUP + 1:
            raise ValueError(f"a watcher looks at {GROUP} steps of a motion at most")
        operations, n, ranges = self._tape.codes.size, self.problem.degrees, self._ranges_of()
        room = Room(
            np.zeros((2 * n + 1, capacity)),
            Slopes(*_columns(operations), np.zeros(operations), np.zeros(operations, dtype=np.int64)),
            Boxes(
                np.zeros((2 * n + 1, capacity)),
                np.zeros((2 * n + 1, capacity)),
                *_columns(capacity),
                np.zeros(capacity),
                np.zeros((2, ranges.inputs_low.size)),
            ),
            _make_workspace(operations),
            Path(np.zeros(capacity), *(np.zeros((capacity, n)) for _ in range(3))),
            np.zeros((2, 2 * n + 1)),
            _make_blind(),
        )
        return Watcher(self, ranges, room)

    def threshold(self, tolerance: float) -> float:
        """The change of q̈ that could move a coordinate by its share of the tolerance."""
        return SHARE * tolerance * self._per_span * self._per_span

    @property
    def _per_span(self) -> float:
        """1/t_end, whose square may be infinite: that of t_end may be 0, by which nothing can be divided."""
        return 1.0 / self.problem.t_end

    @cached_property
    def _tape(self) -> Tape:
        return self.problem.model.audited

    def _nearest(self, joined: _Joined) -> Floats:
        """The least value of each event in each GROUP of steps of meshes: shape (groups, events)."""
        function, events = self.problem.model.events, list(self.problem.model.seen_events)
        if function is None or not events:
            return np.ones((len(joined.groups), 0))
        values = function.table(joined.rows(slice(None)))[:, events]
        values[~(values > 0.0)] = values[joined.lasts] = np.inf
        return np.asarray(np.minimum.reduceat(values, joined.groups, axis=0))

    @property
    def tape_has_choices(self) -> bool:
        """Whether the forces change where a condition does."""
        return self._tape.has_choices

    @cached_property
    def tape_arrays(self) -> TapeArrays:
        """The model's operations, as kernels read them."""
        tape = self._tape
        events = len(self.problem.model.seen_events)
        share = min(1.0, self.limit * largest_gap_of_watch(self.method) / PER_GAP)
        return TapeArrays(tape.codes, tape.a, tape.b, tape.c, tape.constants, tape.outputs, events, share)

    @cached_property
    def _ranges(self) -> Ranges:
        """Room for the bounds, with the inputs at their initial values."""
        return self._ranges_of()

    def _ranges_of(self) -> Ranges:
        inputs = np.array((*self.problem.values, *self.problem.rates, 0.0, *self.problem.parameters))
        operations, outputs = self._tape.codes.size, self._tape.outputs.size
        return Ranges(inputs.copy(), inputs.copy(), *_columns(operations), np.zeros(outputs))

    def seeds(self, rows: Floats, threshold: float = 0.0, values: Floats | None = None) -> Floats:
        """Bounds of how q̈ moves with each output of the tape at rows (q, q̇, t, parameters), |q| above 1 counted as 1.

        Guides count as they move, events by what is left of their `values`, shape (rows, events): what could take all
        of it counts as much as a force at the threshold. `rows` has shape (rows, inputs); returns shape (rows, outputs
        of the tape).
        """
        model, n = self.problem.model, self.problem.degrees
        table = model.motion.table(rows)
        of_motion, of_constraints = sensitivities(
            model.layout, table, np.maximum(1.0, np.abs(rows[:, :n])), self.problem.rank
        )
        guides = np.repeat([[self._per_span * self._per_span, self._per_span]], len(model.layout.guided), axis=1)
        with np.errstate(divide="ignore"):
            of_events = np.zeros((len(rows), len(model.seen_events))) if values is None else threshold / values
        found = np.hstack([of_motion, np.repeat(guides, len(rows), axis=0), of_constraints, of_events])
        return np.asarray(np.nan_to_num(found, nan=sys.float_info.max, posinf=sys.float_info.max))

    def _leaves(self, threshold: float) -> list[tuple[float, float, float]]:
        """Intervals of time with the largest step in each (0: neighbouring numbers with a jump between), in order.

        Level by level the intervals that are not seen through are halved. What is left of one with a kink is one of its
        own, so that steps end there.
        """
        start = self.problem.inputs(np.zeros(1), self.problem.state[None, :])
        values = event_values(self.problem, np.zeros(1), self.problem.state[None, :])
        left = np.maximum(np.abs(values[:, list(self.problem.model.seen_events)]), np.finfo(float).tiny)
        self._ranges.seeds[:] = self.seeds(start, threshold, left)[0]
        leaves: list[tuple[float, float, float]] = []
        level = Level(np.zeros(1), np.array([self.problem.t_end]), np.zeros(1, dtype=np.bool_))
        for depth in range(LEVELS):
            swings, switches = self._swings(level.starts, level.ends, threshold)
            is_steady = depth > STEADY_FROM and not switches.any() and swings.max() < UNIFORM * swings.min() < np.inf
            seen = (swings <= self.limit) & ~switches | level.is_whole
            seen |= is_steady or 2 * np.count_nonzero(~seen) > MOST_LEAVES
            with np.errstate(divide="ignore"):
                steps = np.where(level.is_whole & switches, 0.0, level.sizes * self.limit / swings)
            kinks = level.had_switch & ~switches & (level.sizes < KINK * self.problem.t_end)
            kinks[kinks] = self._swings(level.starts[kinks], level.ends[kinks], 0.0)[1]
            steps = np.where(kinks, np.minimum(steps, level.sizes), steps)
            leaves += list(
                zip(level.starts[seen].tolist(), level.ends[seen].tolist(), steps[seen].tolist(), strict=True)
            )
            if seen.all():
                break
            level = level.halved(~seen, switches)
        return sorted(leaves)

    def _swings(self, starts: Floats, ends: Floats, threshold: float) -> tuple[Floats, NDArray[np.bool_]]:
        swings, switches = np.zeros(starts.size), np.zeros(starts.size, dtype=np.int64)
        place = 2 * self.problem.degrees
        survey_times(self.tape_arrays, self._ranges, place, starts, ends, threshold, swings, switches)
        return swings, switches > 0


@dataclass(frozen=True)
class Watcher:
    """Looks at the steps of several motions of one model."""

    audit: Audit
    ranges: Ranges
    room: Room

    def blind(
        self, meshes: Meshes, parameters: Floats, which: NDArray[np.int64], tolerance: float
    ) -> NDArray[np.bool_]:
        """Of some motions, `which`, whether they were blind in a step, for a tolerance of their coordinates.

        `parameters` has shape (motions, parameters); `which`, and what is returned, shape (some of them,).
        """
        found, audit = np.ones(len(which), dtype=np.int64), self.audit
        if not audit.tape_has_choices:  # of which slopes tell nothing
            find_unsure(audit.tape_arrays, self.ranges, meshes, parameters, which, audit.limit, self.room, found)
        unsure = np.flatnonzero(found)
        if len(unsure):
            some = which[unsure]
            found[unsure] = self.step_by_step(meshes.chosen(some), parameters[some], tolerance)
        return found > 0

    def step_by_step(self, meshes: Meshes, parameters: Floats, tolerance: float) -> NDArray[np.int64]:
        """The same without the quick look at whole motions: 1 for one that was blind, shape (motions,).

        `parameters` has shape (motions, parameters).
        """
        audit, found = self.audit, np.zeros(len(parameters), dtype=np.int64)
        seeds = audit.seeds(np.hstack([meshes.rows[:, 0], parameters]))
        rules = Rules(audit.limit, audit.threshold(tolerance), 1.0)
        find_blind(audit.tape_arrays, self.ranges, meshes, parameters, seeds, rules, self.room, found)
        return found


def _columns(size: int) -> tuple[Floats, Floats, Floats]:
    """Three rows of zeros."""
    return np.zeros(size), np.zeros(size), np.zeros(size)


def _make_blind() -> Blind:
    return Blind(*_columns(MOST_STRETCHES), np.zeros(1, dtype=np.int64))


def _make_workspace(operations: int) -> AuditWorkspace:
    looked, flips = np.zeros(1, dtype=np.int64), np.zeros(operations, dtype=np.int64)
    return AuditWorkspace(*_columns(DEEPEST), looked, flips, np.zeros(operations))


@dataclass(frozen=True)
class _Joined:
    """Meshes of two ends of steps and more, one behind the other: a motion with many events has many.

    `times` have shape (states,), `states` shape (states, 2n); `firsts` and `lasts`, shape (meshes,), are the rows with
    which each begins and ends, `groups`, shape (groups,), those with which each GROUP of steps does. `parameters`, of
    each mesh, have shape (meshes, parameters).
    """

    meshes: Sequence[Mesh]
    times: Floats
    states: Floats
    parameters: Floats
    firsts: NDArray[np.int64]
    lasts: NDArray[np.int64]
    groups: NDArray[np.int64]

    @classmethod
    def of(cls, meshes: Sequence[Mesh]) -> _Joined:
        """Some meshes."""
        counts = np.array([len(each.mesh_times) for each in meshes])
        behind = np.cumsum(counts)
        firsts, lasts = behind - counts, behind - 1
        return cls(
            meshes,
            np.concatenate([each.mesh_times for each in meshes]),
            np.concatenate([each.mesh_states for each in meshes]),
            np.array([each.problem.parameters for each in meshes], dtype=np.float64),
            firsts,
            lasts,
            np.concatenate([np.arange(i, j, GROUP) for i, j in zip(firsts.tolist(), lasts.tolist(), strict=True)]),
        )

    def rows(self, places: NDArray[np.int64] | slice) -> Floats:
        """What the model's functions read in some rows, (q, q̇, t, parameters): shape (rows, inputs)."""
        parameters = np.repeat(self.parameters, self.lasts - self.firsts + 1, axis=0)
        return np.hstack([self.states[places], self.times[places, None], parameters[places]])


def _paths(joined: _Joined) -> list[Path]:
    """Meshes as paths; q̈ of their cubics jumps at the ends of steps.

    At the outer ones it is taken for as large as next to them; a single step has no neighbour, and is held against the
    motion's own q̈.
    """
    meshes, times, states, firsts, lasts = joined.meshes, joined.times, joined.states, joined.firsts, joined.lasts
    n = meshes[0].problem.degrees
    q, v = np.ascontiguousarray(states[:, :n]), np.ascontiguousarray(states[:, n : 2 * n])
    jumps = _jumps(times, q, v, 1e-13 * meshes[0].problem.t_end)
    jumps[firsts] = jumps[lasts] = 0.0
    jumps[firsts], jumps[lasts] = jumps[firsts + 1], jumps[lasts - 1]
    ends = list(zip(firsts.tolist(), lasts.tolist(), strict=True))
    for mesh, (first, last) in zip(meshes, ends, strict=True):
        if last == first + 1:
            jumps[first] = jumps[last] = _off_by(mesh)
    return [Path(times[i : j + 1], q[i : j + 1], v[i : j + 1], jumps[i : j + 1]) for i, j in ends]


def _off_by(mesh: Mesh) -> Floats:
    """How far q̈ of the cubic of a single step is from that of the motion at either end, at most: shape (n,)."""
    n, times, states = mesh.problem.degrees, mesh.mesh_times, mesh.mesh_states
    (before, behind), h = states, float(times[1] - times[0])
    if not h > 1e-13 * mesh.problem.t_end:
        return np.zeros(n)
    slope, v, w = (behind[:n] - before[:n]) / h, before[n : 2 * n], behind[n : 2 * n]
    of_cubic = np.array([6.0 * slope - 4.0 * v - 2.0 * w, 2.0 * v + 4.0 * w - 6.0 * slope]) / h
    found = np.abs(of_cubic - accelerations(mesh.problem, times, states)).max(axis=0)
    return np.where(np.isfinite(found), found, 0.0)


def _jumps(times: Floats, q: Floats, v: Floats, shortest: float) -> Floats:
    """How far q̈ of the cubics jumps from step to step, 0 beside one that is shorter: shape (states, n), like q and q̇.

    `times` has shape (states,), `q` and `v`, which is q̇, shape (states, n).
    """
    found = np.zeros_like(q)
    h = (times[1:] - times[:-1])[:, None]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        slopes = (q[1:] - q[:-1]) / h
        ends = (2.0 * v[:-1] + 4.0 * v[1:] - 6.0 * slopes) / h
        begins = (6.0 * slopes - 4.0 * v[:-1] - 2.0 * v[1:]) / h
        apart = np.abs(ends[:-1] - begins[1:])
    apart[np.minimum(h[:-1], h[1:])[:, 0] <= shortest] = 0.0
    apart[~np.isfinite(apart)] = 0.0
    found[1:-1] = apart
    return found


@cache
def largest_gap_of_watch(method: Method) -> float:
    """The largest distance, in steps, between neighbouring places in which a step is looked at for events."""
    count = NODES_OF_SERIES if isinstance(method.scheme, Series) else NODES
    return float(np.diff(places_of_watch(count)).max())


@cache
def largest_gap(method: Method) -> float:
    """The largest distance, in steps, between neighbouring times at which a method evaluates the right-hand side."""
    places = sorted(
        {float(place) % 1.0 for place in getattr(method.scheme, "c", (0,))}
        | {0.0 if method.is_explicit else float(getattr(method.scheme, "c", (0,))[0])}
    )
    return max(b - a for a, b in zip(places, [*places[1:], places[0] + 1.0], strict=True))
