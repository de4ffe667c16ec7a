"""The equations of motion solved for what they say of accelerations: M(q, t) q̈ = f(q, q̇, t)."""

from __future__ import annotations

import sympy as sp

from ..language.memory import cached_method
from ..language.textbook import negated
from .calculus import column
from .system import System
from .terms import terms_by_source


@cached_method
def left_side(system: System, coordinate: str) -> sp.Expr:
    """d/dt ∂L/∂q̇ − ∂L/∂q − Qᵈ, written out."""
    terms = terms_by_source(system, coordinate)
    return sp.Add(*(term.written_out if term.sign > 0 else negated(term.written_out) for term in terms))


@cached_method
def mass_matrix(system: System) -> sp.ImmutableMatrix:
    """M(q, t), symmetric."""
    accelerations = [system.acceleration(q) for q in system.free]
    return system.display(
        sp.ImmutableMatrix([[system.slope(left_side(system, q), a) for a in accelerations] for q in system.free])
    )


@cached_method
def forcing(system: System) -> sp.ImmutableMatrix:
    """f(q, q̇, t): what does not hang on accelerations, on the right."""
    at_rest = {system.acceleration(q): system.zero for q in system.free}
    return system.display(column(-left_side(system, q).xreplace(at_rest) for q in system.free))


@cached_method
def forces_at_rest(system: System) -> sp.ImmutableMatrix:
    """f(q, 0, t): what acts while nothing moves."""
    at_rest = {system.rate(q): system.zero for q in system.free}
    return system.display(forcing(system).xreplace(at_rest))


def is_autonomous(system: System) -> bool:
    """Whether the equations of motion do not depend on time explicitly."""
    return not (mass_matrix(system).has(system.t) or forcing(system).has(system.t))
