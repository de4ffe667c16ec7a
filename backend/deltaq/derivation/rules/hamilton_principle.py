"""Hamilton's principle: δS = 0 for every δq that vanishes at t₀ and t₁; with other forces δS + ∫ Qᵢᵈ δqᵢ dt = 0.

Where constraints are released their reactions do work as well, δS + ∫ (Qᵢᵈ + λ ∂Φ/∂qᵢ) δqᵢ dt = 0. The constraint is
not put into L with its multiplier: for constraints on rates that would be another (vakonomic) problem.

It is d'Alembert's principle integrated over the time, and is stated here, not derived.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.1; Lanczos, ch. V.1.
"""

from __future__ import annotations

from ..action import Action
from ..formula import Equation, Explicit, Formula, Plus, Term, Times
from ..step import Relation, Step
from ._lagrange import right_terms
from .functional import variation

RULE = "hamilton-principle"


def apply(action: Action) -> Step:
    """δS = 0, or δS + ∫ Qᵢᵈ δqᵢ dt = 0 (outcome `driven`, with reactions `constrained`); sources are what does work."""
    system = action.system
    work = other_work(action)
    left: Formula = Plus((Term(variation(action)), Term(action.on(work)))) if work else variation(action)
    line = Relation((Equation(left, Explicit(system.zero)),))
    sources = tuple(dict.fromkeys(source for term in (work.terms if work else ()) for source in term.sources))
    outcome = "constrained" if system.conditions else "driven" if work else "text"
    return Step(RULE, "", (line,), sources, {"outcome": outcome}, premises=("action",))


def other_work(action: Action) -> Plus | None:
    """(Qᵢᵈ + λ ∂Φ/∂qᵢ) δqᵢ of forces without a potential and of reactions, or None if there are none."""
    terms = tuple(
        Term(Times((term.formula, Explicit(action.system.variation(x)))), term.sources)
        for x in action.functions
        for term in right_terms(action.system, x)
    )
    return Plus(terms) if terms else None
