"""What an impact does, in closed form: with the gap g(q, t) the momenta jump along its gradient, M Δq̇ = Λ ∂g/∂q.

From ġ⁺ = −e ġ⁻ follows Λ = −(1 + e) ġ⁻/(∂g/∂q M⁻¹ ∂g/∂qᵀ). Constraints answer with impulses Λ_c of their own, such that
A Δq̇ = 0: M Δq̇ = Λ ∂g/∂q + AᵀΛ_c. With R = (A M⁻¹Aᵀ)⁻¹A M⁻¹ they are −R ∂g/∂q Λ, and P = M⁻¹ − M⁻¹AᵀR stands for M⁻¹.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4 and 8.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import combinations

import sympy as sp

from ..language.display import size
from ..language.memory import cached_method
from ..mechanics.contributions import Friction
from ..mechanics.event import Event
from .generator import Generator
from .matrix_form import forcing, mass_matrix
from .multipliers import LONGEST, MOST_COORDINATES, MOST_GIVEN, MOST_LEFT, inverse_of, simplified
from .system import System


@dataclass(frozen=True)
class Impact:
    """Λ, the jumps Δpᵢ and Δq̇ᵢ by coordinate, the kinetic energy that is lost, and the impulses of constraints."""

    impulse: sp.Expr
    momenta: dict[str, sp.Expr]
    rates: dict[str, sp.Expr]
    loss: sp.Expr
    answers: dict[str, sp.Expr] = field(default_factory=dict)


@dataclass(frozen=True)
class _Mobility:
    """What an impulse along a row w does: Δq̇ = P wᵀ Λ, which constraints answer with the impulses −R wᵀ Λ."""

    jumps: sp.ImmutableMatrix
    answers: sp.ImmutableMatrix


@dataclass(frozen=True)
class Held:
    """The force that holds, and what it leads to: the rates and accelerations of what sticks."""

    force: sp.Expr
    motion: dict[sp.Symbol, sp.Expr]


def bouncing(system: System) -> tuple[Event, ...]:
    """The events at which bodies meet and part again; not those whose gap no free coordinate changes."""
    return tuple(event for event in system.scene.events if event.bounces and slopes(system, event))


def frictions(system: System) -> tuple[Friction, ...]:
    """The loads that may hold what they act on."""
    return tuple(part for part in system.scene.contributions if isinstance(part, Friction))


@cached_method
def gap(system: System, event: Event) -> sp.Expr:
    """g(q, t) with the guides put in."""
    return system.display(system.guided(system.expression(event.value.tree)))


@cached_method
def gap_rate(system: System, event: Event) -> sp.Expr:
    """ġ"""
    return system.shown_rate(gap(system, event))


def slopes(system: System, event: Event) -> dict[str, sp.Expr]:
    """∂g/∂qᵢ of the coordinates that change the gap."""
    found = {q: system.derivative(gap(system, event), system.q(q)) for q in system.free}
    return {q: slope for q, slope in found.items() if slope != 0}


def contacts_along(system: System, shifts: Mapping[str, sp.Expr]) -> tuple[str, ...]:
    """The contacts whose impulses along ∂g/∂q change Σ ξᵢ ∂L/∂q̇ᵢ, ξ being `shifts`: the gap changes along ξ."""

    def is_met(event: Event) -> bool:
        along = slopes(system, event)
        return not system.is_zero(sp.Add(*(shift * along.get(q, system.zero) for q, shift in shifts.items())))

    return tuple(event.name for event in bouncing(system) if is_met(event))


def contacts_with_losses(system: System) -> tuple[str, ...]:
    """The contacts that change the energy: e is not 1, or they move by themselves."""

    def changes(event: Event) -> bool:
        return not (system.is_zero(1 - restitution(system, event)) and system.is_zero(moving_term(system, event)))

    return tuple(event.name for event in bouncing(system) if changes(event))


def contacts_of(system: System, generator: Generator) -> tuple[str, ...]:
    """The contacts between whose impacts the quantity of a generator is conserved."""
    along = contacts_along(system, generator.shifts)
    losing = () if generator.time == 0 else contacts_with_losses(system)
    return tuple(event.name for event in bouncing(system) if event.name in (*along, *losing))


def moving_term(system: System, event: Event) -> sp.Expr:
    """∂g/∂t: how fast the contact itself moves."""
    return system.derivative(gap(system, event), system.t)


@cached_method
def restitution(system: System, event: Event) -> sp.Expr:
    """e"""
    return system.zero if event.restitution is None else system.guided(system.expression(event.restitution.tree))


@cached_method
def impact(system: System, event: Event) -> Impact | None:
    """None where the contact has no direction that the constraints leave it, or the jumps would be too long to read."""
    along, mobility = slopes(system, event), _mobility(system)
    if mobility is None or not along:
        return None
    row = _row(system, event)
    share = _share(system, event, mobility)
    if share == 0:
        return None
    rate, e = gap_rate(system, event), restitution(system, event)
    impulse = simplified(system, -(1 + e) * rate / share)
    answers = [simplified(system, -part * impulse) for part in mobility.answers * row]
    momenta = _momentum_jumps(system, along, impulse, answers)
    moved = (simplified(system, part * impulse) for part in mobility.jumps * row)
    rates = {q: jump for q, jump in zip(system.free, moved, strict=True) if jump != 0}
    fed = [answer * system.moving_term(each) for answer, each in zip(answers, system.conditions, strict=True)]
    loss = simplified(system, -impulse * ((1 - e) * rate / 2 - moving_term(system, event)) + sp.Add(*fed))
    if sum(map(size, (*momenta.values(), *rates.values(), loss))) > LONGEST:
        return None
    named = {each.source: answer for each, answer in zip(system.conditions, answers, strict=True)}
    return Impact(impulse, momenta, rates, loss, named)


def _row(system: System, event: Event) -> sp.ImmutableMatrix:
    """∂g/∂q as a column."""
    along = slopes(system, event)
    return sp.ImmutableMatrix([along.get(q, system.zero) for q in system.free])


def _share(system: System, event: Event, mobility: _Mobility) -> sp.Expr:
    """How far the gap opens for each unit of impulse."""
    row = _row(system, event)
    return system.display((row.T * mobility.jumps * row)[0])


def effective_mass(system: System, event: Event) -> sp.Expr:
    """What an impulse at the contact sets in motion: 1/(∂g/∂q M⁻¹ ∂g/∂qᵀ) of a contact that has an impact."""
    mobility = _mobility(system)
    if mobility is None:
        raise ValueError(f"the impact at {event.name} is too long")
    return 1 / _share(system, event, mobility)


def free_mass(system: System, event: Event) -> sp.Expr:
    """The same as if no constraint answered: 1/(∂g/∂q M⁻¹ ∂g/∂qᵀ) with the whole M⁻¹. Raises ValueError for none."""
    inverse, row = inverse_of(system, mass_matrix(system)), _row(system, event)
    if inverse is None:
        raise ValueError("the mass matrix has no inverse")
    return 1 / system.display((row.T * inverse * row)[0])


def answers(system: System, event: Event) -> dict[str, sp.Expr]:
    """Λ_c of each constraint for each unit of Λ, −R ∂g/∂q; none of a contact without an impact."""
    mobility = _mobility(system)
    found = () if mobility is None else -mobility.answers * _row(system, event)
    return {each.source: share for each, share in zip(system.conditions, found, strict=False)}


@cached_method
def _mobility(system: System) -> _Mobility | None:
    """P and R; M⁻¹ and nothing without constraints. None where they are too long, or constraints are dependent."""
    mass, rows = mass_matrix(system), system.constraint_matrix()
    if system.scene.is_redundant or len(system.free) > MOST_COORDINATES or sum(map(size, (*mass, *rows))) > MOST_GIVEN:
        return None
    inverse = inverse_of(system, mass)
    if inverse is None or not system.conditions:
        return None if inverse is None else _Mobility(inverse, sp.ImmutableMatrix(sp.zeros(0, len(system.free))))
    turned = system.display(sp.ImmutableMatrix(rows * inverse))
    held = inverse_of(system, system.display(sp.ImmutableMatrix(turned * rows.T)))
    if held is None or sum(map(size, held)) > MOST_LEFT:
        return None
    answers = system.display(sp.ImmutableMatrix(held * turned))
    return _Mobility(system.display(sp.ImmutableMatrix(inverse - turned.T * answers)), answers)


def _momentum_jumps(
    system: System, along: dict[str, sp.Expr], impulse: sp.Expr, answers: list[sp.Expr]
) -> dict[str, sp.Expr]:
    """Λ ∂g/∂qᵢ + Σ Λ_c aᵢ of the coordinates that the contact or a constraint acts on."""
    shares = {q: [impulse * along.get(q, system.zero)] for q in system.free}
    for answer, condition in zip(answers, system.conditions, strict=True):
        for q in system.bound(condition):
            shares[q].append(answer * system.coefficient(condition, q))
    found = {q: simplified(system, sp.Add(*parts)) for q, parts in shares.items()}
    return {q: jump for q, jump in found.items() if q in along or jump != 0}


@cached_method
def kept_rates(system: System) -> dict[sp.Symbol, sp.Expr]:
    """As many rates by the others as there are constraints: what A q̇ + b = 0 leaves of them."""
    rows, drift = system.constraint_matrix(), [system.moving_term(each) for each in system.conditions]
    for chosen in combinations(reversed(range(len(system.free))), rows.rows):
        square = rows.extract(list(range(rows.rows)), list(chosen))
        determinant = system.display(square.det(method="berkowitz"))
        if determinant == 0 or system.is_zero(determinant):
            continue
        others = [k for k in range(len(system.free)) if k not in chosen]
        rates = sp.Matrix([system.rate(system.free[k]) for k in others])
        right = rows.extract(list(range(rows.rows)), others) * rates + sp.Matrix(drift)
        found = -(square.adjugate() * right) / determinant
        names = (system.rate(system.free[k]) for k in chosen)
        return {rate: system.display(value) for rate, value in zip(names, found, strict=True)}
    return {}


def after(system: System, found: Impact) -> dict[sp.Symbol, sp.Expr]:
    """q̇⁺ = q̇ + Δq̇ for the rates that jump."""
    return {system.rate(q): system.rate(q) + jump for q, jump in found.rates.items()}


@cached_method
def holding_force(system: System, load: Friction) -> Held | None:
    """What holds a coordinate c that sticks: from c̈ = u̇ and M q̈ = f + R ∂c/∂q. None where that is not to be read."""
    c = system.slipping(load)
    others = [f - system.load_force(load.source, q) for f, q in zip(forcing(system), system.free, strict=True)]
    return _held(system, c, system.slip_rate(load), others)


@cached_method
def contact_force(system: System, event: Event) -> Held | None:
    """λ of a contact that stays closed: from g̈ = 0 and M q̈ = f + λ ∂g/∂q. None where that is not to be read."""
    return _held(system, gap(system, event), gap_rate(system, event), list(forcing(system)))


def _held(system: System, place: sp.Expr, rate: sp.Expr, others: list[sp.Expr]) -> Held | None:
    """The force along ∂g/∂q of a place g that keeps its rate, which is zero, beside others."""
    row = sp.ImmutableMatrix([system.derivative(place, system.q(q)) for q in system.free])
    mass = mass_matrix(system)
    if system.conditions or row.is_zero_matrix or sum(map(size, mass)) > MOST_GIVEN:
        return None
    inverse = inverse_of(system, mass) if len(system.free) <= MOST_COORDINATES else None
    if inverse is None:
        return None
    loads, still = sp.ImmutableMatrix(others), {system.acceleration(q): system.zero for q in system.free}
    load_on = (row.T * inverse * loads)[0] + system.shown_rate(rate).xreplace(still)
    known = _kept_rate(system, place, rate)
    force = system.display((-load_on / (row.T * inverse * row)[0]).xreplace(known))
    accelerations = inverse * (loads + row * force)
    moved = {system.acceleration(q): a.xreplace(known) for q, a in zip(system.free, accelerations, strict=True)}
    return None if size(force) > LONGEST else Held(force, known | moved)


def _kept_rate(system: System, place: sp.Expr, rate: sp.Expr) -> dict[sp.Symbol, sp.Expr]:
    """q̇ that a rate Σ aᵢ q̇ᵢ + b of zero leaves, where a place changes with one coordinate alone."""
    along = {q: system.derivative(place, system.q(q)) for q in system.free if place.has(system.q(q))}
    alone = system.display(rate.xreplace(system.zero_rates))
    return {system.rate(q): system.display(-alone / slope) for q, slope in along.items() if len(along) == 1}


@dataclass(frozen=True)
class Contact:
    """A contact in the result: its gap and coefficient of restitution, and what an impact does where that is short."""

    name: str
    gap: sp.Expr
    restitution: sp.Expr
    impact: Impact | None


@dataclass(frozen=True)
class Sticking:
    """What holds at a friction load, and how much may."""

    load: str
    holding: sp.Expr
    largest: sp.Expr


def contacts(system: System) -> tuple[Contact, ...]:
    """All contacts, in the scene's order."""
    return tuple(
        Contact(event.name, gap(system, event), restitution(system, event), impact(system, event))
        for event in bouncing(system)
    )


def sticking(system: System) -> tuple[Sticking, ...]:
    """All friction loads whose holding force is short enough to be read."""
    held = ((load, holding_force(system, load)) for load in frictions(system))
    return tuple(
        Sticking(load.source, found.force, system.display(largest_force(system, load, found)))
        for load, found in held
        if found is not None
    )


def largest_force(system: System, load: Friction, found: Held) -> sp.Expr:
    """F₀ at the rates of what sticks."""
    rates = {rate: value for rate, value in found.motion.items() if rate in set(map(system.rate, system.free))}
    return system.guided(system.expression(load.static)).xreplace(rates)
