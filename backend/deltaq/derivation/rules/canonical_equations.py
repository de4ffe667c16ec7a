"""Canonical equations: q̇ = ∂H/∂p and ṗ = −∂H/∂q + Qᵈ say the same as Lagrange's equation of the coordinate.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.1; Arnold, Mathematical Methods of Classical
Mechanics, 2nd ed., §15.
"""

from __future__ import annotations

from ..formula import Equation, Explicit, Formula, Inserted, Named, Partial, Plus, Quantity, Rate, Term, minus
from ..hamiltonian import Hamiltonian
from ..step import Relation, Step
from ..system import System

RULE = "canonical-equations"


def apply(system: System, found: Hamiltonian, coordinate: str) -> Step:
    """Both of one coordinate, and that the second is Lagrange's."""
    q, p = system.q(coordinate), found.momenta[coordinate]
    function = Named(Quantity("hamiltonian"), found.function)
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    momentum = Named(Quantity("momentum", coordinate), system.momentum(coordinate))
    force = system.nonconservative_force(coordinate)
    outside = (Term(Named(Quantity("nonconservative-force", coordinate), force)),) if force != 0 else ()
    falling = Plus((minus(Partial(function, q)),))
    slope = system.derivative(found.function, p)
    written: Formula = Explicit(system.derivative(-found.function, q))
    lagrange = Equation(Rate(momentum), Plus((Term(Partial(lagrangian, q)), *outside)))
    hamilton = Equation(Rate(momentum), Inserted(Plus((*falling.terms, *outside)), found.given))
    lines = (
        Relation(
            (
                Explicit(system.rate(coordinate)),
                Inserted(Partial(function, p), found.given),
                Inserted(Explicit(slope), found.given),
            )
        ),
        Relation((lagrange, hamilton), "⇔"),
        Relation((Inserted(falling, found.given), Inserted(written, found.given))),
    )
    return Step(RULE, coordinate, lines, (), {"coordinate": coordinate})
