"""Decomposition: Qᵢ = Qᵢᵖ + Qᵢᵈ, the part with a potential, Qᵢᵖ = −∂V/∂qᵢ, and the rest, of which −∂R/∂q̇ᵢ dissipates.

Source: the lecture; Szabó, Höhere Technische Mechanik, §I.6.
"""

from __future__ import annotations

from ..dissipation import dissipation_function, dissipative_loads, remaining_loads
from ..formula import Explicit, Named, Partial, Plus, Quantity, Term, minus
from ..step import Relation, Step
from ..system import System
from . import generalized_force, generalized_potential, potential

RULE = "decomposition"


def apply(system: System) -> Step:
    """V of the whole system, and for each coordinate Qᵢ = −∂V/∂qᵢ + Qᵢᵈ; Qᵢᵈ = 0 where there is none."""
    loads = [load for load in system.load_names if system.is_conservative(load)]
    parts = tuple(
        Term(Named(Quantity("potential-energy", load), system.load_potential(load)), (f"load:{load}",))
        for load in loads
    )
    energy = Named(Quantity("potential-energy"), system.static_potential)
    sums = (Plus(parts),) if len(parts) > 1 else ()
    lines = [Relation((energy, *sums, Explicit(system.static_potential)))]
    lines += [_split(system, q, energy) for q in system.free]
    if dissipative_loads(system):
        lines += [_rest(system, q) for q in system.free]
    else:
        lines += [_no_rest(system, q) for q in system.free if system.nonconservative_force(q) == 0]
    about = {"outcome": _outcome(system), "load": ", ".join(remaining_loads(system))}
    sources = tuple(f"load:{load}" for load in system.load_names)
    premises = (*_premises(loads), *(f"{generalized_potential.RULE}:{load}" for load in system.generalized_loads))
    return Step(RULE, "", tuple(lines), sources, about, premises=premises)


def _premises(conservative: list[str]) -> tuple[str, ...]:
    """The forces that are split, and the potentials, though V of a single load is written out at once."""
    return (generalized_force.RULE, *(f"{potential.RULE}:{load}" for load in conservative))


def _of_rates(system: System, coordinate: str) -> tuple[Term, ...]:
    """d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ of every load with a generalized potential that acts on the coordinate."""
    found: tuple[Term, ...] = ()
    for load in system.generalized_loads:
        if system.load_force(load, coordinate) != 0:
            named = Named(Quantity("generalized-potential", load), system.velocity_potential(load))
            found += generalized_potential.law(system, named, coordinate).terms
    return found


def _outcome(system: System) -> str:
    """What the rest consists of."""
    if system.generalized_loads and not dissipative_loads(system):
        return "generalized-and-rest" if remaining_loads(system) else "generalized"
    if dissipative_loads(system):
        return "dissipation-and-rest" if remaining_loads(system) else "dissipation"
    return "rest" if remaining_loads(system) else "text"


def _no_rest(system: System, coordinate: str) -> Relation:
    """Qᵢᵈ = 0"""
    return Relation((Named(_dissipative(coordinate), system.zero), Explicit(system.zero)))


def _rest(system: System, coordinate: str) -> Relation:
    """Qᵢᵈ = −∂R/∂q̇ᵢ of every load that dissipates, and the forces of the others."""
    rate = system.rate(coordinate)
    functions = {load: dissipation_function(system, load) for load in dissipative_loads(system)}
    slopes = tuple(
        minus(Partial(Named(Quantity("dissipation-function", load), function), rate), f"load:{load}")
        for load, function in functions.items()
        if function is not None
    )
    others = ((load, system.load_force(load, coordinate)) for load in remaining_loads(system))
    forces = tuple(
        Term(Named(Quantity("generalized-force", coordinate, load), force), (f"load:{load}",))
        for load, force in others
        if force != 0
    )
    value = system.nonconservative_force(coordinate)
    return Relation((Named(_dissipative(coordinate), value), Plus((*slopes, *forces)), Explicit(value)))


def _split(system: System, coordinate: str, potential: Named) -> Relation:
    total = system.generalized_force(coordinate)
    conservative = system.conservative_force(coordinate)
    rest = system.nonconservative_force(coordinate)
    acting = system.force_sources(coordinate)
    kept = tuple(source for source in acting if source in system.sources_of_lagrangian)
    others = tuple(source for source in acting if source not in kept)
    static = tuple(source for source in kept if source in system.conservative_sources)
    slope = minus(Partial(potential, system.q(coordinate)), *static)
    named = Plus((slope, *_of_rates(system, coordinate), Term(Named(_dissipative(coordinate), rest), others)))
    written = Plus((Term(Explicit(conservative), kept), Term(Explicit(rest), others)))
    return Relation((Named(Quantity("generalized-force", coordinate), total), named, written))


def _dissipative(coordinate: str) -> Quantity:
    return Quantity("nonconservative-force", coordinate)
