"""Conserved quantities: momenta of cyclic coordinates, the Jacobi energy; and Routh's function, made of the former."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..language.derivatives import diff
from ..language.memory import cached_method
from .accelerations import accelerations
from .system import System

MOST_CYCLIC = 2


@cached_method
def is_cyclic(system: System, coordinate: str) -> bool:
    """Whether neither L nor another force or reaction acts on the coordinate: its momentum is conserved."""
    passive = system.is_zero(system.nonconservative_force(coordinate) + system.reaction(coordinate))
    return passive and system.is_zero(system.slope(system.lagrangian, system.q(coordinate)))


def cyclic(system: System) -> tuple[str, ...]:
    """The coordinates whose momenta are conserved."""
    return tuple(q for q in system.free if is_cyclic(system, q))


@cached_method
def jacobi_energy(system: System) -> sp.Expr:
    """h = Σ q̇ᵢ ∂L/∂q̇ᵢ − L"""
    work = sp.Add(*(system.rate(q) * system.momentum(q) for q in system.free))
    energy = system.kinetic_energy + system.potential_energy
    return energy if system.is_zero(work - system.lagrangian - energy) else system.display(work - system.lagrangian)


@cached_method
def power(system: System) -> sp.Expr:
    """Σ Qᵢᵈ q̇ᵢ: what the forces without potential feed in."""
    return system.display(sp.Add(*(system.nonconservative_force(q) * system.rate(q) for q in system.free)))


@cached_method
def is_passive(system: System) -> bool:
    """Whether the forces without potential never feed energy in, by the look of their power: −c |v|³ ≤ 0."""
    found = power(system)
    return system.is_zero(found) or bool(found.is_nonpositive)


@cached_method
def jacobi_energy_rate(system: System) -> sp.Expr:
    """dh/dt along the motion: Σ Qᵢᵈ q̇ᵢ − Σ λ b − ∂L/∂t."""
    return system.display(power(system) + system.reaction_power() - system.slope(system.lagrangian, system.t))


@cached_method
def is_energy(system: System) -> bool:
    """Whether h = E + V."""
    return system.is_zero(jacobi_energy(system) - system.kinetic_energy - system.potential_energy)


@cached_method
def keeps_energy(system: System) -> bool | None:
    """Whether d(E + V)/dt = 0 along the motion, as what is prescribed need not do work; None where q̈ is too long."""
    by_motion = accelerations(system)
    if by_motion is None:
        return None
    energy = system.kinetic_energy + system.potential_energy
    steps = [(system.q(q), system.rate(q)) for q in system.free]
    steps += [(system.rate(q), by_motion[system.acceleration(q)]) for q in system.free]
    change = system.slope(energy, system.t) + sp.Add(*(system.slope(energy, x) * by for x, by in steps))
    return system.is_zero(change)


def potential_that_decides(system: System) -> dict[str, str]:
    """What a sentence calls h at rest: V, or the effective potential −L(q, 0), which prescribed motion adds to."""
    name = "potential" if is_energy(system) else "effective-potential"
    return {"potential": name, "of_potential": f"of-{name}"}


@dataclass(frozen=True)
class Reduction:
    """Routh's function in momenta pᵢ instead of cyclic rates: `rates` are these rates, solved for."""

    momenta: dict[str, sp.Symbol]
    rates: dict[str, sp.Expr]
    function: sp.Expr


@cached_method
def reduction(system: System) -> Reduction | None:
    """R(q, q̇, p) = L − Σ pᵢ q̇ᵢ of the cyclic coordinates; None where there is none, or nothing else that moves."""
    names = () if system.conditions else cyclic(system)
    if not names or len(names) > MOST_CYCLIC or len(names) == len(system.free):
        return None
    momenta = {q: system.fresh(f"p_{q}", f"p_{q}_0", f"momentum_{q}") for q in names}
    rates = solved_rates(system, momenta)
    if rates is None:
        return None
    still = {system.rate(q): system.zero for q in names}
    gained = ((p - system.momentum(q).xreplace(still)) * rates[q] for q, p in momenta.items())
    # L is quadratic in the cyclic rates: L = L₀ + b q̇ + q̇ᵀA q̇/2 with p = b + A q̇, so L − p q̇ = L₀ − (p − b) q̇/2.
    function = system.display(system.lagrangian.xreplace(still) - sp.Add(*gained) / 2)
    return Reduction(momenta, rates, function)


def solved_rates(system: System, momenta: dict[str, sp.Symbol]) -> dict[str, sp.Expr] | None:
    """The cyclic rates from pᵢ = ∂L/∂q̇ᵢ, which is linear in them."""
    rates = [system.rate(q) for q in momenta]
    laws = [system.momentum(q) for q in momenta]
    matrix = sp.Matrix([[diff(law, rate) for rate in rates] for law in laws])
    determinant = system.display(matrix.det(method="berkowitz"))
    if determinant == 0:
        return None
    rest = dict.fromkeys(rates, system.zero)
    right = sp.Matrix([p - law.xreplace(rest) for p, law in zip(momenta.values(), laws, strict=True)])
    solution = matrix.adjugate() * right / determinant
    return {q: system.display(value) for q, value in zip(momenta, solution, strict=True)}
