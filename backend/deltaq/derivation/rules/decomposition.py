"""Decomposition: Qᵢ = Qᵢᵖ + Qᵢᵈ, the part with a potential, Qᵢᵖ = −∂V/∂qᵢ, and the rest.

Source: the lecture; Szabó, Höhere Technische Mechanik, §I.6.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Partial, Plus, Quantity, Term, minus
from ..step import Relation, Step
from ..system import System

RULE = "decomposition"


def apply(system: System) -> Step:
    """V of the whole system, and for each coordinate Qᵢ = −∂V/∂qᵢ + Qᵢᵈ."""
    loads = [load for load in system.load_names if system.is_conservative(load)]
    parts = tuple(
        Term(Named(Quantity("potential-energy", load), system.load_potential(load)), (f"load:{load}",))
        for load in loads
    )
    potential = Named(Quantity("potential-energy"), system.potential_energy)
    sums = (Plus(parts),) if len(parts) > 1 else ()
    lines = [Relation((potential, *sums, Explicit(system.potential_energy)))]
    lines += [_split(system, q, potential) for q in system.free]
    return Step(RULE, "", tuple(lines), tuple(f"load:{load}" for load in system.load_names))


def _split(system: System, coordinate: str, potential: Named) -> Relation:
    total = system.generalized_force(coordinate)
    conservative = system.derivative(-system.potential_energy, system.q(coordinate))
    rest = system.nonconservative_force(coordinate)
    named = Plus((minus(Partial(potential, system.q(coordinate))), Term(Named(_dissipative(coordinate), rest))))
    written = Plus((Term(Explicit(conservative)), Term(Explicit(rest))))
    return Relation((Named(Quantity("generalized-force", coordinate), total), named, written))


def _dissipative(coordinate: str) -> Quantity:
    return Quantity("nonconservative-force", coordinate)
