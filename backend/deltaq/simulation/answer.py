"""A trajectory as plain data for JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mechanics.reaction_units import contact_unit, reaction_unit
from ..mechanics.release import held
from ..mechanics.scene import Scene
from ..mechanics.units import UNITS, dimension_of
from ..mechanics.user_text import plainly
from ..model.model import Observation
from .choice import Choice
from .columns import WRITERS, Writer, as_numbers
from .constraints import Reactions
from .estimate import Estimate
from .friction import FrictionForce
from .impulses import impulses_along
from .indeterminate import IndeterminateForces
from .outcome import Outcome
from .problem import Floats, Moved, Problem
from .request import Request
from .rounding import rounded_alone, short, significant
from .trajectory import MOST_TOLD, Trajectory
from .transitions import Transition

Document = dict[str, object]
NOTICED = 1e-9  # a change of an initial value, relative to it or to 1, that is worth telling
UNKNOWN_ERROR = 1e-12  # to round by where no error estimate was asked for


@dataclass(frozen=True)
class Acting:
    """What acts along a motion: the power `watts`, shape (samples,), frictions and contacts, what is indeterminate.

    `frictions` are by load; `contacts` by event, shape (samples,) each.
    """

    watts: Floats
    frictions: Mapping[str, FrictionForce]
    contacts: Mapping[str, Floats]
    indeterminate: IndeterminateForces


def answer(
    request: Request,
    choice: Choice,
    problem: Problem,
    trajectory: Trajectory,
    seen: Observation,
    acting: Acting,
    compile_time: float,
) -> Document:
    """The answer to a request as plain data. All numbers are finite, and rounded to what their error supports.

    Forces are left out where they are not determined.
    """
    errors = trajectory.estimate.errors if trajectory.estimate else np.full(len(trajectory.times), UNKNOWN_ERROR)
    column = WRITERS[request.columns]
    parts: Document = _curves(request, problem, trajectory, seen, errors, column)
    if not request.include.isdisjoint({"energy", "power"}):
        parts["energy"] = _energy(request, trajectory, seen, acting.watts, errors)
    if "error" in request.include and trajectory.estimate:  # asked for, it is there
        parts["error"] = _error(request, problem, trajectory, trajectory.estimate, acting.indeterminate)
    parts |= _constrained(request, problem, trajectory)
    if "loads" in request.include:
        parts |= _switching(request.scene, acting, trajectory.times, column)
    if "multipliers" in request.include and trajectory.reactions:
        parts["multipliers"] = _multipliers(problem, trajectory, trajectory.reactions, acting.indeterminate, column)
        parts["reactions"] = _reactions(request.scene, problem)
    return {
        "status": trajectory.outcome.status,
        "reason": _told(trajectory.outcome),
        "remedy": _told(trajectory.outcome),
        "event": _event(request, trajectory),
        "events": _transitions(request, problem, trajectory.transitions[:MOST_TOLD]),
        "indeterminate": _indeterminate_spans(acting.indeterminate, trajectory),
        "method": choice.method.id,
        "choice": {"code": choice.reason, "parameters": {}} if choice.reason else None,
        "columns": request.columns,
        "t": column.write(trajectory.times),
        **parts,
        "t_reached": trajectory.reached,
        "trusted_until": trajectory.trusted_until,
        "condition": None if trajectory.outcome.status == "singular_mass_matrix" else 1.0 / trajectory.conditioning,
        "cost": _cost(trajectory, compile_time),
    }


def _curves(
    request: Request,
    problem: Problem,
    trajectory: Trajectory,
    seen: Observation,
    errors: Floats,
    column: Writer,
) -> Document:
    """What was asked for of coordinates, rates, positions and loads, all rounded together."""
    free = problem.model.layout.free
    order = [coordinate.name for coordinate in request.scene.coordinates]
    values = dict(zip(free, trajectory.values.T, strict=True)) | dict(seen.values)
    rates = dict(zip(free, trajectory.rates.T, strict=True)) | dict(seen.rates)
    curves: dict[str, Mapping[str, Floats]] = {
        "coordinates": {name: values[name] for name in order},
        "rates": {name: rates[name] for name in order},
        "positions": seen.positions,
        "loads": seen.arrows,
    }
    wanted = {part: curves[part] for part in curves if part in request.include}
    arrays = [each for part in wanted.values() for each in part.values()]
    shorter = iter(_together(arrays, errors, column))
    return {part: {name: column.write(next(shorter)) for name in wanted[part]} for part in wanted}


def _together(arrays: list[Floats], errors: Floats, column: Writer) -> list[Floats]:
    """Each array rounded to the errors of its samples."""
    if not arrays:
        return []
    table = column.shorten(np.column_stack(arrays), errors)
    ends = np.cumsum([math.prod(each.shape[1:]) for each in arrays])
    pieces = np.split(table, ends[:-1], axis=1)
    return [piece.reshape(each.shape) for piece, each in zip(pieces, arrays, strict=True)]


def _told(outcome: Outcome) -> Document:
    return {"code": outcome.code, "parameters": dict(outcome.parameters)}


def _event(request: Request, trajectory: Trajectory) -> Document | None:
    """The event that ended the motion; its time is rounded to what its error supports."""
    found = trajectory.event
    if found is None:
        return None
    event = request.scene.events[found.index]
    ((time, error),) = _times([found.time], [found.error])
    return {"name": event.name, "title": plainly(event.title), "t": time, "error": error}


def _transitions(request: Request, problem: Problem, found: tuple[Transition, ...]) -> list[Document]:
    """The events behind which the motion went on; their times are rounded to what their errors support."""
    times = _times([each.time for each in found], [each.error for each in found])
    is_asked = not request.include.isdisjoint({"loads", "multipliers"})
    impulses = impulses_along(problem, found) if is_asked else ({},) * len(found)
    return [
        {
            "name": each.name,
            "time": time,
            "kind": each.kind,
            "loss": short(each.loss, 6),
            "error": error,
            "together": list(each.together),
            "impulses": {name: short(impulse, 6) for name, impulse in of_impact.items()},
        }
        for each, (time, error), of_impact in zip(found, times, impulses, strict=True)
    ]


def _times(times: list[float], errors: list[float | None]) -> list[tuple[float, float | None]]:
    """Times, each rounded to what its error supports, and the errors."""
    told = rounded_alone(np.array(times), np.array([error or UNKNOWN_ERROR for error in errors]))
    shorter = (None if error is None else short(error) for error in errors)
    return list(zip(told.tolist(), shorter, strict=True))


def _energy(request: Request, trajectory: Trajectory, seen: Observation, watts: Floats, errors: Floats) -> Document:
    """Energies and the balance E + V − ∫P dt, constant when all is right; P and the work by itself if asked for."""
    column = WRITERS[request.columns]
    balance = seen.kinetic + seen.potential - trajectory.work
    scale = float(np.max(np.abs(seen.kinetic) + np.abs(seen.potential), initial=1e-300))
    # Second order in the error where the energy is flat, hence more digits than the error itself supports.
    doubt = np.maximum(1e-3 * errors, 1e-14) * scale
    energies = {"kinetic": seen.kinetic, "potential": seen.potential, "balance": balance}
    if "power" in request.include:
        energies["power"] = watts
        energies["work"] = trajectory.work
    shorter = _together(list(energies.values()), doubt, column)
    return {
        **{name: column.write(energy) for name, energy in zip(energies, shorter, strict=True)},
        # A guide has a power by its formula even where the motion takes nothing from it, as a floor that turns.
        "works": bool((np.abs(trajectory.work) > doubt).any()),
        "drift": short(float(np.max(np.abs(balance - balance[:1]), initial=0.0))),  # no sample where it cannot start
    }


def _constrained(request: Request, problem: Problem, trajectory: Trajectory) -> Document:
    """Of constraints the largest |g|, the multipliers that are not unique, and how the initial values were moved."""
    reactions, moved = trajectory.reactions, problem.moved
    if reactions is None or moved is None:
        return {}
    return {
        "drift": short(float(np.max(reactions.gaps, initial=0.0))),
        "undetermined": list(moved.undetermined),
        "moved": _moved(request, moved),
    }


def _multipliers(
    problem: Problem, trajectory: Trajectory, reactions: Reactions, indeterminate: IndeterminateForces, column: Writer
) -> Document:
    """The multipliers as far as they are unique, and what holds what was released."""
    known = trajectory.estimate.multipliers if trajectory.estimate else None
    doubts = np.full_like(reactions.multipliers, UNKNOWN_ERROR) if known is None else known
    shorter = {name: column.shorten(reactions.multipliers[:, k], doubts[:, k]) for k, name in _unique(problem)}
    return {
        name: column.write(_without(values, indeterminate.where(name, trajectory.times)))
        for name, values in shorter.items()
    }


def _without(values: Floats, is_open: NDArray[np.bool_]) -> Floats:
    """Values without those that are not determined; both have shape (samples,)."""
    return np.where(is_open, np.nan, values)


def _reactions(scene: Scene, problem: Problem) -> Document:
    """The unit of each reaction that has one value, and whether a single rod or string exerts it."""
    single = {each.name for each in held(scene) if each.kind in ("length", "rod")}
    lengths = {each.name for each in scene.parameters if each.name in single and dimension_of(each.unit) == UNITS["m"]}
    rods = {
        symbol.name
        for symbol, each in zip(scene.multipliers, scene.constraints, strict=True)
        if each.kind == "distance"
    }
    return {
        name: {"unit": reaction_unit(scene, name), "of_rod": name in rods | lengths} for _, name in _unique(problem)
    }


def _switching(scene: Scene, acting: Acting, times: Floats, column: Writer) -> Document:
    """R and F₀ of each load with friction, the force of each contact and its unit; nothing where there are none."""

    def partial(name: str, force: Floats) -> object:
        return column.write(_without(_shorter(force, column), acting.indeterminate.where(name, times)))

    events = {event.name: event for event in scene.events}
    frictions = {
        name: {"force": partial(name, each.force), "largest": column.write(_shorter(each.largest, column))}
        for name, each in acting.frictions.items()
    }
    contacts = {
        name: {"force": partial(name, force), "unit": contact_unit(scene, events[name])}
        for name, force in acting.contacts.items()
    }
    return {key: found for key, found in (("friction", frictions), ("contacts", contacts)) if found}


def _shorter(values: Floats, column: Writer) -> Floats:
    """A column without an error of its own, of shape (samples,)."""
    doubt = UNKNOWN_ERROR * max(1.0, np.abs(values).max(initial=0.0))
    return column.shorten(values, np.full(len(values), doubt))


def _indeterminate_spans(indeterminate: IndeterminateForces, trajectory: Trajectory) -> list[Document]:
    """When which forces are not determined; the times of events are rounded as there."""
    end = float(trajectory.times[-1]) if len(trajectory.times) else 0.0
    found = indeterminate.spans(end)[:MOST_TOLD]
    errors = {each.time: each.error for each in trajectory.transitions}
    starts = _times([each.start for each in found], [errors.get(each.start) for each in found])
    ends = _times([each.end for each in found], [errors.get(each.end) for each in found])
    return [
        {"names": list(each.names), "start": start, "end": stop}
        for each, (start, _), (stop, _) in zip(found, starts, ends, strict=True)
    ]


def _unique(problem: Problem) -> list[tuple[int, str]]:
    """The reactions that have one value, by number: multipliers as the scene orders them, then what is released."""
    places, unknown = problem.model.layout.constraints, problem.moved.undetermined if problem.moved else ()
    ordered = [*sorted(range(len(places)), key=places.__getitem__), *range(len(places), len(problem.reactions))]
    return [(k, problem.reactions[k]) for k in ordered if problem.reactions[k] not in unknown]


def _moved(request: Request, moved: Moved) -> Document | None:
    """By coordinate, what was added to the initial value and rate wanted; None if nothing that counts was."""
    added = zip(request.scene.free, moved.values, moved.rates, strict=True)
    changed: Document = {
        coordinate.name: {"value": short(value, 6), "rate": short(rate, 6)}
        for coordinate, value, rate in added
        if abs(value) > NOTICED * max(1.0, abs(coordinate.value))
        or abs(rate) > NOTICED * max(1.0, abs(coordinate.rate))
    }
    return changed or None


def _error(
    request: Request, problem: Problem, trajectory: Trajectory, found: Estimate, indeterminate: IndeterminateForces
) -> Document:
    told = {}
    if found.multipliers is not None:
        rounded = {name: significant(found.multipliers[:, k], 3) for k, name in _unique(problem)}
        each = {
            name: as_numbers(_without(errors, indeterminate.where(name, trajectory.times)))
            for name, errors in rounded.items()
        }
        told = {"multipliers": each}
    return {
        **told,
        "estimate": significant(found.errors, 3).tolist(),
        "horizon": found.horizon,
        "worst": short(found.worst),
        "tolerance": request.tolerance,
        "reached": trajectory.tolerance_reached,
    }


def _cost(trajectory: Trajectory, compile_time: float) -> Document:
    cost = trajectory.cost
    return {
        "steps": cost.steps,
        "rejected": cost.rejected,
        "rhs_evaluations": cost.rhs_evaluations,
        "wall_time": cost.wall_time,
        "compile_time": compile_time,
        "runs": cost.runs,
        "run_time": cost.run_time,
        "run_evaluations": cost.run_evaluations,
    }
