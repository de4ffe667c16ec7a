"""Sylvester: a symmetric matrix is positive definite if and only if all its leading minors are positive.

So the signs of the minors of K₀ say for which parameters an equilibrium is stable.
Source: Gantmacher, The Theory of Matrices, vol. 1, ch. X §4; Merkin, Introduction to the Theory of Stability, §3.2.
"""

from __future__ import annotations

from ..conditions import Conditions
from ..conservation import potential_that_decides
from ..linearization import Linearization
from ..step import Step
from ..system import System
from ._shape import inequality

RULE = "stability-condition"


def apply(system: System, linear: Linearization, conditions: Conditions | None, number: int) -> Step:
    """The inequalities, which hold at the scene's values; or that the verdict holds at these values only."""
    found = conditions.stability if conditions else ()
    lines = tuple(inequality(system, each.smaller, each.larger) for each in found)
    outcome = linear.stability if conditions else "at-values"
    about = {"outcome": outcome, "number": str(number), **potential_that_decides(system)}
    return Step(RULE, str(number), lines, (), about, premises=(f"equilibrium:{number}",))
