"""The lecture's formulation: from d'Alembert's principle to Lagrange's equations of the second kind.

δW = ∫ r̈ · δr dm for every virtual displacement, which becomes d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ = Qᵢ.
Source: Lagrange, Mécanique analytique (1788); the lecture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from .. import chapters
from ..model_chapter import model
from ..rules import cancellation_of_dots, exchange_of_derivatives, inertia_work, lagrange_function, product_rule
from ..step import Step
from ..system import System

FORMULATION = "dalembert-lagrange"


def _dalembert_to_lagrange(system: System) -> Iterator[Step]:
    for body in system.scene.bodies:
        yield cancellation_of_dots.apply(system, body.name)
        yield exchange_of_derivatives.apply(system, body.name)
        yield product_rule.apply(system, body.name)
    for coordinate in system.free:
        yield inertia_work.apply(system, coordinate)


def _lagrange(system: System) -> Iterator[Step]:
    yield lagrange_function.apply(system)
    yield from chapters.equations(system)


# The chapters in the lecture's order.
CHAPTERS: Mapping[str, Callable[[System], Iterator[Step]]] = MappingProxyType(
    {
        "configuration": chapters.configuration,
        "variation": chapters.variation,
        "virtual-work": chapters.virtual_work,
        "kinetic-energy": chapters.kinetic_energy,
        "dalembert-to-lagrange": _dalembert_to_lagrange,
        "decomposition": chapters.forces,
        "lagrange": _lagrange,
        "constraints": chapters.constraints,
        "contact": chapters.contact,
        "model": model,
    }
)
