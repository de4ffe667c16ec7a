"""The chapters that every formulation shares."""

from __future__ import annotations

from collections.abc import Iterator

from .dissipation import dissipation_function
from .impacts import bouncing, frictions, holding_force, impact
from .multipliers import multipliers
from .rules import (
    augmented_system,
    closed_loop,
    constrained_variation,
    constraint,
    constraint_rates,
    contact_gap,
    curl_test,
    decomposition,
    generalized_force,
    generalized_potential,
    guide,
    guided_position,
    impact_law,
    impact_system,
    lagrange_equation,
    left_out,
    multiplier,
    position,
    potential,
    rayleigh_function,
    sticking_condition,
    total_differential,
    total_kinetic_energy,
    total_virtual_work,
    velocity,
    virtual_displacement,
    work_of_reaction,
)
from .rules._choice import energy_rule_of, rule_of
from .step import Step
from .system import System


def _places(system: System) -> tuple[str, ...]:
    """The places whose motion matters: bodies, and points where forces act."""
    bodies = (body.name for body in system.scene.bodies)
    points = (system.place_of(load) for load in system.scene.contributions)
    return tuple(place for place in dict.fromkeys((*bodies, *points)) if place)


def configuration(system: System) -> Iterator[Step]:
    """Positions of bodies and points; then the guides put in."""
    for place in _places(system):
        yield position.apply(system, place)
    for each in system.scene.guides:
        yield guide.apply(system, each)
    if system.scene.guides:
        for place in _places(system):
            yield guided_position.apply(system, place)


def variation(system: System) -> Iterator[Step]:
    """δr beside dr of every place."""
    for place in _places(system):
        yield virtual_displacement.apply(system, place)
        yield total_differential.apply(system, place)


def virtual_work(system: System) -> Iterator[Step]:
    """δW load by load, and the comparison of coefficients."""
    loads = system.scene.contributions
    for load in loads:
        several = sum(other.source == load.source for other in loads) > 1
        subject = f"{load.source}:{system.place_of(load)}" if several else load.source
        yield rule_of(load).apply(system, load, subject)
    yield total_virtual_work.apply(system)
    yield generalized_force.apply(system)


def kinetic_energy(system: System) -> Iterator[Step]:
    """E of every body, and of all."""
    for body in system.scene.bodies:
        yield velocity.apply(system, body.name)
        yield energy_rule_of(body).apply(system, body)
    if len(system.scene.bodies) > 1:
        yield total_kinetic_energy.apply(system)


def forces(system: System) -> Iterator[Step]:
    """Which loads have a potential, and what is left; then the constraints, released."""
    for load in system.load_names:
        if system.is_generalized(load):
            yield generalized_potential.apply(system, load)
            continue
        yield curl_test.apply(system, load)
        if system.is_conservative(load):
            yield potential.apply(system, load)
        else:
            yield from _without_potential(system, load)
    yield decomposition.apply(system)
    for condition in system.conditions:
        yield constraint.apply(system, condition)
        yield constrained_variation.apply(system, condition)
        yield work_of_reaction.apply(system, condition)


def _without_potential(system: System, load: str) -> Iterator[Step]:
    """What can be said of forces that have no potential: a dissipation function, or a loop that shows it."""
    function = dissipation_function(system, load)
    if function is not None:
        yield rayleigh_function.apply(system, load, function)
    rates = {system.rate(q) for q in system.free}
    if not any(system.load_force(load, q).free_symbols & rates for q in system.free):
        loop = closed_loop.apply(system, load)
        if loop is not None:
            yield loop


def equations(system: System) -> Iterator[Step]:
    """The equation of motion of each free coordinate, term by term."""
    for coordinate in system.free:
        yield lagrange_equation.apply(system, coordinate)


def constraints(system: System) -> Iterator[Step]:
    """Accelerations and multipliers together: the constraints differentiated, one linear system, and its solution."""
    if not system.conditions:
        return
    for condition in system.conditions:
        yield constraint_rates.apply(system, condition)
    yield augmented_system.apply(system)
    found = multipliers(system)
    if found is not None:
        yield from (multiplier.apply(system, condition, found) for condition in system.conditions)
    else:
        yield left_out.apply("multipliers", system.effort.left_out["multipliers"])


def contact(system: System) -> Iterator[Step]:
    """Impacts at contacts that close, and how long friction holds: what happens between stretches of the motion."""
    for event in bouncing(system):
        yield contact_gap.apply(system, event)
        if system.conditions:
            yield impact_system.apply(system, event)
        found = impact(system, event)
        if found is not None:
            yield impact_law.apply(system, event, found)
    for load in frictions(system):
        held = holding_force(system, load)
        if held is not None:
            yield sticking_condition.apply(system, load, held)
