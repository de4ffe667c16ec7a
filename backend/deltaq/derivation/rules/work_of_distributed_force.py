"""Virtual work of a distributed force: δW = ∫ f · δr dS, or over a line or a volume, δr at the loaded particle.

Its coefficients are the integrals that define the generalized forces, Qᵢ = ∫ ∂r/∂qᵢ · f dS.
Source: the lecture's definition of Qᵢ; Szabó, Höhere Technische Mechanik, §I.4.
"""

from __future__ import annotations

from ...mechanics.contributions import DistributedForce
from ..formula import Dot, Explicit, Integral, Named, Partial, Quantity, Term
from ..step import Relation, Step
from ..system import System

RULE = "work-of-distributed-force"
LOAD = DistributedForce


def apply(system: System, load: DistributedForce, subject: str) -> Step:
    """δW = ∫ f · δr over the material: by the letters, with f and δr put in, and integrated."""
    bounds = system.bounds(load.material)
    displacement = system.virtual_displacement(load.place)
    members = (
        Named(Quantity("virtual-work", load.source, load.place), system.virtual_work(load)),
        Integral(
            Dot(_density(system, load), Named(Quantity("virtual-displacement", load.place), displacement)), bounds
        ),
        Integral(Dot(Explicit(system.force(load)), Explicit(displacement)), bounds),
        Explicit(system.virtual_work(load)),
    )
    about = {"load": load.source, "place": load.place}
    return Step(RULE, subject, (Relation(members),), (f"load:{load.source}",), about)


def share(system: System, load: DistributedForce, coordinate: str) -> Term:
    """∫ f · ∂r/∂qᵢ dS"""
    lever = Partial(system.named_position(load.place), system.q(coordinate))
    integrand = Dot(_density(system, load), lever)
    return Term(Integral(integrand, system.bounds(load.material)), (f"load:{load.source}",))


def _density(system: System, load: DistributedForce) -> Named:
    return Named(Quantity("force-density", load.source, load.place), system.force(load))
