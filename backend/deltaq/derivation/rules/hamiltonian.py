"""Hamilton's function: the Legendre transform of L, H(q, p, t) = Σ pᵢ q̇ᵢ − L, has the momenta for variables.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.1; Landau, Lifshitz, Mechanics, §40.
"""

from __future__ import annotations

from ..conservation import jacobi_energy
from ..formula import Explicit, Formula, Inserted, Named, Partial, Plus, Quantity, Term, Times, minus
from ..hamiltonian import Hamiltonian
from ..step import Relation, Step
from ..system import System

RULE = "hamiltonian"


def apply(system: System, found: Hamiltonian | None) -> Step:
    """The momenta, the rates by them, and H."""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    if found is None:
        energy = Named(Quantity("jacobi-energy"), jacobi_energy(system))
        slopes: dict[str, Formula] = {q: Partial(lagrangian, system.rate(q)) for q in system.free}
        line = Relation((energy, _transform(system, slopes, lagrangian), Explicit(energy.value)))
        return Step(RULE, "", (line,), (), {"outcome": "implicit"})
    name = Named(Quantity("hamiltonian"), found.function)
    law = _transform(system, {q: Explicit(p) for q, p in found.momenta.items()}, lagrangian)
    members: tuple[Formula, ...] = (name, law, Explicit(found.function))
    lines = (
        *(_momentum(system, found, q, lagrangian) for q in system.free),
        *(_rate(system, found, q) for q in system.free),
        Relation(tuple(Inserted(member, found.given) for member in members)),
    )
    return Step(RULE, "", lines)


def _momentum(system: System, found: Hamiltonian, q: str, lagrangian: Named) -> Relation:
    symbol = Inserted(Explicit(found.momenta[q]), found.given)
    return Relation((symbol, Partial(lagrangian, system.rate(q)), Explicit(system.momentum(q))))


def _rate(system: System, found: Hamiltonian, q: str) -> Relation:
    return Relation((Explicit(system.rate(q)), Inserted(Explicit(found.rates[q]), found.given)))


def _transform(system: System, slopes: dict[str, Formula], lagrangian: Named) -> Plus:
    """Σ pᵢ q̇ᵢ − L"""
    works = (Term(Times((slope, Explicit(system.rate(q))))) for q, slope in slopes.items())
    return Plus((*works, minus(lagrangian)))
