"""The equations of motion solved for what they say of accelerations: M(q, t) q̈ = f(q, q̇, t)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy as sp

from ..language.derivatives import diff
from ..language.memory import cached_method
from ..language.textbook import negated
from .calculus import column
from .formula import Term
from .system import System
from .terms import terms_by_source


@cached_method
def left_side(system: System, coordinate: str) -> sp.Expr:
    """d/dt ∂L/∂q̇ − ∂L/∂q − Qᵈ − Σ λ a, written out."""
    terms = terms_by_source(system, coordinate)
    return sp.Add(*(term.written_out if term.sign > 0 else negated(term.written_out) for term in terms))


@cached_method
def mass_matrix(system: System) -> sp.ImmutableMatrix:
    """M(q, t), symmetric."""
    accelerations = [system.acceleration(q) for q in system.free]
    rows = (slopes(system, terms_by_source(system, q)) for q in system.free)
    return sp.ImmutableMatrix([[_sum(row.get(a, ())) for a in accelerations] for row in rows])


def slopes(system: System, terms: Iterable[Term]) -> Mapping[sp.Symbol, tuple[tuple[Term, sp.Expr], ...]]:
    """What stands before each acceleration that the terms hang on, term by term."""
    accelerations = {system.acceleration(q) for q in system.free}
    found: dict[sp.Symbol, list[tuple[Term, sp.Expr]]] = {}
    for term in terms:
        for acceleration in accelerations & system.symbols_in(term.written_out):
            slope = diff(term.written_out, acceleration)
            if slope != 0:
                found.setdefault(acceleration, []).append((term, slope))
    return {acceleration: tuple(each) for acceleration, each in found.items()}


def _sum(slopes: Iterable[tuple[Term, sp.Expr]]) -> sp.Expr:
    return sp.Add(*(slope if term.sign > 0 else negated(slope) for term, slope in slopes))


@cached_method
def forcing(system: System) -> sp.ImmutableMatrix:
    """f(q, q̇, t): what hangs neither on accelerations nor on multipliers, on the right."""
    return column(_rest(system, q) for q in system.free)


def _rest(system: System, coordinate: str) -> sp.Expr:
    at_rest = dict.fromkeys((*map(system.acceleration, system.free), *system.multipliers), system.zero)
    terms = [(t, system.symbols_in(t.written_out).isdisjoint(at_rest)) for t in terms_by_source(system, coordinate)]
    outside = (t for t, is_outside in terms if is_outside)
    inside = [t.sign * t.written_out.xreplace(at_rest) for t, is_outside in terms if not is_outside]
    return sp.Add(*(negated(t.written_out) if t.sign > 0 else t.written_out for t in outside), -sp.Add(*inside))


@cached_method
def forces_at_rest(system: System) -> sp.ImmutableMatrix:
    """f(q, 0, t): what acts while nothing moves."""
    at_rest = system.zero_rates
    return system.display(forcing(system).xreplace(at_rest))


def is_autonomous(system: System) -> bool:
    """Whether the equations of motion do not depend on time explicitly."""
    laws = (*mass_matrix(system), *forcing(system), *map(system.condition, system.conditions))
    return all(system.is_zero(diff(law, system.t)) for law in laws if law.has(system.t))
