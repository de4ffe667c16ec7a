"""Lagrange's equation: d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ = Qᵢᵈ for every free coordinate, of the second kind.

With constraints on it the reactions Σ λ aᵢ stand on the right as well.

Source: Lagrange, Mécanique analytique (1788); Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Equation, Explicit, Named, Partial, Plus, Quantity, Rate
from ..step import Relation, Step
from ..system import System
from ..terms import terms_by_source
from ._lagrange import left_side, right_side

RULE = "equation"
MOMENTUM, MOMENTUM_RATE, SLOPE = "momentum", "momentum-rate", "lagrangian-slope"


def apply(system: System, coordinate: str) -> Step:
    """The equation of one coordinate: its three parts as substeps, then all terms on one side."""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    terms = terms_by_source(system, coordinate)
    written = Equation(Plus(terms) if terms else Explicit(system.zero), Explicit(sp.Integer(0)))
    sources = tuple(dict.fromkeys(source for term in terms for source in term.sources))
    line = Relation((Equation(left_side(system, coordinate), right_side(system, coordinate)), written), "⇔")
    outcome = "constrained" if system.bound_by(coordinate) else "text"
    step = Step(RULE, coordinate, (line,), sources, {"outcome": outcome, "coordinate": coordinate})
    return step.with_substeps(*parts(system, coordinate, lagrangian))


def parts(system: System, coordinate: str, lagrangian: Named) -> tuple[Step, ...]:
    """∂L/∂q̇, its rate, and ∂L/∂q."""
    rate, q = system.rate(coordinate), system.q(coordinate)
    momentum = system.momentum(coordinate)
    name = Named(Quantity("momentum", coordinate), momentum)
    about = {"coordinate": coordinate}
    change, slope = _with_what_cancels(system.shown_rate(momentum), system.derivative(system.lagrangian, q))
    lines = {
        MOMENTUM: (name, Partial(lagrangian, rate), Explicit(momentum)),
        MOMENTUM_RATE: (Rate(name), Explicit(change)),
        SLOPE: (Partial(lagrangian, q), Explicit(slope)),
    }
    return tuple(Step(rule, coordinate, (Relation(members),), (), about) for rule, members in lines.items())


def _with_what_cancels(change: sp.Expr, slope: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Both multiplied out where a term of one cancels one of the other, so that it stands alone; else as they are."""
    apart = [sp.Add(*(sp.expand_mul(term, deep=False) for term in sp.Add.make_args(part))) for part in (change, slope)]
    terms = [set(sp.Add.make_args(part)) for part in apart]
    return (apart[0], apart[1]) if terms[0] & terms[1] else (change, slope)
