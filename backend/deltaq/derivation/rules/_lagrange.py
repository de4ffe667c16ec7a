"""Both sides of Lagrange's equations, d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ = Qᵢᵈ + Σ λ ∂Φ/∂qᵢ."""

from __future__ import annotations

from ..formula import Explicit, Formula, Named, Partial, Plus, Quantity, Rate, Term, Times, minus
from ..system import System
from .constrained_variation import slope


def left_side(system: System, coordinate: str) -> Formula:
    """d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ"""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    momentum = Partial(lagrangian, system.rate(coordinate))
    return Plus((Term(Rate(momentum)), minus(Partial(lagrangian, system.q(coordinate)))))


def right_side(system: System, coordinate: str) -> Formula:
    """Qᵢᵈ + Σ λ ∂Φ/∂qᵢ; Qᵢᵈ = 0 where there is neither."""
    terms = right_terms(system, coordinate)
    if not system.bound_by(coordinate):
        return other_force(system, coordinate)
    return Plus(terms)


def right_terms(system: System, coordinate: str) -> tuple[Term, ...]:
    """Qᵢᵈ where a force without potential acts, and λ ∂Φ/∂qᵢ of each constraint on the coordinate."""
    held = tuple(
        Term(
            Times((Explicit(system.multiplier(each)), slope(system, each, coordinate))), (f"constraint:{each.source}",)
        )
        for each in system.bound_by(coordinate)
    )
    if system.nonconservative_force(coordinate) == 0:
        return held
    return (Term(other_force(system, coordinate), other_sources(system, coordinate)), *held)


def other_sources(system: System, coordinate: str) -> tuple[str, ...]:
    """The loads without potential that act on a coordinate."""
    return tuple(source for source in system.force_sources(coordinate) if source not in system.sources_of_lagrangian)


def other_force(system: System, coordinate: str) -> Named:
    """Qᵢᵈ"""
    return Named(Quantity("nonconservative-force", coordinate), system.nonconservative_force(coordinate))
