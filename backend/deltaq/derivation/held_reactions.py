"""Reactions beside others: what holds a released length l while something sticks or a contact rests, and at impacts.

Friction that sticks and a contact that rests are reactions of their own, R along ∂c/∂q and λ along ∂g/∂q. With l let go
they act along it as well: Z = Mₗ q̈ + bₗ − Qₗ − R ∂c/∂l − λ ∂g/∂l, with the accelerations that they leave. An impact's
impulse leaves Ẑ = Mₗ Δq̇ − Λ ∂g/∂l − Σ Λ_c aₗ.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4, 5 and 8.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import sympy as sp

from ..language.derivatives import diff
from ..language.display import size
from ..mechanics.contributions import Friction
from ..mechanics.event import Event
from ..mechanics.jumps import frictions_of
from .accelerations import LONGEST
from .formula import Named, Quantity
from .impacts import Held, Impact, bouncing, contact_force, frictions, gap, holding_force, impact
from .multipliers import simplified
from .released import Release

STICKS, RESTS = "friction", "contact"


@dataclass(frozen=True)
class HeldReaction:
    """Z while friction at a load sticks, or a contact rests (`kind`, and `name` of load or event).

    `others` is Z without that force, `force` what it is, `slope` ∂c/∂l or ∂g/∂l; `value` all of it put in. None of the
    three where they would be too long to be read.
    """

    kind: str
    name: str
    slope: sp.Expr
    others: sp.Expr
    force: Named | None = None
    motion: Mapping[sp.Symbol, sp.Expr] | None = None
    value: sp.Expr | None = None


@dataclass(frozen=True)
class ReactionImpulse:
    """Ẑ at an impact: Σ Mₗⱼ Δq̇ⱼ, less what the impulse and those of constraints do along l."""

    event: Event
    impact: Impact
    inertia: Mapping[str, sp.Expr]
    slope: sp.Expr
    shares: Mapping[str, sp.Expr]
    value: sp.Expr


def held_reactions(release: Release) -> Iterator[HeldReaction]:
    """Z beside each friction load and each contact that changes it, in the scene's order."""
    system = release.system
    for load in frictions_of(system.scene):
        slope = slip_slope(release, load)
        if slope != 0 or _has_accelerations(release):
            yield _beside_friction(release, load, slope)
    for event in bouncing(system):
        slope = gap_slope(release, event)
        if slope != 0 or _has_accelerations(release):
            yield _beside_contact(release, event, slope)


def rivals(release: Release) -> tuple[str, ...]:
    """Loads with friction on what a guide keeps at rest: nothing tells how much each of them and the guide take."""
    system, free = release.system, frictions_of(release.system.scene)
    return tuple(
        load.source
        for load in frictions(system)
        if load not in free and system.slip_rate(load) == 0 and slip_slope(release, load) != 0
    )


def reaction_impulses(release: Release) -> Iterator[ReactionImpulse]:
    """Ẑ of each impact that needs one and is short enough to be read, in the scene's order."""
    for event in bouncing(release.system):
        found = impact(release.system, event)
        impulse = None if found is None else _impulse(release, event, found)
        if impulse is not None and impulse.value != 0:
            yield impulse


def _beside_friction(release: Release, load: Friction, slope: sp.Expr) -> HeldReaction:
    others = release.as_held(release.reaction + release.wider.load_force(load.source, release.coordinate))
    found = HeldReaction(STICKS, load.source, slope, others)
    held = holding_force(release.system, load)
    return found if held is None else _put_in(release, found, held, Quantity("holding-force", load.source))


def _beside_contact(release: Release, event: Event, slope: sp.Expr) -> HeldReaction:
    found = HeldReaction(RESTS, event.name, slope, release.in_motion)
    held, several = contact_force(release.system, event), len(bouncing(release.system)) > 1
    quantity = Quantity("contact-reaction", event.name if several else "")
    return found if held is None else _put_in(release, found, held, quantity)


def _put_in(release: Release, found: HeldReaction, held: Held, quantity: Quantity) -> HeldReaction:
    """With the force and the accelerations that it leaves, where that can be read."""
    value = simplified(release.system, (found.others - held.force * found.slope).xreplace(held.motion))
    if size(value) > LONGEST:
        return found
    return replace(found, force=Named(quantity, held.force), motion=held.motion, value=value)


def _impulse(release: Release, event: Event, found: Impact) -> ReactionImpulse | None:
    system, wider = release.system, release.wider
    inertia = {q: release.as_held(diff(release.reaction, wider.acceleration(q))) for q in found.rates}
    slope = gap_slope(release, event)
    shares = {
        each.source: release.as_held(wider.coefficient(each, release.coordinate))
        for each in wider.conditions
        if each.source in found.answers
    }
    jumped = sp.Add(*(part * found.rates[q] for q, part in inertia.items()))
    answered = sp.Add(*(part * found.answers[name] for name, part in shares.items()))
    value = system.display(jumped - found.impulse * slope - answered)
    return None if size(value) > LONGEST else ReactionImpulse(event, found, inertia, slope, shares, value)


def slip_slope(release: Release, load: Friction) -> sp.Expr:
    """∂c/∂l of what slips."""
    wider = release.wider
    return release.as_held(wider.derivative(wider.slipping(load), wider.q(release.coordinate)))


def gap_slope(release: Release, event: Event) -> sp.Expr:
    """∂g/∂l of a contact."""
    wider = release.wider
    return release.as_held(wider.derivative(gap(wider, event), wider.q(release.coordinate)))


def _has_accelerations(release: Release) -> bool:
    """Whether accelerations were put into Z, which are those of slipping, and of open contacts."""
    return release.accelerations is not None and release.closed is not None
