"""Hamilton's function H(q, p, t) = Σ pᵢ q̇ᵢ − L with the rates by the momenta pᵢ = ∂L/∂q̇ᵢ.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.1; Landau, Lifshitz, Mechanics, §40.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from ..language.memory import cached_method
from .conservation import jacobi_energy, solved_rates
from .system import System

MOST_FREE = 3  # degrees of freedom: the inverse of a larger mass matrix is no formula to be read


@dataclass(frozen=True)
class Hamiltonian:
    """H in the momenta; `rates` are q̇ in them, `given` the momenta in the rates."""

    momenta: Mapping[str, sp.Symbol]
    rates: Mapping[str, sp.Expr]
    given: Mapping[sp.Symbol, sp.Expr]
    function: sp.Expr


@cached_method
def hamiltonian(system: System) -> Hamiltonian | None:
    """None where there are too many degrees of freedom, or where momenta do not determine the rates."""
    if len(system.free) > MOST_FREE:
        return None
    momenta = {q: system.fresh(f"p_{q}", f"p_{q}_0", f"momentum_{q}") for q in system.free}
    rates = solved_rates(system, momenta)
    if rates is None:
        return None
    inserted = {system.rate(q): rate for q, rate in rates.items()}
    still = dict.fromkeys(inserted, system.zero)
    # L = L₀ + b q̇ + q̇ᵀM q̇/2 and p = b + M q̇, so p q̇ − L = (p − b) q̇/2 − L₀.
    gained = sp.Add(*((p - system.momentum(q).xreplace(still)) * rates[q] for q, p in momenta.items()))
    function = system.display(gained / 2 - system.lagrangian.xreplace(still))
    given = {p: system.momentum(q) for q, p in momenta.items()}
    return Hamiltonian(momenta, rates, given, function)


def in_momenta(system: System, found: Hamiltonian, value: sp.Expr) -> sp.Expr:
    """An expression in q, p and t instead of q, q̇ and t."""
    if value == jacobi_energy(system):
        return found.function
    return system.display(value.xreplace({system.rate(q): rate for q, rate in found.rates.items()}))
