"""Rayleigh's dissipation function: forces Q = −C q̇ with a symmetric C have R = 1/2 q̇ᵀC q̇, and Qᵢ = −∂R/∂q̇ᵢ.

Source: Rayleigh, The Theory of Sound, vol. 1, §81; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Explicit, Named, Partial, Plus, Quantity, minus
from ..step import Relation, Step
from ..system import System

RULE = "rayleigh-function"


def apply(system: System, load: str, function: sp.Expr) -> Step:
    """R, and the proof that its slopes are the forces of the load."""
    source = f"load:{load}"
    named = Named(Quantity("dissipation-function", load), function)
    proofs = tuple(
        Relation((Plus((minus(Partial(named, system.rate(q)), source),)), Explicit(system.load_force(load, q))))
        for q in system.free
    )
    return Step(RULE, load, (Relation((named, Explicit(function))), *proofs), (source,), {"load": load})
