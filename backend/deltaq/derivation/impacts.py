"""What an impact does, in closed form: with the gap g(q, t) the momenta jump along its gradient, M Δq̇ = Λ ∂g/∂q.

From ġ⁺ = −e ġ⁻ follows Λ = −(1 + e) ġ⁻/(∂g/∂q M⁻¹ ∂g/∂qᵀ).
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4 and 8.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..language.display import size
from ..language.memory import cached_method
from ..mechanics.contributions import Friction
from ..mechanics.event import Event
from .matrix_form import forcing, mass_matrix
from .multipliers import LONGEST, MOST_COORDINATES, MOST_GIVEN, inverse_of
from .system import System


@dataclass(frozen=True)
class Impact:
    """Λ, the jumps Δpᵢ and Δq̇ᵢ by coordinate, and the kinetic energy that is lost."""

    impulse: sp.Expr
    momenta: dict[str, sp.Expr]
    rates: dict[str, sp.Expr]
    loss: sp.Expr


@dataclass(frozen=True)
class Held:
    """The force that holds, and what it leads to: the rates and accelerations of what sticks."""

    force: sp.Expr
    motion: dict[sp.Symbol, sp.Expr]


def bouncing(system: System) -> tuple[Event, ...]:
    """The events at which bodies meet and part again."""
    return tuple(event for event in system.scene.events if event.bounces)


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


def moving_term(system: System, event: Event) -> sp.Expr:
    """∂g/∂t: how fast the contact itself moves."""
    return system.derivative(gap(system, event), system.t)


@cached_method
def restitution(system: System, event: Event) -> sp.Expr:
    """e"""
    return system.zero if event.restitution is None else system.guided(system.expression(event.restitution.tree))


@cached_method
def impact(system: System, event: Event) -> Impact | None:
    """None where constraints would share the impulse, or the jumps would be too long to be read."""
    mass, along = mass_matrix(system), slopes(system, event)
    if system.conditions or len(system.free) > MOST_COORDINATES or not along:
        return None
    if sum(map(size, mass)) > MOST_GIVEN or (inverse := inverse_of(system, mass)) is None:
        return None
    row = sp.ImmutableMatrix([along.get(q, system.zero) for q in system.free])
    share = system.display((row.T * inverse * row)[0])
    rate, e = gap_rate(system, event), restitution(system, event)
    impulse = system.display(-(1 + e) * rate / share)
    momenta = {q: system.display(impulse * slope) for q, slope in along.items()}
    moved = (system.display(part * impulse) for part in inverse * row)
    rates = {q: jump for q, jump in zip(system.free, moved, strict=True) if jump != 0}
    loss = system.display(-impulse * ((1 - e) * rate / 2 - moving_term(system, event)))
    if sum(map(size, (*momenta.values(), *rates.values(), loss))) > LONGEST:
        return None
    return Impact(impulse, momenta, rates, loss)


def after(system: System, found: Impact) -> dict[sp.Symbol, sp.Expr]:
    """q̇⁺ = q̇ + Δq̇ for the rates that jump."""
    return {system.rate(q): system.rate(q) + jump for q, jump in found.rates.items()}


@cached_method
def holding_force(system: System, load: Friction) -> Held | None:
    """What holds a coordinate c that sticks: from c̈ = u̇ and M q̈ = f + R ∂c/∂q. None where that is not to be read."""
    c = system.slipping(load)
    row = sp.ImmutableMatrix([system.derivative(c, system.q(q)) for q in system.free])
    mass = mass_matrix(system)
    if system.conditions or row.is_zero_matrix or sum(map(size, mass)) > MOST_GIVEN:
        return None
    inverse = inverse_of(system, mass) if len(system.free) <= MOST_COORDINATES else None
    if inverse is None:
        return None
    at_rest = _sticking(system, load)
    others = sp.ImmutableMatrix(
        [f - system.load_force(load.source, q) for f, q in zip(forcing(system), system.free, strict=True)]
    )
    still = {system.acceleration(q): system.zero for q in system.free}
    bias = system.shown_rate(system.slip_rate(load)).xreplace(still)
    load_on = (row.T * inverse * others)[0] + bias
    force = system.display((-load_on / (row.T * inverse * row)[0]).xreplace(at_rest))
    accelerations = inverse * (others + row * force)
    moved = {system.acceleration(q): a.xreplace(at_rest) for q, a in zip(system.free, accelerations, strict=True)}
    return None if size(force) > LONGEST else Held(force, at_rest | moved)


def _sticking(system: System, load: Friction) -> dict[sp.Symbol, sp.Expr]:
    """The rate of a coordinate that sticks is that of its surface."""
    c = system.slipping(load)
    own = next((q for q in system.free if system.q(q) == c), None)
    return {} if own is None else {system.rate(own): system.guided(system.expression(load.surface_rate))}


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
