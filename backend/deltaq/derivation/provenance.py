"""What each body and load adds to the results: pairs of a source, `body:bob` or `load:weight`, and its share.

Energies, virtual works and all that is linear in them are sums over bodies and loads.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..language.derivatives import beside_jumps, diff
from ..language.memory import cached_method
from .generator import Symmetry, solved
from .system import System

Share = tuple[str, sp.Expr]


def of_virtual_work(system: System) -> Iterator[Share]:
    """δW = Σ Qᵢ δqᵢ of each load."""
    for load in system.load_names:
        yield f"load:{load}", sp.Add(*(system.load_force(load, q) * system.variation(q) for q in system.free))


def of_kinetic_energy(system: System) -> Iterator[Share]:
    """E = Σ E of each body."""
    for body in system.scene.bodies:
        yield f"body:{body.name}", system.kinetic_energy_of(body)


def of_potential_energy(system: System) -> Iterator[Share]:
    """V = Σ V of each load that has a potential."""
    yield from _of_static_potentials(system)
    for load in system.generalized_loads:
        still = system.at_rest(system.velocity_potential(load))
        if still != 0:
            yield f"load:{load}", still


def _of_static_potentials(system: System) -> Iterator[Share]:
    """V of each load that has a potential V(q, t)."""
    for load in filter(system.is_conservative, system.load_names):
        yield f"load:{load}", system.load_potential(load)


def _of_rates(system: System) -> Iterator[Share]:
    """U − U₀ of each load with a generalized potential."""
    for load in system.generalized_loads:
        function = system.velocity_potential(load)
        yield f"load:{load}", function - system.at_rest(function)


def of_lagrangian(system: System) -> Iterator[Share]:
    """E − V − U"""
    yield from of_kinetic_energy(system)
    for source, energy in (*of_potential_energy(system), *_of_rates(system)):
        yield source, -energy


def of_force(system: System, coordinate: str) -> Iterator[Share]:
    """Qᵢ"""
    for load in system.load_names:
        yield f"load:{load}", system.load_force(load, coordinate)


def of_conservative_force(system: System, coordinate: str) -> Iterator[Share]:
    """Qᵢᵖ = −∂V/∂qᵢ, and the forces of generalized potentials"""
    for source, energy in _of_static_potentials(system):
        yield source, -beside_jumps(diff(energy, system.q(coordinate)))
    for load in system.generalized_loads:
        yield f"load:{load}", system.load_force(load, coordinate)


def of_nonconservative_force(system: System, coordinate: str) -> Iterator[Share]:
    """Qᵢᵈ"""
    for load in system.load_names:
        if not (system.is_conservative(load) or system.is_generalized(load)):
            yield f"load:{load}", system.load_force(load, coordinate)


def of_momentum(system: System, coordinate: str) -> Iterator[Share]:
    """∂L/∂q̇ᵢ; of the potentials only generalized ones depend on rates."""
    for source, energy in of_kinetic_energy(system):
        yield source, system.slope(energy, system.rate(coordinate))
    for source, energy in _of_rates(system):
        yield source, -system.slope(energy, system.rate(coordinate))


def of_jacobi_energy(system: System) -> Iterator[Share]:
    """h = Σ q̇ᵢ ∂E/∂q̇ᵢ − E + V"""
    for source, energy in of_kinetic_energy(system):
        work = sp.Add(*(system.rate(q) * system.slope(energy, system.rate(q)) for q in system.free))
        yield source, work - energy
    yield from of_potential_energy(system)


def of_symmetry(system: System, symmetry: Symmetry) -> Iterator[Share]:
    """Σ ξᵢ ∂L/∂q̇ᵢ − τ h: what is left of the integral without its gauge function, which is the work of all together."""
    time, special = symmetry.generator.time, solved(symmetry.conditions, system)
    changes = symmetry.generator.characteristic(system)
    for source, energy in of_kinetic_energy(system):
        moved = sp.Add(*(change * system.slope(energy, system.rate(q)) for q, change in changes.items()))
        yield source, (moved + time * energy).xreplace(special)
    for source, energy in of_potential_energy(system):
        yield source, (-time * energy).xreplace(special)
    for source, energy in _of_rates(system):
        moved = (change * system.slope(energy, system.rate(q)) for q, change in changes.items())
        yield source, -(sp.Add(*moved) + time * energy).xreplace(special)


@cached_method
def of_equation(system: System, coordinate: str) -> tuple[Share, ...]:
    """d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ − Qᵢᵈ − Σ λ aᵢ, the left side of `… = 0`."""
    parts = _of_inertia(system, coordinate), _of_loads(system, coordinate), _of_constraints(system, coordinate)
    return tuple(share for part in parts for share in part)


def _of_inertia(system: System, coordinate: str) -> Iterator[Share]:
    for source, energy in of_kinetic_energy(system):
        yield source, system.euler_expression(energy, coordinate)


def _of_constraints(system: System, coordinate: str) -> Iterator[Share]:
    for condition in system.conditions:
        yield f"constraint:{condition.source}", -system.reaction_share(condition, coordinate)


def _of_loads(system: System, coordinate: str) -> Iterator[Share]:
    for load in system.load_names:
        if system.is_conservative(load):
            yield f"load:{load}", beside_jumps(diff(system.load_potential(load), system.q(coordinate)))
        else:
            yield f"load:{load}", -system.load_force(load, coordinate)
