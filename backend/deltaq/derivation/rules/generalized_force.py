"""Comparison of coefficients: the δqᵢ are independent, so δW = Qᵢ δqᵢ for all of them determines every Qᵢ.

With constraints they are not, and Qᵢ is what stands before δqᵢ by definition.
It is also Qᵢ = Σ F · ∂r/∂qᵢ for forces, ∫ f · ∂r/∂qᵢ dS for force densities, M ∂φ/∂qᵢ for moments, −∂V/∂qᵢ for
potentials and −∂R/∂q̇ᵢ for dissipation.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.49; the lecture's definition of Qᵢ.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Plus, Quantity, Term, Times
from ..step import Relation, Step
from ..system import System
from ._choice import rule_of

RULE = "generalized-forces"
EACH = "generalized-force"


def apply(system: System) -> Step:
    """δW = Qᵢ δqᵢ, and below it each Qᵢ by its definition."""
    total = system.collected(sum(map(system.virtual_work, system.scene.contributions), system.zero))
    forces = {q: system.generalized_force(q) for q in system.free}
    compared = tuple(
        Term(
            Times((Named(Quantity("generalized-force", q), force), Explicit(system.variation(q)))),
            system.force_sources(q),
        )
        for q, force in forces.items()
    )
    lines = (
        Relation((Named(Quantity("virtual-work"), total), Plus(compared))),
        *(Relation((Named(Quantity("generalized-force", q), f), Explicit(f))) for q, f in forces.items()),
    )
    about = {"outcome": "constrained" if system.conditions else "text"}
    step = Step(RULE, "", lines, tuple(f"load:{load.name}" for load in system.scene.loads), about)
    return step.with_substeps(*(one(system, q) for q in system.free))


def one(system: System, coordinate: str) -> Step:
    """Qᵢ as the sum of what each load contributes."""
    force = system.generalized_force(coordinate)
    loads = [load for load in system.scene.contributions if system.share(load, coordinate) != 0]
    by_law = tuple(rule_of(load).share(system, load, coordinate) for load in loads)
    written = tuple(Term(Explicit(system.share(load, coordinate)), (f"load:{load.source}",)) for load in loads)
    lines = (Plus(by_law), Plus(written)) if loads else ()
    line = Relation((Named(Quantity("generalized-force", coordinate), force), *lines, Explicit(force)))
    return Step(EACH, coordinate, (line,), tuple(t.sources[0] for t in written), {"coordinate": coordinate})
