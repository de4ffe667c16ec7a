"""Rayleigh's dissipation function of forces that are linear in the rates.

Q = −C(q, t) q̇ with a symmetric C comes from R = 1/2 q̇ᵀC q̇, as Qᵢ = −∂R/∂q̇ᵢ.
Source: Rayleigh, The Theory of Sound, vol. 1, §81; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
"""

from __future__ import annotations

from itertools import combinations

import sympy as sp
from flint import acb_mat, arb

from ..language.derivatives import diff
from ..language.memory import cached_method
from .spectrum import ZERO
from .system import System


@cached_method
def dissipation_function(system: System, load: str) -> sp.Expr | None:
    """R of a load, if its forces are linear in the rates with a symmetric matrix."""
    rates = [system.rate(q) for q in system.free]
    forces = [system.load_force(load, q) for q in system.free]
    slopes = [[-diff(force, rate) for rate in rates] for force in forces]
    if any(slope.has(*rates) for row in slopes for slope in row):
        return None
    at_rest = dict.fromkeys(rates, system.zero)
    if not all(system.is_zero(force.xreplace(at_rest)) for force in forces):
        return None
    if not all(system.is_zero(slopes[i][k] - slopes[k][i]) for i, k in combinations(range(len(rates)), 2)):
        return None
    function = sum((slopes[i][k] * a * b for i, a in enumerate(rates) for k, b in enumerate(rates)), system.zero) / 2
    return None if system.is_zero(function) else system.display(function)


@cached_method
def dissipative_loads(system: System) -> tuple[str, ...]:
    """The loads without potential that have a dissipation function."""
    loads = _outside_lagrangian(system)
    return tuple(load for load in loads if dissipation_function(system, load) is not None)


@cached_method
def remaining_loads(system: System) -> tuple[str, ...]:
    """The loads with neither potential nor dissipation function."""
    known = dissipative_loads(system)
    return tuple(load for load in _outside_lagrangian(system) if load not in known)


def _outside_lagrangian(system: System) -> tuple[str, ...]:
    """The loads whose forces come from no potential, generalized ones included."""
    known = system.sources_of_lagrangian
    return tuple(load for load in system.load_names if f"load:{load}" not in known)


def is_dissipative(system: System, damping: list[arb]) -> bool:
    """Whether every force without potential has a dissipation function, and none of them feeds energy in."""
    if remaining_loads(system) or not dissipative_loads(system) or system.lagrangian.has(system.t):
        return False
    size = len(system.free)
    symmetric = [(damping[i * size + k] + damping[k * size + i]) / 2 for i in range(size) for k in range(size)]
    largest = max(map(abs, damping), default=arb(0))
    values = acb_mat(size, size, symmetric).eig(algorithm="approx")
    return all(bool(value.real >= -ZERO * largest) for value in values)
