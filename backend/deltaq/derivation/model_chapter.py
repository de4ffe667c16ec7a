"""The last chapter of every formulation: what the equations of motion tell before they are integrated.

Each part has its share of operations (`effort`); where that is used up, a step says what is left out.
"""

from __future__ import annotations

from collections.abc import Iterator

from .bound_equilibria import is_sought
from .conditions import conditions
from .conservation import cyclic, jacobi_energy_rate
from .conservation import jacobi_energy as energy_of
from .formula import Named, Quantity
from .hamiltonian import hamiltonian as hamiltonian_of
from .linearization import Linearization
from .matrix_form import is_autonomous
from .optional import (
    contact_search_of,
    kink_search_of,
    left_out_of,
    motions_of,
    reduction_of,
    search_of,
    steady_motions_of,
    symmetries_of,
)
from .rest_sets import RestSearch, band_of
from .rules import (
    canonical_equations,
    contact_equilibrium,
    cyclic_coordinate,
    eigenfrequencies,
    equilibrium,
    equilibrium_condition,
    equilibrium_search,
    existence_condition,
    friction_band,
    hamiltonian,
    jacobi_energy,
    kink_equilibrium,
    left_out,
    linearization,
    matrix_form,
    noether,
    poisson_bracket,
    relative_equilibrium,
    rest_range,
    routh_function,
    stability_condition,
    symmetry_search,
)
from .step import Step
from .system import System

MOST_SHOWN = 4
TOLD_BEFORE = ("steps", "multipliers")  # what is missing in chapters before


def model(system: System) -> Iterator[Step]:
    """Matrix form, equilibria with their small motions, and what is conserved."""
    if not system.conditions:
        yield matrix_form.apply(system)
    if is_autonomous(system) and is_sought(system):
        yield equilibrium_condition.apply(system)
        yield from _equilibria(system)
    elif not is_sought(system):
        search_of(system)  # which says why not
    yield from _conserved(system)
    missing = system.effort.left_out.items()
    yield from (left_out.apply(part, why) for part, why in missing if part not in TOLD_BEFORE)


def _equilibria(system: System) -> Iterator[Step]:
    known, found = search_of(system), motions_of(system)
    for number, linear in enumerate(found[:MOST_SHOWN], 1):
        yield equilibrium.apply(system, linear, number)
        yield from _conditions(system, linear, number)
        if linear.spectrum is not None:
            yield linearization.apply(system, linear, number)
            yield eigenfrequencies.apply(system, linear, linear.spectrum, number)
    others = [equilibrium.apply(system, each, k) for k, each in enumerate(found[MOST_SHOWN:], MOST_SHOWN + 1)]
    resting = contact_search_of(system)
    steps = [contact_equilibrium.apply(system, each, k) for k, each in enumerate(resting.found if resting else (), 1)]
    yield from steps[:MOST_SHOWN]
    others += steps[MOST_SHOWN:]
    kinked = kink_search_of(system) or RestSearch()
    steps = [kink_equilibrium.apply(system, each, k) for k, each in enumerate(kinked.kinks, 1)]
    yield from steps[:MOST_SHOWN]
    others += steps[MOST_SHOWN:]
    told = {linear.band for linear in found}
    ranges = [each for each in kinked.found if (each.low or each.high) and band_of(each) not in told - {None}]
    yield from (rest_range.apply(system, each, k) for k, each in enumerate(ranges, 1))
    if known and (others or known.ranges or not known.complete or left_out_of(system)):
        yield equilibrium_search.apply(system, known, min(len(found), MOST_SHOWN), tuple(others))


def _conditions(system: System, linear: Linearization, number: int) -> Iterator[Step]:
    """When it exists, when it is stable, and between which values friction holds it."""
    if linear.band is not None:
        yield friction_band.apply(system, linear, linear.band, number)
    known = conditions(system, linear)
    if known and known.existence:
        yield existence_condition.apply(system, known, number)
    local = known is None and linear.equilibrium.exact and not linear.verdict.kind and linear.stability != "undecided"
    if local or (known and known.stability):
        yield stability_condition.apply(system, linear, known, number)


def _conserved(system: System) -> Iterator[Step]:
    for coordinate in cyclic(system):
        yield cyclic_coordinate.apply(system, coordinate)
    yield jacobi_energy.apply(system)
    for number, symmetry in enumerate(symmetries_of(system), 1):
        yield noether.apply(system, symmetry, number)
    if "integrals" not in system.effort.left_out:
        yield symmetry_search.apply(system)
    reduced = reduction_of(system)
    if reduced is not None:
        yield routh_function.apply(system, reduced)
    for number, motion in enumerate(steady_motions_of(system), 1):
        yield relative_equilibrium.apply(system, motion, number)


def canonical(system: System) -> Iterator[Step]:
    """Hamilton's function, the canonical equations, and the brackets of the integrals of motion with it."""
    if system.conditions:
        system.effort.left_out["canonical"] = "constraints"
        yield left_out.apply("canonical", "constraints")
        return
    found = system.effort.afford("canonical", lambda: hamiltonian_of(system), None)
    if "canonical" in system.effort.left_out:
        yield left_out.apply("canonical", system.effort.left_out["canonical"])
        return
    yield hamiltonian.apply(system, found)
    if found is None:
        return
    for coordinate in system.free:
        yield canonical_equations.apply(system, found, coordinate)
    for number, integral in enumerate(_integrals(system), 1):
        yield poisson_bracket.apply(system, found, integral, str(number))


def _integrals(system: System) -> Iterator[Named]:
    """Those that hold for all values of the parameters, as they are named in the chapter before."""
    for q in cyclic(system):
        yield Named(Quantity("momentum", q), system.momentum(q))
    if system.is_zero(jacobi_energy_rate(system)):
        yield Named(Quantity("jacobi-energy"), energy_of(system))
    for number, symmetry in enumerate(symmetries_of(system), 1):
        if not symmetry.conditions:
            yield Named(Quantity("integral-of-motion", str(number)), symmetry.value)
