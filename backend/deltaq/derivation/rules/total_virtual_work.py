"""Superposition: the virtual work of all loads is the sum of their virtual works, δW = Σ δW⁽ᵏ⁾.

Source: Szabó, Höhere Technische Mechanik, §I.4.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Plus, Quantity, Term
from ..step import Relation, Step
from ..system import System

RULE = "virtual-work"


def apply(system: System) -> Step:
    """δW = Σ δW⁽ᵏ⁾ by the letters, each term with its load as the source, then the sum collected by the δqᵢ."""
    parts = [(load, system.virtual_work(load)) for load in system.scene.contributions]
    total = system.collected(sum((work for _, work in parts), system.zero))
    terms = tuple(
        Term(Named(Quantity("virtual-work", load.source, system.place_of(load)), work), (f"load:{load.source}",))
        for load, work in parts
    )
    members = (Named(Quantity("virtual-work"), total), *((Plus(terms),) if len(terms) > 1 else ()), Explicit(total))
    sources = tuple(dict.fromkeys(f"load:{load.source}" for load, _ in parts))
    return Step(RULE, "", (Relation(members),), sources)
