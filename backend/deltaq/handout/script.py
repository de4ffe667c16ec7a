"""A motion as a program of its own: Python with NumPy and SciPy, from the derived equations M(q, t) q̈ = f(q, q̇, t).

With constraints the program solves [M Aᵀ; A 0] [q̈; −λ] = [f; −γ] for the accelerations (index 1), and moves positions
and rates back to the constraints at every sample, so that they do not drift away. Where motions go on behind impacts,
or stick and slip, it integrates from event to event (`switching.py`).
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping, Sequence

from ..derivation.calculus import column
from ..derivation.held_reactions import rivals
from ..derivation.matrix_form import mass_matrix
from ..derivation.released import Release
from ..derivation.system import System
from ..errors import Problem, RequestError
from ..mechanics.event import Event
from ..mechanics.jumps import jumps
from ..mechanics.scene import Scene
from ..mechanics.user_text import UserText
from ..narration.derive import releases_of
from .switching import HELD, SWITCHING, dynamics, released, smooth_forcing, switches
from .words import Words, event_symbol

TEMPLATE = """\
# {title}
# The motion of this scene, from the equations of motion {form} that δq derived.
# Needs NumPy and SciPy; draws the motion if Matplotlib is there. Units are those beside the values.

import numpy as np
from numpy import {functions}
from scipy.integrate import solve_ivp

{parameters}

COORDINATES = {coordinates}
VALUES = {values}  # at t = 0
RATES = {rates}
T_END = {t_end}
SAMPLES = {samples}


def mass_matrix(t, q):
    {unpack_values}
    return np.array({mass_matrix}, dtype=float)


def forcing(t, q, v):
    {unpack_values}
    {unpack_rates}
    return np.array({forcing}, dtype=float)


def positions(t, q):
    {unpack_values}
    return {positions}


{events}{dynamics}def draw(times, q):
    try:
        from matplotlib import pyplot
    except ImportError:
        return
    for name, curve in zip(COORDINATES, q):
        pyplot.plot(times, curve, label=name)
    pyplot.xlabel("t in s")
    pyplot.legend()
    pyplot.show()


if __name__ == "__main__":
    times, q, v = solve()
    print("t," + ",".join({columns}))
    for t, *row in zip(times, *q{further}):
        print(",".join(f"{{value:.10g}}" for value in (t, *row)))
    draw(times, q)
"""
FREE = """\
def right_hand_side(t, state):
    q, v = np.split(state, 2)
    return np.concatenate([v, np.linalg.solve(mass_matrix(t, q), forcing(t, q, v))])


def solve(t_end=T_END, samples=SAMPLES):
    times = np.linspace(0.0, t_end, samples)
    start = np.array([*VALUES, *RATES])
    found = solve_ivp(
        right_hand_side, (0.0, t_end), start, method="DOP853", t_eval=times, rtol=1e-11, atol=1e-12{watched}
    )
    if not found.success:
        raise SystemExit(found.message)
    return found.t, found.y[: len(VALUES)], found.y[len(VALUES) :]


"""
CONSTRAINED = """\
MULTIPLIERS = {multipliers}


def conditions(t, q):  # what is zero because positions are constrained
    {unpack_values}
    return np.array({conditions}, dtype=float)


def constraint_matrix(t, q):  # A in A v + b = 0, a row for each constraint
    {unpack_values}
    return np.array({constraint_matrix}, dtype=float).reshape(len(MULTIPLIERS), len(VALUES))


def constraint_offset(t, q):  # b
    {unpack_values}
    return np.array({constraint_offset}, dtype=float)


def constraint_drift(t, q, v):  # gamma in A v' + gamma = 0
    {unpack_values}
    {unpack_rates}
    return np.array({constraint_drift}, dtype=float)


HOLONOMIC = {holonomic}  # rows of A that belong to conditions


{least}def accelerations_and_multipliers(t, q, v):
    mass, rows = mass_matrix(t, q), constraint_matrix(t, q)
    whole = np.block([[mass, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
    found = {solve}(whole, np.concatenate([forcing(t, q, v), -constraint_drift(t, q, v)]))
    return found[: len(q)], -found[len(q) :]


def right_hand_side(t, state):
    q, v = np.split(state, 2)
    return np.concatenate([v, accelerations_and_multipliers(t, q, v)[0]])


def correction(mass, rows, gap):  # the least change in the metric of M that closes the gap
    moved = np.linalg.solve(mass, rows.T)
    return moved @ {solve}(rows @ moved, gap)


def projected(t, state):  # the nearest state that keeps the constraints
    start, v = np.split(state, 2)
    q, mass = start, mass_matrix(t, start)
    for count in range(60 if HOLONOMIC else 0):
        rows = constraint_matrix(t, q)[HOLONOMIC]
        near = start if count < 30 else q  # farther off any that keeps them will do
        moved = near - correction(mass, rows, conditions(t, q) - rows @ (q - near))
        q, change = moved, np.abs(moved - q) / np.maximum(1.0, np.abs(q))
        if change.max() < 1e-15:
            break
    rows = constraint_matrix(t, q)
    v = v - correction(mass_matrix(t, q), rows, rows @ v + constraint_offset(t, q))
    return np.concatenate([q, v])


def solve(t_end=T_END, samples=SAMPLES):
    times = np.linspace(0.0, t_end, samples)
    states = [projected(0.0, np.array([*VALUES, *RATES]))]
    for begin, end in zip(times[:-1], times[1:]):
        found = solve_ivp(
            right_hand_side, (begin, end), states[-1], method="DOP853", rtol=1e-11, atol=1e-12{watched}
        )
        if not found.success:
            raise SystemExit(found.message)
        if found.status == 1:
            break
        states.append(projected(end, found.y[:, -1]))
    times, states = times[: len(states)], np.array(states).T
    return times, states[: len(VALUES)], states[len(VALUES) :]


def multipliers(times, q, v):
    return np.array([accelerations_and_multipliers(*state)[1] for state in zip(times, q.T, v.T)]).T


"""
LEAST = """\
def least(matrix, right):  # constraints depend on one another: of many multipliers the least; the motion is the same
    return np.linalg.lstsq(matrix, right, rcond=1e-9)[0]


"""
EVENT = """\
def {name}(t, state):  # {title}
    q, v = np.split(state, 2)
    {unpack_values}
    {unpack_rates}
    return {value}


{name}.terminal, {name}.direction = True, -1  # the motion is right as long as this is positive


"""
RELEASED = """\
HELD = {held}  # what is held, and by what reaction, in the direction in which it grows{shared}


"""
REACTIONS = """\
def reactions(times, q, v):
    return np.array([reaction(*state) for state in zip(times, q.T, v.T)]).T


def reaction(t, q, v):
    {unpack_values}
    {unpack_rates}
    {unpack_accelerations}
    return {reactions}


"""
TEMPLATES = (TEMPLATE, FREE, CONSTRAINED, LEAST, RELEASED, REACTIONS, SWITCHING, HELD)
SAMPLES_PER_SECOND = 30


def script(scene: Scene, language: str, t_end: float, release: Sequence[str] = ()) -> str:
    """The program: it prints the motion from the scene's own initial values as a table, with what holds the `release`.

    Raises UnknownNameError for what cannot be released, RequestError for constraints where motions jump or stick.
    """
    system = System(scene)
    releases = releases_of(system, release)
    words = Words(system, TEMPLATES)
    free = scene.free
    unpacked = {
        "unpack_values": f"[{', '.join(words.called(system.q(c.name).name) for c in free)}] = q",
        "unpack_rates": f"[{', '.join(words.called(system.rate(c.name).name) for c in free)}] = v",
    }
    ending = [event for event in scene.events if not event.bounces]
    called = [words.called(event_symbol(event.name)) for event in ending]
    content = unpacked | {
        "title": comment((scene.title.get(language) or UserText(scene.id)).line),
        "parameters": "\n".join(_parameters(scene, words)) or "# This scene has no parameters.",
        "coordinates": repr([c.name for c in free]),
        "values": repr([float(c.value) for c in free]),
        "rates": repr([float(c.rate) for c in free]),
        "t_end": repr(float(t_end)),
        "samples": str(max(int(t_end * SAMPLES_PER_SECOND), 1) + 1),
        "events": "".join(_event(event, system, words, language, unpacked) for event in ending),
        "watched": f", events=[{', '.join(called)}]" if ending else "",
        "mass_matrix": words.matrix(mass_matrix(system)),
        "forcing": words.vector(smooth_forcing(system)),
        "positions": "{" + ", ".join(_positions(system, words)) + "}",
    }
    if scene.constraints:
        impacts = Problem("program-impacts-with-constraints", "/scene")
        _refuse(scene, impacts, Problem("program-friction-with-constraints", "/scene"))
        content |= _constrained(system, words, content)
    else:
        ends = "".join(f"{name}, " for name in called)
        content |= _free(dynamics(system, words, content, ends) if switches(system) else FREE.format(**content))
    if releases:
        content |= _released(releases, system, words, content)
    return TEMPLATE.format(functions=", ".join(words.functions), **content)


def _refuse(scene: Scene, impacts: Problem, friction: Problem) -> None:
    """Raises RequestError where motions jump or stick, with what makes them do so."""
    refused = tuple(jumps(scene, impacts, friction))
    if refused:
        raise RequestError(*refused)


def _released(releases: Sequence[Release], system: System, words: Words, content: Mapping[str, str]) -> dict[str, str]:
    """The dynamics with the reactions of what is released, as further columns."""
    accelerations = f"[{', '.join(words.called(system.acceleration(q).name) for q in system.free)}]"
    shared = dict.fromkeys(name for each in releases for name in rivals(each))
    told = f"; with it what friction holds: {', '.join(shared)}" if shared else ""
    parts = {"held": repr([each.name for each in releases]), "shared": comment(told)}
    if switches(system):
        parts |= {**released(releases, system, words), "unpack_accelerations": accelerations}
        functions = HELD.format(**content, **parts)
    else:
        found = f"{accelerations} = np.linalg.solve(mass_matrix(t, q), forcing(t, q, v))"
        if system.conditions:
            held = ", ".join(words.called(symbol.name) for symbol in system.multipliers)
            found = f"{accelerations}, [{held}] = accelerations_and_multipliers(t, q, v)"
        in_motion = words.vector(column(each.in_motion for each in releases))
        functions = REACTIONS.format(**content, unpack_accelerations=found, reactions=in_motion)
    columns = "COORDINATES, *MULTIPLIERS" if system.conditions else "COORDINATES"
    return {
        "dynamics": content["dynamics"] + RELEASED.format(**parts) + functions,
        "columns": f"[*{columns}, *(f'Z_{{name}}' for name in HELD)]",
        "further": f"{content['further']}, *reactions(times, q, v)",
    }


def _free(moved: str) -> dict[str, str]:
    """A scene without constraints, and how it moves."""
    return {"form": "M(q, t) q'' = f(q, q', t)", "dynamics": moved, "columns": "COORDINATES", "further": ""}


def _constrained(system: System, words: Words, content: Mapping[str, str]) -> dict[str, str]:
    """How one with constraints moves, and what keeps them."""
    bound = system.conditions
    kept = [each for each in bound if each.is_holonomic]
    parts = {
        "multipliers": repr([symbol.name for symbol in system.scene.multipliers]),
        "conditions": words.vector(column(map(system.condition, kept))) if kept else "[]",
        "constraint_matrix": words.matrix(system.constraint_matrix()),
        "constraint_offset": words.vector(column(map(system.moving_term, bound))),
        "constraint_drift": words.vector(column(map(system.drift_term, bound))),
        "solve": "least" if system.scene.is_redundant else "np.linalg.solve",
        "least": LEAST if system.scene.is_redundant else "",
        "holonomic": repr([index for index, each in enumerate(bound) if each.is_holonomic]),
    }
    dynamics = CONSTRAINED.format(**content, **parts)
    form = "M q'' = f + A^T lambda with A q'' = -gamma"
    return {
        "form": form,
        "dynamics": dynamics,
        "columns": "[*COORDINATES, *MULTIPLIERS]",
        "further": ", *multipliers(times, q, v)",
    }


def _event(event: Event, system: System, words: Words, language: str, unpacked: Mapping[str, str]) -> str:
    """A function that is positive until the event happens, and ends the integration there."""
    value = words.text(system.guided(system.expression(event.value.tree)))
    title = comment(event.called(language).line)
    return EVENT.format(name=words.called(event_symbol(event.name)), title=title, value=value, **unpacked)


def comment(text: str) -> str:
    """Text that stays within one comment whatever it holds."""
    return "".join(sign if unicodedata.category(sign)[0] not in "CZ" else " " for sign in text).strip()


def _parameters(scene: Scene, words: Words) -> Iterator[str]:
    for parameter in scene.parameters:
        yield f"{words.called(parameter.name)} = {float(parameter.value)!r}" + (
            f"  # {comment(parameter.unit)}" if parameter.unit else ""
        )


def _positions(system: System, words: Words) -> Iterator[str]:
    """Positions that hang on nothing but coordinates and time; a continuum has one for each of its points."""
    for body in system.scene.bodies:
        position = system.position(body.name)
        if words.knows(position):
            yield f"{body.name!r}: np.array({words.vector(position)}, dtype=float)"
