"""Jacobi energy: h = Σ q̇ᵢ ∂L/∂q̇ᵢ − L changes by dh/dt = Σ Qᵢᵈ q̇ᵢ − ∂L/∂t. It is E + V where r depends on q alone.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.7; Arnold, Mathematical Methods of Classical
Mechanics, 2nd ed., §15.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..conservation import is_energy, jacobi_energy, jacobi_energy_rate, keeps_energy, power
from ..formula import Explicit, Formula, Named, Partial, Plus, Quantity, Rate, Term, Times, minus
from ..impacts import contacts_with_losses
from ..step import Relation, Step
from ..system import System

RULE = "jacobi-energy"


def apply(system: System) -> Step:
    """h, its rate by Lagrange's equations, and whether it is the energy."""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    energy = Named(Quantity("jacobi-energy"), jacobi_energy(system))
    law = Plus((*(Term(_work(system, lagrangian, q)) for q in system.free), minus(lagrangian)))
    whole = Plus((Term(_symbol(system, "kinetic")), Term(_symbol(system, "potential"))))
    lines = (
        Relation((energy, law, Explicit(energy.value))),
        Relation((Rate(energy), Plus((*_left_sides(system, lagrangian), *_explicit(system, lagrangian))))),
        Relation((Plus((*_powers(system), *_explicit(system, lagrangian))), Explicit(jacobi_energy_rate(system)))),
        Relation((energy, whole), "=" if is_energy(system) else "≠"),
    )
    about = {"outcome": _outcome(system), "reason": ", ".join(_reasons(system))}
    met = contacts_with_losses(system) if system.is_zero(jacobi_energy_rate(system)) else ()
    return Step(RULE, "", lines, system.body_sources, about | ({"contacts": ", ".join(met)} if met else {}))


def _reasons(system: System) -> Iterator[str]:
    """Why h changes: each part of its rate that is not zero."""
    if not system.is_zero(power(system)):
        yield "forces-work"
    if not system.is_zero(system.slope(system.lagrangian, system.t)):
        yield "time-enters"
    if not system.is_zero(system.reaction_power()):
        yield "constraints-move"


def _outcome(system: System) -> str:
    conserved = system.is_zero(jacobi_energy_rate(system))
    if is_energy(system):
        return "energy-conserved" if conserved else "energy-changes"
    if not conserved:
        return "changes"
    return {True: "both-conserved", False: "conserved", None: "conserved-at-least"}[keeps_energy(system)]


def _symbol(system: System, kind: str) -> Named:
    value = system.kinetic_energy if kind == "kinetic" else system.potential_energy
    return Named(Quantity(f"{kind}-energy"), value)


def _work(system: System, lagrangian: Named, coordinate: str) -> Times:
    return Times((Explicit(system.rate(coordinate)), Partial(lagrangian, system.rate(coordinate))))


def _left_sides(system: System, lagrangian: Named) -> tuple[Term, ...]:
    """Σ q̇ᵢ (d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ)"""

    def left(coordinate: str) -> Formula:
        slope = Rate(Partial(lagrangian, system.rate(coordinate)))
        return Plus((Term(slope), minus(Partial(lagrangian, system.q(coordinate)))))

    return tuple(Term(Times((Explicit(system.rate(q)), left(q)))) for q in system.free)


def _powers(system: System) -> tuple[Term, ...]:
    """Σ Qᵢᵈ q̇ᵢ, and the power of reactions where their constraints move."""
    forces = ((q, system.nonconservative_force(q)) for q in system.free)
    works = tuple(
        Term(Times((Named(Quantity("nonconservative-force", q), force), Explicit(system.rate(q)))))
        for q, force in forces
    )
    moved = system.reaction_power()
    return works if moved == 0 else (*works, Term(Explicit(moved), system.constraint_sources))


def _explicit(system: System, lagrangian: Named) -> tuple[Term, ...]:
    """−∂L/∂t, where L depends on time explicitly."""
    return (minus(Partial(lagrangian, system.t)),) if lagrangian.value.has(system.t) else ()
