"""What a bifurcation diagram is asked, made ready: the drive's period, what is seen and where, scales of the motion.

All that can be told to be wrong is told here, before anything long runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..contract.experiments.bifurcation import BifurcationRequest
from ..contract.experiments.stability_map import FEWEST_VALUES
from ..errors import InputError, RequestError, SceneError
from ..errors import Problem as Mistake
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.parser import parse
from ..language.tree import Node
from ..mechanics.changes import change
from ..mechanics.requests import inside, require_bounds
from ..model.modes import Modes, modes_of
from ..model.observables import Observables
from ..simulation.derivatives import accelerations
from ..simulation.plane import SIGNS, parsed
from ..simulation.problem import Floats, Problem
from ..simulation.service import require_no_event
from .closing import Closing
from .flow import NUDGE, Flow
from .hybrid_flow import Allowance, HybridFlow
from .hysteresis import Settled, Sweep
from .passages import PER_STEP, View
from .period import clocks, common_period
from .sliding import require_no_sliding
from .subject import Subject, bounded, free_subject_of, hybrid_subject_of, parameter_of

MOST_STEPS = 200_000  # of one motion
PART = 0.25  # of a period: no step is longer
MOST_EVENTS = 60_000  # of both sweeps together: a minute or two
TRIED = 20  # periods of the scene's own motion that tell the scales
PROBED = 0.25  # of the longest time: what a motion without a drive is followed for, to find its passages
FEWEST = 4  # passages that tell how long one takes
STILL, KEPT = 1e-9, 1e-9  # of the scales: a motion that rests; of its energy: one that loses nothing
TURNS = 1e-9  # by how much accelerations may change in a turn, over their size
SHORTENINGS = 6  # by a factor of 16 each, of the longest step without a drive
MOST_LOOKED_AT = 60  # states
LEAST = 1e-3  # of a scale, beside the size of what it measures


@dataclass(frozen=True)
class Prepared:
    """A question with all that it takes to answer it; `values` of the parameter, shape (values,), grow."""

    request: BifurcationRequest
    subject: Subject
    values: Floats
    plane: str
    sweep: Sweep

    def events(self, one: Settled) -> int:
        """Behind how many events a motion that repeats goes on until it does."""
        return 0 if one.start is None else self.sweep.view.flow.events(one.value, one.start, one.span)


def prepared(request: BifurcationRequest) -> Prepared:
    """What a request means. Raises InputError that says what to ask instead."""
    hybrid = hybrid_subject_of(request)
    subject = hybrid or free_subject_of(request)
    place = parameter_of(subject, request.sweep.parameter, "/sweep/parameter")
    _require_values(subject, request)
    problem = bounded(subject, MOST_STEPS)
    if hybrid is None:
        require_no_sliding(problem)
    else:
        with inside("/scene"):
            require_no_event(subject.scene, problem)
    values = np.linspace(request.sweep.start, request.sweep.to, request.sweep.count)
    name = request.sweep.parameter
    observables = Observables(subject.scene, (name,))
    drive = _drive(request, subject, values) if observables.depends_on_time else None
    own = problem.state[: 2 * problem.degrees].copy()
    unit = float(min(map(drive, values))) if drive else request.t_end / TRIED
    rough = _flow(problem, place, PART * unit, modes_of(subject.scene) if hybrid else None)
    rough = rough if drive else _begun(rough, values, own)
    path = _path(rough, values, own, unit)
    scales = np.append(_scales(problem, path), float(np.ptp(values)))
    plane = _plane(request, subject, is_driven=drive is not None)
    axis = parsed(request.vertical.strip() or subject.scene.free[0].name, subject.scene, "/vertical")
    view = View(replace(rough, nudges=NUDGE * scales), observables, axis, plane, SIGNS[request.direction])
    _require_function(view)
    if not observables.depends_at_impacts(name):
        _require_influence(rough, values, _around(path, scales[:-1]), drive)
    spacing: Callable[[float], float] = drive or _spacing(view, values, own, request.t_end)
    if drive is None:
        own = _started(view, values, own, request.t_end)
        view = replace(view, flow=replace(view.flow, largest=PART * spacing(float(values[0]))))
    _require_time(request, [spacing(value) for value in (float(values[0]), float(values[-1]))])
    _require_few_events(request, view.flow, values, own, spacing)
    surface = view.surface if plane is not None and drive is None else None
    whole = scales if drive else np.concatenate([scales[:-1], [spacing(float(values[0]))], scales[-1:]])
    closing = Closing(view.flow, drive, surface, 1, whole, _turns(problem, _around(path, scales[:-1])))
    sweep = Sweep(view, closing, spacing, own, request.skip, request.crossings, request.folds)
    return Prepared(request, subject, values, plane.text if plane else "", sweep)


def _flow(problem: Problem, place: int, largest: float, modes: Modes | None) -> Flow:
    width, cancelled = 2 * problem.degrees, np.zeros(1, dtype=np.int64)
    nudges = np.full(width + 1, NUDGE)
    if modes is None:
        return Flow(problem, place, largest, cancelled, nudges)
    return HybridFlow(problem, place, largest, cancelled, nudges, modes, Allowance())


def _require_values(subject: Subject, request: BifurcationRequest) -> None:
    """Raises InputError where the parameter cannot have one of the outermost values."""
    for end, value in (("from", request.sweep.start), ("to", request.sweep.to)):
        try:
            require_bounds(change(subject.scene, parameters={request.sweep.parameter: value}))
        except InputError as error:
            raise type(error)(*(replace(one, pointer=f"/sweep/{end}") for one in error.problems)) from None


def _drive(request: BifurcationRequest, subject: Subject, values: Floats) -> Callable[[float], float]:
    """The period of what drives the scene, over the parameter. Raises InputError where it has none."""
    name, given = request.sweep.parameter, request.period.strip()
    known = subject.scene.parameter_values
    if given:
        with inside("/period"):
            tree = parse(given, subject.scene.names).tree

        def asked(value: float) -> float:
            try:
                return evaluate(tree, known | {name: value})
            except KeyError:
                return math.nan
    else:
        arguments = _clocks(subject)

        def asked(value: float) -> float:
            return common_period(arguments, known | {name: value})

    found = [_period_at(asked, request, float(value)) for value in values]
    if not all(math.isfinite(one) and one > 0.0 for one in found):
        raise RequestError(Mistake("bifurcation-period", "/period", parameters={"expression": given[:80]}))
    return asked


def _period_at(asked: Callable[[float], float], request: BifurcationRequest, value: float) -> float:
    """The period at a value of the parameter. Raises RequestError where there is none."""
    try:
        return asked(value)
    except SceneError as error:
        if error.problems[0].code != "no-period":
            raise RequestError(Mistake("bifurcation-no-period", "/period")) from None
    sweep = request.sweep
    told: dict[str, str | float | int] = {"name": sweep.parameter, "value": float(f"{value:.6g}")}
    place = {sweep.start: "/sweep/from", sweep.to: "/sweep/to"}.get(value, "/sweep")
    raise RequestError(Mistake("bifurcation-drive-at-rest", place, parameters=told))


def _clocks(subject: Subject) -> tuple[Node, ...]:
    try:
        return tuple(dict.fromkeys(clocks(subject.scene)))
    except SceneError:
        raise RequestError(Mistake("bifurcation-no-period", "/period")) from None


def _plane(request: BifurcationRequest, subject: Subject, *, is_driven: bool) -> Expression | None:
    """Where it is looked at; None for once in each period."""
    given = request.plane.strip()
    if not given and is_driven:
        return None
    return parsed(given or f"dot({subject.scene.free[0].name})", subject.scene, "/plane")


def _begun(flow: Flow, values: Floats, own: Floats) -> Flow:
    """The flow with steps that are short enough to begin with: the series of longer ones exceed all numbers."""
    middle = values[len(values) // 2 : len(values) // 2 + 1]
    for _ in range(SHORTENINGS):
        if flow.traced(middle, own[None, :], np.array([0.0, flow.largest])).is_fine:
            break
        flow = replace(flow, largest=flow.largest / 16.0)
    return flow


def _path(flow: Flow, values: Floats, own: Floats, unit: float) -> Floats:
    """The scene's own motion at the first, the middle and the last value, as rows (q, q̇, t), as far as it goes."""
    times = np.linspace(0.0, TRIED * unit, 40 * TRIED + 1)
    rows = []
    for value in (values[0], values[len(values) // 2], values[-1]):
        found = flow.traced(np.array([value]), own[None, :], times).states[0]
        rows.append(np.column_stack([found, times])[np.isfinite(found).all(axis=1)])
    path = np.concatenate(rows)
    if not len(path):
        raise RequestError(Mistake("no-motion"))
    return path


def _scales(problem: Problem, path: Floats) -> Floats:
    """What the components of (q, q̇) are measured by: half of what the motion covers, of an angle π at most."""
    n, seen = problem.degrees, path[:, :-1]
    # a motion that leaves says nothing of those that stay: what the middle of its samples covers counts
    low, high = np.quantile(seen, [0.02, 0.98], axis=0)
    half, middle = 0.5 * (high - low), 0.5 * np.abs(high + low)
    half = np.where(half > LEAST * np.maximum(1.0, middle), half, 1.0)
    angular = np.append(np.array(problem.angular, dtype=bool), np.zeros(n, dtype=bool))
    return np.asarray(np.where(angular, np.minimum(half, math.pi), half))


def _around(path: Floats, scales: Floats) -> Floats:
    """Some rows (q, q̇, t) of a path, and as many beside it by parts of the scales: at rest forces may all be zero."""
    some = path[:: max(1, len(path) // MOST_LOOKED_AT)]
    number = np.arange(len(some))[:, None] + np.arange(len(scales))
    beside = some.copy()
    beside[:, :-1] += scales * np.cos(number)
    return np.vstack([some, beside])


def _turns(problem: Problem, path: Floats) -> NDArray[np.bool_]:
    """Of each coordinate, whether it is an angle after whose turn the scene is the same, shape (n,)."""
    n, here = problem.degrees, accelerations(problem, path[:, -1], path)
    found = np.zeros(n, dtype=bool)
    for place in np.flatnonzero(problem.angular):
        turned = path.copy()
        turned[:, place] += math.tau
        apart = np.abs(accelerations(problem, path[:, -1], turned) - here).max()
        found[place] = apart <= TURNS * max(1.0, float(np.abs(here).max()))
    return found


def _require_function(view: View) -> None:
    """Raises RequestError for a plane that is none."""
    function = view.plane_function
    if function is not None and function.is_constant:
        text = view.plane.text[:80] if view.plane else ""
        raise RequestError(Mistake("section-plane-constant", "/plane", parameters={"plane": text}))


def _require_influence(flow: Flow, values: Floats, path: Floats, drive: Callable[[float], float] | None) -> None:
    """Raises RequestError where the parameter changes nothing."""
    ends = [float(values[0]), float(values[len(values) // 2]), float(values[-1])]
    found = [accelerations(flow.at(value), path[:, -1], path) for value in ends]
    size = TURNS * np.maximum(1.0, np.abs(found[0]).max(axis=1, keepdims=True))
    is_moved = any(bool((np.abs(each - found[0]) > size).any()) for each in found[1:])
    if not is_moved and (drive is None or len({drive(value) for value in ends}) == 1):
        name = flow.problem.model.layout.parameters[flow.place]
        raise RequestError(Mistake("bifurcation-no-influence", "/sweep/parameter", parameters={"name": name}))


def _probe(view: View, values: Floats, own: Floats, longest: float) -> tuple[Floats, Floats]:
    """Passages of the scene's own motion without a drive, rows (q, q̇, t), and where it ends, at the middle value."""
    value, span = float(values[len(values) // 2]), PROBED * longest
    first = view.flow.traced(np.array([value]), own[None, :], np.array([0.0, span]))
    if not first.is_fine:
        return np.zeros((0, len(own) + 1)), own
    passed = view.passed(value, own, span, 1, PER_STEP * float(first.steps[0]) / span)
    return passed.rows, passed.end


def _spacing(view: View, values: Floats, own: Floats, longest: float) -> Callable[[float], float]:
    """How long it is from passage to passage, at any value.

    Raises RequestError where there are hardly any, and where nothing is lost or gained, so that nothing attracts.
    """
    rows, end = _probe(view, values, own, longest)
    middle = float(values[len(values) // 2])
    both = np.column_stack([np.vstack([own, end]), np.zeros(2)])
    energies = view.energies(middle, both)
    moved = float(np.abs(end - own).max())
    rests = bool(len(rows)) and float(np.abs(np.ptp(rows[len(rows) // 2 :, :-1], axis=0)).max()) < STILL * moved
    rests = rests and float(np.abs(end - rows[-1, :-1]).max()) < STILL * moved
    if len(rows) >= FEWEST and abs(energies[1] - energies[0]) <= KEPT * max(1.0, float(np.abs(energies).max())):
        raise RequestError(Mistake("bifurcation-conservative", "/scene"))
    if len(rows) < FEWEST or moved == 0.0 or rests:
        text = view.plane.text[:80] if view.plane else ""
        told: dict[str, str | float] = {"plane": text, "t": float(f"{PROBED * longest:.3g}")}
        raise RequestError(Mistake("bifurcation-no-passages", "/plane", parameters=told))
    spacing = float(np.median(np.diff(rows[len(rows) // 2 :, -1])))
    return lambda _value: spacing


def _started(view: View, values: Floats, own: Floats, longest: float) -> Floats:
    """Where the scene's own motion has come to: closer to what it settles to than its start."""
    return _probe(view, values, own, longest)[1]


def _require_time(request: BifurcationRequest, units: list[float]) -> None:
    """Raises RequestError where what is asked for takes longer than the longest time."""
    periods = request.skip + request.crossings
    seconds = periods * max(units)
    if seconds > request.t_end:
        told = {"periods": periods, "seconds": float(f"{seconds:.3g}"), "t_end": request.t_end}
        raise RequestError(Mistake("bifurcation-too-long", "/t_end", parameters=told))


def _require_few_events(
    request: BifurcationRequest, flow: Flow, values: Floats, own: Floats, spacing: Callable[[float], float]
) -> None:
    """Raises RequestError where the sweeps would go on behind too many events, told by the scene's own motion."""
    some = [float(values[0]), float(values[len(values) // 2]), float(values[-1])]
    each = max(flow.events(value, own, TRIED * spacing(value)) for value in some) / TRIED
    one = each * 2 * (request.skip + request.crossings)
    if one * len(values) <= MOST_EVENTS:
        return
    told: dict[str, str | float | int] = {
        "each": float(f"{each:.2g}"),
        "events": float(f"{one * len(values):.2g}"),
        "most": MOST_EVENTS,
    }
    count, periods = int(MOST_EVENTS / one), int(MOST_EVENTS / (2 * FEWEST_VALUES * each))
    if count < FEWEST_VALUES:
        mistake = Mistake("bifurcation-many-events-each", "/skip", parameters=told | {"periods": periods})
    else:
        mistake = Mistake("bifurcation-many-events", "/sweep/count", parameters=told | {"count": count})
    raise RequestError(mistake)
