"""A condition that holds at all times holds for its derivatives as well: Φ̇ = 0, and Φ̈ = Σ aᵢ q̈ᵢ + γ = 0.

A holonomic condition is differentiated twice, one on rates once; then accelerations stand in it, linearly. The terms
γ(q, q̇, t) without accelerations come from the curvature of the condition.
Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, vol. 1, §3.6.
"""

from __future__ import annotations

from ...mechanics.conditions import Condition
from ..formula import Equation, Explicit, Formula, Named, Rate
from ..step import Relation, Step
from ..system import System

RULE = "constraint-rates"


def apply(system: System, condition: Condition) -> Step:
    """Each derivative along the motion, written out; the last one vanishes."""
    name = system.named_condition(condition)
    value = Explicit(system.condition_acceleration(condition))
    lines: tuple[Relation, ...] = (Relation((highest(name, condition), value)),)
    if condition.is_holonomic:
        lines = (Relation((Rate(name), Explicit(system.condition_rate(condition)))), *lines)
    lines = (*lines, Relation((Equation(highest(name, condition), Explicit(system.zero)),)))
    about = {"outcome": "text" if condition.is_holonomic else "rates", "constraint": condition.source}
    return Step(RULE, condition.source, lines, (f"constraint:{condition.source}",), about)


def highest(name: Named, condition: Condition) -> Formula:
    """The derivative in which accelerations stand."""
    return Rate(Rate(name)) if condition.is_holonomic else Rate(name)
