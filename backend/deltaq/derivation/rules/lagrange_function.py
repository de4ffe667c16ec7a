"""Lagrange function: L = E − V, kinetic minus potential energy.

Source: Lagrange, Mécanique analytique (1788); the lecture.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Plus, Quantity, Term, minus
from ..step import Relation, Step
from ..system import System

RULE = "lagrangian"


def apply(system: System) -> Step:
    """L = E − V by the letters, then written out. The sources of V's term are the loads that have a potential."""
    kinetic = Named(Quantity("kinetic-energy"), system.kinetic_energy)
    potential = Named(Quantity("potential-energy"), system.static_potential)
    written = (*_energies(system), *_potentials(system), *_of_rates(system))
    bodies, loads = system.body_sources, system.sources_of_lagrangian
    static = Term(potential, system.conservative_sources, -1, "energy-potential")
    generalized = tuple(
        minus(Named(Quantity("generalized-potential", load), system.velocity_potential(load)), f"load:{load}")
        for load in system.generalized_loads
    )
    symbols = Plus((Term(kinetic, bodies, 1, "energy-kinetic"), static, *generalized))
    line = Relation((Named(Quantity("lagrangian"), system.lagrangian), symbols, Plus(written)))
    return Step(RULE, "", (line,), bodies + loads, {"outcome": "generalized" if generalized else "text"})


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


def _of_rates(system: System) -> tuple[Term, ...]:
    """Each generalized potential on its own, with the signs carried through its terms."""
    return tuple(
        Term(Explicit(system.display(-system.velocity_potential(load))), (f"load:{load}",))
        for load in system.generalized_loads
    )
