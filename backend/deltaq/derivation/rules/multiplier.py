"""The multiplier from the differentiated constraint: with q̈ from the equations of motion, Φ̈ = 0 is linear in λ.

Accelerations are not needed to know a reaction: it follows from where the system is and how fast it moves.
Source: Udwadia, Kalaba, Analytical Dynamics: A New Approach, §3.3.
"""

from __future__ import annotations

import sympy as sp

from ...mechanics.conditions import Condition
from ..formula import Explicit, Inserted
from ..multipliers import Multipliers
from ..step import Relation, Step
from ..system import System
from .augmented_system import RULE as AUGMENTED
from .constraint_rates import highest

RULE = "multiplier"


def apply(system: System, condition: Condition, found: Multipliers) -> Step:
    """Φ̈ with the accelerations put in, that it vanishes for this λ, and λ."""
    row = system.conditions.index(condition)
    symbol = system.multiplier(condition)
    inside = sp.Add(*(a * each for a, each in zip(found.matrix[row, :], system.multipliers, strict=True)))
    law = Explicit(system.display(inside) + found.rest[row])
    rate = highest(system.named_condition(condition), condition)
    value = found.values[symbol]
    lines = (
        Relation((Inserted(rate, found.accelerations), law)),
        Relation((Inserted(law, found.values), Explicit(system.zero))),
        Relation((Inserted(Explicit(symbol), found.values), Explicit(value))),
    )
    outcome = "in-time" if value.has(system.t) else "text"
    about = {"outcome": outcome, "constraint": condition.source}
    premises = (AUGMENTED, f"constraint-rates:{condition.source}")
    return Step(RULE, condition.source, lines, (f"constraint:{condition.source}",), about, premises=premises)
