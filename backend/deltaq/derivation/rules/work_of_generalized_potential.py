"""Virtual work of a generalized potential: δW = Σ (d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ) δqᵢ with U(q, q̇, t).

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
"""

from __future__ import annotations

from ...mechanics.contributions import GeneralizedPotential
from ..formula import Explicit, Given, Named, Plus, Quantity, Substituted, Term, Times
from ..step import Relation, Step
from ..system import System
from . import generalized_potential

RULE = "work-of-generalized-potential"
LOAD = GeneralizedPotential


def apply(system: System, load: GeneralizedPotential, subject: str) -> Step:
    """U as the scene states it, with guides put in, then its virtual work by both derivatives, and the value."""
    source = f"load:{load.source}"
    function = _function(system, load)
    stated = Given((load.energy,), system.expression(load.energy))
    stages = (
        (Substituted(stated, system.guides), Explicit(function.value))
        if system.guides
        else (stated, Explicit(function.value))
    )
    work = Explicit(system.virtual_work(load))
    terms = tuple(
        Term(Times((generalized_potential.law(system, function, q), Explicit(system.variation(q)))), (source,))
        for q in system.free
        if function.value.has(system.rate(q), system.q(q))
    )
    left = Named(Quantity("virtual-work", load.source), work.value)
    lines = (Relation((function, *stages)), Relation((left, *((Plus(terms),) if terms else ()), work)))
    return Step(RULE, subject, lines, (source,), {"load": load.source})


def share(system: System, load: GeneralizedPotential, coordinate: str) -> Term:
    """d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ"""
    return Term(generalized_potential.law(system, _function(system, load), coordinate), (f"load:{load.source}",))


def _function(system: System, load: GeneralizedPotential) -> Named:
    return Named(Quantity("generalized-potential", load.source), system.generalized_potential(load))
