"""The lecture's road: from d'Alembert's principle to Lagrange's equations of the second kind.

δW = ∫ r̈ · δr dm for every virtual displacement, which becomes d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ = Qᵢ.
Source: Lagrange, Mécanique analytique (1788); the lecture.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..dissipation import dissipation_function
from ..model_chapter import model
from ..rules import (
    cancellation_of_dots,
    closed_loop,
    curl_test,
    decomposition,
    exchange_of_derivatives,
    generalized_force,
    guide,
    guided_position,
    inertia_work,
    lagrange_equation,
    lagrange_function,
    position,
    potential,
    product_rule,
    rayleigh_function,
    total_differential,
    total_kinetic_energy,
    total_virtual_work,
    velocity,
    virtual_displacement,
)
from ..rules._choice import energy_rule_of, rule_of
from ..step import Chapter, Derivation, Step
from ..system import System

FORMULATION = "dalembert-lagrange"


def derive(system: System) -> Derivation:
    """The chapters in the lecture's order."""
    chapters = {
        "configuration": _configuration,
        "variation": _variation,
        "virtual-work": _virtual_work,
        "kinetic-energy": _kinetic_energy,
        "dalembert-to-lagrange": _dalembert_to_lagrange,
        "decomposition": _decomposition,
        "lagrange": _lagrange,
        "model": model,
    }
    return Derivation(FORMULATION, tuple(Chapter(name, tuple(steps(system))) for name, steps in chapters.items()))


def _places(system: System) -> tuple[str, ...]:
    """The places whose motion matters: bodies, and points where forces act."""
    bodies = (body.name for body in system.scene.bodies)
    points = (system.place_of(load) for load in system.scene.contributions)
    return tuple(place for place in dict.fromkeys((*bodies, *points)) if place)


def _configuration(system: System) -> Iterator[Step]:
    for place in _places(system):
        yield position.apply(system, place)
    for each in system.scene.guides:
        yield guide.apply(system, each)
    if system.scene.guides:
        for place in _places(system):
            yield guided_position.apply(system, place)


def _variation(system: System) -> Iterator[Step]:
    for place in _places(system):
        yield virtual_displacement.apply(system, place)
        yield total_differential.apply(system, place)


def _virtual_work(system: System) -> Iterator[Step]:
    loads = system.scene.contributions
    for load in loads:
        several = sum(other.source == load.source for other in loads) > 1
        subject = f"{load.source}:{system.place_of(load)}" if several else load.source
        yield rule_of(load).apply(system, load, subject)
    yield total_virtual_work.apply(system)
    yield generalized_force.apply(system)


def _kinetic_energy(system: System) -> Iterator[Step]:
    for body in system.scene.bodies:
        yield velocity.apply(system, body.name)
        yield energy_rule_of(body).apply(system, body)
    if len(system.scene.bodies) > 1:
        yield total_kinetic_energy.apply(system)


def _dalembert_to_lagrange(system: System) -> Iterator[Step]:
    for body in system.scene.bodies:
        yield cancellation_of_dots.apply(system, body.name)
        yield exchange_of_derivatives.apply(system, body.name)
        yield product_rule.apply(system, body.name)
    for coordinate in system.free:
        yield inertia_work.apply(system, coordinate)


def _decomposition(system: System) -> Iterator[Step]:
    for load in system.load_names:
        yield curl_test.apply(system, load)
        if system.is_conservative(load):
            yield potential.apply(system, load)
        else:
            yield from _without_potential(system, load)
    yield decomposition.apply(system)


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


def _lagrange(system: System) -> Iterator[Step]:
    yield lagrange_function.apply(system)
    for coordinate in system.free:
        yield lagrange_equation.apply(system, coordinate)
