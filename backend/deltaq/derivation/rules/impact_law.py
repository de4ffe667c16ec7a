"""Impact: integrated over the short time of contact, the equations of motion leave only the reaction along ∂g/∂q.

Δpᵢ = Λ ∂g/∂qᵢ with one impulse Λ ≥ 0; positions and finite forces do not count. Newton's hypothesis ġ⁺ = −e ġ⁻ gives
Λ. By Kelvin's theorem the impulse does the work Λ (ġ⁻ + ġ⁺)/2, less what a moving contact feeds in by ∂g/∂t.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 8; Whittaker, Analytical Dynamics, §47.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ...mechanics.event import Event
from ..formula import Explicit, Formula, Named, Plus, Quantity, Term, Times
from ..impacts import Impact, after, bouncing, gap_rate, moving_term, restitution
from ..matrix_form import mass_matrix
from ..step import Relation, Step
from ..system import System
from .contact_gap import RULE as GAP
from .contact_gap import slope_of

RULE = "impact-law"


def apply(system: System, event: Event, found: Impact) -> Step:
    """Λ, the jumps of momenta and of rates, the rate of the gap behind, and what is lost."""
    impulse = _named(system, event, "impulse", found.impulse)
    lines = (
        Relation((impulse, Explicit(found.impulse))),
        *(
            Relation((_momentum(found, q), Times((impulse, slope_of(system, event, q))), Explicit(jump)))
            for q, jump in found.momenta.items()
        ),
        *_momenta_of_rates(system, found),
        *(Relation((_rate(found, q), Explicit(jump))) for q, jump in found.rates.items()),
        *_behind(system, event, found),
    )
    outcome = "text" if moving_term(system, event) == 0 else "moving"
    about = {"event": event.name, "outcome": outcome}
    equations = tuple(f"equation:{q}" for q in found.rates)
    return Step(RULE, event.name, lines, (), about, premises=(f"{GAP}:{event.name}", *equations))


def _named(system: System, event: Event, kind: str, value: sp.Expr) -> Named:
    return Named(Quantity(kind, event.name if len(bouncing(system)) > 1 else ""), value)


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
    yield Relation((Named(Quantity("impact-loss"), energy - energy.xreplace(behind)), Explicit(found.loss)))
