"""What stands on the right of Lagrange's equations: forces without a potential, and reactions."""

from __future__ import annotations

from ..formula import Explicit, Formula, Named, Plus, Quantity, Term, Times
from ..system import System
from .constrained_variation import slope


def outside(system: System, coordinate: str) -> Formula:
    """Qᵢᵈ + Σ λ ∂Φ/∂qᵢ; Qᵢᵈ = 0 where there is neither."""
    terms = outside_terms(system, coordinate)
    if not system.bound_by(coordinate):
        return _other_force(system, coordinate)
    return Plus(terms)


def outside_terms(system: System, coordinate: str) -> tuple[Term, ...]:
    """Qᵢᵈ where a force without potential acts, and λ ∂Φ/∂qᵢ of each constraint on the coordinate."""
    held = tuple(
        Term(
            Times((Explicit(system.multiplier(each)), slope(system, each, coordinate))), (f"constraint:{each.source}",)
        )
        for each in system.bound_by(coordinate)
    )
    if system.nonconservative_force(coordinate) == 0:
        return held
    return (Term(_other_force(system, coordinate), other_sources(system, coordinate)), *held)


def other_sources(system: System, coordinate: str) -> tuple[str, ...]:
    """The loads without potential that act on a coordinate."""
    return tuple(source for source in system.force_sources(coordinate) if source not in system.sources_of_lagrangian)


def _other_force(system: System, coordinate: str) -> Named:
    return Named(Quantity("nonconservative-force", coordinate), system.nonconservative_force(coordinate))
