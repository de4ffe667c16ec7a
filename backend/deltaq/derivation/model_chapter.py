"""The last chapter of every formulation: what the equations of motion tell before they are integrated."""

from __future__ import annotations

from collections.abc import Iterator

from .conditions import conditions
from .conservation import cyclic, reduction
from .equilibria import search
from .linearization import Linearization, linearizations
from .matrix_form import is_autonomous
from .rules import (
    cyclic_coordinate,
    eigenfrequencies,
    equilibrium,
    equilibrium_condition,
    equilibrium_search,
    existence_condition,
    friction_band,
    jacobi_energy,
    linearization,
    matrix_form,
    routh_function,
    stability_condition,
)
from .step import Step
from .system import System

MOST_SHOWN = 4


def model(system: System) -> Iterator[Step]:
    """Matrix form, equilibria with their small motions, and what is conserved."""
    yield matrix_form.apply(system)
    if is_autonomous(system):
        yield equilibrium_condition.apply(system)
        yield from _equilibria(system)
    yield from _conserved(system)


def _equilibria(system: System) -> Iterator[Step]:
    known, found = search(system), linearizations(system)
    for number, linear in enumerate(found[:MOST_SHOWN], 1):
        yield equilibrium.apply(system, linear, number)
        yield from _conditions(system, linear, number)
        if linear.spectrum is not None:
            yield linearization.apply(system, linear, number)
            yield eigenfrequencies.apply(system, linear, linear.spectrum, number)
    others = tuple(equilibrium.apply(system, each, k) for k, each in enumerate(found[MOST_SHOWN:], MOST_SHOWN + 1))
    if known and (others or known.ranges or not known.complete):
        yield equilibrium_search.apply(system, known, min(len(found), MOST_SHOWN), others)


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
    reduced = reduction(system)
    if reduced is not None:
        yield routh_function.apply(system, reduced)
