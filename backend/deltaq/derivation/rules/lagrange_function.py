"""Lagrange function: L = E − V, kinetic minus potential energy.

Source: Lagrange, Mécanique analytique (1788); the lecture.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Plus, Quantity, Term
from ..step import Relation, Step
from ..system import System

RULE = "lagrangian"


def apply(system: System) -> Step:
    """L = E − V by the letters, then written out. The sources of V's term are the loads that have a potential."""
    kinetic = Named(Quantity("kinetic-energy"), system.kinetic_energy)
    potential = Named(Quantity("potential-energy"), system.potential_energy)
    written = (*_energies(system), *_potentials(system))
    bodies, loads = system.body_sources, system.conservative_sources
    symbols = Plus((Term(kinetic, bodies, 1, "energy-kinetic"), Term(potential, loads, -1, "energy-potential")))
    line = Relation((Named(Quantity("lagrangian"), system.lagrangian), symbols, Plus(written)))
    return Step(RULE, "", (line,), bodies + loads)


def _energies(system: System) -> tuple[Term, ...]:
    """The kinetic energy as a whole: what bodies share is written once."""
    return (Term(Explicit(system.kinetic_energy), system.body_sources, 1, "energy-kinetic"),)


def _potentials(system: System) -> tuple[Term, ...]:
    """Each load's potential on its own, with the signs carried through its terms."""
    return tuple(
        Term(Explicit(system.display(-system.load_potential(load))), (f"load:{load}",), 1, "energy-potential")
        for load in system.load_names
        if system.is_conservative(load)
    )
