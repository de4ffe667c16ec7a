"""Virtual displacements that keep a constraint: δΦ = Σ ∂Φ/∂qᵢ δqᵢ = 0, and Σ aᵢ δqᵢ = 0 where rates are bound.

The time is frozen, so ∂Φ/∂t and b do not appear. Of a constraint on rates no variation is taken: δΦ = 0 along the whole
motion would be another condition, and does not lead to d'Alembert's principle.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.4; Neimark, Fufaev, Dynamics of Nonholonomic Systems.
"""

from __future__ import annotations

from ...mechanics.conditions import Condition
from ..formula import Equation, Explicit, Formula, Gateaux, Partial, Plus, Term, Times
from ..step import Relation, Step
from ..system import System

RULE = "constrained-variation"


def apply(system: System, condition: Condition) -> Step:
    """δΦ by the chain rule, or what the virtual displacements keep, term by term and written out."""
    source, zero = f"constraint:{condition.source}", Explicit(system.zero)
    by_law, written = sum_of(system, condition), Explicit(system.constrained_variation(condition))
    lines: tuple[Relation, ...] = (Relation((Equation(by_law, zero), Equation(written, zero)), "⇔"),)
    if condition.is_holonomic:
        varied = Gateaux(system.named_condition(condition))
        lines = (Relation((varied, by_law, written)), Relation((Equation(varied, zero),)))
    outcome = "text" if condition.is_holonomic else "rates"
    about = {"outcome": outcome, "constraint": condition.source}
    return Step(RULE, condition.source, lines, (source,), about)


def sum_of(system: System, condition: Condition) -> Formula:
    """Σ ∂Φ/∂qᵢ δqᵢ, or Σ ∂Φ/∂q̇ᵢ δqᵢ, over the coordinates that the constraint binds."""
    terms = tuple(
        Term(Times((slope(system, condition, q), Explicit(system.variation(q))))) for q in system.bound(condition)
    )
    return Plus(terms)


def slope(system: System, condition: Condition, coordinate: str) -> Partial:
    """∂Φ/∂qᵢ of a holonomic constraint, ∂Φ/∂q̇ᵢ of one on rates."""
    return Partial(system.named_condition(condition), system.slope_symbol(condition, coordinate))
