"""Generalized potential: forces that depend on rates may come from U(q, q̇, t), Qᵢ = d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ.

L = E − V − U then gives these forces, and they stand on no right side. Linear in the rates, U = U₀ + Σ aᵢ q̇ᵢ, they do
no work as far as they depend on rates: Q = (∂aᵢ/∂qⱼ − ∂aⱼ/∂qᵢ) q̇ⱼ is orthogonal to q̇. Only U₀ is energy.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5; Landau, Lifshitz, Classical Theory of Fields, §16.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Partial, Plus, Quantity, Rate, Term, minus
from ..step import Relation, Step
from ..system import System

RULE = "generalized-potential"


def apply(system: System, load: str) -> Step:
    """U of one load, and for each free coordinate the proof d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ = Qᵢ."""
    source, function = f"load:{load}", system.velocity_potential(load)
    named = Named(Quantity("generalized-potential", load), function)
    proofs = tuple(Relation((law(system, named, q), Explicit(system.load_force(load, q)))) for q in system.free)
    return Step(RULE, load, (Relation((named, Explicit(function))), *proofs), (source,), {"load": load})


def law(system: System, function: Named, coordinate: str) -> Plus:
    """d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ"""
    source = f"load:{function.quantity.of}"
    slope = Rate(Partial(function, system.rate(coordinate)))
    return Plus((Term(slope, (source,)), minus(Partial(function, system.q(coordinate)), source)))
