"""Virtual work of dissipation: δW = −∂R/∂q̇ᵢ δqᵢ with Rayleigh's dissipation function R(q, q̇, t).

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
"""

from __future__ import annotations

from ...mechanics.contributions import DissipationFunction
from ..formula import Explicit, Given, Named, Partial, Plus, Quantity, Substituted, Term, Times, minus
from ..step import Relation, Step
from ..system import System

RULE = "work-of-dissipation"
LOAD = DissipationFunction


def apply(system: System, load: DissipationFunction, subject: str) -> Step:
    """R as the scene states it, with guides put in, then δW = −Σ ∂R/∂q̇ᵢ δqᵢ over the rates that are in R."""
    source = f"load:{load.source}"
    function = _function(system, load)
    stated = Given((load.function,), system.expression(load.function))
    stages = (
        (Substituted(stated, system.guides), Explicit(function.value))
        if system.guides
        else (
            stated,
            Explicit(function.value),
        )
    )
    work = Explicit(system.virtual_work(load))
    slopes = tuple(
        minus(Times((Partial(function, system.rate(q)), Explicit(system.variation(q)))), source)
        for q in system.free
        if function.value.has(system.rate(q))
    )
    left = Named(Quantity("virtual-work", load.source), work.value)
    lines = (Relation((function, *stages)), Relation((left, *((Plus(slopes),) if slopes else ()), work)))
    return Step(RULE, subject, lines, (source,), {"load": load.source})


def share(system: System, load: DissipationFunction, coordinate: str) -> Term:
    """−∂R/∂q̇ᵢ"""
    return minus(Partial(_function(system, load), system.rate(coordinate)), f"load:{load.source}")


def _function(system: System, load: DissipationFunction) -> Named:
    return Named(Quantity("dissipation-function", load.source), system.dissipation(load))
