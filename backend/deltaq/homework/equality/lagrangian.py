"""Lagrange functions: equal up to a constant and a total time derivative dF(q, t)/dt, which the equations do not see.

L and L′ have the same equations exactly if the Euler–Lagrange expression of L′ − L vanishes identically.
Source: Landau, Lifshitz, Mechanics, §2.
"""

from __future__ import annotations

import sympy as sp

from ...language.canonical import is_zero
from ..sampling import Sampler, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts, up_to_constant, weakest


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The Euler–Lagrange expressions of every coordinate at all points."""
    (part,) = parts
    solution = sampler.solution
    values = tuple(v for q in solution.free for v in sampler.values(_euler_lagrange(part, q, solution)))
    return values if defined(values) else None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether L′ − L is constant, or its Euler–Lagrange expressions vanish identically."""
    constant = up_to_constant.same(given, right, solution)
    if constant.equal:
        return constant
    (own,), (true,) = given, right
    difference = own - true
    if difference.free_symbols & {solution.acceleration(q) for q in solution.coordinates}:
        return Match(equal=False)
    equal = weakest([is_zero(_euler_lagrange(difference, q, solution), solution.symbols) for q in solution.free])
    return Match(equal, "total-derivative" if equal else "")


def _euler_lagrange(lagrangian: sp.Expr, coordinate: str, solution: Solution) -> sp.Expr:
    """d/dt ∂L/∂q̇ − ∂L/∂q"""
    return solution.time_derivative(lagrangian.diff(solution.rate(coordinate))) - lagrangian.diff(
        solution.q(coordinate)
    )
