"""Hamilton's principle: of all motions between two configurations, the real one makes the action S = ∫ L dt stationary.

Forces without a potential enter by their virtual work. Integration by parts and the fundamental lemma lead to
∂L/∂qᵢ − d/dt ∂L/∂q̇ᵢ + Qᵢᵈ = 0.
Source: Hamilton (1834, 1835); Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., ch. 2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from .. import chapters
from ..action import action
from ..model_chapter import model
from ..rules import action as action_rule
from ..rules import (
    boundary_terms,
    collected_variation,
    exchange_of_variation,
    fundamental_lemma,
    hamilton_principle,
    integration_by_parts,
    lagrange_function,
    variation_by_chain_rule,
)
from ..step import Step
from ..system import System

FORMULATION = "hamilton"


def _hamilton(system: System) -> Iterator[Step]:
    """From the action to the factors of the δqᵢ."""
    whole = action(system)
    yield lagrange_function.apply(system)
    yield action_rule.apply(whole)
    yield hamilton_principle.apply(whole)
    yield variation_by_chain_rule.apply(whole)
    yield exchange_of_variation.apply(whole)
    for coordinate in whole.moving:
        yield integration_by_parts.apply(whole, coordinate)
    yield boundary_terms.apply(whole)
    yield collected_variation.apply(whole)
    yield fundamental_lemma.apply(whole)


# The energies first; virtual work only decides which forces have a potential.
CHAPTERS: Mapping[str, Callable[[System], Iterator[Step]]] = MappingProxyType(
    {
        "configuration": chapters.configuration,
        "kinetic-energy": chapters.kinetic_energy,
        "variation": chapters.variation,
        "virtual-work": chapters.virtual_work,
        "decomposition": chapters.forces,
        "hamilton": _hamilton,
        "lagrange": chapters.equations,
        "constraints": chapters.constraints,
        "contact": chapters.contact,
        "model": model,
    }
)
