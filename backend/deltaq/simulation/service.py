"""Answers to `POST /simulations`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from importlib import import_module
from time import perf_counter
from typing import NoReturn

import numpy as np

from .. import errors
from ..mechanics.event import Event
from ..mechanics.library import load_scene
from ..mechanics.requests import inside
from ..mechanics.scene import Scene
from ..model.model import Observation, compile_model
from ..model.modes import modes_of_model
from ..model.reactions import reactions
from . import ensemble
from .answer import Acting, Document, answer
from .auto import choose
from .choice import Choice, check
from .consistency import consistent
from .contact import contacts_along
from .derivatives import power
from .driver import is_suitable, simulate
from .event import event_values
from .friction import FrictionForce, friction_along
from .impact import NoDirectionError, UndeterminedError, UnsettledError
from .indeterminate import indeterminate_forces
from .kernels.compiler import MACHINE, MachineCodeNeededError, interpreted, soonest
from .library import ENSEMBLES, get_method, method_ids
from .mode_state import TOUCHING
from .observation import observed
from .outcome import Outcome
from .problem import Floats, Problem, Released
from .reactions import releasing
from .request import Request, read_request
from .rounding import short
from .run import Steps
from .run import run as one_run
from .trajectory import Trajectory
from .transitions import NUDGE, begun

ANGLES = frozenset({"rad", "1", "°", "deg"})
# Seconds for what is interpreted: where one waits, where others wait, too, and where that is quicker than compiling.
SOON, AT_ONCE, MEANWHILE = 3.0, 0.9, 25.0
LARGEST = float(np.finfo(np.float64).max) / 16  # of a number in an answer: differences of energies are numbers, too


def run(document: Mapping[str, object]) -> Document:
    """Simulates what the request names: at once, as `run_at_once`, if that is short, else when all is compiled."""
    return soonest(partial(_run, document), SOON)


def run_at_once(document: Mapping[str, object]) -> Document | None:
    """The same by kernels that are interpreted where they are not compiled; None if that takes too long."""
    return _interpreted(document, AT_ONCE)


def run_meanwhile(document: Mapping[str, object]) -> Document | None:
    """The same by the kernels that are compiled, what runs them being loaded first; the others are interpreted longer.

    None if even that takes longer than their compilation.
    """
    import_module(MACHINE)
    return _interpreted(document, MEANWHILE)


def _interpreted(document: Mapping[str, object], seconds: float) -> Document | None:
    with suppress(MachineCodeNeededError):
        return interpreted(partial(_run, document), seconds)
    return None


def _run(document: Mapping[str, object]) -> Document:
    """Simulates what the request names. Raises InputError for what cannot be read.

    `document`: {scene: id or document, guides?, freeze?, parameters?, initial?, t_end, samples?, method?,
    tolerance? or step?, include?, lang?}.
    """
    request, start = read_request(document), perf_counter()
    check(request.method)
    with inside("/scene"):
        compile_model(request.scene)
    compile_time = perf_counter() - start
    with inside("/scene"):
        problem = problem_of(request.scene, request.t_end, request.samples)
        require_no_event(request.scene, problem)
    if request.release:
        problem = releasing(problem, Released(request.release, reactions(request.scene, request.release)))
    choice = choose(request.method, request.scene, problem, request.step, request.tolerance)
    return _simulated(request, choice, problem, compile_time)


def _simulated(request: Request, choice: Choice, problem: Problem, compile_time: float) -> Document:
    with inside("/scene"):  # where its constraints cannot be kept
        trajectory = simulate(
            problem,
            choice.method,
            step=request.step,
            tolerance=request.tolerance,
            with_error="error" in request.include,
        )
    states = np.hstack([trajectory.values, trajectory.rates])
    modes = modes_of_model(problem.model)
    with inside("/scene"):  # where something that is drawn has no value at all
        seen = observed(problem, modes, trajectory.times, states, trajectory.stretches)
    watts = power(problem, trajectory.times, states, trajectory.stretches)
    frictions = friction_along(modes, trajectory.times, states, trajectory.stretches) if modes else {}
    contacts = contacts_along(modes, trajectory.times, states, trajectory.stretches) if modes else {}
    good = _finite(trajectory, seen, watts, frictions, contacts)
    if good < len(trajectory.times):
        trajectory, seen = _cut(trajectory, good), _cut_observation(seen, good)
        frictions = {name: each.first(good) for name, each in frictions.items()}
        contacts = {name: each[:good] for name, each in contacts.items()}
    indeterminate = indeterminate_forces(problem, trajectory.stretches)
    acting = Acting(watts[: len(trajectory.times)], frictions, contacts, indeterminate)
    return answer(request, choice, problem, trajectory, seen, acting, compile_time)


def require_no_event(scene: Scene, problem: Problem) -> None:
    """Raises SceneError if an event has happened before the motion begins."""
    (values,) = event_values(problem, np.zeros(1), problem.state[None, :])
    problems = [
        errors.Problem("event-at-start", f"/events/{i}/value", parameters=_at_start(event, value))
        for i, (event, value) in enumerate(zip(scene.events, values, strict=True))
        if not (value > 0.0 or (event.bounces and value >= -_touching(problem, i)))
    ]
    if problems:
        raise errors.SceneError(*problems)
    _require_beginning(scene, problem)


def _touching(problem: Problem, index: int) -> float:
    """How much a gap may be below zero of a contact that is closed: what rounding of the coordinates does to it."""
    size = max(map(abs, (1.0, *problem.values)))
    steps = np.hstack([np.eye(problem.degrees), np.zeros((problem.degrees, problem.state.size - problem.degrees))])
    states = problem.state + NUDGE * size * np.vstack([np.zeros(problem.state.size), steps])
    first, *others = event_values(problem, np.zeros(len(states)), states)[:, index]
    slope = max(abs(float(other - first)) for other in others) / (NUDGE * size)
    return TOUCHING * size * (slope or 1.0)


def _require_beginning(scene: Scene, problem: Problem) -> None:
    """Raises SceneError where contacts that touch at the start do not say how the motion begins."""
    modes = modes_of_model(problem.model)
    if modes is None or not modes.contacts:
        return
    try:
        begun(replace(problem, model=modes.model), modes)
    except NoDirectionError as found:
        _refuse_contact(scene, "contact-without-direction", modes.contacts[found.contact])
    except UnsettledError:
        _refuse_contact(scene, "contacts-at-start", modes.contacts[0])
    except UndeterminedError:
        _refuse_contact(scene, "contacts-in-any-order", modes.contacts[0])
    except np.linalg.LinAlgError:  # without an inverse of M there is no motion either, and the run tells it
        return


def _refuse_contact(scene: Scene, code: str, index: int) -> NoReturn:
    event = scene.events[index]
    told = {"name": event.name, "value": event.value.text[:80]}
    raise errors.SceneError(errors.Problem(code, f"/events/{index}/value", parameters=told))


def _at_start(event: Event, value: float) -> dict[str, str | int | float]:
    return {"name": event.name, "value": event.value.text[:80], "found": short(float(value))}


def problem_of(scene: Scene, t_end: float, samples: int = 501) -> Problem:
    """The initial value problem that a scene's own values pose.

    Raises SceneError where they cannot be made to keep the scene's constraints.
    """
    problem = Problem(
        compile_model(scene),
        tuple(parameter.value for parameter in scene.parameters),
        tuple(coordinate.value for coordinate in scene.free),
        tuple(coordinate.rate for coordinate in scene.free),
        float(t_end),
        samples,
        tuple(coordinate.unit in ANGLES for coordinate in scene.free),
    )
    return consistent(problem) if problem.is_constrained else problem


def warm(*chosen: str) -> None:
    """Compiles some groups of kernels, or loads them from the cache on disk; all if none is named.

    That is a first run with each method, without and with constraints, and one of an ensemble. The stepping loops come
    first: with them most motions can be had already, what else they need being interpreted (`run_at_once`).
    """
    methods = [method for method in map(get_method, method_ids()) if not chosen or method.family in chosen]
    times, flag = np.array([0.0, 0.1]), np.zeros(1, dtype=np.int64)
    for method in methods:
        one_run(problem_of(load_scene("elastic-pendulum"), 0.1, 2), method, times, flag, Steps(0.05))
    if methods:  # a motion that goes on behind events, which are found by a kernel of their own
        simulate(problem_of(load_scene("bouncing-ball"), 1.0, 2), methods[0], step=0.05)
    for scene in ("pendulum", "cartesian-pendulum") if methods else ():
        problem = problem_of(load_scene(scene), 0.1, 2)
        for method in methods:
            if is_suitable(problem, method):
                simulate(problem, method, step=0.05)
    if not chosen or ENSEMBLES in chosen:
        ensemble.warm(problem_of(load_scene("pendulum"), 0.1, 2))


def _finite(
    trajectory: Trajectory,
    seen: Observation,
    watts: Floats,
    frictions: Mapping[str, FrictionForce],
    contacts: Mapping[str, Floats],
) -> int:
    """The number of first samples at which everything told is finite (a position or a force may have a pole where the
    motion has none), and sums of it are, too.
    """
    arrays = [trajectory.values, trajectory.rates, trajectory.work, watts, seen.kinetic, seen.potential]
    arrays += [trajectory.reactions.multipliers] if trajectory.reactions else []
    told = [*seen.values.values(), *seen.rates.values(), *seen.positions.values(), *seen.arrows.values()]
    told += [column for each in frictions.values() for column in (each.force, each.largest)]
    told += contacts.values()
    return int((np.abs(np.column_stack([*arrays, *told])) <= LARGEST).all(axis=1).cumprod().sum())


def _cut(trajectory: Trajectory, good: int) -> Trajectory:
    """The first `good` samples; a run that went no further has ended for a reason of its own."""
    found, ended = trajectory.estimate, trajectory.outcome
    last = float(trajectory.times[max(good - 1, 0)])
    if ended.status == "ok" or last < trajectory.reached:
        ended = Outcome("singular", "not_finite", {**ended.parameters, "t": last})
    return replace(
        trajectory,
        outcome=ended,
        times=trajectory.times[:good],
        values=trajectory.values[:good],
        rates=trajectory.rates[:good],
        work=trajectory.work[:good],
        estimate=replace(found, errors=found.errors[:good], multipliers=_first(found.multipliers, good))
        if found
        else None,
        reactions=trajectory.reactions and trajectory.reactions.first(good),
        reached=last,
    )


def _first(values: Floats | None, count: int) -> Floats | None:
    return None if values is None else values[:count]


def _cut_observation(seen: Observation, good: int) -> Observation:
    def cut(arrays: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values[:good] for name, values in arrays.items()}

    return Observation(
        seen.kinetic[:good],
        seen.potential[:good],
        cut(seen.values),
        cut(seen.rates),
        cut(seen.positions),
        cut(seen.arrows),
    )
