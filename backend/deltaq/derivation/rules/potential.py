"""Potential by line integral: V(q, t) = −∫ Qᵢ dqᵢ to q along the coordinate axes one by one,
from the origin, or from (1, …, 1) where the force is infinite at the origin or V has no closed form from there.

It is determined up to a function of time, which is left out. The proof is in the step itself: −∂V/∂qᵢ = Qᵢ.
Source: Arnold, Mathematical Methods of Classical Mechanics, 2nd ed., §5.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Partial, Plus, Quantity, minus
from ..step import Relation, Step
from ..system import System

RULE = "potential"


def apply(system: System, load: str) -> Step:
    """V of one load, and for each free coordinate the proof −∂V/∂qᵢ = Qᵢ. The load must be conservative."""
    energy = system.load_potential(load)
    source = f"load:{load}"
    potential = Named(Quantity("potential-energy", load), energy)
    proofs = tuple(
        Relation((Plus((minus(Partial(potential, system.q(q)), source),)), Explicit(system.load_force(load, q))))
        for q in system.free
    )
    lines = (Relation((potential, Explicit(energy))), *proofs)
    return Step(RULE, load, lines, (source,), {"load": load})
