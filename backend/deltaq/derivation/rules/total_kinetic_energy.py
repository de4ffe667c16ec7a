"""Additivity: the kinetic energy of a system is the sum over its bodies, E = Σ E⁽ᵇ⁾.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.2.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Plus, Quantity, Term
from ..step import Relation, Step
from ..system import System

RULE = "kinetic-energy"


def apply(system: System) -> Step:
    """E = Σ E⁽ᵇ⁾ by the letters, each term with its body as the source, then the sum written out."""
    bodies = system.scene.bodies
    terms = tuple(
        Term(Named(Quantity("kinetic-energy", body.name), system.kinetic_energy_of(body)), (f"body:{body.name}",))
        for body in bodies
    )
    total = system.kinetic_energy
    line = Relation((Named(Quantity("kinetic-energy"), total), Plus(terms), Explicit(total)))
    return Step(RULE, "", (line,), tuple(f"body:{body.name}" for body in bodies))
