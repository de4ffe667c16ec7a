"""Hamilton's principle: δS = 0 for every δq that vanishes at t₀ and t₁; with other forces δS + ∫ Qᵢᵈ δqᵢ dt = 0.

It is d'Alembert's principle integrated over the time, and is stated here, not derived.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.1; Lanczos, ch. V.1.
"""

from __future__ import annotations

from ..action import Action
from ..formula import Equation, Explicit, Formula, Named, Plus, Quantity, Term, Times
from ..step import Relation, Step
from .functional import variation

RULE = "hamilton-principle"


def apply(action: Action) -> Step:
    """δS = 0, or δS + ∫ Qᵢᵈ δqᵢ dt = 0 (outcome `driven`) with the loads without potential as its sources."""
    system = action.system
    outside = other_work(action)
    left: Formula = Plus((Term(variation(action)), Term(action.on(outside)))) if outside else variation(action)
    line = Relation((Equation(left, Explicit(system.zero)),))
    sources = tuple(dict.fromkeys(source for x in action.functions for source in other_sources(action, x)))
    return Step(RULE, "", (line,), sources, {"outcome": "driven" if outside else "text"}, premises=("action",))


def other_work(action: Action) -> Plus | None:
    """Qᵢᵈ δqᵢ of the forces that have no potential, or None if there are none."""
    terms = tuple(
        Term(Times((other_force(action, x), Explicit(action.system.variation(x)))), other_sources(action, x))
        for x in action.functions
        if has_other_force(action, x)
    )
    return Plus(terms) if terms else None


def has_other_force(action: Action, coordinate: str) -> bool:
    """Whether Qᵢᵈ ≠ 0: a force without potential acts on the coordinate."""
    return bool(action.system.nonconservative_force(coordinate) != 0)


def other_sources(action: Action, coordinate: str) -> tuple[str, ...]:
    """The loads without potential that act on a coordinate."""
    system = action.system
    return tuple(source for source in system.force_sources(coordinate) if source not in system.conservative_sources)


def other_force(action: Action, coordinate: str) -> Named:
    """Qᵢᵈ"""
    return Named(Quantity("nonconservative-force", coordinate), action.system.nonconservative_force(coordinate))
