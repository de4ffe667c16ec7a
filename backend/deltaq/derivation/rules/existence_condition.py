"""Existence: an equilibrium at arccos u or arcsin u exists for |u| < 1, one with a root for a positive radicand.

Source: Merkin, Introduction to the Theory of Stability, §3.6 (bifurcation of equilibria).
"""

from __future__ import annotations

from ..conditions import Conditions
from ..step import Step
from ..system import System
from ._shape import inequality

RULE = "existence-condition"


def apply(system: System, conditions: Conditions, number: int) -> Step:
    """The inequalities, which hold at the scene's values."""
    lines = tuple(inequality(system, each.smaller, each.larger) for each in conditions.existence)
    return Step(RULE, str(number), lines, (), {"number": str(number)}, premises=(f"equilibrium:{number}",))
