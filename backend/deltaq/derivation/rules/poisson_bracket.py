"""Poisson bracket: a function f(q, p, t) changes by df/dt = {f, H} + Σ Qᵢᵈ ∂f/∂pᵢ + ∂f/∂t; for an integral it is zero.

{f, H} = Σ (∂f/∂qᵢ ∂H/∂pᵢ − ∂f/∂pᵢ ∂H/∂qᵢ). Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §9.6; Landau,
Lifshitz, Mechanics, §42.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..formula import Explicit, Inserted, Named, Partial, Plus, Quantity, Term, Times, minus
from ..hamiltonian import Hamiltonian, in_momenta
from ..step import Relation, Step
from ..system import System

RULE = "poisson-bracket"


def apply(system: System, found: Hamiltonian, integral: Named, subject: str) -> Step:
    """The integral in momenta, and its rate."""
    inside = Named(integral.quantity, in_momenta(system, found, integral.value))
    whole = tuple(_bracket(system, found, inside))
    function = found.function
    bracket = (term for term, q in whole if q is None or function.has(q))
    terms = (*bracket, *_outside(system, found, inside)) or tuple(term for term, _ in whole)
    rate = Relation((Inserted(Plus(terms), found.given), Explicit(system.zero)))
    written = Relation((integral, Inserted(Explicit(inside.value), found.given)))
    is_momentum = inside.value in found.momenta.values()
    return Step(RULE, subject, (rate,) if is_momentum else (written, rate), (), {"number": subject})


def _bracket(system: System, found: Hamiltonian, inside: Named) -> Iterator[tuple[Term, sp.Symbol | None]]:
    """Σ (∂f/∂qᵢ ∂H/∂pᵢ − ∂f/∂pᵢ ∂H/∂qᵢ), each with the qᵢ without which in H it is zero at sight."""
    function = Named(Quantity("hamiltonian"), found.function)
    for coordinate, p in found.momenta.items():
        q = system.q(coordinate)
        if inside.value.has(q):
            yield Term(Times((Partial(inside, q), Partial(function, p)))), None
        if inside.value.has(p):
            yield minus(Times((Partial(inside, p), Partial(function, q)))), q


def _outside(system: System, found: Hamiltonian, inside: Named) -> Iterator[Term]:
    """Σ Qᵢᵈ ∂f/∂pᵢ + ∂f/∂t"""
    for coordinate, p in found.momenta.items():
        force = system.nonconservative_force(coordinate)
        if force != 0 and inside.value.has(p):
            yield Term(Times((Named(Quantity("nonconservative-force", coordinate), force), Partial(inside, p))))
    if inside.value.has(system.t):
        yield Term(Partial(inside, system.t))
