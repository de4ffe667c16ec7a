"""Virtual work of a potential: δW = −δV, with the time held fixed.

Source: Lanczos, The Variational Principles of Mechanics, ch. I.7.
"""

from __future__ import annotations

from ...mechanics.contributions import PotentialEnergy
from ..formula import Explicit, Gateaux, Given, Named, Partial, Plus, Quantity, Substituted, Term, minus
from ..step import Relation, Step
from ..system import System

RULE = "work-of-potential"
LOAD = PotentialEnergy


def apply(system: System, load: PotentialEnergy, subject: str) -> Step:
    """V as the scene states it, with guides put in, then δW = −δV and its value."""
    source = f"load:{load.source}"
    energy = _energy(system, load)
    stated = Given((load.energy,), system.expression(load.energy))
    stages = (Substituted(stated, system.guides), Explicit(energy.value)) if system.guides else (stated,)
    work = Explicit(system.virtual_work(load))
    lines = (
        Relation((energy, *stages)),
        Relation(
            (Named(Quantity("virtual-work", load.source), work.value), Plus((minus(Gateaux(energy), source),)), work)
        ),
    )
    return Step(RULE, subject, lines, (source,), {"load": load.source})


def share(system: System, load: PotentialEnergy, coordinate: str) -> Term:
    """−∂V/∂qᵢ"""
    return minus(Partial(_energy(system, load), system.q(coordinate)), f"load:{load.source}")


def _energy(system: System, load: PotentialEnergy) -> Named:
    return Named(Quantity("potential-energy", load.source), system.energy(load))
