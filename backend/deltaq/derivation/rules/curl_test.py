"""Curl test: generalized forces Q(q, t) have a potential if and only if ∂Qᵢ/∂qₖ = ∂Qₖ/∂qᵢ for all pairs.

The space of coordinates is taken as simply connected; forces that depend on rates have none. Time is held fixed: a
force that depends on it explicitly may have a potential V(q, t), as δW does not know dt.
Source: Arnold, Mathematical Methods of Classical Mechanics, 2nd ed., §5 and §36 (Poincaré's lemma).
"""

from __future__ import annotations

from itertools import combinations

import sympy as sp

from ...language.derivatives import diff
from ...vocabulary import CurlOutcome
from ..formula import Explicit, Named, Partial, Quantity
from ..step import Relation, Step
from ..system import System

RULE = "curl-test"


def apply(system: System, load: str) -> Step:
    """The test for one load; the pairs that differ are shown with ≠."""
    pairs = combinations(system.free, 2)
    lines = tuple(line for a, b in pairs for line in _compare(system, load, a, b))
    return Step(RULE, load, lines, (f"load:{load}",), {"load": load, "outcome": outcome(system, load)})


def outcome(system: System, load: str) -> CurlOutcome:
    """What the test says, in one word of the catalog."""
    if system.has_potential(load) and not system.is_conservative(load):
        return "no-closed-form"
    if system.is_conservative(load):
        timed = any(system.load_force(load, q).has(system.t) for q in system.free)
        if len(system.free) > 1:
            return "conservative-in-time" if timed else "conservative"
        return "single-in-time" if timed else "single"
    if system.is_generalized(load):
        return "generalized"
    rates = {system.rate(q) for q in system.free}
    moving = any(system.load_force(load, q).free_symbols & rates for q in system.free)
    return "rates" if moving else "nonconservative"


def _compare(system: System, load: str, first: str, second: str) -> tuple[Relation, ...]:
    """∂Qᵢ/∂qₖ = a = ∂Qₖ/∂qᵢ in one line, or both values and that they differ."""
    left, right = _cross_derivative(system, load, first, second), _cross_derivative(system, load, second, first)
    alike = system.is_zero(left[1].value - right[1].value)
    if system.has_potential(load) or (alike and not _differ_at_jumps(system, load, first, second)):
        return (Relation((*left, right[0])),)
    if alike:  # at a jump alone they differ, where they are no numbers
        return ()
    return Relation(left), Relation(right), Relation((left[0], right[0]), "≠")


def _differ_at_jumps(system: System, load: str, first: str, second: str) -> bool:
    forces = system.load_force(load, first), system.load_force(load, second)
    impulses = [diff(force, system.q(by)) for force, by in zip(forces, (second, first), strict=True)]
    return any(each.has(sp.DiracDelta) for each in impulses) and not system.is_zero(impulses[0] - impulses[1])


def _cross_derivative(system: System, load: str, of: str, by: str) -> tuple[Partial, Explicit]:
    force = system.load_force(load, of)
    named = Named(Quantity("generalized-force", of, load), force)
    return Partial(named, system.q(by)), Explicit(system.derivative(force, system.q(by)))
