"""Impact: integrated over the short time of contact, the equations of motion leave only the reaction along ∂g/∂q.

Δpᵢ = Λ ∂g/∂qᵢ with one impulse Λ ≥ 0; positions and finite forces do not count. Newton's hypothesis ġ⁺ = −e ġ⁻ gives
Λ. By Kelvin's theorem the impulse does the work Λ (ġ⁻ + ġ⁺)/2, less what a moving contact feeds in by ∂g/∂t.
Constraints answer with impulses of their own, Δpᵢ = Λ ∂g/∂qᵢ + Σ Λ_c aᵢ with Σ aᵢ Δq̇ᵢ = 0.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 8; Whittaker, Analytical Dynamics, §47.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ...mechanics.conditions import Condition
from ...mechanics.event import Event
from ..formula import Explicit, Formula, Inserted, Named, Plus, Quantity, Term, Times
from ..impacts import Impact, after, bouncing, gap_rate, kept_rates, moving_term, restitution, slopes
from ..matrix_form import mass_matrix
from ..step import Relation, Step
from ..system import System
from .constrained_variation import slope
from .contact_gap import RULE as GAP
from .contact_gap import slope_of
from .impact_system import RULE as SYSTEM

RULE = "impact-law"


def apply(system: System, event: Event, found: Impact) -> Step:
    """Λ, the jumps of momenta and of rates, the rate of the gap behind, and what is lost."""
    impulse = _named(system, event, "impulse", found.impulse)
    lines = (
        Relation((impulse, Explicit(found.impulse))),
        *(Relation((name, Explicit(name.value))) for _, name in _answers(system, found)),
        *(
            Relation((_momentum(found, q), _impulses_on(system, event, found, q), Explicit(jump)))
            for q, jump in found.momenta.items()
        ),
        *_momenta_of_rates(system, found),
        *_kept(system, found),
        *(Relation((_rate(found, q), Explicit(jump))) for q, jump in found.rates.items()),
        *_behind(system, event, found),
    )
    moves = moving_term(system, event) != 0 or any(map(system.moving_term, system.conditions))
    kinds = {"constrained": bool(system.conditions), "moving": moves, "several": len(bouncing(system)) > 1}
    about = {"event": event.name, "outcome": "-".join(kind for kind, holds in kinds.items() if holds) or "text"}
    equations = tuple(f"equation:{q}" for q in found.rates)
    system_of_it = (f"{SYSTEM}:{event.name}",) if system.conditions else ()
    premises = (f"{GAP}:{event.name}", *system_of_it, *equations)
    return Step(RULE, event.name, lines, system.constraint_sources, about, premises=premises)


def _named(system: System, event: Event, kind: str, value: sp.Expr) -> Named:
    return Named(Quantity(kind, event.name if len(bouncing(system)) > 1 else ""), value)


def _answers(system: System, found: Impact) -> Iterator[tuple[Condition, Named]]:
    """The impulses of the constraints."""
    for condition in system.conditions:
        yield condition, Named(Quantity("constraint-impulse", condition.source), found.answers[condition.source])


def _impulses_on(system: System, event: Event, found: Impact, coordinate: str) -> Formula:
    """Λ ∂g/∂qᵢ + Σ Λ_c aᵢ"""
    impulse = _named(system, event, "impulse", found.impulse)
    terms = [Times((impulse, slope_of(system, event, q))) for q in slopes(system, event) if q == coordinate]
    terms += [
        Times((name, slope(system, condition, coordinate)))
        for condition, name in _answers(system, found)
        if coordinate in system.bound(condition)
    ]
    return Plus(tuple(map(Term, terms))) if len(terms) > 1 else terms[0]


def _kept(system: System, found: Impact) -> Iterator[Relation]:
    """Σ aᵢ Δq̇ᵢ = 0 of each constraint."""
    for condition in system.conditions:
        bound = [q for q in system.bound(condition) if q in found.rates]
        terms = tuple(Term(Times((slope(system, condition, q), _rate(found, q)))) for q in bound)
        if terms:
            yield Relation((Plus(terms), Explicit(sp.Integer(0))))


def _momentum(found: Impact, coordinate: str) -> Formula:
    jump = found.momenta.get(coordinate)
    return Explicit(sp.Integer(0)) if jump is None else Named(Quantity("momentum-jump", coordinate), jump)


def _rate(found: Impact, coordinate: str) -> Named:
    return Named(Quantity("rate-jump", coordinate), found.rates[coordinate])


def _momenta_of_rates(system: System, found: Impact) -> Iterator[Relation]:
    """Σ Mᵢⱼ Δq̇ⱼ = Δpᵢ"""
    mass = mass_matrix(system)
    for i, coordinate in enumerate(system.free):
        factors = {q: mass[i, system.free.index(q)] for q in found.rates}
        terms = tuple(Term(Times((Explicit(factor), _rate(found, q)))) for q, factor in factors.items() if factor != 0)
        if terms:
            yield Relation((Plus(terms), _momentum(found, coordinate)))


def _behind(system: System, event: Event, found: Impact) -> Iterator[Relation]:
    """ġ⁺ = −e ġ⁻, and E⁻ − E⁺: both with the rates behind put in, against the law."""
    behind = after(system, found)
    rate, energy = gap_rate(system, event), system.kinetic_energy
    rebound = _named(system, event, "gap-rate-behind", rate.xreplace(behind))
    yield Relation((rebound, Explicit(system.display(-restitution(system, event) * rate))))
    loss: Formula = Named(Quantity("impact-loss"), energy - energy.xreplace(behind))
    known: Formula = Explicit(found.loss)
    if system.conditions:  # rates that keep them: else their impulses would do work
        loss, known = (Inserted(each, kept_rates(system)) for each in (loss, known))
    yield Relation((loss, known))
