"""Virtual work of a potential: δW = −δV, with the time held fixed.

Source: Lanczos, The Variational Principles of Mechanics, ch. I.7.
"""

from __future__ import annotations

from ...mechanics.contributions import PotentialEnergy
from ..formula import Explicit, Gateaux, Given, Named, Plus, Quantity, Substituted, Term
from ..step import Relation, Step
from ..system import System

RULE = "work-of-potential"


def apply(system: System, load: PotentialEnergy, subject: str) -> Step:
    source = (f"load:{load.source}",)
    energy = system.potential(load)
    stated = Given((load.energy,), system.expression(load.energy))
    energies = (Substituted(stated, system.guides), Explicit(energy)) if system.guides else (stated,)
    potential = Named(Quantity("potential-energy", load.source), energy)
    work = system.collected(-system.vary(energy))
    lines = (
        Relation((potential, *energies)),
        Relation(
            (
                Named(Quantity("virtual-work", load.source), work),
                Plus((Term(Gateaux(potential), source, -1),)),
                Explicit(work),
            )
        ),
    )
    return Step(RULE, subject, lines, source, {"load": load.source})
