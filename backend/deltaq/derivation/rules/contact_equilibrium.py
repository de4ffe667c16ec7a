"""Rest on a closed contact: its reaction balances the other forces, f₀ + λ_N ∂g_N/∂q = 0, towards opening, λ_N > 0.

Virtual displacements that open the contact are allowed as well; along them the forces may do no positive work.
Source: Lanczos, The Variational Principles of Mechanics, ch. III.6 (Fourier's inequality).
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ...mechanics.event import Event
from ..contact_equilibria import ContactEquilibrium
from ..formula import AtEquilibrium, Explicit, Formula, Inserted, Named, Plus, Quantity, Stack, Term, Times
from ..impacts import bouncing, slopes
from ..matrix_form import forces_at_rest
from ..step import Relation, Step
from ..system import System
from ._shape import at_rest, balanced, multiplier, numbers, place, shaped, valued, zero
from .contact_gap import RULE as GAP
from .contact_gap import named_gap, slope_of

RULE = "contact-equilibrium"


def apply(system: System, found: ContactEquilibrium, number: int) -> Step:
    """Where it is, that the contacts are closed there, the reactions that hold it, and their sign."""
    known = found.equilibrium
    there = at_rest(system, known)
    lines = (
        *(place(system, known, q) for q in system.free if system.q(q) in known.values),
        *(Relation((_at(system, found, named_gap(system, each), there), zero(1))) for each in found.contacts),
        *(multiplier(system, symbol, known) for symbol in known.reactions),
        *_reactions(system, found),
        Relation((_at(system, found, _balance(system, found), there), zero(len(system.free)))),
    )
    about = {"outcome": _outcome(found), "number": str(number), "coordinate": ", ".join(known.free)}
    premises = tuple(f"{GAP}:{event.name}" for event in found.contacts)
    return Step(RULE, str(number), lines, system.constraint_sources, about, premises=premises)


def _outcome(found: ContactEquilibrium) -> str:
    is_family = found.stability == "stable" and bool(found.equilibrium.free)
    outcome = "stable-in-the-others" if is_family else found.stability
    return f"{outcome}-at-values" if found.is_only_here else outcome


def _at(system: System, found: ContactEquilibrium, law: Formula, there: dict[sp.Symbol, sp.Expr]) -> Formula:
    at_rest = AtEquilibrium(law, there)
    for_all = found.equilibrium.exact and not found.is_only_here
    return at_rest if for_all else Inserted(at_rest, numbers(system))


def _reactions(system: System, found: ContactEquilibrium) -> Iterator[Relation]:
    """λ_N of each contact, and that it is positive at the scene's values."""
    for event, value in zip(found.contacts, found.reactions, strict=True):
        name = _reaction(system, event, value)
        yield valued(name, value, found.equilibrium)
        yield Relation((Explicit(system.zero), Inserted(name, numbers(system))), "<")


def _reaction(system: System, event: Event, value: sp.Expr) -> Named:
    return Named(Quantity("contact-reaction", event.name if len(bouncing(system)) > 1 else ""), value)


def _balance(system: System, found: ContactEquilibrium) -> Formula:
    """f + Aᵀλ + Σ λ_N ∂g_N/∂q"""
    force = balanced(system, shaped("forcing", "vector", forces_at_rest(system)))
    terms = [
        Term(Times((_reaction(system, event, value), _gradient(system, event))))
        for event, value in zip(found.contacts, found.reactions, strict=True)
    ]
    return Plus((*(force.terms if isinstance(force, Plus) else (Term(force),)), *terms))


def _gradient(system: System, event: Event) -> Formula:
    """∂g_N/∂q as a column; with one coordinate a number."""
    along = slopes(system, event)
    rows = tuple(slope_of(system, event, q) if q in along else Explicit(system.zero) for q in system.free)
    return rows[0] if len(rows) == 1 else Stack(rows)
