"""Poisson bracket: a function f(q, p, t) changes by df/dt = {f, H} + Σ Qᵢᵈ ∂f/∂pᵢ + ∂f/∂t; for an integral it is zero.

{f, H} = Σ (∂f/∂qᵢ ∂H/∂pᵢ − ∂f/∂pᵢ ∂H/∂qᵢ). Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §9.6; Landau,
Lifshitz, Mechanics, §42.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..formula import Explicit, Inserted, Named, Partial, Plus, Quantity, Term, Times, minus
from ..hamiltonian import Hamiltonian, in_momenta
from ..step import Relation, Step
from ..system import System

RULE = "poisson-bracket"


def apply(system: System, found: Hamiltonian, integral: Named, subject: str) -> Step:
    """The integral in momenta, and its rate."""
    inside = Named(integral.quantity, in_momenta(system, found, integral.value))
    rate = Plus((*_bracket(system, found, inside), *_outside(system, found, inside)))
    lines = (
        Relation((integral, Inserted(Explicit(inside.value), found.given))),
        Relation((Inserted(rate, found.given), Explicit(system.zero))),
    )
    return Step(RULE, subject, lines, (), {"number": subject})


def _bracket(system: System, found: Hamiltonian, inside: Named) -> Iterator[Term]:
    """Σ (∂f/∂qᵢ ∂H/∂pᵢ − ∂f/∂pᵢ ∂H/∂qᵢ), without what is zero at sight."""
    function = Named(Quantity("hamiltonian"), found.function)
    for coordinate, p in found.momenta.items():
        q = system.q(coordinate)
        if inside.value.has(q) and function.value.has(p):
            yield Term(Times((Partial(inside, q), Partial(function, p))))
        if inside.value.has(p) and function.value.has(q):
            yield minus(Times((Partial(inside, p), Partial(function, q))))


def _outside(system: System, found: Hamiltonian, inside: Named) -> Iterator[Term]:
    """Σ Qᵢᵈ ∂f/∂pᵢ + ∂f/∂t"""
    for coordinate, p in found.momenta.items():
        force = system.nonconservative_force(coordinate)
        if force != 0 and inside.value.has(p):
            yield Term(Times((Named(Quantity("nonconservative-force", coordinate), force), Partial(inside, p))))
    if inside.value.has(system.t):
        yield Term(Partial(inside, system.t))
    else:
        yield Term(Explicit(system.zero))
