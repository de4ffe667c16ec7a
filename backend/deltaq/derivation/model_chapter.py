"""The last chapter of every formulation: what the equations of motion tell before they are integrated."""

from __future__ import annotations

from collections.abc import Iterator

from .conservation import cyclic, reduction
from .linearization import linearizations
from .matrix_form import is_autonomous
from .rules import (
    cyclic_coordinate,
    eigenfrequencies,
    equilibrium,
    equilibrium_condition,
    jacobi_energy,
    linearization,
    matrix_form,
    noether,
    relative_equilibrium,
    routh_function,
)
from .steady import steady_motions
from .step import Step
from .symmetry import symmetries
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
    for number, linear in enumerate(linearizations(system)[:MOST_SHOWN], 1):
        yield equilibrium.apply(system, linear, number)
        if linear.spectrum is not None:
            yield linearization.apply(system, linear, number)
            yield eigenfrequencies.apply(system, linear, linear.spectrum, number)


def _conserved(system: System) -> Iterator[Step]:
    for coordinate in cyclic(system):
        yield cyclic_coordinate.apply(system, coordinate)
    yield jacobi_energy.apply(system)
    for number, symmetry in enumerate(symmetries(system), 1):
        yield noether.apply(system, symmetry, number)
    reduced = reduction(system)
    if reduced is not None:
        yield routh_function.apply(system, reduced)
    for number, motion in enumerate(steady_motions(system), 1):
        yield relative_equilibrium.apply(system, motion, number)
