"""Constraint: a condition that the motion keeps, Φ(q, t) = 0, or Φ = Σ aᵢ(q, t) q̇ᵢ + b(q, t) = 0.

The first is holonomic: it binds positions. The second binds rates; where it cannot be integrated it is nonholonomic:
any position can still be reached.
Source: Hertz, Die Prinzipien der Mechanik (1894), §123; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.3.
"""

from __future__ import annotations

from ...mechanics.conditions import Condition
from ..formula import Equation, Explicit, Formula, Substituted
from ..step import Relation, Step
from ..system import System

RULE = "constraint"


def apply(system: System, condition: Condition) -> Step:
    """Φ as the scene states it, with guides put in, and that it is zero."""
    name = system.named_condition(condition)
    stated: Formula = system.stated(condition)
    given = Substituted(stated, system.guides) if system.guides else stated
    zero = Explicit(system.zero)
    lines = (
        Relation((name, given, Explicit(name.value))),
        Relation((Equation(name, zero), Equation(Explicit(name.value), zero)), "⇔"),
    )
    outcome = "holonomic" if condition.is_holonomic else "rates"
    if system.moving_term(condition) != 0:
        outcome += "-in-time"
    about = {"outcome": outcome, "constraint": condition.source}
    return Step(RULE, condition.source, lines, (f"constraint:{condition.source}",), about)
