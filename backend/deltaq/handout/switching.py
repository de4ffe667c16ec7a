"""A program's motion that goes on behind events: impacts, resting contacts, sticking and slipping.

What sticks or rests is a row a·q̇ + … = 0 held by a reaction λ; M q̈ = f + aᵀ λ with a·q̈ + γ = 0 for the rows held. The
program integrates from event to event and decides behind each which rows are held, as long as friction is enough and a
contact pushes.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4–8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from ..derivation.calculus import column
from ..derivation.held_reactions import gap_slope, slip_slope
from ..derivation.matrix_form import forcing
from ..derivation.released import Release
from ..derivation.system import System
from ..language.derivatives import diff
from ..mechanics.contributions import Friction
from ..mechanics.jumps import without_dry_friction
from .words import Words

SWITCHING = """\
FRICTIONS = {frictions}  # rows of `rows` that stick or slip; those behind them are contacts


def rows(t, q, v):  # a, w and gamma of what may be held: d/dt w = a v' + gamma
    {unpack_values}
    {unpack_rates}
    rates, biases = np.array({row_rates}, dtype=float), np.array({row_biases}, dtype=float)
    return np.array({row_matrix}, dtype=float).reshape(-1, len(VALUES)), rates, biases


def friction(t, q, v):  # what opposes slipping, and the most that holds what sticks
    {unpack_values}
    {unpack_rates}
    return np.array({friction}, dtype=float).reshape(-1, 2).T


def contacts(t, q, v):  # gaps, and the coefficients of restitution
    {unpack_values}
    {unpack_rates}
    return np.array({contacts}, dtype=float).reshape(-1, 2).T


SIZES = np.zeros((3, len(VALUES)))  # of each coordinate the largest place, rate and acceleration so far


def measure(t, q, v):  # accelerations by all that acts, whether or not it adds up to zero
    acting = abs(forcing(t, q, v)) + abs(friction(t, q, v)).max(axis=0) @ abs(rows(t, q, v)[0][:FRICTIONS])
    pulls = abs(np.linalg.inv(mass_matrix(t, q))) @ acting
    SIZES[:] = np.fmax(SIZES, [abs(q), abs(v), pulls])


def measure_start(t, q, v):  # what is at zero or at rest counts by what it may become
    SIZES[:] = 0.0
    measure(t, q, v)
    places, rates, pulls = SIZES
    places = np.maximum(places, rates * T_END)
    places = np.where(places > 0.0, places, pulls * T_END**2)
    SIZES[:] = places, np.maximum(rates, np.sqrt(pulls * places)), pulls


def sizes(t, q, v):  # of w, its integral, its derivative and reactions: what is tiny beside them is rounding
    a = rows(t, q, v)[0]
    places, rates, pulls = SIZES @ abs(a).T
    moved = np.sum(a.T * np.linalg.solve(mass_matrix(t, q), a.T), axis=0)  # d/dt w by a reaction of 1
    return places, rates, pulls, pulls / np.where(moved > 0.0, moved, 1.0)


def accelerations_and_reactions(t, q, v, slips, held):
    a, _, gamma = rows(t, q, v)
    slipping = np.where(held[:FRICTIONS], 0.0, slips * friction(t, q, v)[0])
    loads = forcing(t, q, v) - a[:FRICTIONS].T @ slipping
    kept, reactions = a[held], np.zeros(len(a))
    whole = np.block([[mass_matrix(t, q), -kept.T], [kept, np.zeros((len(kept), len(kept)))]])
    found = np.linalg.solve(whole, np.concatenate([loads, -gamma[held]]))
    reactions[held] = found[len(q) :]
    return found[: len(q)], reactions


def watched(t, q, v, slips, held):  # positive as long as everything goes on as it is
    reactions = accelerations_and_reactions(t, q, v, slips, held)[1]
    sticks, rests = held[:FRICTIONS], held[FRICTIONS:]
    enough = friction(t, q, v)[1] - abs(reactions[:FRICTIONS])
    slipping = np.where(sticks, enough, slips * rows(t, q, v)[1][:FRICTIONS])
    return np.concatenate([slipping, np.where(rests, reactions[FRICTIONS:], contacts(t, q, v)[0])])


def pushed(t, q, v, row, change):  # behind an impulse that changes w by so much
    a = rows(t, q, v)[0][row]
    moved = np.linalg.solve(mass_matrix(t, q), a)
    return v + moved * change / (a @ moved)


def behind_impacts(t, q, v, slips, held):  # one after the other; with several at once each may be the first
    places, rates, _, _ = sizes(t, q, v)
    closed = contacts(t, q, v)[0] <= 1e-11 * places[FRICTIONS:]
    closing = closed & (rows(t, q, v)[1][FRICTIONS:] < -1e-12 * rates[FRICTIONS:])
    ends = [in_turn(t, q, v, slips, held, FRICTIONS + first) for first in np.flatnonzero(closing)]
    if any((abs(end - ends[0]) > 1e-9 * SIZES[1]).any() for end in ends):
        raise SystemExit("Several contacts at once: how it goes on depends on which of them pushes first")
    return ends[0] if ends else v


def in_turn(t, q, v, slips, held, first):  # behind the impact of one, then of those that close, the fastest first
    free, (places, rates, _, _) = np.zeros_like(held), sizes(t, q, v)
    for _ in range(1000):
        gaps, restitutions = contacts(t, q, v)
        a, w, gamma = rows(t, q, v)
        closing = np.where(gaps <= 1e-11 * places[FRICTIONS:], w[FRICTIONS:], 0.0)
        contact = int(np.argmin(closing)) if first is None else first - FRICTIONS
        first, row = None, FRICTIONS + contact
        if closing[contact] >= -1e-12 * rates[row]:
            return v
        rebound = restitutions[contact] * closing[contact]
        pull = -(a[row] @ accelerations_and_reactions(t, q, v, slips, free)[0] + gamma[row])
        if pull > 0.0 and rebound**2 < 2e-12 * places[row] * pull:  # too low to be told from rest
            rebound = 0.0
        v = pushed(t, q, v, row, -closing[contact] - rebound)
    raise SystemExit("Several contacts at once, whose impacts do not end")


def independent(t, q, v, held):  # without rows that those before them hold already
    a, held = rows(t, q, v)[0], held.copy()
    for row in np.flatnonzero(held):
        before = a[held & (np.arange(len(held)) <= row)]
        held[row] = np.linalg.matrix_rank(before) == len(before)
    return held


def left(t, q, v, slips, held, row):  # until a row that is held lets go, or how fast another one leaves zero
    accelerations, reactions = accelerations_and_reactions(t, q, v, slips, held)
    if held[row]:
        return friction(t, q, v)[1][row] - abs(reactions[row]) if row < FRICTIONS else reactions[row]
    a, _, gamma = rows(t, q, v)
    return (slips[row] if row < FRICTIONS else 1.0) * (a[row] @ accelerations + gamma[row])


def first_wrong(t, q, v, slips, held, at_zero):  # the first row to be held or let go instead
    h, accelerations = 1e-7 * T_END, accelerations_and_reactions(t, q, v, slips, held)[0]
    _, _, pulls, forces = sizes(t, q, v)
    for row in at_zero:
        value, unclear = left(t, q, v, slips, held, row), 1e-9 * (forces if held[row] else pulls)[row]
        if abs(value) < unclear:  # a moment later it is clear
            value = left(t + h, q + h * v, v + h * accelerations, slips, held, row) + unclear
        if value < 0.0:
            return row
    return None


def settled(t, q, v, slips, held, event):  # how it goes on behind an event, None at the start
    slips, loose = slips.copy(), None
    if event is not None and held[event]:
        loose = event
        if event < FRICTIONS:
            slips[event] = -np.sign(accelerations_and_reactions(t, q, v, slips, held)[1][event])
    elif event is not None and event < FRICTIONS:
        v = pushed(t, q, v, event, -rows(t, q, v)[1][event])
    if len(held) > FRICTIONS and (event is None or event >= FRICTIONS and loose is None):
        v = behind_impacts(t, q, v, slips, held)
    w, (places, rates, _, _) = rows(t, q, v)[1], sizes(t, q, v)
    moving = abs(w[:FRICTIONS]) > 1e-13 * rates[:FRICTIONS]
    slips = np.where(moving, np.sign(w[:FRICTIONS]), slips)
    touching = contacts(t, q, v)[0] <= 1e-11 * places[FRICTIONS:]
    held = (abs(w) <= 1e-11 * rates) & np.concatenate([np.ones(FRICTIONS, dtype=bool), touching])
    at_zero = np.flatnonzero(held)
    if loose is not None:
        held[loose] = False
    for _ in range(1000):
        held = independent(t, q, v, held)
        row = first_wrong(t, q, v, slips, held, at_zero)
        if row is None:
            return v, slips, held
        if held[row] and row < FRICTIONS:
            slips[row] = -np.sign(accelerations_and_reactions(t, q, v, slips, held)[1][row])
        held[row] = not held[row]
    raise SystemExit("Nothing tells what is held and what is let go")


MODES = []  # of each sample: which way it slips, which rows are held


def solve(t_end=T_END, samples=SAMPLES):
    MODES.clear()
    times = np.linspace(0.0, t_end, samples)
    t, q, v, states = 0.0, np.array(VALUES), np.array(RATES), []
    slips, held = np.ones(FRICTIONS), np.zeros(len(rows(t, q, v)[1]), dtype=bool)
    measure_start(t, q, v)
    v, slips, held = settled(t, q, v, slips, held, None)
    for _ in range(10_000):
        places, rates, _, forces = sizes(t, q, v)
        unclear = 1e-13 * np.where(held, forces, np.where(np.arange(len(held)) < FRICTIONS, rates, places))
        room = np.maximum(unclear - watched(t, q, v, slips, held), 0.0)  # what has just happened does not happen again
        small = np.where(SIZES[:2] > 0.0, SIZES[:2], SIZES.max() or 1.0).ravel()

        def right_hand_side(t, state):
            q, v = np.split(state, 2)
            return np.concatenate([v, accelerations_and_reactions(t, q, v, slips, held)[0]])

        def falling(k):
            def value(t, state):
                return watched(t, *np.split(state, 2), slips, held)[k] + room[k]

            value.terminal, value.direction = True, -1
            return value

        found = solve_ivp(
            right_hand_side,
            (t, t_end),
            np.concatenate([q, v]),
            method="DOP853",
            t_eval=times[len(states) :],
            rtol=1e-11,
            atol=1e-12 * small,
            max_step=t_end / 500,  # what falls and rises again within a step is not seen
            events=[{ending}*map(falling, range(len(held)))],
        )
        if not found.success:
            raise SystemExit(found.message)
        shown = np.transpose(found.y)
        for t, state in zip(found.t, shown):
            q, v = np.split(state, 2)
            measure(t, q, v)
            if (friction(t, q, v) < -1e-9 * sizes(t, q, v)[3][:FRICTIONS]).any():
                raise SystemExit("A friction becomes negative: it would drive what slips")
        states.extend(shown)
        MODES.extend([(slips, held)] * len(shown))
        event = next((k for k, instants in enumerate(found.t_events) if len(instants)), None)
        if found.status == 0 or event < {endings}:
            break
        t, (q, v) = found.t_events[event][0], np.split(found.y_events[event][0], 2)
        measure(t, q, v)
        v, slips, held = settled(t, q, v, slips, held, event - {endings})
    else:
        raise SystemExit("There are 10,000 events, and more to come")
    states = np.array(states).T
    return times[: states.shape[1]], states[: len(VALUES)], states[len(VALUES) :]


"""


HELD = """\
def at_rest(t, q, v, slips, held):  # rows that are held, or stay closed or do not slip as others see to it
    places, rates, pulls, _ = sizes(t, q, v)
    closed = contacts(t, q, v)[0] <= 1e-11 * places[FRICTIONS:]
    still = np.concatenate([friction(t, q, v)[1] > 0.0, closed]) & (abs(rows(t, q, v)[1]) <= 1e-9 * rates)
    h, accelerations = 1e-7 * T_END, accelerations_and_reactions(t, q, v, slips, held)[0]
    for then in ((t, q, v), (t + h, q + h * v, v + h * accelerations)):
        a, _, gamma = rows(*then)
        still &= abs(a @ accelerations_and_reactions(*then, slips, held)[0] + gamma) <= 1e-9 * pulls
    return held | still


def indeterminate(t, q, v, slips, held, shares):  # whether forces that move nothing together change each reaction
    rests = at_rest(t, q, v, slips, held)
    a = np.linalg.solve(np.linalg.cholesky(mass_matrix(t, q)), rows(t, q, v)[0][rests].T)
    lengths = np.linalg.norm(a, axis=0)
    lengths[lengths == 0.0] = 1.0
    _, values, combinations = np.linalg.svd(a / lengths)
    without_effect = combinations[np.count_nonzero(values > 1e-9) :].T
    changes = shares[:, rests] / lengths
    changed = abs(changes @ without_effect).max(axis=1, initial=0.0)
    return changed > 1e-6 * abs(changes).max(axis=1, initial=0.0)


def reaction(t, q, v, mode):  # not a number where nothing tells how what rubs and touches shares a load
    {unpack_values}
    {unpack_rates}
    slips, held = mode
    {unpack_accelerations}, forces = accelerations_and_reactions(t, q, v, slips, held)
    slipping = np.concatenate([-slips * friction(t, q, v)[0], np.zeros(len(held) - FRICTIONS)])
    shares = np.array({shares}, dtype=float).reshape(len(HELD), -1)  # of what rubs and touches, by what is held
    found = np.array({reactions}, dtype=float) - shares @ np.where(held, forces, slipping)
    return np.where(indeterminate(t, q, v, slips, held, shares), np.nan, found)


def reactions(times, q, v):
    return np.array([reaction(*state) for state in zip(times, q.T, v.T, MODES)]).T


"""


def switches(system: System) -> bool:
    """Whether motions of the scene go on behind impacts, or stick and slip."""
    return any(event.bounces for event in system.scene.events) or bool(frictions(system))


def frictions(system: System) -> tuple[Friction, ...]:
    """Dry friction on coordinates that are free."""
    found = (part for part in system.scene.contributions if isinstance(part, Friction))
    return tuple(part for part in found if any(system.slip_rate(part).has(system.rate(q)) for q in system.free))


def smooth_forcing(system: System) -> sp.ImmutableMatrix:
    """f of M q̈ = f without dry friction."""
    smooth = without_dry_friction(system.scene)
    return forcing(system if smooth == system.scene else System(smooth))


def released(releases: Sequence[Release], system: System, words: Words) -> dict[str, str]:
    """Z of each without what rubs and touches, and the shares of that, a row for each name."""
    rubbing, bouncing = frictions(system), [event for event in system.scene.events if event.bounces]
    smooth = [
        each.as_held(each.reaction + sp.Add(*(each.wider.load_force(part.source, each.coordinate) for part in rubbing)))
        for each in releases
    ]
    shares = [
        [*(slip_slope(each, part) for part in rubbing), *(gap_slope(each, event) for event in bouncing)]
        for each in releases
    ]
    return {"shares": words.matrix(sp.ImmutableMatrix(shares)), "reactions": words.vector(column(smooth))}


def dynamics(system: System, words: Words, content: Mapping[str, str], ending: str) -> str:
    """How the program moves such a scene. `ending`: names of the events that end it, each with a comma behind."""
    rubbing, bouncing = frictions(system), [event for event in system.scene.events if event.bounces]
    gaps = [system.guided(system.expression(event.value.tree)) for event in bouncing]
    rates = [*map(system.slip_rate, rubbing), *map(system.time_derivative, gaps)]
    slopes = [[diff(rate, system.rate(q)) for q in system.free] for rate in rates]
    still = {system.acceleration(q): system.zero for q in system.free}
    biases = [system.time_derivative(rate).xreplace(still) for rate in rates]
    forces = [[system.guided(system.expression(tree)) for tree in (part.force, part.static)] for part in rubbing]
    restitutions = [system.expression(event.restitution.tree) for event in bouncing if event.restitution]
    parts = {
        "frictions": str(len(rubbing)),
        "row_matrix": words.matrix(sp.ImmutableMatrix(slopes)),
        "row_rates": words.vector(column(rates)),
        "row_biases": words.vector(column(biases)),
        "friction": words.matrix(sp.ImmutableMatrix(forces)) if forces else "[]",
        "contacts": words.matrix(sp.ImmutableMatrix([*zip(gaps, restitutions, strict=True)])) if gaps else "[]",
        "ending": ending,
        "endings": str(ending.count(",")),
    }
    return SWITCHING.format(**content, **parts)
